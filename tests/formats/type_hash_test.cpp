#include "lib/formats/ecosystem/type_hash.h"

#include "lib/formats/hash.h"

#include <cstdio>
#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>

namespace copse {
namespace {

class TypeHash : public testing::Test {
 protected:
  void SetUp() override {
    std::filesystem::create_directory(folder_);
    std::ofstream(folder_ / "oak.stree") << "a tree";
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path folder_ = std::filesystem::path(testing::TempDir()) / "copse_type_hash";
  TreeType oak_{.name = "oak", .uri = "oak.stree", .hash = xxh3("a tree")};
};

TEST_F(TypeHash, TheTreeThatItWasMadeWithIsNotChanged) {
  EXPECT_EQ(changed_tree(oak_, folder_ / "oak.stree"), "");
  Ecosystem eco;
  eco.types = {oak_};
  EXPECT_TRUE(changed_trees(eco, folder_).empty());
}

TEST_F(TypeHash, AnotherFileIsNamedWithBothHashes) {
  std::ofstream(folder_ / "oak.stree") << "another";
  Ecosystem eco;
  eco.types = {oak_};
  const auto lines = changed_trees(eco, folder_);
  ASSERT_EQ(lines.size(), 1u);
  for (const std::string& part :
       {std::string("'oak'"), (folder_ / "oak.stree").string(), hash_of("a tree"), hash_of("another")})
    EXPECT_NE(lines[0].find(part), std::string::npos) << lines[0];
}

TEST_F(TypeHash, AFileThatIsNotThereIsSaid) {
  EXPECT_NE(changed_tree(oak_, folder_ / "none.stree").find("No such file"), std::string::npos);
}

TEST_F(TypeHash, APackedTreeIsLeftToItsChecksum) {
  Ecosystem eco;
  oak_.uri.clear();
  oak_.packed = std::vector<std::uint8_t>{1, 2, 3};
  eco.types = {oak_};
  EXPECT_TRUE(changed_trees(eco, folder_).empty());
}

}  // namespace
}  // namespace copse
