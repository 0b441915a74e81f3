// Lines and points: which segments of a trunk are drawn as lines of which width, which leaves of a group as
// points, and what is left for triangles (digest 000, sections 3.5 and 3.6, with errata E7, E9, E14, E16).
// All by the order of the file's arrays: nothing is sorted, no call allocates.
#pragma once

#include "lib/formats/tree/tree.h"

#include <array>
#include <cstdint>
#include <span>

namespace copse {

inline constexpr int k_widest_line = 16;  // pixels

// What may be drawn. Larger maxima are faster and poorer.
struct PrimitiveSizes {
  int least_width = 1, largest_width = 4;  // of lines, pixels, 1 to k_widest_line
  double point_size = 2;                   // of a point's side, pixels, above 0
};

// `pixel`: metres that a pixel covers on the plane at distance 1, 2 tan(fov / 2) / lines. `scale`: of the
// instance.
struct PrimitiveView {
  double pixel = 0.001, scale = 1;
};

// Segments [0, discarded) are thinner than half of the least width and not drawn; [first_of(w), end[w]) are
// lines w pixels wide; [triangles, segments) are drawn as triangles.
struct TrunkSelection {
  std::uint32_t discarded = 0, triangles = 0;
  std::array<std::uint32_t, k_widest_line + 1> end{};  // by width; widths that are not used are empty
  std::uint32_t first_of(int width) const { return width > 0 ? end[static_cast<std::size_t>(width) - 1] : 0; }
  std::uint32_t lines() const { return triangles - discarded; }
};

// `diameters` ascend; `depth` is that of the trunk's centre along the view, metres. Behind the eye (depth not
// above 0) everything is triangles. O(widths log segments).
TrunkSelection select_trunk(std::span<const float> diameters, double depth, const PrimitiveView& view,
                            const PrimitiveSizes& sizes);

// Of a group's leaves in its order, innermost first: [first_point, end_point) as points, [first_leaf,
// end_leaf) as triangles.
struct GroupSelection {
  std::uint32_t first_point = 0, end_point = 0, first_leaf = 0, end_leaf = 0;
  std::uint32_t points() const { return end_point - first_point; }
};

// As many points as cover the projected area of the leaves, estimated as n a / (1.8 z^2): the outermost ones
// alone where they are fewer than the leaves; up to twice as many, the innermost as points and the rest as
// triangles, so that the change is continuous at both ends; beyond that, and behind the eye, all triangles.
GroupSelection select_group(const LeafGroup& group, double depth, const PrimitiveView& view,
                            const PrimitiveSizes& sizes);

}  // namespace copse
