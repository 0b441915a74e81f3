// Whatever the mesh is: no crash, no hang, and what comes out is a sound tree.
#include "tests/treeprep/mesh_of_bytes.h"

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <gtest/gtest.h>

namespace copse {
namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr double k_most_seconds = 30;  // of processor time; the sanitizers take their share
#else
constexpr double k_most_seconds = 2;
#endif

double processor_seconds() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

void expect_sound(PrepareJob job, const std::string& name) {
  for (const Skeleton skeleton : {Skeleton::automatic, Skeleton::rings, Skeleton::surface}) {
    job.options.skeleton = skeleton;
    const double start = processor_seconds();
    EXPECT_EQ(prepare_job(job), "") << name << ", --skeleton " << static_cast<int>(skeleton);
    EXPECT_LT(processor_seconds() - start, k_most_seconds)
        << name << ", --skeleton " << static_cast<int>(skeleton);
  }
}

class AnalyseRandom : public ::testing::TestWithParam<std::uint64_t> {};

TEST_P(AnalyseRandom, MeshesGiveSoundTrees) {
  for (std::uint64_t number = GetParam(); number < GetParam() + 100; ++number)
    expect_sound(job_of_bytes(random_job(number), 500), "job " + std::to_string(number));
}

INSTANTIATE_TEST_SUITE_P(Hundreds, AnalyseRandom, ::testing::Values(0, 100, 200));

TEST(Analyse, OfTheFuzzersCorpusGivesSoundTrees) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(COPSE_SOURCE_DIR "/fuzz/corpus/treeprep"))
    files.push_back(entry.path());
  std::ranges::sort(files);
  ASSERT_FALSE(files.empty());
  for (const auto& path : files) {
    std::ifstream stream(path, std::ios::binary);
    const std::vector<std::uint8_t> bytes((std::istreambuf_iterator<char>(stream)),
                                          std::istreambuf_iterator<char>());
    expect_sound(job_of_bytes(bytes, 1500), path.string());
  }
}

}  // namespace
}  // namespace copse
