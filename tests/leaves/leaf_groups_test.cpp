#include "lib/analysis/leaves/leaf_groups.h"

#include "lib/analysis/round/minimal_sphere.h"
#include "lib/formats/random.h"
#include "lib/formats/volumes/sphere_contains.h"
#include "tests/leaves/shapes.h"

#include <numeric>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace copse {
namespace {

using testing::ElementsAre;
using Indices = std::vector<std::uint32_t>;

struct Crown {
  Mesh mesh;
  LeafGeometry leaves;
};

// Cards at random in a box of 2 x 2 x 2 about `middle`, all leaves.
Crown random_crown(std::uint64_t seed, int leaves, const Double3& middle = {}) {
  shapes::Builder b;
  Random random(seed);
  Indices leaf_of;
  for (int l = 0; l < leaves; ++l) {
    const Double3 at{random.around(0, 1), random.around(0, 1), random.around(0, 1)};
    b.card(middle + at, {0.05, random.around(0, 0.05), 0}, {0, 0.03, random.around(0, 0.05)});
    leaf_of.insert(leaf_of.end(), 2, static_cast<std::uint32_t>(l));
  }
  Crown crown{b.mesh, {}};
  crown.leaves = leaf_geometry(crown.mesh, leaf_of, static_cast<std::uint32_t>(leaves));
  return crown;
}

std::vector<Double3> random_terminals(std::uint64_t seed, int n) {
  Random random(seed);
  std::vector<Double3> terminals;
  for (int i = 0; i < n; ++i)
    terminals.push_back({random.around(0, 1), random.around(0, 1), random.around(0, 1)});
  return terminals;
}

// Every leaf once; groups full, in order, and their spheres around every vertex, in double and as stored.
void expect_sound(const Crown& crown, const LeafGroups& g, const Double3& origin) {
  std::vector<int> seen(crown.leaves.count(), 0);
  std::uint32_t next = 0;
  ASSERT_EQ(g.terminal.size(), g.groups.size());
  for (std::uint32_t i = 0; i < g.groups.size(); ++i) {
    const LeafGroup& group = g.groups[i];
    ASSERT_EQ(group.first, next);
    ASSERT_GT(group.count, 0u);
    next += group.count;
    double area = 0;
    for (std::uint32_t k = group.first; k < next; ++k) {
      const std::uint32_t leaf = g.order[k];
      ++seen[leaf];
      ASSERT_EQ(g.group_of[leaf], i);
      area += crown.leaves.areas[leaf];
      for (const std::uint32_t t : crown.leaves.of(leaf)) {
        for (const std::uint32_t v : crown.mesh.triangles[t]) {
          const Double3 p = crown.mesh.positions[v] - origin;
          ASSERT_TRUE(sphere_contains(group.centre, group.radius, to_float(p)));
          ASSERT_TRUE(encloses({group.centre, group.radius}, p));
        }
      }
    }
    ASSERT_NEAR(group.mean_area, area / group.count, 1e-6 * area);
  }
  EXPECT_THAT(seen, testing::Each(1));
}

TEST(LeafGroups, OfNoLeavesAreNone) {
  const LeafGroups g = leaf_groups({}, {}, std::vector<Double3>{{0, 0, 0}}, {});
  EXPECT_TRUE(g.groups.empty());
  EXPECT_THAT(g.of_terminal, ElementsAre(k_none));
}

TEST(LeafGroups, EveryLeafHangsOnItsNearestTerminal) {
  const Crown crown = random_crown(1, 800);
  const std::vector<Double3> terminals = random_terminals(2, 40);
  const LeafGroups g = leaf_groups(crown.mesh, crown.leaves, terminals, {});
  expect_sound(crown, g, {});
  for (std::uint32_t l = 0; l < crown.leaves.count(); ++l) {
    const double d = distance(crown.leaves.centres[l], terminals[g.terminal[g.group_of[l]]]);
    for (const Double3& t : terminals) ASSERT_LE(d, distance(crown.leaves.centres[l], t) * (1 + 1e-15));
  }
  for (std::uint32_t t = 0; t < terminals.size(); ++t) {
    if (g.of_terminal[t] == k_none) continue;
    EXPECT_EQ(g.terminal[g.of_terminal[t]], t);
  }
}

TEST(LeafGroups, AtTheSameDistanceTheLowestTerminalWinsAndEmptyOnesGetNoGroup) {
  const Crown crown = random_crown(1, 1);
  const Double3 c = crown.leaves.centres[0];
  const std::vector<Double3> terminals{c + Double3{9, 0, 0}, c + Double3{0, 1, 0}, c + Double3{0, 1, 0}};
  const LeafGroups g = leaf_groups(crown.mesh, crown.leaves, terminals, {});
  EXPECT_THAT(g.terminal, ElementsAre(1));
  EXPECT_THAT(g.of_terminal, ElementsAre(k_none, 0, k_none));
}

TEST(LeafGroups, SpheresAreTheSmallest) {
  const Crown crown = random_crown(5, 300);
  const LeafGroups g = leaf_groups(crown.mesh, crown.leaves, random_terminals(6, 10), {});
  for (const LeafGroup& group : g.groups) {
    std::vector<Double3> points;
    for (std::uint32_t k = group.first; k < group.first + group.count; ++k) {
      for (const std::uint32_t t : crown.leaves.of(g.order[k])) {
        for (const std::uint32_t v : crown.mesh.triangles[t]) points.push_back(crown.mesh.positions[v]);
      }
    }
    EXPECT_LE(group.radius, minimal_sphere(points).radius * (1 + 1e-6));
  }
}

TEST(LeafGroups, SpheresEncloseWhatIsStoredFarFromTheOrigin) {
  const Double3 far{1e7, 1e6, -1e7};
  const Crown crown = random_crown(7, 100, far);
  for (const Double3& origin : {far, far + Double3{1000, 0, 0}, Double3{}}) {
    GroupOptions options;
    options.origin = origin;
    expect_sound(crown, leaf_groups(crown.mesh, crown.leaves, {}, options), origin);
  }
}

TEST(LeafGroups, ALeafOfOnePointHasASphereWithoutNaN) {
  shapes::Builder b;
  b.triangle({1, 1, 1}, {1, 1, 1}, {1, 1, 1});
  const LeafGeometry leaves = leaf_geometry(b.mesh, Indices{0}, 1);
  const LeafGroups g = leaf_groups(b.mesh, leaves, {}, {});
  ASSERT_EQ(g.groups.size(), 1u);
  EXPECT_EQ(g.groups[0].radius, 0);
  EXPECT_EQ(g.groups[0].mean_area, 0);
}

TEST(LeafGroups, TheOrderIsByDistanceFromTheGroupsCentreOrFromTheTerminal) {
  const Crown crown = random_crown(8, 200);
  const std::vector<Double3> terminals = random_terminals(9, 5);
  for (const LeafOrder order : {LeafOrder::group, LeafOrder::terminal}) {
    GroupOptions options;
    options.order = order;
    const LeafGroups g = leaf_groups(crown.mesh, crown.leaves, terminals, options);
    expect_sound(crown, g, {});
    for (std::uint32_t i = 0; i < g.groups.size(); ++i) {
      const Double3 from =
          order == LeafOrder::group ? to_double(g.groups[i].centre) : terminals[g.terminal[i]];
      double before = 0;
      for (std::uint32_t k = g.groups[i].first; k < g.groups[i].first + g.groups[i].count; ++k) {
        const double d = distance(crown.leaves.centres[g.order[k]], from);
        EXPECT_GE(d, before * (1 - 1e-15));
        before = d;
      }
    }
  }
}

TEST(LeafGroups, TheOrderHoldsWhereASumWithTheOriginIsRounded) {
  const Double3 far{1e15, 0, 0};  // doubles are an eighth apart there
  const Crown crown = random_crown(7, 100, far);
  GroupOptions options;
  options.origin = far;
  const LeafGroups g = leaf_groups(crown.mesh, crown.leaves, {}, options);
  for (const LeafGroup& group : g.groups) {
    double before = 0;
    for (std::uint32_t k = group.first; k < group.first + group.count; ++k) {
      const double d = distance(crown.leaves.centres[g.order[k]] - far, to_double(group.centre));
      EXPECT_GE(d, before * (1 - 1e-15));
      before = d;
    }
  }
}

TEST(LeafGroups, TheRandomOrderDependsOnTheSeedAlone) {
  const Crown crown = random_crown(8, 200);
  GroupOptions options;
  options.order = LeafOrder::random;
  const LeafGroups a = leaf_groups(crown.mesh, crown.leaves, {}, options);
  const LeafGroups b = leaf_groups(crown.mesh, crown.leaves, {}, options);
  options.seed = 1;
  const LeafGroups c = leaf_groups(crown.mesh, crown.leaves, {}, options);
  expect_sound(crown, a, {});
  EXPECT_EQ(a.order, b.order);
  EXPECT_NE(a.order, c.order);
}

TEST(LeafGroups, ALimitMergesUntilItHolds) {
  const Crown crown = random_crown(10, 900);
  const std::vector<Double3> terminals = random_terminals(11, 60);
  const LeafGroups all = leaf_groups(crown.mesh, crown.leaves, terminals, {});
  for (const std::uint32_t limit : {1u, 7u, 59u}) {
    GroupOptions options;
    options.max_groups = limit;
    const LeafGroups g = leaf_groups(crown.mesh, crown.leaves, terminals, options);
    expect_sound(crown, g, {});
    EXPECT_EQ(g.groups.size(), std::min<std::size_t>(limit, all.groups.size()));
    EXPECT_EQ(g.merged, all.groups.size() - g.groups.size());
    EXPECT_TRUE(std::is_sorted(g.terminal.begin(), g.terminal.end()));
    // Leaves that were together stay together.
    for (std::uint32_t l = 1; l < crown.leaves.count(); ++l) {
      if (all.group_of[l] != all.group_of[l - 1]) continue;
      EXPECT_EQ(g.group_of[l], g.group_of[l - 1]);
    }
  }
}

TEST(LeafGroups, WithoutTerminalsNeighboursAreClustered) {
  const Crown crown = random_crown(12, 1000);
  const LeafGroups g = leaf_groups(crown.mesh, crown.leaves, {}, {});
  expect_sound(crown, g, {});
  EXPECT_GE(g.groups.size(), 1000u / k_leaves_of_a_cluster);
  double radii = 0;
  for (const LeafGroup& group : g.groups) {
    EXPECT_LE(group.count, k_leaves_of_a_cluster);
    EXPECT_GE(2 * group.count + 1, k_leaves_of_a_cluster);
    radii += group.radius;
  }
  EXPECT_LT(radii / double(g.groups.size()), 0.6);  // a box of 2 x 2 x 2 cut into 32 pieces
  EXPECT_THAT(g.terminal, testing::Each(k_none));
  GroupOptions options;
  options.max_groups = 5;
  expect_sound(crown, leaf_groups(crown.mesh, crown.leaves, {}, options), {});
}

TEST(LeafGroups, LeavesThatAllLieInOnePlaceAreClusteredToo) {
  shapes::Builder b;
  Indices leaf_of;
  for (std::uint32_t l = 0; l < 500; ++l) {
    b.card({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
    leaf_of.insert(leaf_of.end(), 2, l);
  }
  Crown crown{b.mesh, leaf_geometry(b.mesh, leaf_of, 500)};
  expect_sound(crown, leaf_groups(crown.mesh, crown.leaves, {}, {}), {});
}

}  // namespace
}  // namespace copse
