#include "lib/analysis/lod/foliage_pruning.h"

#include "lib/analysis/lod/cell_visibility.h"
#include "lib/analysis/lod/foliage_cells_tree.h"
#include "lib/analysis/lod/leaf_enlargement.h"
#include "lib/analysis/lod/radius_ancestors.h"
#include "lib/analysis/lod/spectrum_builder.h"
#include "lib/formats/levels/part_triangles.h"
#include "lib/formats/random.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace copse {
namespace {

constexpr int k_steps = 128;      // each 2^(1/4) fewer: from 2^32 leaves to one
constexpr int k_curve_bits = 10;  // a side: a cell is cut into 2^30 boxes at most

std::uint32_t reversed(std::uint32_t x) {
  std::uint32_t out = 0;
  for (int i = 0; i < 32; ++i) out |= (x >> i & 1u) << (31 - i);
  return out;
}

// Places along a Z curve through the cell's box.
std::uint32_t place(const OrientedBox<float>& box, const Float3& centre) {
  std::uint32_t key = 0;
  const Double3 d = to_double(centre) - to_double(box.centre);
  for (int a = 0; a < 3; ++a) {
    const double half = box.half_extents[a];
    const double at = half > 0 ? (dot(d, to_double(box.axes[a])) / half + 1) / 2 : 0;
    const auto cell = static_cast<std::uint32_t>(std::clamp(at, 0.0, 1.0) * ((1 << k_curve_bits) - 1));
    for (int b = 0; b < k_curve_bits; ++b) key |= (cell >> b & 1u) << (3 * b + a);
  }
  return key;
}

// Sorts the cell's leaves into their order of pruning.
void stratify(const Tree& tree, const FoliageCell& cell, Random draw, std::span<std::uint32_t> leaves) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> curve;
  for (const std::uint32_t l : leaves) curve.emplace_back(place(cell.box, tree.leaves.centres[l]), l);
  std::sort(curve.begin(), curve.end());
  const auto scramble = static_cast<std::uint32_t>(draw.next());
  const int bits = std::bit_width(curve.size());
  std::vector<std::pair<std::uint32_t, std::uint32_t>> ranked;
  for (std::uint32_t i = 0; i < curve.size(); ++i)
    ranked.emplace_back((reversed(i) ^ scramble) >> (32 - bits), curve[i].second);
  std::sort(ranked.begin(), ranked.end());
  for (std::size_t i = 0; i < leaves.size(); ++i) leaves[i] = ranked[i].second;
}

FoliageParameters parameters_of(const Tree& tree, const PruningOptions& options) {
  FoliageParameters p;
  FloatBox box;
  for (const Float3& v : tree.leaves.vertices) box.grow(v);
  const double radius = box.empty() ? 0 : length(to_double(box.extent())) / 2;
  const bool chosen = options.near > 0 || options.far > 0;
  p.near = static_cast<float>(chosen ? options.near : 2 * radius);
  p.far = static_cast<float>(chosen ? std::max(options.far, options.near) : 40 * radius);
  p.least = static_cast<float>(options.least);
  p.half_distance = static_cast<float>(options.half_distance);
  p.largest_enlargement = static_cast<float>(options.largest_enlargement);
  p.distance = options.distance, p.compensation = options.compensation, p.ramp = options.ramp;
  p.resolution = static_cast<std::uint32_t>(options.resolution);
  p.seed = options.seed, p.leaves = hash_leaves(tree);
  return p;
}

// The leaves' triangles, cell after cell.
struct Sorted {
  DrawnMesh mesh;
  std::vector<std::uint32_t> cell_of;
};

Sorted sorted_by_cell(const Tree& tree, std::span<const FoliageCell> cells,
                      std::span<const std::uint32_t> leaves) {
  Sorted out;
  const DrawnMesh all = drawn_leaves(tree);
  out.mesh.positions = all.positions, out.mesh.texcoords = all.texcoords;
  for (std::uint32_t c = 0; c < cells.size(); ++c) {
    for (const std::uint32_t l : leaves.subspan(cells[c].first, cells[c].count)) {
      const std::size_t end = std::min(tree.first_triangle_of_leaf(l + 1), all.triangles.size());
      for (std::size_t t = tree.first_triangle_of_leaf(l); t < end; ++t) {
        out.mesh.triangles.push_back(all.triangles[t]), out.mesh.material.push_back(all.material[t]);
        out.cell_of.push_back(c);
      }
    }
  }
  return out;
}

class Pruner {
 public:
  Pruner(const Tree& tree, const FoliageCells& foliage)
      : tree_(tree),
        foliage_(foliage),
        part_(leaf_triangles(tree)),
        enlargement_(tree, part_, foliage),
        builder_(LodMethod::prune),
        element_(tree.leaf_count(), k_none),
        radius_(tree.leaf_count(), k_none) {
    const RadiusAncestors ancestors(tree);
    for (std::uint32_t g = 0; g < tree.leaves.groups.size(); ++g) {
      const LeafGroup& group = tree.leaves.groups[g];
      for (std::uint32_t i = group.first; i < group.first + group.count; ++i)
        radius_[tree.leaves.order[i]] = ancestors.of_group()[g];
    }
    DoubleBox box;
    for (const SpectrumVertex& v : part_.vertices) box.grow(to_double(v.position));
    const Double3 extent = box.empty() ? Double3{} : box.extent();
    longest_ = std::max({extent.x, extent.y, extent.z}) / 2;
  }

  Spectrum run() {
    for (const SpectrumVertex& v : part_.vertices) builder_.vertex(v);
    for (std::uint32_t l = 0; l < element_.size(); ++l)
      element_[l] = builder_.element(material(l), radius_[l], faces(l));
    for (const FoliageCell& cell : foliage_.cells) shown_.push_back(cell.count);
    factors_.assign(element_.size(), 1.0);
    for (int k = 1; k <= k_steps; ++k) fewer(std::exp2(-k / 4.0));
    return builder_.finish();
  }

 private:
  // The next level, if any cell shows less in it. Its error: how far apart the leaves that are left stand.
  void fewer(double fraction) {
    const std::vector<std::uint32_t> shown = shown_cells(foliage_.cells, fraction);
    if (shown == shown_) return;
    double apart = 0, cells = 0;
    for (std::size_t c = 0; c < shown.size(); ++c) {
      if (shown[c] == 0) continue;
      ++cells;
      if (shown[c] < foliage_.cells[c].count)
        apart = std::max(apart, longest(foliage_.cells[c]) / std::cbrt(double(shown[c])));
    }
    if (cells < double(shown.size())) apart = std::max(apart, longest_ / std::cbrt(cells));
    builder_.step(apart);
    const std::vector<double> factors = enlargement_.factors(shown);
    for (std::size_t i = 0; i < factors.size(); ++i) {
      if (factors[i] == factors_[i]) continue;
      const std::uint32_t leaf = foliage_.order[i];
      builder_.remove(element_[leaf]);
      if (factors[i] > 0) element_[leaf] = put(leaf, std::sqrt(factors[i]));
    }
    shown_ = shown, factors_ = factors;
  }

  static double longest(const FoliageCell& cell) {
    return std::max({cell.box.half_extents.x, cell.box.half_extents.y, cell.box.half_extents.z});
  }
  std::uint32_t put(std::uint32_t leaf, double scale) {
    const Double3 anchor = to_double(tree_.leaves.centres[leaf]);
    std::uint32_t base = k_none;
    for_each(leaf, [&](std::uint32_t v) {
      SpectrumVertex vertex = part_.vertices[v];
      vertex.position = to_float(anchor + (to_double(vertex.position) - anchor) * scale);
      const std::uint32_t made = builder_.vertex(vertex);
      base = base == k_none ? made : base;
    });
    std::vector<std::array<std::uint32_t, 3>> triangles;
    for (std::uint32_t t = 0; t < faces(leaf).size(); ++t)
      triangles.push_back({base + 3 * t, base + 3 * t + 1, base + 3 * t + 2});
    return builder_.element(material(leaf), radius_[leaf], triangles);
  }

  template <class F>
  void for_each(std::uint32_t leaf, F&& f) const {
    for (const auto& t : faces(leaf))
      for (const std::uint32_t v : t) f(v);
  }

  std::span<const std::array<std::uint32_t, 3>> faces(std::uint32_t leaf) const {
    const std::size_t first = std::min(tree_.first_triangle_of_leaf(leaf), part_.triangles.size());
    const std::size_t last = std::min(tree_.first_triangle_of_leaf(leaf + 1), part_.triangles.size());
    return std::span(part_.triangles).subspan(first, last - first);
  }
  std::uint32_t material(std::uint32_t leaf) const {
    return part_.materials[tree_.first_triangle_of_leaf(leaf)];
  }

  const Tree& tree_;
  const FoliageCells& foliage_;
  PartTriangles part_;
  LeafEnlargement enlargement_;
  SpectrumBuilder builder_;
  std::vector<std::uint32_t> element_, radius_;  // of each leaf
  std::vector<std::uint32_t> shown_;             // of each cell
  std::vector<double> factors_;                  // of each place in the order
  double longest_ = 0;                           // half extent of the crown
};

}  // namespace

FoliageCells prune_foliage(const Tree& tree, const Looks& looks, const PruningOptions& options) {
  CellCut cut = cut_cells(tree, options.cells);
  const Random root(options.seed);
  for (std::uint32_t c = 0; c < cut.cells.size(); ++c) {
    const FoliageCell& cell = cut.cells[c];
    stratify(tree, cell, root.fork(c), std::span(cut.leaves).subspan(cell.first, cell.count));
  }
  const Sorted sorted = sorted_by_cell(tree, cut.cells, cut.leaves);
  const ViewSphere sphere = view_sphere(subdivisions_for(options.views));
  std::vector<Float3> views;
  for (const Double3& d : sphere.directions) views.push_back(to_float(d));
  FoliageCells out;
  out.visibility =
      cell_visibility(sorted.mesh, looks, sorted.cell_of, static_cast<std::uint32_t>(cut.cells.size()),
                      sphere.directions, options.resolution);
  out.views = std::move(views), out.view_triangles = sphere.triangles;
  out.cells = std::move(cut.cells), out.order = std::move(cut.leaves);
  out.parameters = parameters_of(tree, options);
  return out;
}

std::uint32_t shown_leaves(std::uint32_t count, double fraction) {
  if (count == 0 || std::isnan(fraction)) return count;
  const double wanted = std::ceil(count * std::clamp(fraction, 0.0, 1.0) - 1e-9);
  return std::clamp(static_cast<std::uint32_t>(wanted), 1u, count);
}

std::vector<std::uint32_t> shown_cells(std::span<const FoliageCell> cells, double fraction) {
  double leaves = 0;
  std::vector<std::uint32_t> out;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> order;
  for (std::uint32_t c = 0; c < cells.size(); ++c) {
    leaves += cells[c].count;
    out.push_back(shown_leaves(cells[c].count, fraction));
    order.emplace_back(reversed(c), c);
  }
  const double left = std::max(1.0, std::ceil(leaves * fraction - 1e-9));
  if (!(left < double(cells.size()))) return out;
  std::sort(order.begin(), order.end());
  for (std::size_t i = static_cast<std::size_t>(left); i < order.size(); ++i) out[order[i].second] = 0;
  return out;
}

Spectrum pruned_spectrum(const Tree& tree, const FoliageCells& foliage) {
  return Pruner(tree, foliage).run();
}

}  // namespace copse
