// smallest_circle: the smallest circle that encloses points of a plane.
//
// Source: as minimal_sphere.h, in the plane: the circle of at most three points is enlarged by the farthest
// one until none lies outside; of all circles through two or three of the four points the one with the
// nearest farthest point is taken, so that no step depends on a tolerance. For the inner loop of a search,
// where a general solver's set-up would cost more than the circle.
#pragma once

#include "lib/formats/vec.h"

#include <array>
#include <cstdint>
#include <span>

namespace copse {

struct SmallestCircle {
  Vec2<double> centre;
  double radius = 0;        // reaches every point, but for the rounding of the distance
  double lower_radius = 0;  // of the smallest circle round the support alone
  std::array<std::uint32_t, 3> support{};
  int supports = 0;  // of them
};

// Finite points, |p| about 1. The radius is within 1e-12 of the least, or within the rounding of the
// coordinates. None: all 0. O(n) a step, some five steps, one or two from points that are `likely` (indices,
// at most three) to hold it; nothing is allocated.
SmallestCircle smallest_circle(std::span<const Vec2<double>> points,
                               std::span<const std::uint32_t> likely = {});

}  // namespace copse
