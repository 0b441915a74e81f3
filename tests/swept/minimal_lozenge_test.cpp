#include "lib/analysis/swept/minimal_lozenge.h"

#include "lib/analysis/swept/capsule.h"
#include "lib/analysis/swept/lozenge.h"
#include "lib/analysis/swept/minimal_capsule.h"
#include "tests/volumes/hull_of.h"
#include "tests/volumes/point_sets.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

constexpr double k_flat = 0x1p-46;  // what convex_hull.h takes for flat

TEST(MinimalLozenge, ReachesTheBestThatIsKnown) {  // reference: 80 starts of a random search
  const auto volume = [](const Points& p) { return interior_volume(minimal_lozenge(hull_of(p)).volume); };
  EXPECT_LE(volume(cube_corners()), 2.444035895 * (1 + 1e-7));
  EXPECT_LE(volume(corner_tetrahedron()), 1.414735605 * (1 + 1e-7));
  EXPECT_LE(volume(icosahedron()), 28.82687553 * (1 + 1e-7));
  EXPECT_LE(volume(torus()), 0.35435676 * 1.0005);
}

TEST(MinimalLozenge, EnclosesAndIsNeverWorseThanTheGaussianOrTheCapsule) {
  for (const NamedPoints& s : mixed_sets()) {
    const BoundedFit<Lozenge<double>> fit = minimal_lozenge(hull_of(s.points));
    for (const Double3& p : s.points) {
      EXPECT_LE(distance_from_rectangle(fit.volume, p), fit.volume.radius) << s.name;
    }
    const double v = interior_volume(fit.volume);
    EXPECT_LE(v, interior_volume(gaussian_lozenge(s.points))) << s.name;
    EXPECT_LE(v, interior_volume(minimal_capsule(hull_of(s.points)).volume) * (1 + 1e-12)) << s.name;
    EXPECT_LE(fit.lower_bound, v) << s.name;
  }
}

TEST(MinimalLozenge, EdgesAreOrthogonal) {
  for (const NamedPoints& s : mixed_sets()) {
    const Lozenge<double> l = minimal_lozenge(hull_of(s.points)).volume;
    EXPECT_LE(std::abs(dot(l.edge0, l.edge1)), 1e-15 * length(l.edge0) * length(l.edge1)) << s.name;
  }
}

TEST(MinimalLozenge, OfFlatSetsHasNoThickness) {
  for (const NamedPoints& s : flat_sets()) {
    const Lozenge<double> l = minimal_lozenge(hull_of(s.points)).volume;
    for (const Double3& p : s.points) EXPECT_LE(distance_from_rectangle(l, p), l.radius + k_flat) << s.name;
    EXPECT_LT(l.radius, k_flat) << s.name;
  }
}

TEST(MinimalLozenge, OfThinBladesIsThin) {
  Random random(4);
  for (const double thin : {1e-3, 1e-6, 1e-9, 1e-12}) {
    const Points p = repeated(60, [&] { return in_box(random, {1, thin, 0.3}); });
    const Lozenge<double> l = minimal_lozenge(hull_of(p)).volume;
    for (const Double3& q : p) EXPECT_LE(distance_from_rectangle(l, q), l.radius);
    EXPECT_LT(l.radius, thin * (1 + 1e-3) + 1e-15);
  }
}

}  // namespace
}  // namespace copse
