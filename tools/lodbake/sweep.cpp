#include "lib/analysis/lod/coupling.h"
#include "lib/analysis/lod/edge_collapse.h"
#include "lib/analysis/lod/edge_spectrum.h"
#include "lib/analysis/lod/foliage_pruning.h"
#include "lib/analysis/measure/lod_quality.h"
#include "lib/runtime/levels.h"
#include "tools/lodbake/gltfpack.h"
#include "tools/lodbake/level_pictures.h"
#include "tools/lodbake/measure_stage.h"

#include <cmath>
#include <optional>

#include <fmt/format.h>
#include <meshoptimizer.h>

namespace copse::lodbake {
namespace {

constexpr double k_shares[] = {0.5, 0.25, 0.1, 0.05, 0.02};

// Of every vertex the material of a triangle that has it: the simplifier knows none, but keeps vertices.
std::vector<std::uint32_t> vertex_materials(const DrawnMesh& mesh) {
  std::vector<std::uint32_t> out(mesh.positions.size(), k_none);
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t)
    for (const std::uint32_t v : mesh.triangles[t])
      if (out[v] == k_none) out[v] = mesh.material[t];
  return out;
}

// meshoptimizer's simplifier, its error limit off, as its users call it on an indexed mesh.
DrawnMesh simplified(const DrawnMesh& mesh, std::uint64_t triangles) {
  if (mesh.triangles.empty()) return mesh;
  std::vector<Float3> positions;
  for (const Double3& p : mesh.positions) positions.push_back(to_float(p));
  std::vector<unsigned> indices(3 * mesh.triangles.size());
  float error = 0;
  indices.resize(meshopt_simplify(indices.data(), reinterpret_cast<const unsigned*>(mesh.triangles.data()),
                                  indices.size(), &positions[0].x, positions.size(), sizeof(Float3),
                                  3 * triangles, 1e9f, 0, &error));
  DrawnMesh out = mesh;
  out.triangles.clear(), out.material.clear();
  const std::vector<std::uint32_t> material = vertex_materials(mesh);
  for (std::size_t i = 0; i < indices.size(); i += 3) {
    out.triangles.push_back({indices[i], indices[i + 1], indices[i + 2]});
    // What most of its corners have, the first one's of three that differ.
    const std::uint32_t a = material[indices[i]], b = material[indices[i + 1]], c = material[indices[i + 2]];
    out.material.push_back(b == c ? b : a);
  }
  return out;
}

// Material by material, as an engine draws them: the simplifier knows none. `whole`: one target for all
// together, so that it takes where it costs least; otherwise the same share of each.
DrawnMesh peer(const LodSpectra& spectra, std::uint64_t target, bool whole) {
  const DrawnMesh trunk = drawn_state(spectra.trunk, 0), leaves = drawn_state(spectra.leaves, 0);
  if (whole) {
    DrawnMesh all = trunk;
    append(all, leaves);
    return simplified(all, target);
  }
  const double share =
      static_cast<double>(target) / static_cast<double>(trunk.triangles.size() + leaves.triangles.size());
  const auto part = [&](const DrawnMesh& mesh) {
    return simplified(
        mesh, static_cast<std::uint64_t>(std::floor(share * static_cast<double>(mesh.triangles.size()))));
  };
  DrawnMesh out = part(trunk);
  append(out, part(leaves));
  return out;
}

}  // namespace

void sweep(const Tree& tree, const LodSpectra& spectra, const Looks& looks, const Options& options,
           Context& context) {
  Stage stage = context.stage("sweep");
  const DrawnMesh source = drawn_level(spectra, {});
  const double full = static_cast<double>(source.triangles.size());
  LodSpectra even = spectra, edges = spectra;
  couple(even, nullptr);
  const PartTriangles trunk = trunk_triangles(tree);
  edges.trunk = edge_spectrum(trunk, collapse_edges(trunk), {});
  couple(edges, nullptr);
  LodSpectra pruned = spectra;
  pruned.leaves = pruned_spectrum(
      tree,
      prune_foliage(tree, looks, {.cells = options.cells, .views = 12, .seed = context.options().seed}));
  couple(pruned, nullptr);
  const std::optional<Gltfpack> gltfpack = Gltfpack::find(tree);
  if (!gltfpack)
    context.warn("--sweep: gltfpack is not installed (npm install gltfpack), its rows are left out");
  Table table{.name = "sweep",
              .columns = {"Method", "Share", "Triangles", "Area", "Coverage", "Silhouette IoU", "RMSE",
                          "SSIM", "Hull growth", "Pixels"},
              .rows = {}};
  for (const double share : k_shares) {
    const int pixels = share >= 0.25 ? 512 : share >= 0.05 ? 128 : 32;
    const LodJudge judge(source, looks, {.views = options.views, .image_size = pixels, .mask_size = 256});
    const auto target = static_cast<std::uint64_t>(std::floor(share * full));
    const auto add = [&](const char* method, const DrawnMesh& level) {
      const LodQuality q = judge.measure(level);
      table.rows.push_back({method, fmt::format("{}", share), fmt::format("{}", q.triangles),
                            fmt::format("{:.3f}", q.area_ratio), fmt::format("{:.3f}", q.coverage_ratio),
                            fmt::format("{:.3f}", q.iou), fmt::format("{:.4f}", q.rmse),
                            fmt::format("{:.3f}", q.ssim), fmt::format("{:.3f}", q.hull_growth),
                            fmt::format("{}", pixels)});
    };
    add("copse", drawn_level(spectra, level_of_triangles(spectra, target)));
    add("copse, even", drawn_level(even, level_of_triangles(even, target)));
    add("copse, trunk by edges", drawn_level(edges, level_of_triangles(edges, target)));
    add("copse, leaves pruned", drawn_level(pruned, level_of_triangles(pruned, target)));
    add("meshoptimizer, one mesh", peer(spectra, target, true));
    add("meshoptimizer, each part", peer(spectra, target, false));
    for (const bool aggressive : {false, true}) {
      const auto level = gltfpack ? gltfpack->level(share, aggressive) : std::nullopt;
      if (level) add(aggressive ? "gltfpack -sa" : "gltfpack -si", *level);
    }
  }
  stage.items(table.rows.size(), "levels");
  context.report().tables.push_back(std::move(table));
}

}  // namespace copse::lodbake
