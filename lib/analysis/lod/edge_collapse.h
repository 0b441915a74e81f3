// Half-edge collapses of a triangle mesh in the order of what they cost (digest 003, sections 6 and 8): the
// vertices of every state are a subset of the mesh's own, and one collapse is a record of a few numbers,
// never an index list.
#pragma once

#include "lib/formats/levels/part_triangles.h"

#include <cstdint>
#include <vector>

namespace copse {

struct EdgeCollapseOptions {
  double attribute_weight =
      0.3;  // of a normal or a texture coordinate that is wrong by 1, in diagonals of the box
  double fold_cosine = 0.2;         // a collapse that turns a face by more than this angle is a fold
  double max_error = 0.02;          // no collapse that errs by more, rms, in diagonals of the box
  std::uint64_t min_triangles = 0;  // no collapse is made once there are fewer than this
};

// A vertex takes the place of another; a collapse at a seam of the texture has several of these, one a wedge.
struct CollapsedWedge {
  std::uint32_t thrown = 0, kept = 0;
};

struct EdgeCollapses {
  std::vector<CollapsedWedge> wedges;
  std::vector<std::uint32_t> first{0};  // collapses + 1 offsets into wedges
  std::vector<float> errors;    // one a collapse: rms distance from the planes of the original faces, metres
  std::uint64_t triangles = 0;  // that are left after all of them

  std::size_t size() const { return errors.size(); }
};

// Quadrics of the faces' planes, of planes across borders and seams, and of the gradients of normals and
// texture coordinates, always measured against the original (hazard H-25). A collapse is refused when it
// turns a face over, breaks the link condition, makes a face twice, opens a seam, or moves a border off
// itself; vertices that are no manifold stay. Edges that are sharp in their normals alone are no seams.
// Duplicate and degenerate faces are not in the way: they go first. Ties: the lower vertex. Runs in passes of
// independent collapses: O(n log n) in all. Sources: Garland and Heckbert 1997; Hoppe 1999 (attributes);
// digest 003 section 6.9 (guards).
EdgeCollapses collapse_edges(const PartTriangles& mesh, const EdgeCollapseOptions& options = {});

}  // namespace copse
