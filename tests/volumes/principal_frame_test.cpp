#include "lib/analysis/volumes/principal_frame.h"

#include "tests/volumes/point_sets.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(PrincipalFrame, OfABrickHasTheBricksAxesByDecreasingExtent) {
  Points p;
  for (const Double3& c : unit_cube()) p.push_back({c.x, 5 * c.y, 2 * c.z});
  const PrincipalFrame f = principal_frame(p);
  EXPECT_EQ(f.mean, (Double3{0.5, 2.5, 1}));
  EXPECT_NEAR(std::abs(f.axes[0].y), 1, 1e-15);
  EXPECT_NEAR(std::abs(f.axes[1].z), 1, 1e-15);
  EXPECT_NEAR(f.variances.x, 6.25, 1e-14);
  EXPECT_NEAR(f.variances.y, 1, 1e-14);
  EXPECT_NEAR(f.variances.z, 0.25, 1e-14);
}

TEST(PrincipalFrame, IsARotationForEveryKindOfSet) {
  for (const auto& sets : {mixed_sets(), flat_sets()}) {
    for (const NamedPoints& s : sets) {
      const Frame3 a = principal_frame(s.points).axes;
      for (int i = 0; i < 3; ++i) {
        for (int j = 0; j < 3; ++j) EXPECT_NEAR(dot(a[i], a[j]), i == j, 1e-15) << s.name;
      }
      EXPECT_NEAR(dot(cross(a[0], a[1]), a[2]), 1, 1e-15) << s.name;
    }
  }
}

TEST(PrincipalFrame, DiagonalizesTheCovariance) {
  for (const NamedPoints& s : mixed_sets()) {
    const PrincipalFrame f = principal_frame(s.points);
    for (int i = 0; i < 3; ++i) {
      for (int j = i; j < 3; ++j) {
        double sum = 0;
        for (const Double3& p : s.points) sum += dot(f.axes[i], p - f.mean) * dot(f.axes[j], p - f.mean);
        EXPECT_NEAR(sum / double(s.points.size()), i == j ? f.variances[i] : 0, 1e-14 * f.variances.x)
            << s.name;
      }
    }
  }
}

}  // namespace
}  // namespace copse
