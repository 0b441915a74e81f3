// The point of a set that lies farthest in some measure.
#pragma once

#include "lib/formats/vec.h"

#include <cstddef>
#include <span>

namespace copse {

// The index of the point where `measure` is largest; the first of equals, 0 of none. Linear.
template <class Measure>
std::size_t farthest(std::span<const Double3> points, Measure&& measure) {
  std::size_t best = 0;
  double most = -1;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double m = measure(points[i]);
    if (m > most) most = m, best = i;
  }
  return best;
}

}  // namespace copse
