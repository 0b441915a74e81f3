#include "lib/analysis/lod/lines_points.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace copse {
namespace {

double depth_of(const EyeAt& eye, const Double3& p) {
  return std::max(dot(eye.position - p, eye.toward), 1.0);
}

// Where a point falls on the plane at distance 1, relative to its middle.
Double3 project(const EyeAt& eye, const Double3& p) {
  const Double3 d = p - eye.position;
  return (d + eye.toward * dot(eye.position - p, eye.toward)) / depth_of(eye, p);
}

double projected_area(const EyeAt& eye, const std::array<Double3, 3>& t) {
  const Double3 a = project(eye, t[0]);
  return 0.5 * length(cross(project(eye, t[1]) - a, project(eye, t[2]) - a));
}

std::array<Double3, 3> corners(const CornerTriangle& t, std::span<const Float3> vertices) {
  return {to_double(vertices[t.vertex[0]]), to_double(vertices[t.vertex[1]]),
          to_double(vertices[t.vertex[2]])};
}

// Both ends of each segment.
std::vector<std::array<Double3, 2>> segments(const Tree& tree) {
  std::vector<Double3> points;
  if (tree.header.kind == TreeKind::sensitive)
    points = absolute_centres(tree);
  else
    for (const Float3& v : tree.trunk.line_vertices) points.push_back(to_double(v));
  std::vector<std::array<Double3, 2>> out;
  for (const auto& [a, b] : tree.trunk.lines)
    if (a < points.size() && b < points.size()) out.push_back({points[a], points[b]});
  return out;
}

// The mean of |cos| (or sine) from its mean square: their ratio is 1 where all directions are the same; at
// the mean square of directions spread evenly it is what it is for those. Linear between.
constexpr double k_area_share = 0.7990381056766580;    // so that 1/3 gives 1/2
constexpr double k_length_share = 0.8857175430886117;  // so that 2/3 gives pi / 4

double from_square(double square, double share) {
  return std::sqrt(square) * (share + (1 - share) * square);
}

void add_normal(const std::array<Double3, 3>& t, Symmetric3& sum) {
  const Double3 n = cross(t[1] - t[0], t[2] - t[0]);
  const double twice = length(n);
  if (twice > 0) sum.add(n / twice, twice / 2);
}

void scale(Symmetric3& m) {
  const double trace = m.trace();
  for (double& x : m.m) x = trace > 0 ? x / trace : 0;
}

double opacity(const Tree& tree, std::size_t leaf) {
  const std::uint32_t m = tree.leaves.materials.empty() ? tree.leaves.material : tree.leaves.materials[leaf];
  return m < tree.materials.size() ? tree.materials[m].alpha_coverage : 1;
}

}  // namespace

ProjectionEstimate::ProjectionEstimate(const Tree& tree)
    : trunk_centre_(to_double(tree.header.area_density_centre)) {
  for (const LeafGroup& g : tree.leaves.groups)
    groups_.push_back({to_double(g.centre), double(g.mean_area) * g.count});
  trunk_area_ = double(tree.header.mean_trunk_area) * static_cast<double>(tree.trunk.triangles.size());
  for (const auto& [a, b] : segments(tree)) {
    const double l = distance(a, b);
    if (l > 0) directions_.add((b - a) / l, l), length_ += l;
  }
  scale(directions_);
  for (const CornerTriangle& t : tree.leaves.triangles)
    add_normal(corners(t, tree.leaves.vertices), leaf_normals_);
  const std::vector<Float3> vertices = trunk_vertices(tree);
  for (const CornerTriangle& t : tree.trunk.triangles) add_normal(corners(t, vertices), trunk_normals_);
  scale(leaf_normals_), scale(trunk_normals_);
}

Projection ProjectionEstimate::at(const EyeAt& eye, const EstimateOptions& options) const {
  const bool tensor = options.orientation == Orientation::tensor;
  const auto cosine = [&](const Symmetric3& m) { return std::clamp(m.along(eye.toward), 0.0, 1.0); };
  const double leaf = tensor ? from_square(cosine(leaf_normals_), k_area_share) : 1 / options.divisor;
  const double trunk = tensor ? 0.5 * from_square(cosine(trunk_normals_), k_area_share) : 0.25;
  double line = std::numbers::pi / 4;
  if (options.orientation == Orientation::seed) line = std::sqrt(cosine(directions_));
  if (tensor) line = from_square(1 - cosine(directions_), k_length_share);

  Projection out;
  for (const Group& g : groups_) {
    const double z = depth_of(eye, g.centre);
    out.leaf_area += g.area * leaf / (z * z);
  }
  const double z = depth_of(eye, trunk_centre_);
  out.trunk_area = trunk * trunk_area_ / (z * z);
  out.length = line * length_ / z;
  return out;
}

Projection true_projection(const Tree& tree, const EyeAt& eye) {
  Projection out;
  for (std::size_t l = 0; l < tree.leaf_count(); ++l) {
    const std::size_t end = std::min(tree.first_triangle_of_leaf(l + 1), tree.leaves.triangles.size());
    for (std::size_t t = tree.first_triangle_of_leaf(l); t < end; ++t)
      out.leaf_area +=
          opacity(tree, l) * projected_area(eye, corners(tree.leaves.triangles[t], tree.leaves.vertices));
  }
  const std::vector<Float3> vertices = trunk_vertices(tree);
  for (const CornerTriangle& t : tree.trunk.triangles)
    out.trunk_area += 0.5 * projected_area(eye, corners(t, vertices));
  for (const auto& [a, b] : segments(tree)) out.length += distance(project(eye, a), project(eye, b));
  return out;
}

ProjectionErrors projection_errors(const Tree& tree, double coverage, std::span<const Double3> directions,
                                   const EstimateOptions& options) {
  const ProjectionEstimate estimate(tree);
  const Double3 low = to_double(tree.header.bounds.min), high = to_double(tree.header.bounds.max);
  const Double3 centre = (low + high) * 0.5;
  const double radius = distance(low, high) / 2,
               far = radius / std::sin(std::numbers::pi / 6) / std::sqrt(coverage);
  ProjectionErrors out;
  for (const Double3& d : directions) {
    const EyeAt eye{centre + d * far, d};
    const Projection e = estimate.at(eye, options), t = true_projection(tree, eye);
    const auto add = [&](double Projection::*what) {
      const double error = t.*what > 0 ? std::abs(e.*what / (t.*what) - 1) : 0;
      out.mean.*what += error / static_cast<double>(directions.size());
      out.largest.*what = std::max(out.largest.*what, error);
    };
    add(&Projection::leaf_area), add(&Projection::trunk_area), add(&Projection::length);
  }
  return out;
}

}  // namespace copse
