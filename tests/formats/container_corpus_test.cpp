// Replays fuzz/corpus/container: what the fuzzer found interesting, and what it once found wrong.
#include "tests/formats/read_everything.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

namespace copse {
namespace {

namespace fs = std::filesystem;
const fs::path k_corpus = fs::path(COPSE_SOURCE_DIR) / "fuzz/corpus/container";

TEST(ContainerCorpus, IsRefusedOrSound) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(k_corpus)) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  ASSERT_GT(files.size(), 4u);
  for (const fs::path& path : files) {
    std::ifstream in(path, std::ios::binary);
    const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(in), {}};
    EXPECT_EQ(read_everything(bytes), "") << path;
  }
}

// The fuzzer needs seeds that are sound, or it would never see past the header.
TEST(ContainerCorpus, HasSoundSeeds) {
  int sound = 0;
  for (const auto& entry : fs::directory_iterator(k_corpus)) {
    const auto file = TreeFile::open(entry.path());
    if (file && file->load()) ++sound;
  }
  EXPECT_GE(sound, 6) << "write them again: fuzz_container_seeds fuzz/corpus/container";
}

}  // namespace
}  // namespace copse
