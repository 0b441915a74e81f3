// principal_frame: mean and principal axes of points, the start of every fit of the Gaussian class.
//
// Source: digest 002, section 4.0 (the sums run over 0 .. n - 1, two passes); Jacobi's method, whose axes are
// orthonormal whatever the eigenvalues.
#pragma once

#include "lib/analysis/volumes/swept_shape.h"

#include <span>

namespace copse {

struct PrincipalFrame {
  Double3 mean;
  Frame3 axes;  // right-handed, by decreasing variance; row 0 is the direction of the least-squares line
  Double3 variances;  // along them
};

// At least one point. Equal variances leave the axes between them arbitrary, but the same for the same points
// in the same order. O(n).
PrincipalFrame principal_frame(std::span<const Double3> points);

// The same of a symmetric matrix (its upper triangle is read): rows are eigenvectors.
void principal_axes(std::array<Double3, 3> matrix, Frame3& axes, Double3& values);

}  // namespace copse
