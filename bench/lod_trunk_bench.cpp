// Trunks at a quarter to a fiftieth of their triangles: speed, coverage and distance of the spectra by radii
// and by edges beside meshoptimizer's simplifier. bench/lod_trunk.py calls it.
//
//   probe_lod_trunk [--speed] TREE...      .tree or .stree files
#include "lib/analysis/lod/edge_collapse.h"
#include "lib/analysis/lod/edge_spectrum.h"
#include "lib/analysis/lod/trunk_radii.h"
#include "lib/analysis/measure/drawn_mesh.h"
#include "lib/analysis/measure/raster.h"
#include "lib/analysis/measure/surface_distance.h"
#include "lib/formats/tree_file/tree_file.h"

#include <algorithm>
#include <ctime>
#include <filesystem>
#include <functional>
#include <limits>
#include <numbers>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <meshoptimizer.h>

namespace {

using namespace copse;

constexpr int k_runs = 5, k_views = 6, k_pixels = 512;
constexpr std::uint32_t k_samples = 20000;

// Processor time, the least of some runs that take turns with the others' in `works`.
std::vector<double> least_seconds(const std::vector<std::function<void()>>& works) {
  std::vector<double> least(works.size(), std::numeric_limits<double>::infinity());
  for (int run = 0; run < k_runs; ++run) {
    for (std::size_t i = 0; i < works.size(); ++i) {
      const std::clock_t start = std::clock();
      works[i]();
      least[i] = std::min(least[i], double(std::clock() - start) / CLOCKS_PER_SEC);
    }
  }
  return least;
}

DrawnMesh simplified(const DrawnMesh& source, std::size_t triangles) {
  std::vector<Float3> places;
  for (const Double3& p : source.positions) places.push_back(to_float(p));
  std::vector<unsigned> indices(3 * source.triangles.size());
  indices.resize(meshopt_simplify(indices.data(), source.triangles[0].data(), indices.size(), &places[0].x,
                                  places.size(), sizeof(Float3), 3 * triangles, 1e9f, 0, nullptr));
  DrawnMesh level = source;
  level.triangles.clear();
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3)
    level.triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
  level.material.assign(level.triangles.size(), k_none);
  return level;
}

double covered(const DrawnMesh& mesh, const DoubleBox& box) {
  double pixels = 0;
  for (int view = 0; view < k_views; ++view) {
    const Raster r = rasterize(mesh.positions, mesh.triangles,
                               frame_box(box, std::numbers::pi * view / k_views, k_pixels, k_pixels));
    pixels += static_cast<double>(
        std::count_if(r.triangle.begin(), r.triangle.end(), [](std::uint32_t t) { return t != k_none; }));
  }
  return pixels;
}

DrawnMesh state_with(const Spectrum& s, std::size_t triangles) {
  const auto at = std::partition_point(s.counts.begin(), s.counts.end(),
                                       [&](std::uint32_t count) { return count > triangles; });
  return drawn_state(s, std::min(static_cast<std::uint32_t>(at - s.counts.begin()), s.steps()));
}

void compare(const std::string& name, const DrawnMesh& full, const Spectrum& radii, const Spectrum& edges) {
  const DoubleBox box = bounds(full);
  const double whole = covered(full, box), height = box.extent().y;
  for (const double share : {0.25, 0.1, 0.05, 0.02}) {
    const auto target = static_cast<std::size_t>(share * static_cast<double>(full.triangles.size()));
    const auto row = [&](const char* method, const DrawnMesh& level) {
      const SurfaceDistances d = surface_distance(full, level, k_samples);
      fmt::print("{:24} {:5.2f} {:12} {:8} {:8.3f} {:9.3f} {:9.3f}\n", name, share, method,
                 level.triangles.size(), covered(level, box) / whole, 100 * d.from_source.mean / height,
                 100 * d.from_level.mean / height);
    };
    row("radii", state_with(radii, target));
    row("edges", state_with(edges, target));
    row("meshopt", simplified(full, target));
  }
}

void bench(const std::filesystem::path& path, bool quality) {
  const auto file = TreeFile::open(path);
  if (!file) return fmt::print("{}\n", to_line(file.error(), "bench"));
  const auto tree = file->load();
  if (!tree) return fmt::print("{}\n", to_line(tree.error(), "bench"));
  const PartTriangles part = trunk_triangles(*tree);
  if (part.triangles.empty()) return;
  const DrawnMesh full = drawn_trunk(*tree);
  Spectrum radii, edges;
  EdgeCollapses collapses;
  const auto n = static_cast<double>(part.triangles.size());
  const std::vector<double> seconds =
      least_seconds({[&] { radii = trunk_by_radii(*tree); }, [&] { collapses = collapse_edges(part); },
                     [&] { edges = edge_spectrum(part, collapses, {}); },
                     [&] { simplified(full, part.triangles.size() / 10); }});
  fmt::print(
      "{:24} {} triangles; M triangles/s: radii {:.2f}, edges {:.2f} (collapses {:.2f}, spectrum {:.2f}), "
      "meshopt to a "
      "tenth {:.2f}\n",
      path.stem().string(), part.triangles.size(), n / seconds[0] / 1e6, n / (seconds[1] + seconds[2]) / 1e6,
      n / seconds[1] / 1e6, n / seconds[2] / 1e6, n / seconds[3] / 1e6);
  if (quality) compare(path.stem().string(), full, radii, edges);
}

}  // namespace

int main(int argc, char** argv) {
  bool quality = true;
  fmt::print("{:24} {:>5} {:12} {:>8} {:>8} {:>9} {:>9}\n", "tree", "share", "method", "count", "coverage",
             "missing %", "added %");
  for (int i = 1; i < argc; ++i) {
    if (std::string(argv[i]) == "--speed") {
      quality = false;
    } else {
      bench(argv[i], quality);
    }
  }
}
