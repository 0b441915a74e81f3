// Hulls for tests whose points are about 1 in size already: in the points' own coordinates.
#pragma once

#include "lib/analysis/hull/convex_hull.h"

#include <gtest/gtest.h>

namespace copse {

inline ConvexHull hull_of(std::span<const Double3> points) {
  PointCloud cloud;
  cloud.points.assign(points.begin(), points.end());
  for (const Double3& p : points) cloud.box.grow(p);
  return convex_hull(cloud);
}

}  // namespace copse
