#include "lib/analysis/lod/leaf_collapse.h"

#include "lib/analysis/lod/crown_field.h"
#include "lib/analysis/lod/leaf_clusters.h"
#include "lib/analysis/lod/leaf_pieces.h"
#include "lib/analysis/lod/leaf_shape.h"
#include "lib/analysis/lod/radius_ancestors.h"
#include "lib/analysis/lod/spectrum_builder.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <tbb/parallel_for.h>

namespace copse {
namespace {

using Face = std::array<std::uint32_t, 3>;

int cells_for(std::size_t triangles) {
  return std::clamp(static_cast<int>(2 * std::cbrt(double(triangles))), 8, 64);
}

CrownField field_of(const LeafPieces& pieces, int cells) {
  std::vector<FoliageTriangle> triangles(pieces.part.triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (int c = 0; c < 3; ++c)
      triangles[t].corners[c] = to_double(pieces.part.vertices[pieces.part.triangles[t][c]].position);
    triangles[t].opacity = pieces.opacity_of(t);
  }
  return {triangles, cells > 0 ? cells : cells_for(triangles.size())};
}

class Collapse {
 public:
  Collapse(const Tree& tree, const LeafPieces& pieces, const LeafCollapseOptions& options)
      : pieces_(pieces),
        options_(options),
        field_(field_of(pieces, options.cells)),
        ancestors_(tree),
        builder_(LodMethod::collapse) {
    shape_.emptiness = options.emptiness;
    DoubleBox box;
    for (const SpectrumVertex& v : pieces.part.vertices) box.grow(to_double(v.position));
    offset_ = box.empty() ? Double3{} : box.centre();
  }

  Spectrum run() {
    make_nodes();
    put_source();
    ClusterOptions clusters;
    clusters.largest = options_.largest * field_.cross_section();
    clusters.turning = options_.turning, clusters.least_seen = options_.least_seen,
    clusters.window = options_.window;
    const std::vector<PatchMerge> merges = cluster_leaves(patches_, groups_, clusters);
    patches_.reserve(patches_.size() + merges.size());
    for (const PatchMerge& m : merges) add_node(m);
    const auto first = static_cast<std::uint32_t>(patches_.size() - merges.size());
    std::vector<std::uint32_t> order(merges.size());
    std::iota(order.begin(), order.end(), 0u);
    std::stable_sort(order.begin(), order.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return merges[a].cost < merges[b].cost; });
    shapes_.resize(merges.size());
    shape_.largest = clusters.largest;
    tbb::parallel_for(std::size_t{0}, order.size(), [&](std::size_t i) {
      const std::uint32_t m = order[i];
      ShapeOptions shape = options_of(first + m);
      shape.search = 2 * i > order.size();
      shapes_[m] = leaf_shape(patches_[first + m], &field_, offset_, shape);
    });
    for (const std::uint32_t m : order) apply(merges[m], first + m, shapes_[m]);
    return builder_.finish();
  }

 private:
  struct Node {
    std::uint32_t piece = 0;          // whose material and texture it has
    std::uint32_t triangle = k_none;  // of the source, when it is one of a piece's
    std::uint32_t radius = k_none;
    std::uint32_t element = k_none;  // of the spectrum, while it has one of its own
  };

  // One node a triangle of an opaque piece, one a piece that has alpha.
  void make_nodes() {
    for (std::uint32_t p = 0; p < pieces_.list.size(); ++p) {
      const LeafPiece& piece = pieces_.list[p];
      first_node_.push_back(static_cast<std::uint32_t>(nodes_.size()));
      Patch whole;
      for (std::uint32_t t = piece.first; t < piece.last; ++t) {
        const Patch one = patch(pieces_.triangles[t]);
        if (piece.card)
          whole += one;
        else
          add_source(p, pieces_.triangles[t], one);
      }
      if (piece.card) add_source(p, k_none, whole);
    }
    first_node_.push_back(static_cast<std::uint32_t>(nodes_.size()));
  }

  Patch patch(std::uint32_t triangle) const {
    std::array<Double3, 3> corners;
    Double3 shading{};
    for (int c = 0; c < 3; ++c) {
      const SpectrumVertex& v = pieces_.part.vertices[pieces_.part.triangles[triangle][c]];
      corners[c] = to_double(v.position);
      shading += to_double(v.normal) / 3;
    }
    const Double3 middle = (corners[0] + corners[1] + corners[2]) / 3;
    const double seen = field_.exposure(middle), open = field_.at(middle).openness;
    for (Double3& c : corners) c -= offset_;
    Patch p = patch_of(corners, pieces_.opacity_of(triangle), seen);
    p.open = p.area * open, p.shading = shading * p.area, p.up = pieces_.up_of(triangle) * p.area;
    return p;
  }

  void add_source(std::uint32_t piece, std::uint32_t triangle, const Patch& patch) {
    patches_.push_back(patch);
    nodes_.push_back({piece, triangle, pieces_.list[piece].radius, k_none});
    groups_.push_back(pieces_.list[piece].group);
  }

  void add_node(const PatchMerge& m) {
    Patch sum = patches_[m.a];
    sum += patches_[m.b];
    const Node &a = nodes_[m.a], &b = nodes_[m.b];
    Node node = patches_[m.b].visible > patches_[m.a].visible ? b : a;
    node.triangle =
        node.triangle == k_none ? pieces_.triangles[pieces_.list[node.piece].first] : node.triangle;
    node.radius = ancestors_.common(a.radius, b.radius), node.element = k_none;
    patches_.push_back(sum);
    nodes_.push_back(node);
  }

  void put_source() {
    for (const SpectrumVertex& v : pieces_.part.vertices) builder_.vertex(v);
    std::vector<Face> faces;
    for (const LeafPiece& piece : pieces_.list) {
      faces.clear();
      for (std::uint32_t t = piece.first; t < piece.last; ++t)
        faces.push_back(pieces_.part.triangles[pieces_.triangles[t]]);
      piece_element_.push_back(builder_.element(piece.material, piece.radius, faces));
    }
  }

  void apply(const PatchMerge& merge, std::uint32_t made, const LeafShape& shape) {
    builder_.step(shape.displacement);
    dissolve(merge.a, merge.a, merge.b), dissolve(merge.b, merge.a, merge.b);
    for (const std::uint32_t n : {merge.a, merge.b})
      if (nodes_[n].element != k_none) builder_.remove(nodes_[n].element);
    nodes_[made].element = put(made, shape);
  }

  // A piece of the source goes as a whole: those of its triangles that stay get elements of their own.
  void dissolve(std::uint32_t node, std::uint32_t a, std::uint32_t b) {
    if (node >= first_node_.back()) return;  // made by a merge
    const std::uint32_t p = nodes_[node].piece;
    if (piece_element_[p] == k_none) return;
    builder_.remove(piece_element_[p]);
    piece_element_[p] = k_none;
    for (std::uint32_t n = first_node_[p]; n < first_node_[p + 1]; ++n) {
      if (n == a || n == b) continue;
      nodes_[n].element = builder_.element(pieces_.list[p].material, nodes_[n].radius,
                                           std::span(&pieces_.part.triangles[nodes_[n].triangle], 1));
    }
  }

  ShapeOptions options_of(std::size_t node) const {
    ShapeOptions options = shape_;
    options.card = pieces_.list[nodes_[node].piece].cut == LeafCut::card;
    options.textured = pieces_.list[nodes_[node].piece].card;
    return options;
  }

  std::uint32_t put(std::uint32_t node, const LeafShape& shape) {
    const LeafPiece& piece = pieces_.list[nodes_[node].piece];
    const Double3 mean = patches_[node].shading;
    const bool agree = dot(mean, mean) > 0.25 * patches_[node].area * patches_[node].area;
    const Double3 facing = dot(shape.normal, mean) < 0 ? -shape.normal : shape.normal;
    const Float3 normal = to_float(agree ? normalized(mean) : facing);
    const std::array<Float2, 4> uv = pieces_.texcoords(nodes_[node].piece, nodes_[node].triangle);
    const int n = piece.cut == LeafCut::card ? 4 : 3;
    const std::uint32_t v = builder_.vertex({to_float(shape.corners[0]), normal, uv[0]});
    for (int c = 1; c < n; ++c) builder_.vertex({to_float(shape.corners[c]), normal, uv[c]});
    std::array<Face, 2> faces{Face{v, v + 1, v + 2}, Face{v, v + 2, v + 3}};
    const Double3 front = cross(shape.corners[1] - shape.corners[0], shape.corners[2] - shape.corners[0]);
    if (dot(front, to_double(normal)) < 0)
      for (Face& f : faces) std::swap(f[1], f[2]);
    return builder_.element(piece.material, nodes_[node].radius, std::span(faces).first(n - 2));
  }

  const LeafPieces& pieces_;
  LeafCollapseOptions options_;
  CrownField field_;
  RadiusAncestors ancestors_;
  SpectrumBuilder builder_;
  ShapeOptions shape_;
  Double3 offset_;
  std::vector<Node> nodes_;
  std::vector<Patch> patches_;
  std::vector<LeafShape> shapes_;  // one a merge
  std::vector<std::uint32_t> groups_, first_node_, piece_element_;
};

}  // namespace

Spectrum collapse_spectrum(const Tree& tree, const LeafCollapseOptions& options) {
  const LeafPieces pieces = leaf_pieces(tree);
  return Collapse(tree, pieces, options).run();
}

}  // namespace copse
