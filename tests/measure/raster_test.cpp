#include "lib/analysis/measure/raster.h"

#include <algorithm>
#include <numbers>

#include <gtest/gtest.h>

namespace copse {
namespace {

OrthographicView view_of(int size) {
  return {.pixel = 1, .width = size, .height = size};
}

std::size_t covered(const Raster& r, std::uint32_t id) {
  return static_cast<std::size_t>(std::count(r.triangle.begin(), r.triangle.end(), id));
}

TEST(Raster, CoversExactlyThePixelsWhoseCentresAreInside) {
  const std::vector<Double3> p{{-4, -4, 0}, {4, -4, 0}, {4, 4, 0}, {-4, 4, 0}};
  const std::vector<Triangle> t{{0, 1, 2}, {0, 2, 3}};
  const Raster r = rasterize(p, t, view_of(10));
  EXPECT_EQ(covered(r, 0) + covered(r, 1), 64u);
  EXPECT_EQ(r.triangle[0], k_none);
  EXPECT_NE(r.triangle[1 * 10 + 1], k_none);
}

TEST(Raster, ShowsTheNearerTriangleWhateverTheOrder) {
  const std::vector<Double3> p{{-9, -9, 1}, {9, -9, 1}, {0, 9, 1}, {-9, -9, 2}, {9, -9, 2}, {0, 9, 2}};
  for (const auto& t :
       {std::vector<Triangle>{{0, 1, 2}, {3, 4, 5}}, std::vector<Triangle>{{3, 4, 5}, {0, 1, 2}}}) {
    const Raster r = rasterize(p, t, view_of(6));
    EXPECT_EQ(p[t[r.triangle[3 * 6 + 3]][0]].z, 2);
  }
}

TEST(Raster, DrawsBothSides) {
  const std::vector<Double3> p{{-9, -9, 0}, {9, -9, 0}, {0, 9, 0}};
  EXPECT_EQ(covered(rasterize(p, std::vector<Triangle>{{0, 1, 2}}, view_of(6)), 0),
            covered(rasterize(p, std::vector<Triangle>{{0, 2, 1}}, view_of(6)), 0));
}

TEST(Raster, FramesABoxFromAnySide) {
  const DoubleBox box{{-1, 0, -3}, {1, 8, 3}};
  for (const double azimuth : {0.0, std::numbers::pi / 2, 0.7}) {
    const OrthographicView v = frame_box(box, azimuth, 100, 200);
    for (int corner = 0; corner < 8; ++corner) {
      const Double3 p = v.project({corner & 1 ? 1.0 : -1.0, corner & 2 ? 8.0 : 0.0, corner & 4 ? 3.0 : -3.0});
      EXPECT_TRUE(p.x >= 0 && p.x <= 100 && p.y >= 0 && p.y <= 200) << p.x << " " << p.y;
    }
  }
}

TEST(Raster, OfNothingIsEmpty) {
  const Raster r = rasterize({}, {}, frame_box({}, 0, 4, 4));
  EXPECT_EQ(covered(r, k_none), 16u);
}

}  // namespace
}  // namespace copse
