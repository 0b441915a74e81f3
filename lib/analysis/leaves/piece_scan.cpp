#include "lib/analysis/leaves/piece_scan.h"

#include <algorithm>
#include <array>
#include <bit>

namespace copse {
namespace {

constexpr double k_wide = 0.5;       // of the mesh, along x and along z
constexpr double k_on_ground = 0.1;  // of the mesh's height

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
      : mesh_(mesh), triangles_(sound_triangles(mesh, welded, triangles)) {
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
  DoubleBox sides_below(double level) const {
    DoubleBox box;
    for (const Edge& e : edges_) {
      const Double3 &a = mesh_.positions[e[0]], &b = mesh_.positions[e[1]];
      if (a.y < level && b.y < level && is_border(e)) box.grow(a), box.grow(b);
    }
    return box;
  }

 private:
  using Edge = std::array<std::uint32_t, 2>;
  static Edge edge(const Triangle& v, int e) {
    const std::uint32_t a = v[e], b = v[(e + 1) % 3];
    return {std::min(a, b), std::max(a, b)};
  }
  bool is_border(const Edge& e) const { return std::ranges::equal_range(edges_, e).size() == 1; }

  const Mesh& mesh_;
  std::vector<Triangle> triangles_;
  std::vector<Edge> edges_;
};

// What the sides on the border that lie below a level take up.
DoubleBox sides_below(double level, const Mesh& mesh, const Pieces& pieces,
                      std::span<const std::uint32_t> triangles) {
  DoubleBox box;
  for (const std::uint32_t t : triangles) {
    for (int e = 0; e < 3; ++e) {
      if (!(pieces.edges[t] & Pieces::border_0 << e)) continue;
      const Double3& a = mesh.positions[mesh.triangles[t][e]];
      const Double3& b = mesh.positions[mesh.triangles[t][(e + 1) % 3]];
      if (a.y < level && b.y < level) box.grow(a), box.grow(b);
    }
  }
  return box;
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
    const double ground = bounds_.min.y + k_on_ground * bounds_.extent().y;
    fact.stands = shape.box.min.y <= ground;
    DoubleBox below_zero, foot;
    if (fact.strip) {
      below_zero = sides_below(0, mesh, pieces_, triangles);
      if (fact.stands) foot = sides_below(ground, mesh, pieces_, triangles);
    } else if (fact.stands) {
      // Sorting is for those alone that may be blades of grass.
      const Strip strip(mesh, welded, triangles);
      fact.strip = strip.is_strip();
      if (fact.strip) below_zero = strip.sides_below(0), foot = strip.sides_below(ground);
    }
    fact.rooted = !below_zero.empty();
    fact.footed = !foot.empty() && shape.box.max.y > ground;
    if (fact.footed) feet_.grow(foot);
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
