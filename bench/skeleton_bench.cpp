// What rings, levels and mean-curvature flow make of the largest trunk surface of each real mesh at
// ../shared/trees: cost (fit.h: mean distance between surface and cylinders over the diagonal; less is
// better) and CPU time. docs/skeleton.md shows the table.
//
//   ./run bench skeleton
#include "lib/analysis/leaves/classify.h"
#include "lib/analysis/surface/surface.h"
#include "lib/analysis/surface/surfaces.h"
#include "lib/analysis/trunk/fit.h"
#include "lib/analysis/trunk/welded.h"
#include "lib/formats/import/import.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <filesystem>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace copse {
namespace {

double cpu_seconds() {
  timespec t{};
  ::clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

TrunkMesh trunk_of(const Mesh& mesh) {
  const auto classes = classify(mesh);
  std::vector<std::uint8_t> is_trunk(mesh.triangles.size(), 1);
  for (std::size_t t = 0; classes && t < is_trunk.size(); ++t) is_trunk[t] = classes->leaf_of[t] == k_none;
  return make_trunk_mesh(mesh, is_trunk);
}

// "0.0029, 1.4 ms": the least of three runs, of the same answer.
std::string measured(const TrunkMesh& trunk, std::span<const std::uint32_t> triangles,
                     const WeldedOptions& options) {
  double seconds = 1e300;
  Hierarchy h;
  for (int run = 0; run < 3; ++run) {
    const double start = cpu_seconds();
    h = recover_welded(trunk, triangles, options);
    seconds = std::min(seconds, cpu_seconds() - start);
  }
  const Surface surface = make_surface(trunk, triangles);
  std::vector<std::uint32_t> segment_of(surface.triangles.size(), k_none);
  for (std::size_t i = 0; i < triangles.size(); ++i) segment_of[surface.triangle_of[i]] = h.segment_of[i];
  h.segment_of = std::move(segment_of);
  std::vector<std::uint32_t> local(trunk.positions.size());
  for (std::uint32_t v = 0; v < surface.vertex.size(); ++v) local[surface.vertex[v]] = v;
  for (std::uint32_t& v : h.ring_vertices) v = local[v];
  return fmt::format("{:.4f}, {:.1f} ms", fit_of(surface, h).cost(), 1e3 * seconds);
}

void row(const std::filesystem::path& path) {
  const auto import = import_mesh(path);
  if (!import) return;
  const TrunkMesh trunk = trunk_of(import->mesh);
  const Surfaces surfaces = make_surfaces(trunk);
  std::uint32_t largest = k_none;
  for (std::uint32_t s = 0; s < surfaces.size(); ++s) {
    if (largest == k_none || surfaces.triangles(s).size() > surfaces.triangles(largest).size()) largest = s;
  }
  if (largest == k_none) return;
  const auto triangles = surfaces.triangles(largest);
  fmt::print("| {} | {} | {} | {} | {} |\n", path.stem().stem().string(), triangles.size(),
             measured(trunk, triangles, {WeldedMethod::rings, SurfaceMethod::automatic}),
             measured(trunk, triangles, {WeldedMethod::surface, SurfaceMethod::levels}),
             measured(trunk, triangles, {WeldedMethod::surface, SurfaceMethod::flow}));
  std::fflush(stdout);
}

}  // namespace
}  // namespace copse

int main() {
  const std::filesystem::path trees = COPSE_SOURCE_DIR "/../shared/trees";
  std::vector<std::filesystem::path> meshes;
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(trees, error)) {
    const std::string name = entry.path().filename().string();
    if (name.ends_with(".obj") || name.ends_with(".obj.gz")) meshes.push_back(entry.path());
  }
  if (meshes.empty()) {
    fmt::print(stderr, "../shared/trees is not there: nothing to measure\n");
    return EXIT_FAILURE;
  }
  std::ranges::sort(meshes);
  fmt::print("| surface | triangles | rings | levels | flow |\n|---|---|---|---|---|\n");
  for (const std::filesystem::path& mesh : meshes) copse::row(mesh);
  return EXIT_SUCCESS;
}
