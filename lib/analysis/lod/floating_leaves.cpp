#include "lib/analysis/lod/floating_leaves.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace copse {
namespace {

constexpr double k_visible_gap = 0.01;  // of the tree's height

// Between the segments p q and a b.
double segment_distance(const Double3& p, const Double3& q, const Double3& a, const Double3& b) {
  const Double3 u = q - p, v = b - a, w = p - a;
  const double uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), uw = dot(u, w), vw = dot(v, w),
               d = uu * vv - uv * uv;
  double s = d > 1e-12 * uu * vv ? std::clamp((uv * vw - vv * uw) / d, 0.0, 1.0) : 0;
  const double t = vv > 0 ? std::clamp((s * uv + vw) / vv, 0.0, 1.0) : 0;
  s = uu > 0 ? std::clamp((t * uv - uw) / uu, 0.0, 1.0) : 0;
  return length(p + u * s - (a + v * t));
}

// Whether the segment a b goes through the triangle.
bool pierces(const std::array<Double3, 3>& t, const Double3& a, const Double3& b) {
  const Double3 n = cross(t[1] - t[0], t[2] - t[0]), d = b - a;
  const double along = dot(n, d), from = dot(n, t[0] - a);
  if (along == 0 || from / along < 0 || from / along > 1) return false;
  const Double3 p = a + d * (from / along);
  for (std::size_t c = 0; c < 3; ++c)
    if (dot(n, cross(t[(c + 1) % 3] - t[c], p - t[c])) < 0) return false;
  return true;
}

double point_distance(const Double3& p, const std::array<Double3, 3>& t) {
  const Double3 n = cross(t[1] - t[0], t[2] - t[0]);
  const double size = length(n);
  bool inside = size > 0;
  for (std::size_t c = 0; inside && c < 3; ++c) inside = dot(n, cross(t[(c + 1) % 3] - t[c], p - t[c])) >= 0;
  return inside ? std::abs(dot(n, p - t[0])) / size : std::numeric_limits<double>::infinity();
}

double triangle_distance(const std::array<Double3, 3>& t, const Double3& a, const Double3& b) {
  if (pierces(t, a, b)) return 0;
  double least = std::min(point_distance(a, t), point_distance(b, t));
  for (std::size_t c = 0; c < 3; ++c) least = std::min(least, segment_distance(t[c], t[(c + 1) % 3], a, b));
  return least;
}

}  // namespace

FloatingLeaves::FloatingLeaves(const Tree& tree, const LodSpectra& spectra)
    : spectra_(spectra), centres_(absolute_centres(tree)), parent_(parents(tree)) {
  for (const Radius& r : tree.hierarchy.radii) half_.push_back(0.5 * r.diameter);
  tolerance_ = k_visible_gap * tree.header.bounds.extent().y;
  const Spectrum& s = spectra.leaves;
  allowed_.assign(centres_.size(), tolerance_);
  for (std::size_t e = 0; e < s.elements.size(); ++e) {
    const std::uint32_t r = s.elements[e].radius;
    if (s.elements[e].birth == 0 && r < allowed_.size()) allowed_[r] = std::max(allowed_[r], gap(e, r));
  }
}

double FloatingLeaves::gap(std::size_t element, std::uint32_t radius) const {
  double least = std::numeric_limits<double>::infinity();
  const Double3 a = centres_[radius], b = parent_[radius] == k_none ? a : centres_[parent_[radius]];
  const Spectrum& s = spectra_.leaves;
  for (std::uint32_t t = s.first_triangle[element]; t < s.first_triangle[element + 1]; ++t) {
    std::array<Double3, 3> corners;
    for (std::size_t c = 0; c < 3; ++c) corners[c] = to_double(s.vertices[s.triangles[t][c]].position);
    least = std::min(least, triangle_distance(corners, a, b) - half_[radius]);
  }
  return least;
}

std::vector<std::uint8_t> FloatingLeaves::alive_radii(std::uint32_t steps) const {
  std::vector<std::uint8_t> alive(centres_.size(), 0);
  for (const SpectrumElement& e : spectra_.trunk.elements) {
    if (steps < e.birth || steps >= e.death) continue;
    // A limb outlives what grows from it: from here down to the root all is there.
    for (std::uint32_t r = e.radius; r < alive.size() && !alive[r]; r = parent_[r]) alive[r] = 1;
  }
  return alive;
}

std::uint64_t FloatingLeaves::count(const LodLevel& level) const {
  if (spectra_.trunk.elements.empty() || centres_.empty()) return 0;
  const std::vector<std::uint8_t> alive = alive_radii(level.trunk_steps);
  std::uint64_t floating = 0;
  const auto& elements = spectra_.leaves.elements;
  for (std::size_t e = 0; e < elements.size(); ++e) {
    if (level.leaf_steps < elements[e].birth || level.leaf_steps >= elements[e].death) continue;
    std::uint32_t r = elements[e].radius;
    if (r >= alive.size() || alive[r]) continue;
    const double allowed = allowed_[r];
    bool reached = false;
    // What is left of the trunk near the bearer: its first ancestor that is there, and a few above.
    while (r != k_none && !alive[r]) r = parent_[r];
    for (int up = 0; up < 4 && r != k_none && !reached; ++up, r = parent_[r]) reached = gap(e, r) <= allowed;
    if (!reached) ++floating;
  }
  return floating;
}

}  // namespace copse
