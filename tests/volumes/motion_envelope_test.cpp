#include "lib/analysis/volumes/motion_envelope.h"

#include "lib/analysis/hull/convex_hull.h"
#include "lib/analysis/volumes/certify.h"
#include "lib/formats/random.h"
#include "tests/formats/tree_maker.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace copse {
namespace {

using Points = std::vector<Double3>;

double farthest_along(const Points& points, const Double3& n) {
  double most = -1e300;
  for (const Double3& p : points) most = std::max(most, dot(n, p));
  return most;
}
Double3 unit_vector(Random& random) {
  const double z = random.around(0, 1), a = random.uniform(0, 2 * std::numbers::pi),
               r = std::sqrt(std::max(0.0, 1 - z * z));
  return {r * std::cos(a), r * std::sin(a), z};
}
Double3 turned(const Double3& p, const Double3& axis, double angle) {
  const Double3 along = axis * dot(axis, p), across = p - along;
  return along + across * std::cos(angle) + cross(axis, across) * std::sin(angle);
}

TEST(MotionEnvelope, BallsLieInTheHullOfTheirCornersAndNotFarFromIt) {
  const Points points{{0, 0, 0}, {3, 1, -2}};
  const std::vector<double> radii{1, 0.25};
  const Points corners = ball_envelope(points, radii);
  EXPECT_EQ(corners.size(), 24u);
  Random random(1);
  for (int i = 0; i < 2000; ++i) {
    const Double3 n = unit_vector(random);
    const double needed = std::max(dot(n, points[0]) + radii[0], dot(n, points[1]) + radii[1]);
    EXPECT_GE(farthest_along(corners, n), needed);
    EXPECT_LE(farthest_along(corners, n), needed + 0.26);
  }
  EXPECT_EQ(ball_envelope(Points{{1, 2, 3}}, std::vector<double>{0}), (Points{{1, 2, 3}}));
}

TEST(MotionEnvelope, ArcsLieInTheHullOfTheirChords) {
  Random random(2);
  const Joint joint{{1, 2, 3}, {1, 1, 0}, -0.4, 1.1};
  Points points;
  for (int i = 0; i < 20; ++i)
    points.push_back({random.around(0, 2), random.around(0, 2), random.around(0, 2)});
  const Points envelope = joint_envelope(points, joint, 8);
  const Double3 axis = normalized(joint.axis);
  for (int i = 0; i < 500; ++i) {
    const Double3 n = unit_vector(random);
    const double most = farthest_along(envelope, n);
    for (const Double3& p : points) {
      const double angle = random.uniform(joint.from, joint.to);
      EXPECT_LE(dot(n, joint.origin + turned(p - joint.origin, axis, angle)), most);
    }
  }
}

TEST(MotionEnvelope, AWholeTurnInFewStepsIsHeldAllTheSame) {
  const Points points{{1, 0, 0}, {0, 2, 1}};
  const Joint joint{{0, 0, 0}, {0, 0, 1}, 0, 2 * std::numbers::pi};
  const Points envelope = joint_envelope(points, joint, 3);
  for (int i = 0; i < 360; ++i) {
    const double turn = i * std::numbers::pi / 180;
    const Double3 n{std::cos(turn), std::sin(turn), 0};
    double most = -1;
    for (const Double3& p : envelope) most = std::max(most, dot(n, p));
    EXPECT_GE(most, 2) << i;
  }
}

TEST(MotionEnvelope, AStillJointIsThePointsThemselves) {
  const Points points{{1, 0, 0}, {0, 2, 0}};
  for (const Double3& p : joint_envelope(points, {{0, 0, 0}, {0, 1, 0}, 0, 0}, 1)) {
    EXPECT_LE(std::min(distance(p, points[0]), distance(p, points[1])), 1e-11);
  }
}

// Every link, vector and leaf is turned by its own random rotation of at most the angle.
Points swayed(const Tree& tree, double angle, Random& random) {
  const auto turn = [&](const Double3& v) { return turned(v, unit_vector(random), random.around(0, angle)); };
  const std::vector<std::uint32_t> parent = parents(tree);
  const Points rest = absolute_centres(tree);
  Points centres(rest.size()), out;
  for (std::size_t r = 0; r < rest.size(); ++r) {
    const Double3 link = to_double(tree.hierarchy.radii[r].centre);
    centres[r] = parent[r] == k_none ? rest[r] : centres[parent[r]] + turn(link);
  }
  for (std::size_t r = 0; r < rest.size(); ++r) {
    for (std::size_t v = tree.first_vector_of(r); v < tree.first_vector_of(r + 1); ++v) {
      out.push_back(centres[r] + turn(to_double(tree.hierarchy.vectors[v])));
    }
  }
  std::vector<std::size_t> radius_of(tree.leaves.vertices.size(), 0);
  for (std::size_t r = 0; r < rest.size(); ++r) {
    const Radius& radius = tree.hierarchy.radii[r];
    if ((radius.flags & Radius::terminal) == 0 || radius.child_count == 0) continue;
    const LeafGroup& g = tree.leaves.groups[radius.first_child];
    for (std::uint32_t i = 0; i < g.count; ++i) {
      const std::uint32_t leaf = tree.leaves.order[g.first + i];
      for (std::size_t t = tree.first_triangle_of_leaf(leaf); t < tree.first_triangle_of_leaf(leaf + 1);
           ++t) {
        for (const std::uint32_t v : tree.leaves.triangles[t].vertex) radius_of[v] = r;
      }
    }
  }
  for (std::size_t v = 0; v < radius_of.size(); ++v) {
    const std::size_t r = radius_of[v];
    out.push_back(centres[r] + turn(to_double(tree.leaves.vertices[v]) - rest[r]));
  }
  return out;
}

TEST(MotionEnvelope, NoVertexOfASwayingTreeLeavesItsReach) {
  const double angle = 0.3;
  for (const std::uint64_t seed : {1u, 2u, 3u}) {
    const Tree tree = make_tree({.radii = 40, .leaves = 30, .groups = 8}, seed);
    const std::vector<double> reach = sway_reach(tree, angle);
    Points rest;
    for (const Float3& v : trunk_vertices(tree)) rest.push_back(to_double(v));
    for (const Float3& v : tree.leaves.vertices) rest.push_back(to_double(v));
    ASSERT_EQ(reach.size(), rest.size());
    Random random(seed);
    double used = 0;
    for (int i = 0; i < 200; ++i) {
      const Points now = swayed(tree, angle, random);
      for (std::size_t v = 0; v < rest.size(); ++v) {
        ASSERT_LE(distance(now[v], rest[v]), reach[v] * (1 + 1e-9) + 1e-5) << v;
        if (reach[v] > 0) used = std::max(used, distance(now[v], rest[v]) / reach[v]);
      }
    }
    EXPECT_GT(used, 0.8);  // the bound is not a wild guess
  }
}

TEST(MotionEnvelope, AStillTreeHasNoReach) {
  for (const double r : sway_reach(make_tree({.kind = TreeKind::still}, 1), 0.5)) EXPECT_EQ(r, 0);
}

}  // namespace
}  // namespace copse
