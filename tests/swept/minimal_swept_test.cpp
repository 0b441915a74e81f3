// What must hold of minimal capsules and of minimal lozenges alike.
#include "lib/analysis/swept/capsule.h"
#include "lib/analysis/swept/lozenge.h"
#include "lib/analysis/swept/minimal_capsule.h"
#include "lib/analysis/swept/minimal_lozenge.h"
#include "tests/volumes/hull_of.h"
#include "tests/volumes/point_sets.h"
#include "tests/volumes/reference_models.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

constexpr double k_flat = 0x1p-46;  // what convex_hull.h takes for flat

struct OfCapsules {
  static constexpr double above_best = 1.001;
  static auto fit(const ConvexHull& hull, const SweptBoundOptions& how) { return minimal_capsule(hull, how); }
  static double best(const ReferenceModel& model) { return model.capsule; }
  static double distance_from(const Capsule<double>& v, const Double3& p) {
    return distance_from_segment(v, p);
  }
};
struct OfLozenges {
  static constexpr double above_best = 1.0015;
  static auto fit(const ConvexHull& hull, const SweptBoundOptions& how) { return minimal_lozenge(hull, how); }
  static double best(const ReferenceModel& model) { return model.lozenge; }
  static double distance_from(const Lozenge<double>& v, const Double3& p) {
    return distance_from_rectangle(v, p);
  }
};

template <class Type>
class MinimalSwept : public testing::Test {};
using Types = testing::Types<OfCapsules, OfLozenges>;
TYPED_TEST_SUITE(MinimalSwept, Types);

TYPED_TEST(MinimalSwept, OfReferenceModelsIsTheBestKnownAndProvenTo2Percent) {
  ASSERT_FALSE(reference_folder().empty()) << "no reference models: ./run installs libcgal-demo";
  for (const ReferenceModel& model : reference_models()) {
    const std::vector<Double3> points = reference_points(model.name);
    if (points.size() > 3000) continue;  // the quick ones
    const auto cloud = make_point_cloud(points);
    ASSERT_TRUE(cloud) << model.name;
    const ConvexHull hull = convex_hull(*cloud);
    SweptBoundOptions proof;
    proof.gap = 0.02;
    const auto fit = TypeParam::fit(hull, proof);
    const double volume = interior_volume(fit.volume), unit = hull.frame.volume_out(1),
                 best = TypeParam::best(model);
    EXPECT_LE(volume * unit, best * TypeParam::above_best) << model.name;
    EXPECT_LE(fit.lower_bound * unit, best * (1 + 1e-6)) << model.name;
    EXPECT_GE(fit.lower_bound * 1.02001, volume) << model.name;
  }
}

// Every set that breaks other fitters, with a proof that is cut short: what is given is sound all the same.
TYPED_TEST(MinimalSwept, OfTheDegenerateBatteryEnclosesAndClaimsNoMoreThanItHas) {
  SweptBoundOptions proof;
  proof.gap = 0.1, proof.max_separations = 60;
  for (const NamedPoints& s : float32_battery()) {
    const auto cloud = make_point_cloud(s.points);
    ASSERT_TRUE(cloud) << s.name;
    const auto fit = TypeParam::fit(convex_hull(*cloud), proof);
    const double volume = interior_volume(fit.volume);
    EXPECT_TRUE(std::isfinite(volume)) << s.name;
    EXPECT_GE(fit.lower_bound, 0) << s.name;
    EXPECT_LE(fit.lower_bound, volume) << s.name;
    for (const Double3& p : cloud->points)
      EXPECT_LE(TypeParam::distance_from(fit.volume, p), fit.volume.radius + k_flat) << s.name;
  }
}

TYPED_TEST(MinimalSwept, DoesNotChangeOneBitWithTheOrderOrRepetitionOfThePoints) {
  Random random(8);
  Points p = repeated(50, [&] { return in_box(random, {1, 0.6, 0.3}); });
  SweptBoundOptions proof;
  proof.gap = 0.05;
  const auto before = TypeParam::fit(hull_of(p), proof);
  p.insert(p.end(), p.begin(), p.begin() + 20);
  random.shuffle(std::span<Double3>(p));
  const auto after = TypeParam::fit(hull_of(p), proof);
  EXPECT_EQ(before.volume, after.volume);
  EXPECT_EQ(before.lower_bound, after.lower_bound);
}

}  // namespace
}  // namespace copse
