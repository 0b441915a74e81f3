// tree_parts: the vertices of a tree and of its parts, and the triangles between them.
#pragma once

#include "lib/formats/levels/foliage_cells.h"
#include "lib/formats/mesh.h"
#include "lib/formats/tree/tree.h"
#include "lib/formats/tree_file/tree_volumes.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

struct TreePart {
  std::vector<std::uint32_t> points;  // indices into TreeParts::points(), each once
  std::vector<Triangle> triangles;    // over `points`
};

// Of a tree, and its foliage cells where it has some, that must outlive it and whose indices are in range
// (they were loaded with Trust::nothing).
class TreeParts {
 public:
  explicit TreeParts(const Tree& tree, const FoliageCells* cells = nullptr);

  // The trunk's vertices, then the leaves', relative to the tree's origin, as float32.
  const std::vector<Double3>& points() const { return points_; }
  std::uint32_t trunk_points() const { return trunk_points_; }

  // How many of a part there are: 1 of whole, trunk and leaves; none of nodes, which are made of others.
  std::uint32_t count(VolumePart part) const;
  // Whether the leaves of each group are known: neither LORD nor LTRI were left out.
  bool groups_have_leaves() const;

  // index < count(part). Nothing where its triangles were left out. O(its triangles); whole, trunk and
  // leaves: O(vertices).
  TreePart part(VolumePart part, std::uint32_t index = 0);

 private:
  // Of some leaves, all in range.
  TreePart of_leaves(std::span<const std::uint32_t> leaves);
  void add(const CornerTriangle& triangle, std::uint32_t base, TreePart& part);
  void add(std::uint32_t point, TreePart& part);
  void close(const TreePart& part);
  const Tree& tree_;
  const FoliageCells* cells_;
  std::vector<Double3> points_;
  std::uint32_t trunk_points_ = 0;
  std::vector<std::uint32_t> local_;  // of a point in the part that is being gathered, k_none outside
};

}  // namespace copse
