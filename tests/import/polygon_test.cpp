#include "lib/formats/import/polygon.h"

#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace copse {
namespace {

using Ring = std::vector<Double3>;
using Cuts = std::vector<PolygonCutter::Cut>;

Cuts cut(const Ring& ring) {
  PolygonCutter cutter;
  const auto cuts = cutter.cut(ring);
  return {cuts.begin(), cuts.end()};
}

Double3 area_vector(const Ring& ring) {
  Double3 sum;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i)
    sum += cross(ring[i] - ring[0], ring[i + 1] - ring[0]) * 0.5;
  return sum;
}

// The sum of the triangles' areas, signed by the polygon's normal, and the least of them.
std::pair<double, double> covered(const Ring& ring, const Cuts& cuts) {
  const Double3 up = normalized(area_vector(ring));
  double sum = 0, least = 1e300;
  for (const auto& [a, b, c] : cuts) {
    const double area = dot(cross(ring[b] - ring[a], ring[c] - ring[a]), up) * 0.5;
    sum += area;
    least = std::min(least, area);
  }
  return {sum, least};
}

// n - 2 triangles, none turned over, that have the polygon's area: so none overlap.
void expect_exact_cover(const Ring& ring) {
  const Cuts cuts = cut(ring);
  ASSERT_EQ(cuts.size(), ring.size() - 2);
  const auto [sum, least] = covered(ring, cuts);
  const double area = length(area_vector(ring));
  EXPECT_NEAR(sum, area, 1e-9 * area);
  EXPECT_GE(least, -1e-12 * area);
}

Ring circle(std::size_t n, double radius = 1) {
  Ring ring;
  for (std::size_t i = 0; i < n; ++i) {
    const double t = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
    ring.push_back({radius * std::cos(t), 0, -radius * std::sin(t)});
  }
  return ring;
}

// Rays of random length: never crosses itself, concave nearly everywhere.
Ring star(std::size_t n, unsigned seed) {
  Ring ring = circle(n);
  std::mt19937 random(seed);
  for (Double3& p : ring) p *= 0.1 + 0.9 * static_cast<double>(random()) / 4294967296.0;
  return ring;
}

TEST(Polygon, AFlatRectangleIsCutThroughItsFirstCorner) {
  EXPECT_EQ(cut({{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {0, 1, 0}}), (Cuts{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Polygon, AQuadIsCutAlongItsShorterDiagonal) {
  EXPECT_EQ(cut({{0, 0, 0}, {3, 1, 0}, {6, 0, 0}, {3, -1, 0}}), (Cuts{{1, 2, 3}, {1, 3, 0}}));
  EXPECT_EQ(cut({{3, 1, 0}, {6, 0, 0}, {3, -1, 0}, {0, 0, 0}}), (Cuts{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Polygon, RoundingDoesNotDecideBetweenEqualDiagonals) {
  EXPECT_EQ(cut({{0, 0, 0}, {1, 0, 0}, {0.99999, 1, 0}, {0, 1, 0}}), (Cuts{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(cut({{0, 0, 0}, {1, 0, 0}, {1.00001, 1, 0}, {0, 1, 0}}), (Cuts{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Polygon, AConcaveQuadIsCutAtItsReflexCornerWhereverItBegins) {
  const Ring dart{{0, 0, 0}, {2, 3, 0}, {0, 1, 0}, {-2, 3, 0}};
  for (std::size_t turn = 0; turn < 4; ++turn) {
    Ring ring(dart);
    std::rotate(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(turn), ring.end());
    expect_exact_cover(ring);
  }
}

TEST(Polygon, NGonsOfAnyShapeAreCoveredExactly) {
  expect_exact_cover(circle(8));
  expect_exact_cover(
      {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {3, 4, 0}, {3, 1, 0}, {1, 1, 0}, {1, 4, 0}, {0, 4, 0}});  // U
  expect_exact_cover(
      {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 1, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}, {0, 1, 0}});  // on edges
  for (unsigned seed = 0; seed < 50; ++seed) expect_exact_cover(star(5 + seed * 3, seed));
}

TEST(Polygon, AKeyholeCutsAHoleOut) {
  // A square with a square hole, joined by a bridge that is walked both ways.
  expect_exact_cover({{0, 0, 0},
                      {9, 0, 0},
                      {9, 9, 0},
                      {0, 9, 0},
                      {0, 0, 0},
                      {3, 3, 0},
                      {3, 6, 0},
                      {6, 6, 0},
                      {6, 3, 0},
                      {3, 3, 0}});
}

TEST(Polygon, ItsPlaneAndItsWindingDoNotMatter) {
  const Ring flat = star(40, 7);
  for (int k = 0; k < 8; ++k) {
    const double a = 0.7 * k, b = 1.3 * k;
    Ring turned;
    for (const Double3& p : flat) {
      const Double3 q{p.x * std::cos(a) - p.z * std::sin(a), p.y, p.x * std::sin(a) + p.z * std::cos(a)};
      turned.push_back({q.x, q.y * std::cos(b) - q.z * std::sin(b), q.y * std::sin(b) + q.z * std::cos(b)});
    }
    expect_exact_cover(turned);
    std::reverse(turned.begin(), turned.end());
    expect_exact_cover(turned);
  }
}

TEST(Polygon, ExtremeSizesAndPlacesAreCutAlike) {
  const Cuts expected = cut(star(30, 3));
  for (const double size : {1e-300, 1e-30, 1e30, 1e300}) {
    Ring ring = star(30, 3);
    for (Double3& p : ring) p *= size;
    EXPECT_EQ(cut(ring), expected) << size;
  }
  Ring far = star(30, 3);
  for (Double3& p : far) p = p * 1000 + Double3{1e7, -1e7, 1e7};
  EXPECT_EQ(cut(far).size(), 28u);
  EXPECT_EQ(cut({{-1.7e308, 0, 0}, {1.7e308, 0, 0}, {1.7e308, 1e308, 0}, {0, 1e308, 1}, {-1.7e308, 1e308, 0}})
                .size(),
            3u);
}

TEST(Polygon, WithoutAreaThereAreStillAllTriangles) {
  EXPECT_EQ(cut(Ring(7, {1, 2, 3})).size(), 5u);
  EXPECT_EQ(cut({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}, {1.5, 0, 0}}).size(), 3u);
  EXPECT_EQ(cut(Ring(4, {1, 2, 3})), (Cuts{{0, 1, 2}, {0, 2, 3}}));
}

TEST(Polygon, OneThatCrossesItselfStillGivesAllTriangles) {
  Ring ring;
  for (int i = 0; i < 101; ++i) {  // a star polygon {101/40}
    const double t = 2 * std::numbers::pi * 40 * i / 101;
    ring.push_back({std::cos(t), std::sin(t), 0.01 * i});
  }
  const Cuts cuts = cut(ring);
  EXPECT_EQ(cuts.size(), 99u);
  for (const auto& [a, b, c] : cuts) EXPECT_TRUE(a < 101 && b < 101 && c < 101 && a != b && b != c && c != a);
}

TEST(Polygon, AHundredThousandCornersTakeNoQuadraticWork) {
  bool gave_up = false;
  const auto work = [&](const Ring& ring) {
    PolygonCutter cutter;
    EXPECT_EQ(cutter.cut(ring).size(), ring.size() - 2);
    gave_up = cutter.gave_up();
    return static_cast<double>(cutter.work()) / static_cast<double>(ring.size());
  };
  EXPECT_LT(work(circle(100'000)), 2);
  EXPECT_LT(work(star(100'000, 1)), 800);
  EXPECT_FALSE(gave_up);
  Ring comb;  // long thin teeth: a quarter of the corners is reflex, and ears are long
  for (int i = 0; i < 25'000; ++i) {
    const double x = i;
    comb.insert(comb.end(), {{x, 1000, 0}, {x + 0.3, 1000, 0}, {x + 0.3, 1, 0}, {x + 1, 1, 0}});
  }
  comb.insert(comb.end(), {{25'000, 0, 0}, {0, 0, 0}});
  EXPECT_LT(work(comb), 200);
  EXPECT_FALSE(gave_up);
  Ring noise(100'000);  // crosses itself everywhere: given up in time
  std::mt19937 random(1);
  for (Double3& p : noise) p = {random() * 1.0, random() * 1.0, 0};
  EXPECT_LT(work(noise), 1.0 * k_cut_budget * 18);
  EXPECT_TRUE(gave_up);
}

TEST(Polygon, ALargeSimplePolygonIsCoveredExactlyToo) {
  const Ring ring = star(20'000, 5);
  PolygonCutter cutter;
  const auto cuts = cutter.cut(ring);
  EXPECT_FALSE(cutter.gave_up());
  const auto [sum, least] = covered(ring, {cuts.begin(), cuts.end()});
  EXPECT_NEAR(sum, length(area_vector(ring)), 1e-9);
  EXPECT_GE(least, -1e-12);
}

}  // namespace
}  // namespace copse
