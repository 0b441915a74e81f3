#include "lib/formats/hash.h"

#include "lib/formats/container/atomic_file.h"
#include "lib/formats/container/mapped_file.h"

#include <csignal>
#include <thread>

#include <fcntl.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

namespace copse {
namespace {

using testing::HasSubstr;

std::string temporary(const std::string& name) {
  return testing::TempDir() + "copse_" + std::to_string(::getpid()) + "_" + name;
}

TEST(Hash, IsXxh3WithSeedZero) {
  EXPECT_EQ(xxh3(std::string_view()), 0x2d06800538d394c2u);  // published test vector of the empty input
  EXPECT_EQ(hash_of(std::string_view()), "xxh3:2d06800538d394c2");
  EXPECT_EQ(hash_text(0xabc), "xxh3:0000000000000abc");
}

TEST(Hash, OfAFileIsTheHashOfItsBytes) {
  const std::string path = temporary("hash");
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, (std::size_t{1} << 20) + 3}) {
    const std::string bytes(size, 'x');
    ASSERT_TRUE(write_file(path, bytes));
    const auto record = hash_file(path);
    ASSERT_TRUE(record);
    EXPECT_EQ(record->path, path);
    EXPECT_EQ(record->bytes, size);
    EXPECT_EQ(record->hash, hash_of(bytes));
  }
  ::unlink(path.c_str());
  EXPECT_EQ(hash_file(path).error().fault, Fault::io);
  EXPECT_EQ(hash_file(testing::TempDir()).error().fault, Fault::io);
}

TEST(MappedFile, GivesTheBytesOfAFileAndKeepsThem) {
  const std::string path = temporary("map");
  ASSERT_TRUE(write_file(path, "some bytes"));
  MappedFile file = *MappedFile::open(path);
  const MappedFile copy = file;
  file = MappedFile();
  ASSERT_TRUE(write_file(path, "other"));
  EXPECT_EQ(std::string(copy.bytes().begin(), copy.bytes().end()), "some bytes");
  ASSERT_TRUE(write_file(path, std::string_view()));
  EXPECT_TRUE(MappedFile::open(path)->bytes().empty());
  ::unlink(path.c_str());
}

TEST(MappedFile, ReadsAPipeToItsEnd) {
  const std::string path = temporary("fifo"), bytes(200000, 'y');
  ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
  std::jthread writer([&] { EXPECT_TRUE(write_file(path, bytes)); });
  const auto file = MappedFile::open(path);
  ASSERT_TRUE(file);
  EXPECT_EQ(std::string(file->bytes().begin(), file->bytes().end()), bytes);
  ::unlink(path.c_str());
}

TEST(MappedFile, RefusesAPipeThatGoesOn) {
  for (const std::size_t most :
       {std::size_t{0}, std::size_t{4095}, std::size_t{199999}, std::size_t{200000}}) {
    const std::string path = temporary("endless"), bytes(200000, 'y');
    ASSERT_EQ(::mkfifo(path.c_str(), 0600), 0);
    std::jthread writer([&] {
      ::signal(SIGPIPE, SIG_IGN);
      const int pipe = ::open(path.c_str(), O_WRONLY);
      for (std::size_t sent = 0; sent < bytes.size();) {
        const ssize_t n = ::write(pipe, bytes.data() + sent, bytes.size() - sent);
        if (n <= 0) break;  // the reader has left
        sent += static_cast<std::size_t>(n);
      }
      ::close(pipe);
    });
    const auto file = MappedFile::open(path, most);
    EXPECT_EQ(file.has_value(), most == bytes.size());
    if (!file) {
      EXPECT_EQ(file.error().what, "the pipe holds more than " + std::to_string(most) + " bytes");
    }
    ::unlink(path.c_str());
  }
}

TEST(MappedFile, RefusesWhatIsNoFile) {
  EXPECT_THAT(MappedFile::open(testing::TempDir()).error().what, HasSubstr("is a folder"));
  EXPECT_THAT(MappedFile::open("/dev/zero").error().what, HasSubstr("is not a file"));
  EXPECT_EQ(MappedFile::open(temporary("missing")).error().fault, Fault::io);
}

}  // namespace
}  // namespace copse
