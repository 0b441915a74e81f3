// Small trees whose every array is known: a forked stem of square rings with two leaves.
#pragma once

#include "lib/formats/tree/tree.h"

#include <cstdint>
#include <vector>

namespace copse::testing {

// Radii (breadth first): 0 root (0, 0, 0) d 0.4; 1 (0, 1, 0) d 0.3, its child; 2 (0, 2, 0) d 0.2 and
// 3 (1, 1, 0) d 0.1 (a joint), the children of 1, both terminal. k = 4. Segments, by ascending diameter: 1-2,
// 0-1, each of 8 triangles. Two leaves of two triangles each hang on radius 2 in one group, the second one
// first; the leaves have texture coordinates and material 1, the trunk neither.
Tree little_stree();

// The same as a .tree: lines 1-2 and 0-1 over the centres of radii 0, 1, 2.
Tree little_tree();

}  // namespace copse::testing
