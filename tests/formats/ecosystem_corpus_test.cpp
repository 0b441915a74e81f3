// Replays fuzz/corpus/ecosystem, and 10 000 mutants of it.
#include "lib/formats/random.h"
#include "tests/formats/read_ecosystem.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

namespace copse {
namespace {

namespace fs = std::filesystem;
using tampering::Bytes;

std::vector<Bytes> corpus() {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::directory_iterator(fs::path(COPSE_SOURCE_DIR) / "fuzz/corpus/ecosystem"))
    paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  std::vector<Bytes> files;
  for (const fs::path& path : paths) {
    std::ifstream in(path, std::ios::binary);
    files.emplace_back(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  }
  return files;
}

// One to four changes: a bit, a number that is an edge case somewhere, a run copied over another, an end.
Bytes mutant(Bytes bytes, Random& random) {
  constexpr std::uint32_t k_edges[] = {0,          1,          0xffffffff, 0x7fffffff,
                                       0x80000000, 0x7f800000, 0x7fc00000, 0x00800000};
  for (std::uint64_t changes = 1 + random.below(4); changes > 0 && bytes.size() > 8; --changes) {
    const std::size_t at = random.below(bytes.size() - 4);
    switch (random.below(8)) {
      case 0:
        bytes.resize(random.below(bytes.size()));
        break;
      case 1: {
        const std::size_t from = random.below(bytes.size()), room = bytes.size() - std::max(at, from);
        const Bytes run(bytes.begin() + static_cast<std::ptrdiff_t>(from),
                        bytes.begin() + static_cast<std::ptrdiff_t>(
                                            from + random.below(std::min<std::size_t>(room, 64))));
        std::copy(run.begin(), run.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at));
        break;
      }
      case 2:
      case 3:
      case 4:
        put(std::span(bytes), at / 4 * 4, k_edges[random.below(8)]);
        break;
      default:
        bytes[at] ^= static_cast<std::uint8_t>(1u << random.below(8));
    }
  }
  return bytes;
}

TEST(EcosystemCorpus, IsRefusedOrSound) {
  for (const Bytes& bytes : corpus()) EXPECT_EQ(read_ecosystem(bytes), "");
}

// The fuzzer needs seeds that are sound, or it would never see past the header.
TEST(EcosystemCorpus, HasSoundSeeds) {
  int sound = 0;
  for (const Bytes& bytes : corpus()) {
    const auto file = EcosystemFile::from_bytes(bytes, "seed");
    sound += file && file->load();
  }
  EXPECT_GE(sound, 8) << "write them again: fuzz_ecosystem_seeds fuzz/corpus/ecosystem";
}

TEST(EcosystemCorpus, TenThousandMutantsAreRefusedOrSound) {
  const std::vector<Bytes> files = corpus();
  Random random(7);
  for (int i = 0; i < 10000; ++i) {
    const std::string wrong =
        read_ecosystem(mutant(files[static_cast<std::size_t>(i) % files.size()], random));
    ASSERT_EQ(wrong, "") << "mutant " << i;
  }
}

}  // namespace
}  // namespace copse
