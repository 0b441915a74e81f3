#include "lib/analysis/boxes/kdop.h"

#include "lib/analysis/volumes/volume_measures.h"
#include "tests/volumes/inside.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(Kdop, HasHalfAsManyDirectionsAndNoneTwice) {
  for (const int k : {2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 26, 32, 100, 1000}) {
    const std::vector<Double3> normals = kdop_normals(k);
    ASSERT_EQ(normals.size(), static_cast<std::size_t>(k / 2));
    for (std::size_t i = 0; i < normals.size() && k <= 100; ++i) {
      for (std::size_t j = 0; j < i; ++j)
        EXPECT_GT(length(cross(normalized(normals[i]), normalized(normals[j]))), 1e-3);
    }
  }
  for (const int k : {14, 18, 26}) {
    for (const Double3& n : kdop_normals(k)) {
      for (int i = 0; i < 3; ++i) EXPECT_TRUE(n[i] == 0 || std::abs(n[i]) == 1);
    }
  }
}

TEST(Kdop, EnclosesEveryAwkwardSetAndTouchesIt) {
  for (const NamedPoints& set : degenerate_battery()) {
    for (const int k : {6, 14, 18, 26, 32}) {
      const Kdop<double> kdop = fit_kdop(set.points, kdop_normals(k));
      EXPECT_EQ(outside_by(kdop, set.points), 0) << set.name;
      for (std::size_t i = 0; i < kdop.normals.size(); ++i) {
        EXPECT_TRUE(std::any_of(set.points.begin(), set.points.end(),
                                [&](const Double3& p) { return dot(kdop.normals[i], p) == kdop.max[i]; }));
      }
    }
  }
}

TEST(Kdop, MoreDirectionsMakeItSmaller) {
  const auto ball = on_sphere(3, 3000);
  double last = 9;
  for (const int k : {6, 14, 26}) {  // each has the directions of the one before
    const double volume = measures_of(fit_kdop(ball, kdop_normals(k))).volume;
    EXPECT_LT(volume, last);
    last = volume;
  }
  EXPECT_NEAR(measures_of(fit_kdop(ball, kdop_normals(400))).volume, 4.18879, 0.08);
  EXPECT_NEAR(measures_of(fit_kdop(cube_corners(2), kdop_normals(26))).volume, 8, 1e-12);
}

}  // namespace
}  // namespace copse
