// Checks of whole arrays at the speed of memory: loops without branches, which the compiler vectorises. They
// answer only whether all is well; who wants to know where something is wrong looks again, element by
// element.
#pragma once

#include "lib/formats/tree/tree.h"

#include <cstdint>
#include <span>

namespace copse {

bool all_finite(std::span<const float> values);
bool all_finite(std::span<const double> values);

// Every value is below `limit`.
bool all_below(std::span<const std::uint32_t> values, std::uint32_t limit);
// Every value is below `limit` or k_none.
bool all_below_or_none(std::span<const std::uint32_t> values, std::uint32_t limit);
// Every corner's vertex is below the first limit; its normal and texture coordinate below theirs, or k_none.
bool corners_below(std::span<const CornerTriangle> triangles, std::uint32_t vertices, std::uint32_t normals,
                   std::uint32_t texcoords);

bool non_decreasing(std::span<const std::uint32_t> values);
bool non_decreasing(std::span<const float> values);
bool non_decreasing(std::span<const double> values);

// The box of points without NaN; empty when there are none.
FloatBox box_of(std::span<const Float3> points);

inline std::span<const float> as_floats(std::span<const Float3> v) {
  return {reinterpret_cast<const float*>(v.data()), v.size() * 3};
}
inline std::span<const float> as_floats(std::span<const Float2> v) {
  return {reinterpret_cast<const float*>(v.data()), v.size() * 2};
}

}  // namespace copse
