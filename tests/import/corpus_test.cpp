// What the fuzzers found, and what they start from, is read again on every run.
#include "tests/import/testing.h"

#include <algorithm>
#include <iterator>

namespace copse {
namespace {

using namespace copse::testing;

void expect_corpus_survives(const char* folder, MeshFormat format) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry :
       std::filesystem::directory_iterator(std::filesystem::path(COPSE_SOURCE_DIR "/fuzz/corpus") / folder))
    files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  ASSERT_FALSE(files.empty());
  for (const auto& path : files) {
    std::ifstream stream(path, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(stream)), std::istreambuf_iterator<char>());
    for (const bool strict : {false, true}) {
      const auto result =
          import_mesh(as_bytes(bytes), format, "corpus", {.strict = strict, .instance_limit = 100'000});
      if (result) {
        EXPECT_EQ(broken_promise(*result), nullptr) << path;
      } else {
        EXPECT_NE(result.error().fault, Fault::bug) << path << ": " << error_of(result);
      }
    }
  }
}

TEST(Corpus, OfEveryFormatIsRefusedOrSound) {
  expect_corpus_survives("obj", MeshFormat::obj);
  expect_corpus_survives("ply", MeshFormat::ply);
  expect_corpus_survives("off", MeshFormat::off);
  expect_corpus_survives("stl", MeshFormat::stl);
  expect_corpus_survives("gltf", MeshFormat::glb);
}

}  // namespace
}  // namespace copse
