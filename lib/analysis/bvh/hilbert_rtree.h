// hilbert_rtree: the static R-tree packed along a Hilbert curve, bottom up.
//
// Items are sorted by the Hilbert coordinate of their boxes' centres and grouped k at a time; the groups are
// sorted again by the centres of their own boxes, and so on until one group holds all.
//
// Source: digest 002, section 3.3 (the dissertation's section 3.7, after Kamel and Faloutsos 1993), which
// measured k = 2, 4, 8. The coordinate: J. Skilling, "Programming the Hilbert curve" (2004).
#pragma once

#include "lib/analysis/bvh/box_tree.h"

#include <array>

namespace copse {

// boxes: finite, none empty, fewer than 2^31; k >= 2. Centres are quantised to 2^21 steps of one cube round
// all of them; ties go by index. O(n log n); all but the last node of a level are full.
BoxTree hilbert_rtree(std::span<const DoubleBox> boxes, std::uint32_t k);

// The place of a cell on the three-dimensional Hilbert curve of order `bits` (1 to 21): a bijection from
// cells (each coordinate below 2^bits) to 0 .. 2^(3 bits) - 1; cells next to one another on the curve share
// a face.
std::uint64_t hilbert_index(std::array<std::uint32_t, 3> cell, int bits);

// The order of points along the curve.
std::vector<std::uint32_t> hilbert_order(std::span<const Double3> points);

}  // namespace copse
