// NURBS surfaces: the terrain as a user shapes it, by moving control points.
//
// Source: digest 000, section 2.5; Piegl and Tiller, "The NURBS Book", algorithms A2.1, A2.2 and A4.3. Exact
// for circles, cylinders, spheres and all other quadrics, with the right weights.
#pragma once

#include "lib/formats/vec.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace copse {

inline constexpr int k_max_degree = 16;

// Control point (i, j), i along u, is points[j * count_u + i].
struct NurbsSurface {
  int degree_u = 3, degree_v = 3;  // 1 to k_max_degree
  std::size_t count_u = 0, count_v = 0;
  std::vector<double> knots_u, knots_v;  // count + degree + 1, non-decreasing
  std::vector<Double3> points;
  std::vector<double> weights;  // one a point, > 0; empty: all 1
};

// The first thing that is wrong ("knots_u[3] is below the knot before it"), or nothing.
std::string fault_of(const NurbsSurface& surface);

// 0 ... 0 1 2 ... n 1 ... scaled to [0, 1], the first and last knot repeated degree + 1 times, so that the
// surface begins and ends at its outer points.
std::vector<double> clamped_knots(std::size_t count, int degree);

// Where control points must stand for their coordinate to be linear in the parameter: the mean of `degree`
// consecutive knots (Greville).
std::vector<double> greville(std::span<const double> knots, int degree);

// The point at (u, v), each clamped to the surface's domain: the knots from `degree` to count. At the end of
// the domain the last non-empty span counts as closed (hazard H28). Precondition: no fault.
Double3 evaluate(const NurbsSurface& surface, double u, double v);

// columns x rows points at equal steps of the parameters, row after row, u along a row. In parallel.
// Precondition: no fault, both at least 2.
std::vector<Double3> sample(const NurbsSurface& surface, std::size_t columns, std::size_t rows);

}  // namespace copse
