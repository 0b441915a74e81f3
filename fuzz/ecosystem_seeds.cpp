// Writes the seeds of fuzz_ecosystem: little sound ecosystems of every kind.
//   fuzz_ecosystem_seeds fuzz/corpus/ecosystem
#include "lib/formats/container/atomic_file.h"
#include "lib/formats/ecosystem/ecosystem_file.h"
#include "tests/formats/ecosystem_maker.h"

#include <cstdio>
#include <string>

namespace copse {
namespace {

// With what the little one has not: volumes, a packed tree, a free terrain, trees over the blocks.
Ecosystem rich_ecosystem() {
  Ecosystem e = little_ecosystem(false);
  e.types[0].volumes = {BoundingSphere<float>{{0, 1.5f, 0}, 4}, FloatBox{{-1, 0, -1}, {1, 3, 1}}};
  e.types[1].envelopes = {FloatBox{{-0.1f, 0, -0.1f}, {0.1f, 0.2f, 0.1f}}};
  e.types[1].uri.clear();
  e.types[1].packed = std::vector<std::uint8_t>{'t', 'r', 'e', 'e'};
  std::vector<Float3> points;
  for (std::uint32_t r = 0; r < 3; ++r)
    for (std::uint32_t c = 0; c < 3; ++c) points.push_back(to_float(e.terrain.vertex(c, r)));
  e.terrain.points = std::move(points);
  e.terrain.heights = {};
  const FloatBox all = e.boxes[0].bounds;
  e.kd_tree = std::vector<BlockNode>{{.bounds = all, .skip = 3},
                                     {.bounds = all, .skip = 2, .block = 0},
                                     {.bounds = all, .skip = 3, .block = 1}};
  e.rtree = e.kd_tree;
  e.provenance = "{}";
  return e;
}

Result<void> write_seed(const std::filesystem::path& file, const Ecosystem& eco, Encoding encoding) {
  const auto bytes = encode_ecosystem(eco, encoding);
  if (!bytes) return std::unexpected(bytes.error());
  return write_file(file, *bytes);
}

}  // namespace
}  // namespace copse

int main(int argc, char** argv) {
  using namespace copse;
  if (argc != 2) return std::puts("fuzz_ecosystem_seeds FOLDER"), 2;
  const std::filesystem::path folder = argv[1];
  for (const Encoding encoding : {Encoding::raw, Encoding::zstd}) {
    const std::string end = encoding == Encoding::raw ? "_raw.eco" : "_zstd.eco";
    for (const auto& [name, eco] : {std::pair<std::string, Ecosystem>("packed", little_ecosystem(false)),
                                    {"exact", little_ecosystem(true)},
                                    {"rich", rich_ecosystem()},
                                    {"empty", Ecosystem{}}}) {
      const auto written = write_seed(folder / (name + end), eco, encoding);
      if (!written) return std::puts(to_line(written.error(), "fuzz_ecosystem_seeds").c_str()), 3;
    }
  }
}
