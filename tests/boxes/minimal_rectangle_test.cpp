#include "lib/analysis/boxes/minimal_rectangle.h"

#include "lib/formats/random.h"

#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace copse {
namespace {

using Points = std::vector<Double2>;

double area_along(const Points& points, const Double2& u) {
  double l = 1e300, r = -1e300, b = 1e300, t = -1e300;
  for (const Double2& p : points) {
    const double x = p.x * u.x + p.y * u.y, y = p.y * u.x - p.x * u.y;
    l = std::min(l, x), r = std::max(r, x), b = std::min(b, y), t = std::max(t, y);
  }
  return (r - l) * (t - b);
}

TEST(MinimalRectangle, IsNoLargerThanAlongAnyDirection) {
  for (int seed = 0; seed < 50; ++seed) {
    Random random(seed);
    Points points;
    const double thin = seed % 3 == 0 ? 1e-6 : 1;
    for (int i = 0; i < 3 + seed; ++i) points.push_back({random.uniform(), thin * random.uniform()});
    const Rectangle best = minimal_rectangle(hull_of_plane(points));
    EXPECT_NEAR(std::hypot(best.along.x, best.along.y), 1, 1e-15);
    EXPECT_NEAR(best.area, area_along(points, best.along), 1e-12 * best.area);
    for (int i = 0; i < 360; ++i) {
      const double a = i * std::numbers::pi / 360;
      EXPECT_LE(best.area, area_along(points, {std::cos(a), std::sin(a)}) * (1 + 1e-12));
    }
  }
}

TEST(MinimalRectangle, OfPointsOnALineLiesAlongIt) {
  const Points hull = hull_of_plane(Points{{3, 3}, {1, 1}, {2, 2}, {1, 1}});
  ASSERT_EQ(hull.size(), 2u);
  const Rectangle r = minimal_rectangle(hull);
  EXPECT_EQ(r.area, 0);
  EXPECT_NEAR(r.along.x, std::sqrt(0.5), 1e-15);
  EXPECT_EQ(minimal_rectangle(hull_of_plane(Points{{3, 3}, {3, 3}})).area, 0);
  EXPECT_EQ(hull_of_plane({}).size(), 0u);
}

TEST(MinimalRectangle, HullHasTheCornersAlone) {
  Points points;
  for (int i = 0; i < 100; ++i) points.push_back({double(i % 10), double(i / 10)});
  const Points corners{{0, 0}, {9, 0}, {9, 9}, {0, 9}};
  EXPECT_EQ(hull_of_plane(points), corners);
}

}  // namespace
}  // namespace copse
