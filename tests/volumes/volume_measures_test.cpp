#include "lib/analysis/volumes/volume_measures.h"

#include "lib/analysis/boxes/kdop.h"
#include "tests/volumes/point_sets.h"

#include <numbers>

#include <gtest/gtest.h>

namespace copse {
namespace {

constexpr double k_pi = std::numbers::pi;

void expect_measures(const VolumeMeasures& m, double volume, double surface, double mean_width,
                     double tolerance) {
  EXPECT_NEAR(m.volume, volume, tolerance * volume);
  EXPECT_NEAR(m.surface, surface, tolerance * surface);
  EXPECT_NEAR(m.mean_width, mean_width, tolerance * mean_width);
}

TEST(VolumeMeasures, OfTheBallAreTheSameInEveryTypeThatCanBeOne) {
  const double v = 4 * k_pi / 3 * 8, s = 16 * k_pi, w = 4;
  expect_measures(measures_of(BoundingSphere<double>{{1, 2, 3}, 2}), v, s, w, 1e-15);
  expect_measures(measures_of(Capsule<double>{{1, 2, 3}, {1, 2, 3}, 2}), v, s, w, 1e-15);
  expect_measures(measures_of(Lozenge<double>{{1, 2, 3}, {}, {}, 2}), v, s, w, 1e-15);
  expect_measures(measures_of(Ellipsoid<double>{{}, {}, {2, 2, 2}}), v, s, w, 1e-14);
}

TEST(VolumeMeasures, OfTheCubeAreTheSameInEveryTypeThatCanBeOne) {
  const Kdop<double> kdop{{{2, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}, {1, 1, 1}},
                          {20, 20, 30, -1e3, -1e3},
                          {26, 23, 33, 1e3, 1e3}};
  expect_measures(measures_of(Box<double>{{10, 20, 30}, {13, 23, 33}}), 27, 54, 4.5, 1e-15);
  expect_measures(measures_of(OrientedBox<double>{{}, {}, {1.5, 1.5, 1.5}}), 27, 54, 4.5, 1e-15);
  expect_measures(measures_of(kdop), 27, 54, 4.5, 1e-8);
}

TEST(VolumeMeasures, OfCapsuleCylinderAndLozengeAreThoseOfTheirParts) {
  const double r = 2, h = 3;
  expect_measures(measures_of(Capsule<double>{{0, 0, 0}, {0, h, 0}, r}),
                  k_pi * r * r * h + 4 * k_pi / 3 * r * r * r, 2 * k_pi * r * h + 4 * k_pi * r * r,
                  h / 2 + 2 * r, 1e-15);
  expect_measures(measures_of(Cylinder<double>{{0, 0, 0}, {0, h, 0}, r}), k_pi * r * r * h,
                  2 * k_pi * r * h + 2 * k_pi * r * r, h / 2 + k_pi * r / 2, 1e-15);
  expect_measures(measures_of(Lozenge<double>{{}, {5, 0, 0}, {0, 7, 0}, 1}), 70 + 12 * k_pi + 4 * k_pi / 3,
                  70 + 24 * k_pi + 4 * k_pi, 8, 1e-15);
}

TEST(VolumeMeasures, OfEllipsoidsAgreeWithSpheroidsAndWithSampling) {
  // Prolate and oblate spheroids have elementary surfaces.
  const double a = 3, c = 5, e = std::sqrt(1 - a * a / c / c);
  expect_measures(measures_of(Ellipsoid<double>{{}, {}, {a, c, a}}), 4 * k_pi / 3 * a * a * c,
                  2 * k_pi * a * a * (1 + c / a / e * std::asin(e)), a * a / c / e * std::atanh(e) + c,
                  1e-13);
  const double f = std::sqrt(1 - 4. / 9);
  EXPECT_NEAR(measures_of(Ellipsoid<double>{{}, {}, {3, 3, 2}}).surface,
              2 * k_pi * 9 * (1 + (1 - f * f) / f * std::atanh(f)), 1e-12);
  const VolumeMeasures m = measures_of(Ellipsoid<double>{{}, {}, {1, 2, 7}});
  double width = 0;
  const int n = 200;
  for (int i = 0; i < n; ++i) {  // midpoint rule over heights and angles, equal areas
    for (int k = 0; k < n; ++k) {
      const double z = -1 + (2 * i + 1.) / n, t = 2 * k_pi * (k + 0.5) / n, r = std::sqrt(1 - z * z);
      width += 2 * length({r * std::cos(t), 2 * r * std::sin(t), 7 * z}) / n / n;
    }
  }
  EXPECT_NEAR(m.mean_width, width, 1e-3);
  for (const double thin : {1e-3, 1e-8, 0.0}) {  // towards the disc
    const VolumeMeasures disc = measures_of(Ellipsoid<double>{{}, {}, {1, thin, 1}});
    EXPECT_NEAR(disc.surface, 2 * k_pi, 30 * thin);
    EXPECT_NEAR(disc.mean_width, k_pi / 2, 30 * thin);
  }
  EXPECT_EQ(measures_of(Ellipsoid<double>{}).mean_width, 0);
  EXPECT_EQ(measures_of(Ellipsoid<double>{{}, {}, {0, 3, 0}}).mean_width, 3);
}

TEST(VolumeMeasures, OfKdopsAreThoseOfTheirPolyhedra) {
  Kdop<double> octahedron;  // |x| + |y| + |z| <= 1, off the origin
  const Double3 at{100, 50, -20};
  for (int i = 0; i < 4; ++i) {
    const Double3 n{1, i & 1 ? 1. : -1., i & 2 ? 1. : -1.};
    octahedron.normals.push_back(n);
    octahedron.min.push_back(dot(n, at) - 1), octahedron.max.push_back(dot(n, at) + 1);
  }
  expect_measures(measures_of(octahedron), 4. / 3, 4 * std::sqrt(3),
                  12 * std::sqrt(2) * (k_pi - std::acos(-1. / 3)) / (4 * k_pi), 1e-10);
  Kdop<double> open{{{1, 0, 0}, {0, 1, 0}}, {0, 0}, {1, 1}};
  EXPECT_EQ(measures_of(open).volume, std::numeric_limits<double>::infinity());
  const Kdop<double> flat{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 5}, {2, 3, 5}};
  EXPECT_NEAR(measures_of(flat).volume, 0, 1e-12);
  EXPECT_NEAR(measures_of(flat).surface, 12, 1e-12);
  EXPECT_NEAR(measures_of(flat).mean_width, 2.5, 1e-10);
}

TEST(VolumeMeasures, OfKdopsOfBoxesAndPlatesAreThoseOfTheBox) {
  // Their other planes touch edges and corners only.
  for (const Double3& e : {Double3{1, 1, 1}, Double3{1, 2, 3}, Double3{1, 1e-3, 2}, Double3{1, 1e-7, 1e-7},
                           Double3{1, 0.75, 1e-14}, Double3{1, 0.7, 0}, Double3{0, 1, 0}, Double3{}}) {
    const Double3 at{0.1, -0.3, 0.7};
    for (const int k : {6, 14, 18, 26}) {
      std::vector<Double3> corners;
      for (int c = 0; c < 8; ++c) corners.push_back({c & 1 ? e.x : 0, c & 2 ? e.y : 0, c & 4 ? e.z : 0});
      const VolumeMeasures m = measures_of(fit_kdop(corners, kdop_normals(k)));
      const double volume = e.x * e.y * e.z, surface = 2 * (e.x * e.y + e.y * e.z + e.z * e.x);
      EXPECT_LE(m.volume, volume * (1 + 1e-12));
      expect_measures(m, volume, surface, (e.x + e.y + e.z) / 2, 1e-2);
      if (e.z > 1e-10) expect_measures(m, volume, surface, (e.x + e.y + e.z) / 2, 1e-9);
      for (Double3& c : corners) c += at;
      const VolumeMeasures there = measures_of(fit_kdop(corners, kdop_normals(k)));
      EXPECT_NEAR(there.volume, volume, 1e-14);
      EXPECT_NEAR(there.surface, surface, 1e-12);
      EXPECT_NEAR(there.mean_width, (e.x + e.y + e.z) / 2, 1e-9);
    }
  }
}

}  // namespace
}  // namespace copse
