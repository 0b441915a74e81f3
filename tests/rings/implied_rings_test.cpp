#include "lib/analysis/rings/implied_rings.h"

#include "tests/trunk/welded_meshes.h"

#include <cmath>

#include <gtest/gtest.h>

namespace copse {
namespace {

// One limb of rings, `step` radii apart, along a polyline with a corner every `corner` rings.
Hierarchy limb(int rings, double step, int corner, double taper = 0) {
  Hierarchy h;
  Double3 at{}, way{0, 1, 0};
  double radius = 1;
  for (int r = 0; r < rings; ++r) {
    RadiusNode& node = h.radii.emplace_back();
    node.centre = at;
    node.diameter = 2 * radius;
    node.parent = r == 0 ? k_none : static_cast<std::uint32_t>(r - 1);
    for (std::uint32_t v = 0; v < 4; ++v) h.ring_vertices.push_back(static_cast<std::uint32_t>(4 * r) + v);
    h.first_vertex.push_back(static_cast<std::uint32_t>(h.ring_vertices.size()));
    h.segment_of.push_back(r == 0 ? k_none : static_cast<std::uint32_t>(r));
    if (corner > 0 && r > 0 && r % corner == 0)
      way = normalized(way + Double3{r / corner % 2 ? 0.3 : -0.3, 0, 0.1});
    at += way * (step * radius);
    radius *= 1 - taper;
  }
  return h;
}

TEST(ImpliedRings, EvenStepsInRadiiAreASubdivisions) {
  EXPECT_TRUE(is_evenly_cut(limb(200, 1, 0, 0.01)));
  EXPECT_TRUE(is_evenly_cut(limb(200, 1, 5, 0.02)));
  EXPECT_FALSE(is_evenly_cut(limb(200, 8, 0, 0.01)));  // long segments
  EXPECT_FALSE(is_evenly_cut(limb(40, 1, 0, 0.05)));   // too few to tell
  EXPECT_FALSE(is_evenly_cut(limb(200, 1, 0)));        // as thick everywhere: a generator may lay them so
}

TEST(ImpliedRings, StepsOfOneLengthOnATaperingLimbAreAGenerators) {
  Hierarchy h = limb(200, 1, 0);
  for (std::size_t r = 0; r < h.radii.size(); ++r)
    h.radii[r].diameter = 2 * std::pow(0.98, static_cast<double>(r));
  EXPECT_FALSE(is_evenly_cut(h));
}

TEST(ImpliedRings, KeepsTheCornersOfAPolylineAndItsEnds) {
  const Hierarchy h = limb(101, 1, 10);
  const Hierarchy left = without_implied_rings(h);
  ASSERT_EQ(left.radii.size(), 11u);
  for (std::uint32_t r = 0; r < left.radii.size(); ++r) {
    EXPECT_EQ(left.radii[r].centre, h.radii[10 * r].centre);
    EXPECT_EQ(left.radii[r].parent, r == 0 ? k_none : r - 1);
  }
  EXPECT_EQ(breach(left, 404, 101), "");
}

TEST(ImpliedRings, KeepsWhatIsOffTheStraightLine) {
  Hierarchy h = limb(101, 1, 0);
  h.radii[50].diameter *= 1.2;
  const Hierarchy left = without_implied_rings(h);
  EXPECT_GE(left.radii.size(), 3u);
  EXPECT_EQ(std::ranges::count(left.radii, h.radii[50].diameter, &RadiusNode::diameter), 1);
  for (std::size_t r = 0; r < h.radii.size(); ++r) {
    bool near = false;
    for (const RadiusNode& n : left.radii) {
      if (n.parent == k_none) continue;
      const RadiusNode& p = left.radii[n.parent];
      const double y = h.radii[r].centre.y;
      if (y < p.centre.y || y > n.centre.y) continue;
      const double at = (y - p.centre.y) / (n.centre.y - p.centre.y);
      near |= std::abs(p.diameter + (n.diameter - p.diameter) * at - h.radii[r].diameter) <= 0.06;
    }
    EXPECT_TRUE(near) << r;
  }
}

TEST(ImpliedRings, KeepsForksPointsAndBranches) {
  Hierarchy h = limb(30, 1, 0);
  h.radii[20].parent = 10;  // a second limb from ring 10
  for (std::size_t r = 20; r < 30; ++r) h.radii[r].branch = 1;
  h.radii[29].source = RadiusSource::point;
  const Hierarchy left = without_implied_rings(h);
  std::vector<double> heights;
  for (const RadiusNode& r : left.radii) heights.push_back(r.centre.y);
  for (const double y : {0.0, 10.0, 19.0, 20.0, 29.0}) EXPECT_EQ(std::ranges::count(heights, y), 1) << y;
}

// A vine whose diameter falls by ever more orders of magnitude: the farthest ring is always beside the thick
// end.
TEST(ImpliedRings, AVineOfAHundredThousandRingsIsNotQuadratic) {
  Hierarchy h = limb(100'000, 1, 0);
  for (std::size_t r = 0; r < h.radii.size(); ++r) {
    h.radii[r].centre = {0, static_cast<double>(r), 0};
    h.radii[r].diameter = std::exp(-static_cast<double>(r) / 150);
  }
  const Hierarchy left = without_implied_rings(h);
  EXPECT_GT(left.radii.size(), 500u);
  EXPECT_LT(left.radii.size(), h.radii.size());
  for (const RadiusNode& n : left.radii) {
    if (n.parent == k_none) continue;
    const RadiusNode& p = left.radii[n.parent];
    for (double y = p.centre.y + 1; y < n.centre.y; ++y) {
      const double at = (y - p.centre.y) / (n.centre.y - p.centre.y);
      const double real = std::exp(-y / 150);
      ASSERT_LE(std::abs(p.diameter + (n.diameter - p.diameter) * at - real), 0.0201 * real) << y;
    }
  }
}

TEST(ImpliedRings, TrianglesGoWithTheNextRadiusThatStays) {
  const Hierarchy h = limb(101, 1, 10);
  const Hierarchy left = without_implied_rings(h);
  for (std::uint32_t t = 1; t < 101; ++t) EXPECT_EQ(left.segment_of[t], (t + 9) / 10) << t;
  EXPECT_EQ(left.segment_of[0], k_none);
}

}  // namespace
}  // namespace copse
