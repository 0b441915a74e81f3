#include "lib/analysis/skeleton/skeleton_limbs.h"

#include "lib/formats/material.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

// A skeleton from polylines: each continues from the given point.
struct Maker {
  CurveSkeleton k;
  std::uint32_t add(std::uint32_t from, const Double3& p, double radius) {
    k.points.push_back(p);
    k.radii.push_back(radius);
    const auto id = static_cast<std::uint32_t>(k.points.size() - 1);
    if (from != k_none) k.edges.emplace_back(from, id);
    return id;
  }
  std::uint32_t line(std::uint32_t from, Double3 start, const Double3& step, int count, double radius) {
    for (int i = 1; i <= count; ++i) from = add(from, start + step * i, radius);
    return from;
  }
};

TEST(SkeletonLimbs, CarryOnAlongTheThickAndStraightLimb) {
  Maker m;
  std::uint32_t fork = m.line(k_none, {0, 0, 0}, {0, 0.5, 0}, 20, 1);
  const std::uint32_t top = m.line(fork, {0, 10, 0}, {0, 0.5, 0}, 16, 0.9);
  m.line(fork, {0, 10, 0}, {0.5, 0.2, 0}, 40, 0.5);  // longer, but thinner and to the side
  const Limbs limbs = find_limbs(m.k);
  ASSERT_EQ(limbs.limbs.size(), 2u);
  EXPECT_EQ(limbs.limbs[0].nodes.front(), 0u);
  EXPECT_EQ(limbs.limbs[0].nodes.back(), top);
  EXPECT_EQ(limbs.limbs[1].parent, 0u);
  EXPECT_EQ(limbs.limbs[0].nodes[limbs.limbs[1].at], fork);
  EXPECT_EQ(limbs.limbs[1].nodes.front(), fork);
}

TEST(SkeletonLimbs, TakeBumpsIn) {
  Maker m;
  const std::uint32_t middle = m.line(k_none, {0, 0, 0}, {0, 0.5, 0}, 10, 1);
  m.line(middle, {0, 5, 0}, {0, 0.5, 0}, 20, 1);
  const std::uint32_t bump = m.line(middle, {0, 5, 0}, {0.4, 0, 0}, 3, 0.2);
  const Limbs limbs = find_limbs(m.k);
  ASSERT_EQ(limbs.limbs.size(), 1u);
  EXPECT_EQ(limbs.kept_node[bump], middle);
  EXPECT_EQ(limbs.kept_node[middle], middle);
}

TEST(SkeletonLimbs, CutACycleWhereItIsThinnest) {
  Maker m;
  const std::uint32_t a = m.add(k_none, {0, 0, 0}, 2), b = m.add(a, {0, 5, 0}, 2);
  const std::uint32_t c = m.add(b, {5, 10, 0}, 0.1), d = m.add(b, {-5, 10, 0}, 1),
                      e = m.add(d, {0, 15, 0}, 1);
  m.k.edges.emplace_back(c, e);
  const Limbs limbs = find_limbs(m.k);
  std::size_t links = 0;
  for (const Limb& l : limbs.limbs) links += l.nodes.size() - 1;
  EXPECT_EQ(links, 4u);
  for (const Limb& l : limbs.limbs) {
    for (std::size_t i = 1; i < l.nodes.size(); ++i) {
      EXPECT_FALSE(l.nodes[i - 1] == b && l.nodes[i] == e);
    }
  }
}

TEST(SkeletonLimbs, OfOnePointAreOne) {
  Maker m;
  m.add(k_none, {1, 2, 3}, 0);
  const Limbs limbs = find_limbs(m.k);
  ASSERT_EQ(limbs.limbs.size(), 1u);
  EXPECT_EQ(limbs.limbs[0].nodes.size(), 1u);
  EXPECT_TRUE(find_limbs({}).limbs.empty());
}

TEST(SkeletonLimbs, StartAtTheThickLowEnd) {
  Maker m;
  const std::uint32_t thin = m.line(k_none, {0, 20, 0}, {0, -0.5, 0}, 20, 0.2);
  const std::uint32_t base = m.line(thin, {0, 10, 0}, {0, -0.5, 0}, 20, 1);
  EXPECT_EQ(find_limbs(m.k).limbs[0].nodes.front(), base);
}

}  // namespace
}  // namespace copse
