// principal_axes: mean and axes of largest and smallest spread, of points and of surfaces.
//
// Source: digest 002, sections 4.0 and 4.3.d (the covariance of triangles, as corrected there). Eigenvectors
// by cyclic Jacobi rotations: orthonormal whatever the eigenvalues.
#pragma once

#include "lib/analysis/hull/frame.h"
#include "lib/formats/vec.h"

#include <array>
#include <cstdint>
#include <span>

namespace copse {

struct PrincipalAxes {
  Double3 mean;
  Axes axes = k_world_axes;           // right-handed, by descending variance
  std::array<double, 3> variances{};  // >= 0
};

// Of each distinct point once. Coordinates within 2 (a PointCloud's). The order of the points does not change
// one bit: terms are added as multiples of a fixed unit, so that no sum rounds (up to 2^31 points). Variances
// below 2^-49 are rounding. No points: the origin and the world's axes. O(n), one pass.
PrincipalAxes principal_axes(std::span<const Double3> points);

// Of the triangles' area, each triangle's own spread included. Without area: of the points. The order of the
// triangles does not change one bit either.
PrincipalAxes principal_axes(std::span<const Double3> points,
                             std::span<const std::array<std::uint32_t, 3>> triangles);

// The same for a symmetric matrix {xx, xy, xz, yy, yz, zz}.
struct Eigen3 {
  Axes axes = k_world_axes;
  std::array<double, 3> values{};  // descending
};
Eigen3 eigen_of(const std::array<double, 6>& symmetric);

}  // namespace copse
