#include "lib/analysis/tree/tree_parts.h"

namespace copse {

TreeParts::TreeParts(const Tree& tree, const FoliageCells* cells) : tree_(tree), cells_(cells) {
  for (const Float3& v : trunk_vertices(tree)) points_.push_back(to_double(v));
  trunk_points_ = static_cast<std::uint32_t>(points_.size());
  for (const Float3& v : tree.leaves.vertices) points_.push_back(to_double(v));
  local_.assign(points_.size(), k_none);
}

std::uint32_t TreeParts::count(VolumePart part) const {
  switch (part) {
    case VolumePart::whole:
    case VolumePart::trunk:
    case VolumePart::leaves:
      return 1;
    case VolumePart::group:
      return static_cast<std::uint32_t>(tree_.leaves.groups.size());
    case VolumePart::segment:
      return static_cast<std::uint32_t>(tree_.segment_count());
    case VolumePart::cell:
      return cells_ != nullptr ? static_cast<std::uint32_t>(cells_->cells.size()) : 0;
    case VolumePart::node:
      break;
  }
  return 0;
}

bool TreeParts::groups_have_leaves() const {
  const Leaves& l = tree_.leaves;
  return l.groups.empty() || (!l.order.empty() && !l.triangles.empty());
}

void TreeParts::add(std::uint32_t point, TreePart& part) {
  if (local_[point] != k_none) return;
  local_[point] = static_cast<std::uint32_t>(part.points.size());
  part.points.push_back(point);
}

void TreeParts::add(const CornerTriangle& triangle, std::uint32_t base, TreePart& part) {
  Triangle t{};
  for (std::size_t c = 0; c < 3; ++c) {
    add(base + triangle.vertex[c], part);
    t[c] = local_[base + triangle.vertex[c]];
  }
  part.triangles.push_back(t);
}

void TreeParts::close(const TreePart& part) {
  for (const std::uint32_t p : part.points) local_[p] = k_none;
}

TreePart TreeParts::of_leaves(std::span<const std::uint32_t> leaves) {
  TreePart part;
  if (tree_.leaves.triangles.empty()) return part;  // left out
  for (const std::uint32_t leaf : leaves) {
    const std::size_t end = tree_.first_triangle_of_leaf(leaf + 1);
    for (std::size_t t = tree_.first_triangle_of_leaf(leaf); t < end; ++t)
      add(tree_.leaves.triangles[t], trunk_points_, part);
  }
  close(part);
  return part;
}

TreePart TreeParts::part(VolumePart which, std::uint32_t index) {
  if (which == VolumePart::group) {
    if (!groups_have_leaves()) return {};
    const LeafGroup& group = tree_.leaves.groups[index];
    return of_leaves(tree_.leaves.order.span().subspan(group.first, group.count));
  }
  if (which == VolumePart::cell) {
    const FoliageCell& cell = cells_->cells[index];
    return of_leaves(cells_->order.span().subspan(cell.first, cell.count));
  }
  TreePart part;
  const Array<CornerTriangle>&trunk = tree_.trunk.triangles, &leaves = tree_.leaves.triangles;
  const auto all = static_cast<std::uint32_t>(points_.size());
  const bool has_trunk = which == VolumePart::whole || which == VolumePart::trunk;
  const bool has_leaves = which == VolumePart::whole || which == VolumePart::leaves;
  if (has_trunk) {
    for (std::uint32_t p = 0; p < trunk_points_; ++p) add(p, part);
    for (const CornerTriangle& t : trunk) add(t, 0, part);
  }
  if (has_leaves) {
    for (std::uint32_t p = trunk_points_; p < all; ++p) add(p, part);
    for (const CornerTriangle& t : leaves) add(t, trunk_points_, part);
  }
  if (which == VolumePart::segment) {
    const std::size_t end = tree_.first_triangle_of_segment(index + 1);
    for (std::size_t t = tree_.first_triangle_of_segment(index); t < end; ++t) add(trunk[t], 0, part);
  }
  close(part);
  return part;
}

}  // namespace copse
