#include "lib/analysis/leaves/group_hierarchy.h"

#include "lib/analysis/round/minimal_sphere.h"
#include "lib/formats/random.h"
#include "lib/formats/volumes/sphere_contains.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

namespace copse {
namespace {

LeafGroup group_at(const Double3& c, double r) {
  LeafGroup g;
  g.centre = to_float(c);
  g.radius = static_cast<float>(r);
  g.count = 1;
  return g;
}

std::vector<LeafGroup> crown(std::uint64_t seed, int n) {  // on the shell of a ball, as leaves are
  Random random(seed);
  std::vector<LeafGroup> groups;
  for (int i = 0; i < n; ++i) {
    const Double3 d{random.around(0, 1), random.around(0, 1), random.around(0, 1)};
    groups.push_back(group_at(normalized(d) * random.uniform(3, 4), random.uniform(0.1, 0.4)));
  }
  return groups;
}

// Every group at one bottom node, with its sphere; every sphere inside the one above, in exact arithmetic.
void expect_sound(const std::vector<GroupNode>& nodes, const std::vector<LeafGroup>& groups) {
  std::set<std::uint32_t> seen;
  ASSERT_FALSE(nodes.empty());
  ASSERT_EQ(nodes[0].skip, nodes.size());
  std::size_t reached = 1;
  for (std::uint32_t n = 0; n < nodes.size(); ++n) {
    if (nodes[n].group != k_none) {
      ASSERT_TRUE(seen.insert(nodes[n].group).second);
      ASSERT_EQ(nodes[n].skip, n + 1);
      ASSERT_EQ(nodes[n].centre, groups[nodes[n].group].centre);
      ASSERT_EQ(nodes[n].radius, groups[nodes[n].group].radius);
      continue;
    }
    int children = 0;
    for (std::uint32_t c = n + 1; c < nodes[n].skip; c = nodes[c].skip) {
      ASSERT_TRUE(sphere_contains(nodes[n].centre, nodes[n].radius, nodes[c].centre, nodes[c].radius));
      ASSERT_LE(nodes[c].skip, nodes[n].skip);
      ++children, ++reached;
    }
    ASSERT_GE(children, 2);
  }
  EXPECT_EQ(reached, nodes.size());
  EXPECT_EQ(seen.size(), groups.size());
}

TEST(GroupHierarchy, OfNoGroupsIsEmptyAndOfOneIsItsSphere) {
  EXPECT_TRUE(group_hierarchy({}).empty());
  EXPECT_EQ(expected_tests({}), 0);
  const std::vector<LeafGroup> one = crown(1, 1);
  expect_sound(group_hierarchy(one), one);
}

TEST(GroupHierarchy, HoldsEveryGroupOnceInsideEverySphereAbove) {
  for (const GroupBuilder builder : {GroupBuilder::median, GroupBuilder::sweep}) {
    for (const int n : {2, 3, 17, 500}) {
      const std::vector<LeafGroup> groups = crown(static_cast<std::uint64_t>(n), n);
      expect_sound(group_hierarchy(groups, builder), groups);
    }
  }
}

TEST(GroupHierarchy, CopesWithEqualNestedAndPointLikeGroups) {
  for (const GroupBuilder builder : {GroupBuilder::median, GroupBuilder::sweep}) {
    const std::vector<LeafGroup> equal(100, group_at({1, 2, 3}, 0.5));
    expect_sound(group_hierarchy(equal, builder), equal);
    const std::vector<LeafGroup> points(50, group_at({1, 2, 3}, 0));
    expect_sound(group_hierarchy(points, builder), points);
    std::vector<LeafGroup> nested;
    for (int i = 0; i < 60; ++i) nested.push_back(group_at({0, 0, 0}, std::ldexp(1.0, -i)));
    expect_sound(group_hierarchy(nested, builder), nested);
  }
}

TEST(GroupHierarchy, ALopsidedSetDoesNotMakeADeepTree) {
  std::vector<LeafGroup> groups;
  for (int i = 0; i < 100; ++i)
    groups.push_back(group_at({std::ldexp(1.0, i - 60), 0, 0}, std::ldexp(0.1, i - 60)));
  const std::vector<GroupNode> nodes = group_hierarchy(groups);
  expect_sound(nodes, groups);
  std::vector<std::uint32_t> above;
  std::size_t depth = 0;
  for (std::uint32_t n = 0; n < nodes.size(); ++n) {
    while (!above.empty() && nodes[above.back()].skip <= n) above.pop_back();
    above.push_back(n);
    depth = std::max(depth, above.size());
  }
  EXPECT_LE(depth, 4 * 7 + 8u);
}

TEST(GroupHierarchy, TheSweepExpectsFewerTestsThanTheMedianAndBothFewerThanNone) {
  for (const int n : {100, 1000, 10000}) {
    const std::vector<LeafGroup> groups = crown(9, n);
    const std::vector<GroupNode> median = group_hierarchy(groups, GroupBuilder::median),
                                 sweep = group_hierarchy(groups);
    // How much larger the nested spheres are than the smallest round the same groups.
    double growth = 0, inner = 0;
    for (std::uint32_t i = 0; i < sweep.size(); ++i) {
      if (sweep[i].group != k_none) continue;
      std::vector<Sphere> below;
      for (std::uint32_t k = i + 1; k < sweep[i].skip; ++k) {
        if (sweep[k].group != k_none) below.push_back({to_double(sweep[k].centre), sweep[k].radius});
      }
      growth += sweep[i].radius / minimal_sphere(below).radius;
      ++inner;
    }
    std::printf(
        "  %d groups: %.1f tests by median, %.1f by sweep (%zu inner nodes); nesting costs %.1f %% of the "
        "radius\n",
        n, expected_tests(median), expected_tests(sweep), static_cast<std::size_t>(inner),
        100 * (growth / inner - 1));
    EXPECT_LT(expected_tests(sweep), expected_tests(median));
    EXPECT_LT(expected_tests(median), n);
  }
}

TEST(GroupHierarchy, GroupsThatAllOverlapGetNoNodesThatSaveNothing) {
  std::vector<LeafGroup> groups;
  for (int i = 0; i < 64; ++i) groups.push_back(group_at({0.01 * i, 0, 0}, 10));
  EXPECT_EQ(group_hierarchy(groups).size(), 65u);  // the root and the groups
}

}  // namespace
}  // namespace copse
