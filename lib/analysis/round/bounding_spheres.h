// bounding_spheres: of the box, about the mean, of extreme points, and the smallest.
//
// Source: digest 002, section 4.2; J. Ritter, "An efficient bounding sphere" (Graphics Gems, 1990); T.
// Larsson, "Fast and tight fitting bounding spheres" (2008).
#pragma once

#include "lib/analysis/hull/point_cloud.h"
#include "lib/analysis/volumes/bounded_fit.h"
#include "lib/formats/volumes/volume.h"

#include <cstdint>
#include <vector>

namespace copse {

// All in cloud coordinates; O(n). None depends on the order of the points.

// About the centre of the box; as large as the points need, not the box's corners.
BoundingSphere<double> box_sphere(const PointCloud& cloud);

// About the mean of the distinct points.
BoundingSphere<double> mean_sphere(const PointCloud& cloud);

// The smallest ball of what is extreme along seven directions, twice moved towards the farthest point
// (Ritter).
BoundingSphere<double> extremal_sphere(const PointCloud& cloud);

struct SupportedSphere {
  BoundedFit<BoundingSphere<double>> fit;  // minimal; the bound is the ball of the support alone
  std::vector<std::uint32_t> support;      // at most 4 of the points, all on the sphere; ascending
};
SupportedSphere smallest_sphere(const PointCloud& cloud);

}  // namespace copse
