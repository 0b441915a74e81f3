// ellipsoids: axis-aligned, Gaussian, and of least volume with a bound of how small any can be.
//
// Source: digest 002, section 4.7 (as corrected: semi-axes are square roots of eigenvalues). Minimal: L.
// Khachiyan (1996) with the away steps of M. Todd and E. Yildirim (2007) from the start of P. Kumar and E.
// Yildirim (2005). Weights w of the points give a centre and a covariance S; any enclosing ellipsoid of
// dimension d has at least the volume of the unit ball times sqrt(d^d det S), and the weights that make this
// largest are those of the minimal one.
#pragma once

#include "lib/analysis/hull/convex_hull.h"
#include "lib/analysis/hull/deadline.h"
#include "lib/analysis/volumes/bounded_fit.h"
#include "lib/formats/volumes/volume.h"

namespace copse {

// All in cloud coordinates. A cloud without thickness along an axis gets 0 there, or for a tilted flat cloud
// what rounding leaves.

// About the box's centre, with its proportions.
Ellipsoid<double> axis_aligned_ellipsoid(const PointCloud& cloud);

// About the mean, along the principal axes, semi-axes in proportion to the standard deviations.
Ellipsoid<double> gaussian_ellipsoid(const PointCloud& cloud);

struct MinimalEllipsoidOptions {
  double gap = 1e-5;  // stop when the volume is at most (1 + gap) times the bound
  int max_steps = 20'000;
  Deadline deadline = {};
};

// Flat clouds: the minimal ellipse or segment, other semi-axes and the bound 0. O(vertices) a step, some
// hundreds to thousands of steps.
BoundedFit<Ellipsoid<double>> minimal_ellipsoid(const ConvexHull& hull,
                                                const MinimalEllipsoidOptions& options = {});

}  // namespace copse
