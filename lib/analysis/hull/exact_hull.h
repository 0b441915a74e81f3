// The hull of points that do not lie in one plane, by exact predicates: what convex_hull is built on.
#pragma once

#include "lib/analysis/hull/quickhull.h"
#include "lib/formats/vec.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace copse {

struct ExactHull {
  std::vector<std::uint32_t> vertices;  // indices of the points, ascending: the corners and no other point
  // Of `vertices`, counter-clockwise from outside, sorted. A facet of more than three corners is a fan around
  // the first of them: the hull is a function of the points alone.
  std::vector<std::array<std::uint32_t, 3>> faces;
  std::vector<std::uint32_t> outside;  // ascending: the points that it does not hold, where it was cut short
};

// `points`: distinct, in lexicographic order, four of them not in one plane (else the hull is empty).
ExactHull exact_hull(std::span<const Double3> points, const QuickhullLimits& limits = {});

}  // namespace copse
