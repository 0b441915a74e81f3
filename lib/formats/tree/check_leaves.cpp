#include "lib/formats/tree/check_parts.h"
#include "lib/formats/tree/check_tolerance.h"
#include "lib/formats/tree/scan.h"

#include <fmt/format.h>

namespace copse {
namespace {

// A leaf's centre is a mean of its vertices, so it cannot leave their box but by rounding.
void check_centres(const Check& check) {
  const Tree& tree = check.tree;
  const Leaves& l = tree.leaves;
  const auto slack = static_cast<float>(length_tolerance(0, largest_coordinate(box_of(l.vertices))));
  for (std::size_t leaf = 0; leaf < l.centres.size(); ++leaf) {
    FloatBox box;
    const std::size_t end = tree.first_triangle_of_leaf(leaf + 1);
    for (std::size_t t = tree.first_triangle_of_leaf(leaf); t < end; ++t) {
      for (const std::uint32_t v : l.triangles[t].vertex) box.grow(l.vertices[v]);
    }
    const Float3 c = l.centres[leaf];
    const bool inside = c.x >= box.min.x - slack && c.y >= box.min.y - slack && c.z >= box.min.z - slack &&
                        c.x <= box.max.x + slack && c.y <= box.max.y + slack && c.z <= box.max.z + slack;
    if (!inside && !box.empty()) {
      check.add("LCEN", leaf, "the centre is outside the leaf's box",
                [&] { return fmt::format("({} {} {})", c.x, c.y, c.z); });
    }
  }
}

}  // namespace

bool check_leaves(const Check& check) {
  const Leaves& l = check.tree.leaves;
  const TreeCounts& c = check.counts();
  const bool corners = check.corners("LTRI", l.triangles, c.leaf_vertices, c.leaf_normals, c.leaf_texcoords);
  const bool offsets = check.offsets("LFIR", l.first_triangle, c.leaf_triangles);
  const bool materials = check.below("LMAT", l.materials, c.materials, "materials", true);
  const bool vertices = check.finite("LVTX", l.vertices);
  check.finite("LNRM", l.normals);
  check.finite("LTEX", l.texcoords);
  const bool centres = check.finite("LCEN", l.centres);
  if (vertices) check.inside("LVTX", l.vertices, check.head.header.bounds, "the tree");
  const bool present = c.leaf_triangles > 0 && l.triangles.size() == c.leaf_triangles &&
                       l.vertices.size() == c.leaf_vertices &&
                       (check.head.header.leaf_factor != 0 || !l.first_triangle.empty());
  if (!present || !corners || !offsets || !materials || !vertices) return false;
  if (centres && !l.centres.empty()) check_centres(check);
  return true;
}

}  // namespace copse
