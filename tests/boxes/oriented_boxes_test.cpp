#include "lib/analysis/boxes/oriented_boxes.h"

#include "lib/analysis/volumes/volume_measures.h"
#include "tests/volumes/inside.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(OrientedBoxes, EncloseEveryDegenerateSet) {
  for (const NamedPoints& set : degenerate_battery()) {
    const PointCloud cloud = make_point_cloud(set.points).value();
    const ConvexHull hull = convex_hull(cloud);
    const std::vector<std::array<std::uint32_t, 3>> triangle{
        {0, 0, static_cast<std::uint32_t>(set.points.size() - 1)}};
    for (const auto& box : {gaussian_box(cloud), surface_box(cloud, triangle), hull_surface_box(hull)}) {
      EXPECT_LE(outside_by(box, cloud.points), 1e-14) << set.name;
      EXPECT_TRUE(is_finite(box.centre) && is_finite(box.half_extents)) << set.name;
    }
  }
}

TEST(OrientedBoxes, InPrincipalAxesOfATurnedBrickAreTheBrick) {
  const PointCloud cloud =
      make_point_cloud(
          turned({{0, 0, 0}, {5, 0, 0}, {0, 3, 0}, {5, 3, 0}, {0, 0, 1}, {5, 0, 1}, {0, 3, 1}, {5, 3, 1}},
                 {1, 2, 3}, {0, 1, 1}))
          .value();
  const ConvexHull hull = convex_hull(cloud);
  for (const auto& box : {gaussian_box(cloud), hull_surface_box(hull)}) {
    EXPECT_NEAR(cloud.frame.volume_out(measures_of(box).volume), 15, 1e-11);
  }
}

TEST(OrientedBoxes, AreCentredOnTheExtentsNotOnTheMean) {
  std::vector<Double3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  points.insert(points.end(), {{.1, .1, .1}, {.1, .2, .1}, {.2, .1, .1}, {.11, .1, .1}});
  const OrientedBox<double> box = box_in_axes(points, k_world_axes);
  EXPECT_EQ(box.centre, (Double3{.5, .5, .5}));
  EXPECT_EQ(box.half_extents, (Double3{.5, .5, .5}));
}

}  // namespace
}  // namespace copse
