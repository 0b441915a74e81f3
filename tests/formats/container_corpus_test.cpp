// Replays fuzz/corpus/container: what the fuzzer found interesting, and what it once found wrong.
#include "tests/formats/read_everything.h"
#include "tests/formats/tree_maker.h"

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
  EXPECT_GE(sound, 6) << "write them again: --gtest_also_run_disabled_tests --gtest_filter='*WritesTheSeeds'";
}

TEST(ContainerCorpus, DISABLED_WritesTheSeeds) {
  fs::create_directories(k_corpus);
  for (const TreeKind kind : {TreeKind::still, TreeKind::sensitive}) {
    for (const bool constant : {false, true}) {
      for (const Encoding encoding : {Encoding::raw, Encoding::zstd}) {
        const std::uint32_t one = constant ? 2 : 0;
        const Tree tree = make_tree({.kind = kind,
                                     .roots = 1,
                                     .radii = 4,
                                     .leaves = 3,
                                     .groups = 2,
                                     .ring = one,
                                     .segment = one,
                                     .leaf = one,
                                     .one_material = constant},
                                    1);
        const auto bytes = encode_tree(
            tree, {.encoding = encoding,
                   .omit = constant ? std::vector<std::string>{"TNRM", "TTEX"} : std::vector<std::string>{}});
        const std::string name = std::string(encoding == Encoding::raw ? "raw" : "zstd") +
                                 (constant ? "_constant" : "") +
                                 (kind == TreeKind::still ? ".tree" : ".stree");
        std::ofstream(k_corpus / name, std::ios::binary)
            .write(reinterpret_cast<const char*>(bytes->data()), static_cast<std::streamsize>(bytes->size()));
      }
    }
  }
}

}  // namespace
}  // namespace copse
