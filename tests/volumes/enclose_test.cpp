#include "lib/analysis/volumes/enclose.h"

#include "lib/analysis/round/minimal_sphere.h"
#include "lib/analysis/volumes/certify.h"
#include "tests/volumes/point_sets.h"

#include <numbers>

#include <gtest/gtest.h>

namespace copse {
namespace {

using Points = std::vector<Double3>;

struct Frame {
  Double3 centre;
  std::array<Double3, 3> axes;
};

Frame frame_of(const Points& points, bool turned) {
  DoubleBox box;
  for (const Double3& p : points) box.grow(p);
  Frame f{box.min * 0.5 + box.max * 0.5, {Double3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  if (turned) {
    f.axes[0] = normalized(Double3{2, -1, 3}), f.axes[1] = normalized(cross(f.axes[0], {0, 1, 0}));
    f.axes[2] = cross(f.axes[0], f.axes[1]);
  }
  return f;
}

// Plain volumes of every type round the points, some of them too small by rounding or altogether: what they
// enclose is enclose's business.
std::vector<Volume<double>> fits(const Points& points, bool turned) {
  const Frame f = frame_of(points, turned);
  const Sphere ball = minimal_sphere(points);
  Double3 half;
  for (const Double3& p : points) {
    for (int i = 0; i < 3; ++i) half[i] = std::max(half[i], std::abs(dot(f.axes[i], p - f.centre)));
  }
  const Double3 end = f.axes[0] * half.x, edge = f.axes[1] * half.y;
  std::vector<Volume<double>> v;
  v.push_back(DoubleBox{});
  v.push_back(BoundingSphere<double>{ball.centre, ball.radius});
  v.push_back(OrientedBox<double>{f.centre, f.axes, half});
  v.push_back(Capsule<double>{f.centre - end, f.centre + end, half.y});
  v.push_back(Cylinder<double>{f.centre - end, f.centre + end, half.y});
  v.push_back(Lozenge<double>{f.centre - end - edge, end * 2, edge * 2, half.z});
  v.push_back(Ellipsoid<double>{f.centre, f.axes, half * std::sqrt(3.0)});
  v.push_back(Kdop<double>{{f.axes[0], f.axes[1], f.axes[2], {1, 1, 1}, {-1, 1, 0}}, {}, {}});
  return v;
}

double reach_of(const Points& points) {
  DoubleBox box;
  for (const Double3& p : points) box.grow(p);
  return std::max(length(box.min), length(box.max)) + length(box.max * 0.5 - box.min * 0.5) * 2;
}

// A double volume that holds the points up to double rounding: what an outward rounding must come near to.
double needed(const Volume<double>& fit, const Volume<float>& stored, const Points& points) {
  // grown by what is sought, every point must be inside the *fit's* sizes taken from the points themselves
  (void)fit;
  const Volume<double> wide = to_double(stored);
  if (const auto* s = std::get_if<BoundingSphere<double>>(&wide)) {
    double r = 0;
    for (const Double3& p : points) r = std::max(r, distance(p, s->centre));
    return s->radius - r;
  }
  if (const auto* b = std::get_if<OrientedBox<double>>(&wide)) {
    double worst = 0;
    for (int i = 0; i < 3; ++i) {
      double h = 0;
      for (const Double3& p : points) h = std::max(h, std::abs(dot(b->axes[i], p - b->centre)));
      worst = std::max(worst, b->half_extents[i] - h);
    }
    return worst;
  }
  if (const auto* c = std::get_if<Capsule<double>>(&wide)) {
    double r = 0;
    const Double3 d = c->b - c->a;
    const double l = length(d);
    for (const Double3& p : points) {
      const Double3 q = p - c->a;
      const double t = l > 0 ? std::clamp(dot(q / l, d / l), 0.0, 1.0) : 0;
      r = std::max(r, length(q - d * t));
    }
    return c->radius - r;
  }
  return 0;
}

TEST(Enclose, EveryVolumeOfTheBatteryIsCertifiedAsStored) {
  for (const NamedPoints& set : float32_battery()) {
    for (const bool turned : {false, true}) {
      for (const Volume<double>& fit : fits(set.points, turned)) {
        const auto e = enclose(fit, set.points);
        ASSERT_TRUE(e) << set.name << " type " << fit.index();
        EXPECT_TRUE(e->certified) << set.name << " type " << fit.index();
        EXPECT_TRUE(certify(e->volume, set.points).holds()) << set.name << " type " << fit.index();
        EXPECT_EQ(e->volume.index(), fit.index());
      }
    }
  }
}

TEST(Enclose, InflatesByAFewUnitsInTheLastPlaceOfTheSize) {
  for (const NamedPoints& set : float32_battery()) {
    for (const bool turned : {false, true}) {
      for (const Volume<double>& fit : fits(set.points, turned)) {
        const auto e = enclose(fit, set.points);
        ASSERT_TRUE(e);
        EXPECT_LE(needed(fit, e->volume, set.points), 4 * 0x1p-23 * reach_of(set.points) + 1.5e-45)
            << set.name << " type " << fit.index();
      }
    }
  }
}

TEST(Enclose, FlatSetsInFloat32KeepVolumesOfNoThickness) {
  const Points grid = copse::grid(10, 7, {1, 0, 0}, {0, 1, 0});
  for (const Volume<double>& fit : fits(grid, false)) {
    const Volume<float> v = enclose(fit, grid)->volume;
    if (const auto* box = std::get_if<OrientedBox<float>>(&v)) {
      EXPECT_EQ(box->half_extents, (Float3{4.5f, 3, 0}));
    }
    if (const auto* l = std::get_if<Lozenge<float>>(&v)) {
      EXPECT_EQ(l->radius, 0);
    }
    if (const auto* e = std::get_if<Ellipsoid<float>>(&v)) {
      EXPECT_EQ(e->semi_axes.z, 0);
    }
  }
  const Points one{{1, 2, 3}};
  const Volume<float> ball = enclose(BoundingSphere<double>{{1, 2, 3}, 0}, one)->volume;
  EXPECT_EQ(std::get<BoundingSphere<float>>(ball).radius, 0);
}

TEST(Enclose, ACylinderOfNoLengthGetsTheThinnestHeightThatIsCertified) {
  const Points circle = copse::circle(64);
  const auto flat = enclose(Cylinder<double>{{0, 0, 0}, {0, 0, 0}, 1}, line(2, {0, 1, 0}));
  ASSERT_TRUE(flat);
  const auto thin = enclose(Cylinder<double>{{0, 0, 0}, {0, 0, 1e-9}, 1}, circle);
  const auto& c = std::get<Cylinder<float>>(thin->volume);
  EXPECT_NE(c.a, c.b);
  EXPECT_LE(std::abs(c.b.z - c.a.z), 1e-6f);
  EXPECT_LE(c.radius, 1.000001f);
  const Points tilted = turned(circle);
  const Double3 axis = cross(tilted[16], tilted[0]);
  const auto across = enclose(Cylinder<double>{{0, 0, 0}, axis * 1e-9, 1}, tilted);
  const auto& t = std::get<Cylinder<float>>(across->volume);
  EXPECT_LE(length(to_double(t.b) - to_double(t.a)), 3e-3);
  EXPECT_LE(t.radius, 1.00001f);
}

// A unit of the length is a hundredth of the radius: none of it may get into the radius.
TEST(Enclose, ACylinderRoundANeedleIsWithinAFewUnitsOfTheLeastRadiusThatIsCertified) {
  for (const double thin : {1e-2, 1e-4, 1e-6}) {
    Points needle;
    for (int i = 0; i < 12 * 21; ++i) {
      const double a = i % 12 * std::numbers::pi / 6;
      needle.push_back({thin * std::cos(a), thin * std::sin(a), 5.0 * (i / 12) / 20});
    }
    for (const Points& points : {needle, turned(needle), scaled(turned(needle), 1, {0.3, -0.2, 0.1})}) {
      const Double3 a = (points[0] + points[6]) * 0.5, b = (points[240] + points[246]) * 0.5;
      const auto e = enclose(Cylinder<double>{a, b, thin}, points);
      ASSERT_TRUE(e);
      Cylinder<float> c = std::get<Cylinder<float>>(e->volume);
      EXPECT_TRUE(certify(c, points).holds()) << thin;
      for (int unit = 0; unit < 3; ++unit) c.radius = std::nextafter(c.radius, 0.0f);
      EXPECT_FALSE(certify(c, points).holds()) << thin << ": " << c.radius;
    }
  }
}

TEST(Enclose, ABallTooSmallForItsPointsIsMadeLargeEnough) {
  const Points cube = cube_corners();
  const auto e = enclose(BoundingSphere<double>{{0.5, 0.5, 0.5}, 0.1}, cube);
  EXPECT_NEAR(std::get<BoundingSphere<float>>(e->volume).radius, std::sqrt(0.75), 1e-7);
}

TEST(Enclose, WhatFloat32CannotHoldIsToldInsteadOfBeingWrong) {
  const Points huge = scaled(cube_corners(), 1e200);
  for (const Volume<double>& fit : fits(huge, false)) EXPECT_FALSE(enclose(fit, huge)) << fit.index();
  const Points edge = scaled(cube_corners(), 3.4e38);  // the ball's radius fits, barely
  EXPECT_TRUE(enclose(BoundingSphere<double>{{1.7e38, 1.7e38, 1.7e38}, 2.95e38}, edge));
}

TEST(Enclose, AMillionthOfAPointBeyondIsSeen) {
  Points sphere = even_sphere(1000);
  const auto before = enclose(BoundingSphere<double>{{0, 0, 0}, 1}, sphere);
  sphere.push_back({0, 0, 1.000001});
  const auto after = enclose(BoundingSphere<double>{{0, 0, 0}, 1}, sphere);
  EXPECT_FALSE(certify(before->volume, sphere).holds());
  EXPECT_TRUE(certify(after->volume, sphere).holds());
}

}  // namespace
}  // namespace copse
