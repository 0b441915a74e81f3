#include "lib/analysis/rings/axis.h"

#include "lib/analysis/surface/welded_tolerances.h"

#include <algorithm>
#include <cmath>

namespace copse {

namespace {

// Solves the symmetric positive definite system whose columns are a, b, c.
Double3 solve(const Double3& a, const Double3& b, const Double3& c, const Double3& right) {
  const double det = dot(a, cross(b, c));
  return Double3{dot(right, cross(b, c)), dot(a, cross(right, c)), dot(a, cross(b, right))} / det;
}

}  // namespace

Double3 meeting_point(std::span<const AxisLine> lines) {
  Double3 mean;
  double weight = 0;
  for (const AxisLine& l : lines) mean += l.point * l.weight, weight += l.weight;
  if (!(weight > 0)) return lines.empty() ? Double3{} : lines[0].point;
  mean = mean / weight;
  double reach = 0;
  for (const AxisLine& l : lines) reach = std::max(reach, distance(l.point, mean));

  // Minimises sum w |(I - d d^T)(x - p)|^2 + pull |x - mean|^2 over x - mean.
  const double pull = k_meeting_pull * weight;
  Double3 a{pull, 0, 0}, b{0, pull, 0}, c{0, 0, pull}, right;
  for (const AxisLine& l : lines) {
    const Double3 d = l.direction, p = l.point - mean;
    a += (Double3{1, 0, 0} - d * d.x) * l.weight;
    b += (Double3{0, 1, 0} - d * d.y) * l.weight;
    c += (Double3{0, 0, 1} - d * d.z) * l.weight;
    right += (p - d * dot(d, p)) * l.weight;
  }
  const Double3 x = solve(a, b, c, right);
  return is_finite(x) && length(x) <= reach ? mean + x : mean;
}

double nearest_on_segment(const Double3& a, const Double3& b, const Double3& p) {
  const Double3 d = b - a;
  const double l = length(d);
  return l > 0 ? std::clamp(dot((p - a) / l, d / l), 0.0, 1.0) : 0;
}

}  // namespace copse
