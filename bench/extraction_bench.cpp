// Time to extract a level's index lists from the spectra of a tree. bench/extraction.py calls it.
//
//   probe_extraction NAME TREE     a file that lodbake --continuous has made
#include "lib/formats/levels/spectrum_file.h"
#include "lib/formats/tree_file/tree_file.h"
#include "lib/runtime/levels.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <limits>
#include <vector>

#include <fmt/format.h>

namespace {

using namespace copse;

constexpr int k_runs = 400;

template <class Work>
double least_microseconds(Work work) {
  double least = std::numeric_limits<double>::infinity();
  for (int run = 0; run < k_runs; ++run) {
    const auto start = std::chrono::steady_clock::now();
    work();
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - start;
    least = std::min(least, took.count());
  }
  return least;
}

void bench(const char* name, const LodSpectra& spectra) {
  const LevelExtractor trunk(spectra.trunk), leaves(spectra.leaves);
  std::vector<std::uint32_t> out(trunk.capacity() + leaves.capacity()), copy(out.size());
  const double full = full_detail(spectra).triangles;
  for (const double share : {1.0, 0.66, 0.33, 0.15}) {
    const LodLevel level = level_of_triangles(spectra, static_cast<std::uint64_t>(share * full));
    std::size_t n = 0;
    const double took = least_microseconds([&] {
      n = trunk.extract(level.trunk_steps, out);
      n += leaves.extract(level.leaf_steps, std::span(out).subspan(n));
    });
    const double floor =
        least_microseconds([&] { std::memcpy(copy.data(), out.data(), n * sizeof(std::uint32_t)); });
    fmt::print("{:34} {:5.2f} {:9} {:8.1f} {:8.1f}\n", name, share, n / 3, took, floor);
  }
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const auto file = TreeFile::open(argv[2]);
  if (!file) return fmt::print("{}\n", to_line(file.error(), "bench")), 3;
  const auto spectra = load_spectra(file->container(), file->counts().radii, file->counts().materials);
  if (!spectra) return fmt::print("{}\n", to_line(spectra.error(), "bench")), 3;
  bench(argv[1], *spectra);
  return 0;
}
