#include "lib/analysis/rings/ring_circles.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

Hierarchy two_rings(RadiusSource source) {
  Hierarchy h;
  h.radii = {{{0, 0, 0}, 2, k_none, false, source}, {{0, 4, 0}, 1, 0, false, source}};
  h.ring_vertices = {0, 1, 2, 3, 4, 5};
  h.first_vertex = {0, 3, 6};
  return h;
}

TEST(RingCircles, TellHowFarAlongTheCornersOfATriangleAre) {
  const Hierarchy h = two_rings(RadiusSource::ring);
  const RingCircles circles(h, 7);
  const auto at = circles.along({0, 4, 2}, 1);
  ASSERT_TRUE(at.has_value());
  EXPECT_EQ(*at, (std::array<double, 3>{0, 1, 0}));
  EXPECT_FALSE(circles.along({0, 4, 6}, 1)) << "a vertex of no ring";
}

TEST(RingCircles, KnowNothingOfVerticesThatASkeletonCountsToARadius) {
  const Hierarchy h = two_rings(RadiusSource::surface);
  EXPECT_FALSE(RingCircles(h, 6).along({0, 4, 2}, 1));
}

TEST(RingCircles, APointOfATiltedRingIsOnItsCircle) {
  const Hierarchy h = two_rings(RadiusSource::ring);
  EXPECT_NEAR(off_circle({0.6, 0.8, 0}, h.radii[0], h.radii[1], 0), 0, 1e-15);
  EXPECT_NEAR(off_circle({0, 2.75, 0}, h.radii[0], h.radii[1], 0.5), 0, 1e-15);
  EXPECT_NEAR(off_circle({0, 4, 0}, h.radii[0], h.radii[1], 1), 0.5, 1e-15);
}

}  // namespace
}  // namespace copse
