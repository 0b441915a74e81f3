#include "lib/analysis/volumes/motion_envelope.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace copse {
namespace {

// The corners of an icosahedron whose faces touch the unit ball.
std::array<Double3, 12> icosahedron() {
  const double phi = std::numbers::phi;
  // Faces of the one with corners (0, +-1, +-phi) are phi^2 / sqrt 3 from the middle. A whisker more, so that
  // rounding cannot leave a ball outside.
  const double scale = std::numbers::sqrt3 / (phi * phi) * (1 + 1e-12);
  std::array<Double3, 12> out;
  std::size_t at = 0;
  for (const double a : {-scale, scale}) {
    for (const double b : {-phi * scale, phi * scale}) {
      out[at++] = {0, a, b}, out[at++] = {a, b, 0}, out[at++] = {b, 0, a};
    }
  }
  return out;
}

// Which radius every leaf vertex hangs on; the one that moves most where leaves of several groups share it.
std::vector<double> leaf_reach(const Tree& tree, const std::vector<Double3>& centres,
                               const std::vector<double>& reach, double chord) {
  const Leaves& l = tree.leaves;
  std::vector<double> out(l.vertices.size(), 0);
  std::vector<bool> hangs(l.vertices.size());
  const auto hang = [&](std::uint32_t vertex, std::size_t radius) {
    const double far = reach[radius] + chord * distance(to_double(l.vertices[vertex]), centres[radius]);
    out[vertex] = std::max(out[vertex], far);
    hangs[vertex] = true;
  };
  for (std::size_t r = 0; r < tree.radius_count(); ++r) {
    const Radius& radius = tree.hierarchy.radii[r];
    if ((radius.flags & Radius::terminal) == 0 || radius.child_count == 0 || l.order.empty()) continue;
    const LeafGroup& group = l.groups[radius.first_child];
    for (std::uint32_t i = 0; i < group.count; ++i) {
      const std::uint32_t leaf = l.order[group.first + i];
      for (std::size_t t = tree.first_triangle_of_leaf(leaf); t < tree.first_triangle_of_leaf(leaf + 1);
           ++t) {
        for (const std::uint32_t v : l.triangles[t].vertex) hang(v, r);
      }
    }
  }
  // What no radius holds may hang on any.
  for (std::uint32_t v = 0; v < l.vertices.size(); ++v) {
    for (std::size_t r = 0; !hangs[v] && r < tree.radius_count(); ++r) {
      const double far = reach[r] + chord * distance(to_double(l.vertices[v]), centres[r]);
      out[v] = std::max(out[v], far);
    }
  }
  return out;
}

}  // namespace

std::vector<Double3> ball_envelope(std::span<const Double3> points, std::span<const double> radii) {
  static const std::array<Double3, 12> k_corners = icosahedron();
  std::vector<Double3> out;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (radii[i] == 0) {
      out.push_back(points[i]);
    } else {
      for (const Double3& c : k_corners) out.push_back(points[i] + c * radii[i]);
    }
  }
  return out;
}

std::vector<Double3> joint_envelope(std::span<const Double3> points, const Joint& joint, int steps) {
  const Double3 axis = normalized(joint.axis);
  steps = std::max(steps, static_cast<int>(std::ceil(std::abs(joint.to - joint.from))));  // a radian at most
  const double step = (joint.to - joint.from) / steps;
  const double outward = 1 / std::cos(std::abs(step) / 2) * (1 + 1e-12);
  std::vector<Double3> out;
  out.reserve(points.size() * static_cast<std::size_t>(steps + 1));
  for (const Double3& p : points) {
    const Double3 q = p - joint.origin, along = axis * dot(axis, q), across = q - along,
                  side = cross(axis, across);
    for (int i = 0; i <= steps; ++i) {
      const double angle = joint.from + step * i;
      out.push_back(joint.origin + along + (across * std::cos(angle) + side * std::sin(angle)) * outward);
    }
  }
  return out;
}

std::vector<double> sway_reach(const Tree& tree, double angle) {
  const double chord = 2 * std::sin(std::min(angle, std::numbers::pi) / 2);
  const std::size_t trunk = trunk_vertices(tree).size();
  std::vector<double> out(trunk + tree.leaves.vertices.size(), 0);
  if (tree.header.kind != TreeKind::sensitive || tree.radius_count() == 0) return out;
  const std::vector<std::uint32_t> parent = parents(tree);
  const std::vector<Double3> centres = absolute_centres(tree);
  std::vector<double> reach(tree.radius_count(), 0);
  for (std::size_t r = 0; r < reach.size(); ++r) {
    if (parent[r] == k_none) continue;
    reach[r] = reach[parent[r]] + chord * length(to_double(tree.hierarchy.radii[r].centre));
  }
  for (std::size_t r = 0; r < reach.size(); ++r) {
    for (std::size_t v = tree.first_vector_of(r); v < tree.first_vector_of(r + 1); ++v) {
      out[v] = reach[r] + chord * length(to_double(tree.hierarchy.vectors[v]));
    }
  }
  const std::vector<double> leaves = leaf_reach(tree, centres, reach, chord);
  std::copy(leaves.begin(), leaves.end(), out.begin() + static_cast<std::ptrdiff_t>(trunk));
  return out;
}

}  // namespace copse
