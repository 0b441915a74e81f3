// kd_tree: the adaptive k-ary kd-tree over boxes, top down.
//
// The centres of the boxes are sorted along the axis on which they spread most and cut into k runs of equal
// count, again and again, until a run has no more than k items. There is no cost function and nothing is
// split.
//
// Source: digest 002, section 3.2 (the dissertation's section 3.5), which measured k = 2, 3, 4, 8, 16.
#pragma once

#include "lib/analysis/bvh/box_tree.h"

namespace copse {

// boxes: finite, none empty, fewer than 2^31; k >= 2. Ties go by index, so the same boxes give the same tree.
// O(n log^2 n); depth at most ceil(log_k n).
BoxTree kd_tree(std::span<const DoubleBox> boxes, std::uint32_t k);

}  // namespace copse
