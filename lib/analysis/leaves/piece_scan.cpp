#include "lib/analysis/leaves/piece_scan.h"

#include <algorithm>

namespace copse {
namespace {

constexpr double k_wide = 0.5;  // of the mesh, along x and along z

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
