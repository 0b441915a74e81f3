#include "lib/formats/container/atomic_file.h"

#include "lib/formats/hash.h"

#include <csignal>
#include <fstream>
#include <sstream>
#include <thread>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

namespace copse {
namespace {

namespace fs = std::filesystem;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

class AtomicFile : public testing::Test {
 protected:
  void SetUp() override {
    std::string name = testing::TempDir() + "copse_atomic_XXXXXX";
    folder = ::mkdtemp(name.data());
  }
  void TearDown() override { fs::remove_all(folder); }

  fs::path at(const std::string& name) const { return folder / name; }
  std::string text(const std::string& name) const {
    std::ifstream in(at(name), std::ios::binary);
    std::ostringstream out;
    out << in.rdbuf();
    return out.str();
  }
  std::vector<std::string> names() const {
    std::vector<std::string> out;
    for (const auto& entry : fs::directory_iterator(folder)) out.push_back(entry.path().filename());
    std::sort(out.begin(), out.end());
    return out;
  }
  fs::path folder;
};

TEST_F(AtomicFile, WritesTheBytesAndNothingElse) {
  const std::string bytes("a\0b\n", 4);
  ASSERT_TRUE(write_file(at("out"), bytes));
  EXPECT_EQ(text("out"), bytes);
  EXPECT_THAT(names(), ElementsAre("out"));
  ASSERT_TRUE(write_file(at("out"), std::string_view()));
  EXPECT_EQ(text("out"), "");
}

TEST_F(AtomicFile, PiecesAreWrittenOneAfterTheOther) {
  Pieces pieces = Pieces::borrowed("ab");
  pieces.add(std::vector<std::uint8_t>{'c', 0});
  pieces.add({});
  pieces.add(std::vector<std::uint8_t>{'d'});
  EXPECT_EQ(pieces.size(), 5u);
  ASSERT_TRUE(write_file(at("out"), pieces));
  EXPECT_EQ(text("out"), std::string("abc\0d", 5));
  EXPECT_EQ(hash_of(pieces), hash_of(pieces.joined()));
}

TEST_F(AtomicFile, AGroupIsInvisibleUntilItIsCommitted) {
  ASSERT_TRUE(write_file(at("a"), "old"));
  OutputGroup group;
  ASSERT_TRUE(group.add(at("a"), "new"));
  ASSERT_TRUE(group.add(at("b"), "new"));
  EXPECT_EQ(text("a"), "old");
  EXPECT_FALSE(fs::exists(at("b")));
  ASSERT_TRUE(group.commit());
  EXPECT_EQ(text("a"), "new");
  EXPECT_EQ(text("b"), "new");
  EXPECT_THAT(names(), ElementsAre("a", "b"));
}

TEST_F(AtomicFile, WithoutCommitNoTraceIsLeft) {
  {
    OutputGroup group;
    ASSERT_TRUE(group.add(at("a"), "new"));
    OutputGroup moved(std::move(group));
    ASSERT_TRUE(moved.add(at("b"), "new"));
  }
  EXPECT_THAT(names(), IsEmpty());
}

TEST_F(AtomicFile, TheLaterOfTwoContentsWins) {
  OutputGroup group;
  ASSERT_TRUE(group.add(at("a"), "one"));
  ASSERT_TRUE(group.add(at("a"), "two"));
  ASSERT_TRUE(group.commit());
  EXPECT_EQ(text("a"), "two");
  EXPECT_THAT(names(), ElementsAre("a"));
}

TEST_F(AtomicFile, SaysWhyItCannotWrite) {
  const auto missing = write_file(at("no/such/folder"), "x");
  ASSERT_FALSE(missing);
  EXPECT_EQ(missing.error().fault, Fault::io);
  EXPECT_EQ(missing.error().file, at("no/such/folder").string());
  EXPECT_THAT(missing.error().what, HasSubstr("No such file"));
  fs::create_directory(at("folder"));
  EXPECT_THAT(write_file(at("folder"), "x").error().what, HasSubstr("is a folder"));
  EXPECT_FALSE(write_file("", "x"));
  EXPECT_THAT(write_file(at("folder") / "", "x").error().what, HasSubstr("folder"));
}

// A limit on the size of files stands in for a full disk: the same path of errors, without needing one.
TEST_F(AtomicFile, AFullDiskLeavesNothingBehind) {
  struct rlimit old {};
  ::getrlimit(RLIMIT_FSIZE, &old);
  struct rlimit small = old;
  small.rlim_cur = 1000;
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  ::setrlimit(RLIMIT_FSIZE, &small);
  OutputGroup group;
  const bool first = group.add(at("a"), "fits").has_value();
  const auto second = group.add(at("b"), std::string(5000, 'x'));
  ::setrlimit(RLIMIT_FSIZE, &old);
  std::signal(SIGXFSZ, handler);
  EXPECT_TRUE(first);
  ASSERT_FALSE(second);
  EXPECT_EQ(second.error().fault, Fault::io);
  EXPECT_THAT(second.error().what, HasSubstr("File too large"));
  group = OutputGroup();
  EXPECT_THAT(names(), IsEmpty());
}

TEST_F(AtomicFile, WritesThroughALink) {
  ASSERT_TRUE(write_file(at("target"), "old"));
  fs::create_symlink("target", at("link"));
  ASSERT_TRUE(write_file(at("link"), "new"));
  EXPECT_TRUE(fs::is_symlink(at("link")));
  EXPECT_EQ(text("target"), "new");
  fs::create_symlink("later", at("dangling"));
  ASSERT_TRUE(write_file(at("dangling"), "made"));
  EXPECT_EQ(text("later"), "made");
}

TEST_F(AtomicFile, KeepsThePermissionsOfWhatItReplaces) {
  ASSERT_TRUE(write_file(at("a"), "old"));
  ::chmod(at("a").c_str(), 0640);
  ASSERT_TRUE(write_file(at("a"), "new"));
  struct stat status {};
  ::stat(at("a").c_str(), &status);
  EXPECT_EQ(status.st_mode & 0777, 0640u);
}

TEST_F(AtomicFile, DoesNotReplaceAFileThatIsProtected) {
  if (::geteuid() == 0) {
    std::puts("root may write anything: the check of a protected file is skipped");
    return;
  }
  ASSERT_TRUE(write_file(at("a"), "old"));
  ::chmod(at("a").c_str(), 0444);
  EXPECT_FALSE(write_file(at("a"), "new"));
  EXPECT_EQ(text("a"), "old");
}

TEST_F(AtomicFile, APipeIsWrittenToNotReplaced) {
  ASSERT_EQ(::mkfifo(at("pipe").c_str(), 0600), 0);
  std::string got;
  std::jthread reader([&] {
    std::ifstream in(at("pipe"));
    std::getline(in, got);
  });
  ASSERT_TRUE(write_file(at("pipe"), "through\n"));
  reader.join();
  EXPECT_EQ(got, "through");
  EXPECT_TRUE(fs::is_fifo(at("pipe")));
}

}  // namespace
}  // namespace copse
