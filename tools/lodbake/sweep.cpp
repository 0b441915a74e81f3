#include "lib/analysis/measure/lod_quality.h"
#include "lib/runtime/levels.h"
#include "tools/lodbake/gltfpack.h"
#include "tools/lodbake/level_pictures.h"
#include "tools/lodbake/measure_stage.h"

#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <meshoptimizer.h>

namespace copse::lodbake {
namespace {

// Pixels across the tree at which methods are compared at a share of the triangles: the same for every tree.
int compared_size(double share) {
  return share >= 0.25 ? 512 : share >= 0.05 ? 128 : 32;
}

constexpr double k_shares[] = {0.5, 0.25, 0.1, 0.05, 0.02};
constexpr std::uint64_t k_last = 200;  // triangles of the last geometric level

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

// A level of some method; the area of its leaves where they can be told from the trunk, m².
struct Made {
  DrawnMesh mesh;
  std::optional<double> leaf_area;
};

// `whole`: one target for all together, so that it takes where it costs least; otherwise the same share of
// each part.
Made peer(const LodSpectra& spectra, std::uint64_t target, bool whole) {
  const DrawnMesh trunk = drawn_state(spectra.trunk, 0), leaves = drawn_state(spectra.leaves, 0);
  if (whole) {
    DrawnMesh all = trunk;
    append(all, leaves);
    Made out{simplified(all, target), 0.0};
    for (std::uint32_t t = 0; t < out.mesh.triangles.size(); ++t)
      if (out.mesh.triangles[t][0] >= trunk.positions.size()) *out.leaf_area += area(out.mesh, t);
    return out;
  }
  const double share =
      static_cast<double>(target) / static_cast<double>(trunk.triangles.size() + leaves.triangles.size());
  const auto part = [&](const DrawnMesh& mesh) {
    return simplified(
        mesh, static_cast<std::uint64_t>(std::floor(share * static_cast<double>(mesh.triangles.size()))));
  };
  Made out{part(trunk), {}};
  const DrawnMesh left = part(leaves);
  out.leaf_area = area(left);
  append(out.mesh, left);
  return out;
}

Made level_of(const LodSpectra& spectra, std::uint64_t target) {
  const LodLevel level = level_of_triangles(spectra, target);
  return {drawn_level(spectra, level), area(drawn_state(spectra.leaves, level.leaf_steps))};
}

// What the tool makes of other options.
struct Variant {
  std::string name;
  LodSpectra spectra;
};

// The options as given, each time with one of them the other way: what stays as it was is not made again.
class Variants {
 public:
  Variants(const Tree& tree, const LodSpectra& as_made, const Looks& looks, const Options& options,
           std::uint64_t seed)
      : tree_(tree), as_made_(as_made), looks_(looks), options_(options), seed_(seed) {}

  std::vector<Variant> make() {
    const bool trunk = !as_made_.trunk.elements.empty(), leaves = !as_made_.leaves.elements.empty();
    if (trunk && leaves) other_division();
    if (trunk) other_trunk();
    if (leaves) other_leaves();
    return std::move(out_);
  }

 private:
  void add(std::string name, const Options& options, LodSpectra spectra) {
    divide(tree_, looks_, options, spectra);
    out_.push_back({std::move(name), std::move(spectra)});
  }
  void other_division() {
    Options other = options_;
    const bool even = options_.division == Division::picture;
    other.division = even ? Division::even : Division::picture;
    add(even ? "copse, even" : "copse, by pictures", other, as_made_);
  }
  void other_trunk() {
    Options other = options_;
    const bool edges = options_.trunk == TrunkMethod::radii;
    other.trunk = edges ? TrunkMethod::edges : TrunkMethod::radii;
    LodSpectra spectra = as_made_;
    spectra.trunk = trunk_spectrum(tree_, other);
    if (spectra.trunk.method == as_made_.trunk.method) return;  // without limbs there is one way alone
    add(edges ? "copse, trunk by edges" : "copse, trunk by radii", other, std::move(spectra));
  }
  void other_leaves() {
    Options other = options_;
    const bool prune = options_.foliage == FoliageMethod::collapse;
    other.foliage = prune ? FoliageMethod::prune : FoliageMethod::collapse;
    LodSpectra spectra = as_made_;
    spectra.leaves = leaf_spectrum(tree_, looks_, other, seed_).spectrum;
    add(prune ? "copse, leaves pruned" : "copse, leaves collapsed", other, std::move(spectra));
    if (!prune || options_.quality == CollapseQuality::fast) return;
    other = options_, other.quality = CollapseQuality::fast;
    spectra = as_made_;
    spectra.leaves = leaf_spectrum(tree_, looks_, other, seed_).spectrum;
    add("copse, leaves fast", other, std::move(spectra));
  }

  const Tree& tree_;
  const LodSpectra& as_made_;
  const Looks& looks_;
  const Options& options_;
  std::uint64_t seed_;
  std::vector<Variant> out_;
};

// All methods at the same number of triangles.
class Contest {
 public:
  Contest(const Tree& tree, const LodSpectra& spectra, std::vector<Variant> variants)
      : spectra_(spectra), variants_(std::move(variants)), gltfpack_(Gltfpack::find(tree)) {}

  bool has_gltfpack() const { return gltfpack_.has_value(); }

  // add(name, level).
  template <class Add>
  void each(double share, std::uint64_t target, Add&& add) const {
    add("copse", level_of(spectra_, target));
    for (const Variant& v : variants_) add(v.name.c_str(), level_of(v.spectra, target));
    add("meshoptimizer, one mesh", peer(spectra_, target, true));
    add("meshoptimizer, each part", peer(spectra_, target, false));
    for (const bool aggressive : {false, true}) {
      auto level = gltfpack_ ? gltfpack_->level(share, aggressive) : std::nullopt;
      if (level) add(aggressive ? "gltfpack -sa" : "gltfpack -si", Made{std::move(*level), {}});
    }
  }

 private:
  const LodSpectra& spectra_;
  std::vector<Variant> variants_;
  std::optional<Gltfpack> gltfpack_;
};

}  // namespace

void sweep(const Tree& tree, const BakedSpectra& baked, const Looks& looks, const Options& options,
           Context& context) {
  Stage stage = context.stage("sweep");
  const LodSpectra& spectra = baked.spectra;
  const DrawnMesh source = drawn_level(spectra, {});
  const double leaf_area = area(drawn_state(spectra.leaves, 0));
  const auto full = static_cast<double>(source.triangles.size());
  const Contest contest(tree, spectra,
                        Variants(tree, baked.as_made, looks, options, context.options().seed).make());
  if (!contest.has_gltfpack())
    context.warn("--sweep: gltfpack is not installed (npm install gltfpack), its rows are left out");
  Table table{.name = "sweep",
              .columns = {"Method", "Share", "Triangles", "Area", "Leaf area", "Coverage", "Silhouette IoU",
                          "RMSE", "SSIM", "Hull growth", "Pixels"},
              .rows = {}};
  Table last = table;
  last.name = "last geometric level";
  const auto rows = [&](Table& to, double share, std::uint64_t target, int pixels) {
    const LodJudge judge(source, looks, {.views = options.views, .image_size = pixels, .mask_size = 256});
    contest.each(share, target, [&](const char* method, const Made& level) {
      const LodQuality q = judge.measure(level.mesh);
      const bool leaves = level.leaf_area && leaf_area > 0;
      to.rows.push_back({method, fmt::format("{:.4g}", share), fmt::format("{}", q.triangles),
                         fmt::format("{:.3f}", q.area_ratio),
                         leaves ? fmt::format("{:.3f}", *level.leaf_area / leaf_area) : "",
                         fmt::format("{:.3f}", q.coverage_ratio), fmt::format("{:.3f}", q.iou),
                         fmt::format("{:.4f}", q.rmse), fmt::format("{:.3f}", q.ssim),
                         fmt::format("{:.3f}", q.hull_growth), fmt::format("{}", pixels)});
    });
  };
  for (const double share : k_shares)
    rows(table, share, static_cast<std::uint64_t>(std::floor(share * full)), compared_size(share));
  if (full > k_last) rows(last, k_last / full, k_last, compared_size(0));
  stage.items(table.rows.size() + last.rows.size(), "levels");
  for (Table* t : {&table, &last})
    if (!t->rows.empty()) context.report().tables.push_back(std::move(*t));
}

}  // namespace copse::lodbake
