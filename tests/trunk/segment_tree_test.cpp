#include "lib/analysis/trunk/segment_tree.h"

#include <algorithm>
#include <random>

#include <gtest/gtest.h>

namespace copse {
namespace {

std::vector<Segment> random_segments(std::size_t count, std::uint32_t limbs, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto draw = [&](double high) { return high * random() / 4294967296.0; };
  std::vector<Segment> segments;
  for (std::size_t i = 0; i < count; ++i) {
    const Double3 a{draw(10), draw(10), draw(10)};
    segments.push_back({a, a + Double3{draw(2) - 1, draw(2) - 1, draw(2) - 1}, draw(0.3), draw(0.3),
                        static_cast<std::uint32_t>(random() % limbs)});
  }
  return segments;
}

TEST(SegmentTree, MeasuresADistanceAndTheRadiusThere) {
  const std::vector<Segment> s{{{0, 0, 0}, {0, 4, 0}, 1, 0.5, 0}};
  const Nearness beside = nearness(s, 0, {3, 1, 0});
  EXPECT_DOUBLE_EQ(beside.t, 0.25);
  EXPECT_DOUBLE_EQ(beside.distance, 3);
  EXPECT_DOUBLE_EQ(beside.radius, 0.875);
  EXPECT_DOUBLE_EQ(nearness(s, 0, {0, 6, 0}).distance, 2);
  EXPECT_DOUBLE_EQ(nearness(std::vector<Segment>{{{1, 1, 1}, {1, 1, 1}, 1, 1, 0}}, 0, {1, 1, 3}).distance, 2);
}

// Straws: every axis goes through most of the heap.
std::vector<Segment> heap_of_straws(std::size_t count, std::uint32_t limbs, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto draw = [&](double high) { return high * random() / 4294967296.0; };
  std::vector<Segment> segments;
  for (std::size_t i = 0; i < count; ++i) {
    segments.push_back({{draw(10), draw(10), draw(10)},
                        {draw(10), draw(10), draw(10)},
                        draw(0.3),
                        draw(0.3),
                        static_cast<std::uint32_t>(random() % limbs)});
  }
  return segments;
}

void expect_the_nearest_of_each_limb(const SegmentTree& tree) {
  std::vector<Nearness> found;
  std::mt19937 random(7);
  for (int query = 0; query < 200; ++query) {
    const Double3 p{random() % 1000 * 0.01, random() % 1000 * 0.01, random() % 1000 * 0.01};
    const std::uint32_t except = random() % 40;
    tree.near(p, 0.5, 0.1, except, 5, found);
    std::vector<Nearness> all;
    const auto key = [](const Nearness& n) {
      return std::tuple(n.distance / std::max(n.radius, 0.1), -n.radius, n.segment);
    };
    for (std::uint32_t limb = 0; limb < 40; ++limb) {
      Nearness best;
      bool any = false;
      for (std::uint32_t s = 0; s < tree.segments().size(); ++s) {
        if (tree.segments()[s].limb != limb || limb == except) continue;
        const Nearness n = nearness(tree.segments(), s, p);
        if (n.gap() <= 0.5 && (!any || key(n) < key(best))) best = n, any = true;
      }
      if (any) all.push_back(best);
    }
    std::ranges::sort(all, {}, key);
    all.resize(std::min<std::size_t>(all.size(), 5));
    ASSERT_EQ(found.size(), all.size());
    for (std::size_t i = 0; i < all.size(); ++i) EXPECT_EQ(found[i].segment, all[i].segment);
  }
}

TEST(SegmentTree, FindsTheNearestOfEachLimbAsALookAtAllWould) {
  expect_the_nearest_of_each_limb(SegmentTree(random_segments(500, 40, 3)));
  expect_the_nearest_of_each_limb(SegmentTree(heap_of_straws(800, 40, 3)));
}

void expect_the_nearest_surface(const SegmentTree& tree) {
  std::mt19937 random(1);
  for (int query = 0; query < 200; ++query) {
    const Double3 p{random() % 1000 * 0.01, random() % 1000 * 0.01, random() % 1000 * 0.01};
    const std::uint32_t except = random() % 300;
    Nearness best, found;
    bool any = false;
    for (std::uint32_t s = 0; s < tree.segments().size(); ++s) {
      const Nearness n = nearness(tree.segments(), s, p);
      if (tree.segments()[s].limb == except || n.gap() > 0.8) continue;
      if (!any || n.gap() < best.gap()) best = n, any = true;
    }
    ASSERT_EQ(tree.nearest(p, 0.8, except, found), any);
    if (any) {
      EXPECT_EQ(found.segment, best.segment);
    }
  }
}

TEST(SegmentTree, FindsTheNearestSurfaceWithinReach) {
  expect_the_nearest_surface(SegmentTree(random_segments(300, 300, 9)));
  expect_the_nearest_surface(SegmentTree(heap_of_straws(600, 300, 9)));
}

TEST(SegmentTree, OfNothingFindsNothingAndManyInOnePlaceAreNoTrap) {
  std::vector<Nearness> found{{}};
  const SegmentTree none({});
  none.near({0, 0, 0}, 1, 1, 0xffffffffu, 4, found);
  EXPECT_TRUE(found.empty());
  std::vector<Segment> heap;
  for (std::uint32_t i = 0; i < 50000; ++i) heap.push_back({{0, 0, 0}, {0, 1, 0}, 1, 1, i});
  const SegmentTree tree(std::move(heap));
  for (int query = 0; query < 100; ++query) tree.near({0, 0.5, 0}, 1, 1, 0xffffffffu, 16, found);
  ASSERT_EQ(found.size(), 16u);
}

// The head of a palm, a pom-pom: tubes that all begin where the trunk ends, as exactly as a file says it.
TEST(SegmentTree, OfAxesThatBeginInOnePlaceItLooksAtTheThickestAndFindsTheTrunk) {
  std::mt19937 random(3);
  const auto draw = [&](double from, double to) { return from + (to - from) * random() / 4294967296.0; };
  constexpr std::uint32_t k_tubes = 4000;
  for (const double rounding : {0.0, 1e-7}) {
    std::vector<Segment> segments;
    for (std::uint32_t i = 0; i < k_tubes; ++i) {
      const Double3 from{draw(0, rounding), 5 + draw(0, rounding), draw(0, rounding)};
      const Double3 way = normalized({draw(-1, 1), draw(-1, 1), draw(-1, 1)}, {1, 0, 0});
      const Double3 knee = from + way, tip = knee + way;
      const double radius = 0.02 + draw(0, rounding);
      segments.push_back({from, knee, radius, radius / 2, i});
      segments.push_back({knee, tip, radius / 2, radius / 4, i});
    }
    segments.push_back({{0, 0, 0}, {0, 5, 0}, 0.2, 0.1, k_tubes});
    const SegmentTree tree(segments);
    std::size_t looked_at = 0;
    std::vector<Nearness> found;
    for (std::uint32_t i = 0; i < k_tubes; ++i) {
      looked_at += tree.near(segments[2 * i].a, 0.04, 0.01, i, 16, found);
      ASSERT_EQ(found.size(), 16u);
      ASSERT_EQ(found.front().segment, 2 * k_tubes);
    }
    EXPECT_LT(looked_at, 400u * k_tubes) << rounding;
  }
}

}  // namespace
}  // namespace copse
