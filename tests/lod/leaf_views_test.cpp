#include "lib/analysis/lod/leaf_views.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace copse {
namespace {

using Triangles = std::vector<ViewedTriangle>;

// A square in the plane across `axis`.
Triangles square(const Double3& centre, double half, int axis = 2) {
  Double3 u{}, v{};
  u[(axis + 1) % 3] = half, v[(axis + 2) % 3] = half;
  const Double3 a = centre - u - v, b = centre + u - v, c = centre + u + v, d = centre - u + v;
  return {{{a, b, c}, {Float2{0, 0}, {1, 0}, {1, 1}}}, {{a, c, d}, {Float2{0, 0}, {1, 1}, {0, 1}}}};
}

// Three squares that hide the middle one's square from nearly everywhere.
Triangles box(const Double3& centre, double half) {
  Triangles out;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-half, half}) {
      Double3 c = centre;
      c[axis] += side;
      for (const ViewedTriangle& t : square(c, half, axis)) out.push_back(t);
    }
  return out;
}

LeafViews views_of(std::span<const ViewedLeaf> leaves, double radius = 2, double pixel = 0.04) {
  LeafViews views({}, radius, pixel, 0);
  views.set_source(leaves);
  return views;
}

TEST(LeafViews, ALeafAloneIsSoleAndSeenFromBothSides) {
  const Triangles one = square({}, 0.5);
  const std::vector<ViewedLeaf> leaves{{one, nullptr}};
  LeafViews views = views_of(leaves);
  const auto counts = views.look(leaves);
  EXPECT_GT(counts[0].total, 0u);
  EXPECT_EQ(counts[0].sole, counts[0].total);
  EXPECT_EQ(counts[0].seen, 2 * counts[0].total);
  EXPECT_EQ(views.coverage(), 1);
}

TEST(LeafViews, PixelsMeasureTheMeanProjectedArea) {
  const Triangles one = square({}, 0.5), two = square({}, 0.5, 0);
  const std::vector<ViewedLeaf> leaves{{one, nullptr}, {two, nullptr}};
  LeafViews views = views_of(leaves);
  for (const auto& count : views.look(leaves)) {
    const double area = count.total * views.pixel() * views.pixel() / LeafViews::k_views;
    EXPECT_NEAR(area, 0.5, 0.1) << "half of its area, from all round";
  }
}

TEST(LeafViews, WhatIsInABoxIsNotSeen) {
  const Triangles outer = box({}, 0.8), inner = square({}, 0.3);
  const std::vector<ViewedLeaf> leaves{{outer, nullptr}, {inner, nullptr}};
  LeafViews views = views_of(leaves);
  const auto counts = views.look(leaves);
  EXPECT_GT(counts[1].total, 0u);
  EXPECT_EQ(counts[1].sole, 0u);
  EXPECT_EQ(counts[1].seen, 0u);
}

TEST(LeafViews, AlphaLetsTheGroundThrough) {
  const AlphaMask half{2, 1, {1, 0}};
  const Triangles one = square({}, 0.5);
  const std::vector<ViewedLeaf> opaque{{one, nullptr}}, cut{{one, &half}};
  LeafViews views = views_of(opaque);
  const double all = views.look(opaque)[0].total, some = views.look(cut)[0].total;
  EXPECT_NEAR(some / all, 0.5, 0.05);
  EXPECT_NEAR(views.coverage(), 0.5, 0.05);
}

TEST(LeafViews, TakingAHiddenLeafAwayChangesNothing) {
  const Triangles outer = box({}, 0.8), inner = square({}, 0.3), grown = square({}, 0.4);
  const std::vector<ViewedLeaf> leaves{{outer, nullptr}, {inner, nullptr}};
  LeafViews views = views_of(leaves);
  views.look(leaves);
  LeafViews::Exchange exchange(views);
  exchange.remove(std::vector<std::uint32_t>{1}, std::vector<ViewedLeaf>{leaves[1]});
  const LeafViews::Change change = exchange.add({grown, nullptr}, 1);
  EXPECT_EQ(change.covered, 0);
  EXPECT_EQ(change.other, 0);
}

TEST(LeafViews, PuttingALeafBackWhereItWasChangesNothing) {
  const Triangles a = square({}, 0.5), b = square({0.7, 0.2, 0.3}, 0.4, 1);
  const std::vector<ViewedLeaf> leaves{{a, nullptr}, {b, nullptr}};
  LeafViews views = views_of(leaves);
  views.look(leaves);
  LeafViews::Exchange exchange(views);
  for (const std::uint32_t l : {0u, 1u}) {
    exchange.remove(std::vector<std::uint32_t>{l}, std::vector<ViewedLeaf>{leaves[l]});
    const LeafViews::Change change = exchange.add(leaves[l], l);
    EXPECT_EQ(change.covered, 0) << l;
    EXPECT_EQ(change.other, 0) << l;
  }
}

TEST(LeafViews, LosingAndGainingCountTheirPixels) {
  const Triangles a = square({}, 0.5), b = square({0, 0, 1.2}, 0.3), none;
  const std::vector<ViewedLeaf> leaves{{a, nullptr}};
  LeafViews views = views_of(leaves);
  const auto counts = views.look(leaves);
  LeafViews::Exchange exchange(views);
  exchange.remove(std::vector<std::uint32_t>{0}, leaves);
  EXPECT_EQ(exchange.add({none, nullptr}, k_none).covered, counts[0].total);
  EXPECT_GT(exchange.add({b, nullptr}, k_none).covered, counts[0].total * 0.9)
      << "elsewhere it is no help, and covers what was open";
}

TEST(LeafViews, MendingAHoleIsWorthMoreThanNothing) {
  const Triangles a = square({-0.6, 0, 0}, 0.5), b = square({0.6, 0, 0}, 0.5);
  const std::vector<ViewedLeaf> source{{a, nullptr}, {b, nullptr}}, left{{a, nullptr}};
  LeafViews views = views_of(source);
  views.look(left);
  LeafViews::Exchange exchange(views);
  exchange.remove(std::vector<std::uint32_t>{0}, left);
  const double stays = exchange.add({a, nullptr}, 0).covered;
  Triangles both = a;
  both.insert(both.end(), b.begin(), b.end());
  EXPECT_LT(exchange.add({both, nullptr}, 0).covered, stays);
}

TEST(LeafViews, DoesNotDependOnTheNumberOfThreads) {
  const Triangles a = square({}, 0.5), b = square({0.1, 0.2, 0.3}, 0.4, 1);
  const std::vector<ViewedLeaf> leaves{{a, nullptr}, {b, nullptr}};
  LeafViews many = views_of(leaves);
  const auto first = many.look(leaves);
  tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  LeafViews single = views_of(leaves);
  const auto second = single.look(leaves);
  for (int l = 0; l < 2; ++l) {
    EXPECT_EQ(first[l].total, second[l].total);
    EXPECT_EQ(first[l].sole, second[l].sole);
    EXPECT_EQ(first[l].seen, second[l].seen);
  }
}

TEST(LeafViews, NothingAndNowhereAreCountedAsNothing) {
  LeafViews views({}, 0, 0, 3);
  views.set_source({});
  EXPECT_TRUE(views.look({}).empty());
  EXPECT_EQ(views.coverage(), 1);
  const Triangles point{{{Double3{}, Double3{}, Double3{}}, {}}};
  EXPECT_EQ(views.look(std::vector<ViewedLeaf>{{point, nullptr}})[0].total, 0u);
}

}  // namespace
}  // namespace copse
