#include "lib/analysis/lod/leaf_views.h"

#include "lib/formats/random.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace copse {
namespace {

struct Triangles {
  std::vector<SpectrumVertex> vertices;
  std::vector<std::array<std::uint32_t, 3>> triangles;

  ViewedLeaf leaf(const AlphaMask* mask = nullptr) const { return {vertices, triangles, mask}; }
  void append(const Triangles& more) {
    const auto base = static_cast<std::uint32_t>(vertices.size());
    vertices.insert(vertices.end(), more.vertices.begin(), more.vertices.end());
    for (const auto& t : more.triangles) triangles.push_back({base + t[0], base + t[1], base + t[2]});
  }
};

// A square in the plane across `axis`.
Triangles square(const Double3& centre, double half, int axis = 2) {
  Double3 u{}, v{};
  u[(axis + 1) % 3] = half, v[(axis + 2) % 3] = half;
  Triangles out{{}, {{0, 1, 2}, {0, 2, 3}}};
  for (const auto& [p, uv] : {std::pair(centre - u - v, Float2{0, 0}),
                              {centre + u - v, Float2{1, 0}},
                              {centre + u + v, Float2{1, 1}},
                              {centre - u + v, Float2{0, 1}}})
    out.vertices.push_back({to_float(p), {}, uv});
  return out;
}

// Three squares that hide the middle one's square from nearly everywhere.
Triangles box(const Double3& centre, double half) {
  Triangles out;
  for (int axis = 0; axis < 3; ++axis)
    for (const double side : {-half, half}) {
      Double3 c = centre;
      c[axis] += side;
      out.append(square(c, half, axis));
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
  const std::vector<ViewedLeaf> leaves{one.leaf()};
  LeafViews views = views_of(leaves);
  const auto counts = views.look(leaves);
  EXPECT_GT(counts[0].total, 0u);
  EXPECT_EQ(counts[0].sole, counts[0].total);
  EXPECT_EQ(counts[0].seen, 2 * counts[0].total);
  EXPECT_EQ(views.coverage(), 1);
}

TEST(LeafViews, PixelsMeasureTheMeanProjectedArea) {
  const Triangles one = square({}, 0.5), two = square({}, 0.5, 0);
  const std::vector<ViewedLeaf> leaves{one.leaf(), two.leaf()};
  LeafViews views = views_of(leaves);
  for (const auto& count : views.look(leaves)) {
    const double area = count.total * views.pixel() * views.pixel() / views.views();
    EXPECT_NEAR(area, 0.5, 0.1) << "half of its area, from all round";
  }
}

TEST(LeafViews, WhatIsInABoxIsNotSeen) {
  const Triangles outer = box({}, 0.8), inner = square({}, 0.3);
  const std::vector<ViewedLeaf> leaves{outer.leaf(), inner.leaf()};
  LeafViews views = views_of(leaves);
  const auto counts = views.look(leaves);
  EXPECT_GT(counts[1].total, 0u);
  EXPECT_EQ(counts[1].sole, 0u);
  EXPECT_EQ(counts[1].seen, 0u);
}

TEST(LeafViews, AlphaLetsTheGroundThrough) {
  const AlphaMask half{2, 1, {1, 0}};
  const Triangles one = square({}, 0.5);
  const std::vector<ViewedLeaf> opaque{one.leaf()}, cut{one.leaf(&half)};
  LeafViews views = views_of(opaque);
  const double all = views.look(opaque)[0].total, some = views.look(cut)[0].total;
  EXPECT_NEAR(some / all, 0.5, 0.05);
  EXPECT_NEAR(views.coverage(), 0.5, 0.05);
}

TEST(LeafViews, TakingAHiddenLeafAwayChangesNothing) {
  const Triangles outer = box({}, 0.8), inner = square({}, 0.3), grown = square({}, 0.4);
  const std::vector<ViewedLeaf> leaves{outer.leaf(), inner.leaf()};
  LeafViews views = views_of(leaves);
  views.look(leaves);
  LeafViews::Exchange exchange(views);
  exchange.remove(std::vector<std::uint32_t>{1}, std::vector<ViewedLeaf>{leaves[1]});
  const LeafViews::Change change = exchange.add(grown.leaf(), 1);
  EXPECT_EQ(change.covered, 0);
  EXPECT_EQ(change.other, 0);
}

TEST(LeafViews, PuttingALeafBackWhereItWasChangesNothing) {
  const Triangles a = square({}, 0.5), b = square({0.7, 0.2, 0.3}, 0.4, 1);
  const std::vector<ViewedLeaf> leaves{a.leaf(), b.leaf()};
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
  const std::vector<ViewedLeaf> leaves{a.leaf()};
  LeafViews views = views_of(leaves);
  const auto counts = views.look(leaves);
  LeafViews::Exchange exchange(views);
  exchange.remove(std::vector<std::uint32_t>{0}, leaves);
  EXPECT_EQ(exchange.add(none.leaf(), k_none).covered, counts[0].total);
  EXPECT_GT(exchange.add(b.leaf(), k_none).covered, counts[0].total * 0.9)
      << "elsewhere it is no help, and covers what was open";
}

TEST(LeafViews, MendingAHoleIsWorthMoreThanNothing) {
  const Triangles a = square({-0.6, 0, 0}, 0.5), b = square({0.6, 0, 0}, 0.5);
  const std::vector<ViewedLeaf> source{a.leaf(), b.leaf()}, left{a.leaf()};
  LeafViews views = views_of(source);
  views.look(left);
  LeafViews::Exchange exchange(views);
  exchange.remove(std::vector<std::uint32_t>{0}, left);
  const double stays = exchange.add(a.leaf(), 0).covered;
  Triangles both = a;
  both.append(b);
  EXPECT_LT(exchange.add(both.leaf(), 0).covered, stays);
}

// Leaves at random, the last of them to be moved.
std::vector<Triangles> crowd(double size) {
  std::vector<Triangles> out;
  const Random root(3);
  for (int l = 0; l < 40; ++l) {
    Random draw = root.fork(l);
    out.push_back(square({draw.uniform(-1, 1), draw.uniform(-1, 1), draw.uniform(-1, 1)}, size, l % 3));
  }
  return out;
}

TEST(LeafViews, AnEstimateComesNearToWhatAllPixelsSay) {
  const std::vector<Triangles> crown = crowd(0.2);
  std::vector<ViewedLeaf> leaves;
  for (const Triangles& t : crown) leaves.push_back(t.leaf());
  LeafViews views = views_of(leaves);
  const auto counts = views.look(leaves);
  LeafViews::Exchange exact(views);
  LeafViews::Estimate estimate(views);
  for (std::uint32_t l = 0; l + 1 < 40; l += 2) {
    const std::array<std::uint32_t, 2> numbers{l, l + 1};
    const std::array<ViewedLeaf, 2> gone{leaves[l], leaves[l + 1]};
    exact.remove(numbers, gone), estimate.remove(numbers, gone);
    const double pixels = counts[l].total + counts[l + 1].total;
    for (const Triangles& put : {crown[l], square({0, 0.5, 0}, 0.28, 1), square({3, 0, 0}, 0.2)}) {
      const LeafViews::Change a = exact.add(put.leaf(), l), b = estimate.add(put.leaf(), l);
      EXPECT_NEAR(a.covered, b.covered, 0.2 * pixels) << l;
      EXPECT_NEAR(a.other, b.other, 0.2 * pixels) << l;
    }
  }
}

TEST(LeafViews, WhatIsInTheBoxIsCountedAsInTheWholeBall) {
  const std::vector<Triangles> crown = crowd(0.2);
  std::vector<ViewedLeaf> leaves;
  DoubleBox box;
  for (const Triangles& t : crown) {
    leaves.push_back(t.leaf());
    for (const SpectrumVertex& v : t.vertices) box.grow(to_double(v.position));
  }
  LeafViews ball({}, 4, 0.04, 0), cut({}, 4, 0.04, 0, LeafViews::k_most_views, box);
  const auto a = ball.look(leaves), b = cut.look(leaves);
  for (std::size_t l = 0; l < leaves.size(); ++l) {
    // Pixels are where they were but for rounding.
    EXPECT_NEAR(a[l].total, b[l].total, 2);
    EXPECT_NEAR(a[l].sole, b[l].sole, 2);
  }
}

TEST(LeafViews, FewerViewsCountAsMuchInEachOfThem) {
  const Triangles one = square({}, 0.5);
  const std::vector<ViewedLeaf> leaves{one.leaf()};
  LeafViews few({}, 2, 0.04, 0, 6), all({}, 2, 0.04, 0);
  EXPECT_EQ(few.views(), 6);
  const double share = few.look(leaves)[0].total / 6.0, whole = all.look(leaves)[0].total / 12.0;
  EXPECT_NEAR(share / whole, 1, 0.25);
}

TEST(LeafViews, DoesNotDependOnTheNumberOfThreads) {
  const Triangles a = square({}, 0.5), b = square({0.1, 0.2, 0.3}, 0.4, 1);
  const std::vector<ViewedLeaf> leaves{a.leaf(), b.leaf()};
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
  const Triangles point{std::vector<SpectrumVertex>(3), {{0, 1, 2}}};
  EXPECT_EQ(views.look(std::vector<ViewedLeaf>{point.leaf()})[0].total, 0u);
}

}  // namespace
}  // namespace copse
