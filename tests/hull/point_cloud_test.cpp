#include "lib/analysis/hull/point_cloud.h"

#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

namespace copse {
namespace {

using Points = std::vector<Double3>;

TEST(PointCloud, RefusesNoPointsAndNamesThePointThatIsNotFinite) {
  EXPECT_FALSE(make_point_cloud({}));
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  for (const double bad : {nan, inf, -inf}) {
    const auto cloud = make_point_cloud(Points{{0, 0, 0}, {1, 2, 3}, {4, bad, 6}, {bad, bad, bad}});
    ASSERT_FALSE(cloud);
    EXPECT_EQ(cloud.error().fault, Fault::refused);
    EXPECT_NE(cloud.error().what.find("point 2 "), std::string::npos) << cloud.error().what;
    EXPECT_FALSE(cloud.error().remedy.empty());
  }
}

TEST(PointCloud, IsOfSizeOneAtTheOriginWhateverTheScaleAndPlace) {
  for (const double scale : {1e-300, 1e-160, 1e-30, 1.0, 1e30, 1e200, 1.7e308}) {
    for (const double offset : {0.0, 1e7, -1e9}) {
      const Double3 o{offset * scale, 0, -offset * scale};
      if (!is_finite(o)) continue;
      const auto cloud =
          make_point_cloud(Points{o, o + Double3{scale, 0, 0}, o + Double3{0, -scale / 2, scale / 4}});
      ASSERT_TRUE(cloud) << scale;
      const Double3 size = cloud->box.extent();
      EXPECT_GE(std::max({size.x, size.y, size.z}), 0.49) << scale << " " << offset;
      for (const Double3& p : cloud->points) {
        for (int i = 0; i < 3; ++i) EXPECT_LE(std::abs(p[i]), 2) << scale << " " << offset;
      }
      EXPECT_EQ(std::ilogb(cloud->frame.scale), std::ilogb(cloud->frame.scale * (1 + 1e-15)));
    }
  }
}

TEST(PointCloud, OfFloatsIsExactAndComesBackExactly) {
  Points points;
  for (int i = 0; i < 1000; ++i) {
    points.push_back({static_cast<float>(1e5 + std::sin(i)), static_cast<float>(std::cos(3 * i)),
                      static_cast<float>(0.01 * i)});
  }
  const auto cloud = make_point_cloud(points);
  ASSERT_TRUE(cloud);
  for (std::size_t i = 0; i < points.size(); ++i) EXPECT_EQ(cloud->frame.out(cloud->points[i]), points[i]);
}

TEST(PointCloud, OfOnePointIsAtTheOriginOfItsFrame) {
  const auto cloud = make_point_cloud(Points{{3, -4, 1e9}});
  ASSERT_TRUE(cloud);
  EXPECT_EQ(cloud->frame.out(cloud->points[0]), (Double3{3, -4, 1e9}));
}

TEST(PointCloud, HasNoNegativeZero) {
  const auto cloud = make_point_cloud(Points{{-0.0, 0, 0}, {0, -0.0, -0.0}});
  ASSERT_TRUE(cloud);
  for (const Double3& p : cloud->points) {
    for (int i = 0; i < 3; ++i) EXPECT_FALSE(std::signbit(p[i]));
  }
  EXPECT_EQ(distinct_points(cloud->points).size(), 1u);
}

TEST(PointCloud, DistinctPointsDoNotDependOnTheOrder) {
  const Points points{{1, 2, 3}, {0, 5, 5}, {1, 2, 3}, {1, 2, -3}};
  const Points wanted{{0, 5, 5}, {1, 2, -3}, {1, 2, 3}};
  EXPECT_EQ(distinct_points(points), wanted);
  EXPECT_EQ(distinct_points(Points(points.rbegin(), points.rend())), wanted);
}

TEST(PointCloud, VolumesAreBroughtBackToTheCallersCoordinates) {
  const PointFrame frame{{10, 20, 30}, 4};
  EXPECT_EQ(placed(BoundingSphere<double>{{1, 1, 1}, 2}, frame), (BoundingSphere<double>{{14, 24, 34}, 8}));
  EXPECT_EQ(placed(Capsule<double>{{1, 0, 0}, {2, 0, 0}, 1}, frame),
            (Capsule<double>{{14, 20, 30}, {18, 20, 30}, 4}));
  const auto lozenge = placed(Lozenge<double>{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, 0.5}, frame);
  EXPECT_EQ(lozenge, (Lozenge<double>{{10, 20, 30}, {4, 0, 0}, {0, 8, 0}, 2}));
  const auto kdop = placed(Kdop<double>{{{1, 1, 0}}, {-1}, {2}}, frame);
  EXPECT_EQ(kdop.min[0], 26);
  EXPECT_EQ(kdop.max[0], 38);
  EXPECT_EQ(frame.volume_out(2), 128);
}

}  // namespace
}  // namespace copse
