#include "lib/analysis/leaves/piece_scan.h"

#include <algorithm>
#include <array>
#include <bit>

namespace copse {
namespace {

constexpr double k_wide = 0.5;       // of the mesh, along x and along z
constexpr double k_on_ground = 0.1;  // of the mesh's height
// Twice a triangle's area over the square of its longer side: what six digits of a file make of none.
constexpr double k_no_area = 1e-5;

bool is_wide(const DoubleBox& piece, const DoubleBox& mesh) {
  return piece.extent().x >= k_wide * mesh.extent().x && piece.extent().z >= k_wide * mesh.extent().z;
}

// The border is all shared with triangles of other keys, and there is one.
bool lies_on_others(const Pieces& pieces, std::span<const std::uint32_t> triangles) {
  bool any = false;
  for (const std::uint32_t t : triangles) {
    const unsigned border = pieces.edges[t] & 7u, shared = pieces.edges[t] >> 3 & 7u;
    if (border & ~shared) return false;
    any |= border != 0;
  }
  return any;
}

// Triangles one after the other, each with a side on the border, two of them (the ends) with two.
bool is_strip(const Pieces& pieces, std::span<const std::uint32_t> triangles) {
  std::size_t ends = 0;
  for (const std::uint32_t t : triangles) {
    const int sides = std::popcount(pieces.edges[t] & 7u);
    if (sides < 1 || sides > 2) return false;
    ends += sides == 2;
  }
  return ends == 2;
}

// The piece without what a damaged file adds: triangles that are there twice, and triangles without area.
class Strip {
 public:
  Strip(const Mesh& mesh, std::span<const std::uint32_t> welded, std::span<const std::uint32_t> triangles)
      : mesh_(mesh) {
    for (const std::uint32_t t : triangles) {
      Triangle v = mesh.triangles[t];
      if (!has_area(v)) continue;
      for (std::uint32_t& corner : v) corner = welded[corner];
      std::ranges::sort(v);
      if (v[0] != v[1] && v[1] != v[2]) triangles_.push_back(v);
    }
    std::ranges::sort(triangles_);
    const auto repeated = std::ranges::unique(triangles_);
    triangles_.erase(repeated.begin(), repeated.end());
    for (const Triangle& v : triangles_) {
      for (int e = 0; e < 3; ++e) edges_.push_back(edge(v, e));
    }
    std::ranges::sort(edges_);
  }

  bool is_strip() const {
    std::size_t ends = 0;
    for (const Triangle& v : triangles_) {
      const int sides = is_border(edge(v, 0)) + is_border(edge(v, 1)) + is_border(edge(v, 2));
      if (sides < 1 || sides > 2) return false;
      ends += sides == 2;
    }
    return ends == 2;
  }
  bool has_side_below_zero() const {
    return std::ranges::any_of(edges_, [&](const Edge& e) {
      return mesh_.positions[e[0]].y < 0 && mesh_.positions[e[1]].y < 0 && is_border(e);
    });
  }

 private:
  using Edge = std::array<std::uint32_t, 2>;
  static Edge edge(const Triangle& v, int e) {
    const std::uint32_t a = v[e], b = v[(e + 1) % 3];
    return {std::min(a, b), std::max(a, b)};
  }
  bool is_border(const Edge& e) const { return std::ranges::equal_range(edges_, e).size() == 1; }
  bool has_area(const Triangle& v) const {
    const Double3 a = mesh_.positions[v[1]] - mesh_.positions[v[0]];
    const Double3 b = mesh_.positions[v[2]] - mesh_.positions[v[0]];
    return length(cross(a, b)) > k_no_area * std::max(dot(a, a), dot(b, b));
  }

  const Mesh& mesh_;
  std::vector<Triangle> triangles_;
  std::vector<Edge> edges_;
};

bool has_side_below_zero(const Mesh& mesh, const Pieces& pieces, std::span<const std::uint32_t> triangles) {
  for (const std::uint32_t t : triangles) {
    for (int e = 0; e < 3; ++e) {
      const Triangle& v = mesh.triangles[t];
      const bool border = (pieces.edges[t] & Pieces::border_0 << e) != 0;
      if (border && mesh.positions[v[e]].y < 0 && mesh.positions[v[(e + 1) % 3]].y < 0) return true;
    }
  }
  return false;
}

}  // namespace

PieceScan::PieceScan(const Mesh& mesh, std::span<const std::uint32_t> welded, Pieces pieces,
                     std::span<const PartVerdict> verdicts)
    : pieces_(std::move(pieces)),
      triangles_(triangles_of(pieces_.of, pieces_.count)),
      part_of_(mesh.part_of),
      facts_(pieces_.count) {
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) bounds_.grow(mesh.positions[v]);
  }
  for (std::uint32_t p = 0; p < pieces_.count; ++p) {
    facts_[p].decided = verdicts[part(p)].binding == Binding::firm;
    if (!facts_[p].decided) facts_[p] = read(mesh, welded, p);
  }
}

PieceFact PieceScan::read(const Mesh& mesh, std::span<const std::uint32_t> welded, std::uint32_t piece) {
  const std::span<const std::uint32_t> triangles = triangles_.of(piece);
  const PieceShape shape = shape_of(mesh, welded, pieces_, triangles);
  PieceFact fact;
  fact.shape = shape.kind;
  fact.planar = shape.planar;
  fact.solid = shape.solid;
  if (shape.kind == ShapeKind::sheet) {
    fact.layered = shape.border_ratio == 0 && !shape.solid && shape.area > 0;
    fact.capped = lies_on_others(pieces_, triangles);
    fact.strip = is_strip(pieces_, triangles);
    fact.stands = shape.box.min.y <= bounds_.min.y + k_on_ground * bounds_.extent().y;
    fact.rooted = fact.strip && has_side_below_zero(mesh, pieces_, triangles);
    // Sorting is for those alone that may be blades of grass.
    if (!fact.strip && fact.stands) {
      const Strip strip(mesh, welded, triangles);
      fact.strip = strip.is_strip();
      fact.rooted = fact.strip && strip.has_side_below_zero();
    }
  }
  if (shape.kind != ShapeKind::sheet || is_wide(shape.box, bounds_)) placed_.push_back({piece, shape});
  std::vector<std::uint32_t>& count = alike_[static_cast<int>(shape.kind)];
  if (count.size() <= triangles.size()) count.resize(std::max(triangles.size() + 1, 2 * count.size()), 0);
  ++count[triangles.size()];
  return fact;
}

std::uint32_t PieceScan::alike(std::uint32_t piece) const {
  return alike_[static_cast<int>(facts_[piece].shape)][triangles_.of(piece).size()];
}

}  // namespace copse
