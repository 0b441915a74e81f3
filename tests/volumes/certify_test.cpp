#include "lib/analysis/volumes/certify.h"

#include "tests/volumes/point_sets.h"

#include <CGAL/Exact_rational.h>
#include <gtest/gtest.h>

namespace copse {
namespace {

using Q = CGAL::Exact_rational;
using Points = std::vector<Double3>;

bool inside(const Volume<double>& v, const Double3& p) {
  return certify(v, std::span(&p, 1)).holds();
}

Q dot_of(const std::array<Q, 3>& a, const std::array<Q, 3>& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}
std::array<Q, 3> minus(const Double3& a, const Double3& b) {
  return {Q(a.x) - Q(b.x), Q(a.y) - Q(b.y), Q(a.z) - Q(b.z)};
}

TEST(Certify, TheSurfaceIsInsideAndOneUnitBeyondItIsNot) {
  const BoundingSphere<double> ball{{1, 0, 0}, 2};
  EXPECT_TRUE(inside(ball, {3, 0, 0}));
  EXPECT_FALSE(inside(ball, {std::nextafter(3.0, 4.0), 0, 0}));
  EXPECT_FALSE(inside(ball, {3, 1e-200, 0}));  // squares vanish in doubles, not here
  EXPECT_TRUE(inside(DoubleBox{{0, 0, 0}, {1, 1, 1}}, {1, 1, 0}));
  EXPECT_FALSE(inside(DoubleBox{{0, 0, 0}, {1, 1, 1}}, {1, 1, -1e-300}));
  const Capsule<double> capsule{{0, 0, 0}, {4, 0, 0}, 1};
  EXPECT_TRUE(inside(capsule, {2, 1, 0}));
  EXPECT_TRUE(inside(capsule, {-1, 0, 0}));
  EXPECT_FALSE(inside(capsule, {-1, 1e-160, 0}));
  EXPECT_TRUE(inside(capsule, {5, 0, 0}));
  EXPECT_FALSE(inside(capsule, {2, 1, 1e-170}));
  const Cylinder<double> cylinder{{0, 0, 0}, {4, 0, 0}, 1};
  EXPECT_TRUE(inside(cylinder, {4, 0, 1}));
  EXPECT_FALSE(inside(cylinder, {std::nextafter(4.0, 5.0), 0, 0}));
  EXPECT_FALSE(inside(cylinder, {-1e-300, 0, 0}));
  const Lozenge<double> lozenge{{0, 0, 0}, {4, 0, 0}, {0, 2, 0}, 1};
  EXPECT_TRUE(inside(lozenge, {2, 1, 1}));
  EXPECT_TRUE(inside(lozenge, {-1, 1, 0}));
  EXPECT_FALSE(inside(lozenge, {2, 1, std::nextafter(1.0, 2.0)}));
  EXPECT_FALSE(inside(lozenge, {4.8, 2.8, 0}));
  const OrientedBox<double> box{{0, 0, 0}, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {1, 2, 0}};
  EXPECT_TRUE(inside(box, {-1, 2, 0}));
  EXPECT_FALSE(inside(box, {0, 0, 1e-300}));
  const Ellipsoid<double> ellipsoid{{0, 0, 0}, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {2, 1, 0}};
  EXPECT_TRUE(inside(ellipsoid, {2, 0, 0}));
  EXPECT_FALSE(inside(ellipsoid, {2, 1e-160, 0}));
  EXPECT_FALSE(inside(ellipsoid, {0, 0, 1e-300}));
  const Kdop<double> kdop{{{1, 1, 0}, {0, 0, 2}, {1, -1, 0}}, {0, -1, -1}, {2, 1, 1}};
  EXPECT_TRUE(inside(kdop, {1, 1, 0.5}));
  EXPECT_FALSE(inside(kdop, {1, std::nextafter(1.0, 2.0), 0}));
}

TEST(Certify, AgreesWithRationalArithmeticOnPointsNextToTheSurface) {
  Random random(1);
  const auto number = [&] { return static_cast<double>(static_cast<float>(random.around(0, 3))); };
  const auto vector = [&] { return Double3{number(), number(), number()}; };
  std::size_t near = 0, outside = 0;
  for (int i = 0; i < 3000; ++i) {
    const Double3 a = vector(), b = vector(), p = vector();
    const double r = distance(a, p) * (i % 3 == 0 ? 1 : 1 + random.around(0, 3e-16));
    const Certificate c = certify(Volume<double>(BoundingSphere<double>{a, r}), std::span(&p, 1));
    const auto d = minus(p, a);
    ASSERT_EQ(c.holds(), dot_of(d, d) <= Q(r) * Q(r)) << i;
    near += c.near, outside += c.outside;

    // A cylinder whose radius is the distance of p from its axis, but for rounding.
    const Double3 axis = b - a;
    const double radius = length(cross(p - a, axis)) / length(axis) * (1 + random.around(0, 3e-16));
    const auto q = minus(p, a), e = minus(b, a);
    const std::array<Q, 3> x{q[1] * e[2] - q[2] * e[1], q[2] * e[0] - q[0] * e[2], q[0] * e[1] - q[1] * e[0]};
    const Q along = dot_of(q, e), ee = dot_of(e, e);
    const bool in = along >= 0 && along <= ee && dot_of(x, x) <= Q(radius) * Q(radius) * ee;
    ASSERT_EQ(inside(Cylinder<double>{a, b, radius}, p), in) << i;

    const bool in_capsule = [&] {
      const Q s = along <= 0 ? Q(0) : along >= ee ? Q(1) : Q(along / ee);
      const std::array<Q, 3> rest{q[0] - s * e[0], q[1] - s * e[1], q[2] - s * e[2]};
      return dot_of(rest, rest) <= Q(radius) * Q(radius);
    }();
    ASSERT_EQ(inside(Capsule<double>{a, b, radius}, p), in_capsule) << i;
  }
  EXPECT_GT(near, 300u);  // the test is no test unless doubles were not enough, and both answers came
  EXPECT_GT(outside, 300u);
  EXPECT_LT(outside, 2700u);
}

// A roof, a slope, a card: every point lies on two faces of its box.
TEST(Certify, PointsOnFacesOfFloat32NumbersNeedNoRationals) {
  Points roof;
  for (int i = 0; i < 30; ++i) {
    for (int j = 0; j < 30; ++j) roof.push_back({double(i), double(i) + j, double(j)});
  }
  const float s = std::sqrt(1.f / 3), t = std::sqrt(1.f / 2), u = std::sqrt(1.f / 6);
  OrientedBox<double> box{{14.5, 29, 14.5}, {{{s, -s, s}, {t, 0, -t}, {u, 2 * u, u}}}, {0, 60, 60}};
  const Certificate flat = certify(Volume<double>(box), roof);
  EXPECT_TRUE(flat.holds());
  EXPECT_GE(flat.near, roof.size() / 2);
  EXPECT_EQ(flat.exact, 0u);
  roof.push_back({3, 7 + 0x1p-50, 4});
  EXPECT_EQ(certify(Volume<double>(box), roof).outside, 1u);
}

TEST(Certify, NamesTheWorstPoint) {
  const Points points{{0, 0, 0}, {0, 1.5, 0}, {-3, 0, 0}, {0, 0, 3}, {1, 0, 0}};
  const Certificate c = certify(Volume<double>(BoundingSphere<double>{{0, 0, 0}, 1}), points);
  EXPECT_EQ(c.points, 5u);
  EXPECT_EQ(c.outside, 3u);
  EXPECT_EQ(c.worst, 2u);  // the first of two that are equally far
  EXPECT_DOUBLE_EQ(c.excess, 2);
}

TEST(Certify, WhatIsNoVolumeContainsNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Double3 p{0, 0, 0}, x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};
  EXPECT_FALSE(inside(BoundingSphere<double>{p, -1}, p));
  EXPECT_FALSE(inside(BoundingSphere<double>{p, nan}, p));
  EXPECT_FALSE(inside(DoubleBox{}, p));
  EXPECT_FALSE(inside(OrientedBox<double>{p, {x, y, z}, {1, -1, 1}}, p));
  for (const std::array<Double3, 3>& axes : {std::array{p, p, p},
                                             {x, x, x},
                                             {x, y, y},
                                             {x, y, z * 2},
                                             {x, y, z + y * 1e-5},
                                             {x, y, {0, 0, nan}}}) {
    EXPECT_FALSE(inside(OrientedBox<double>{p, axes, {1, 1, 1}}, p));
    EXPECT_FALSE(inside(Ellipsoid<double>{p, axes, {1, 1, 1}}, p));
  }
  EXPECT_TRUE(inside(OrientedBox<double>{p, {x, y, z + y * 1e-7}, {1, 1, 1}}, p));
  EXPECT_FALSE(inside(Capsule<double>{p, {nan, 0, 0}, 1}, p));
  EXPECT_FALSE(inside(Cylinder<double>{x, x, 5}, p));
  EXPECT_FALSE(inside(Kdop<double>{{x}, {-1, -1}, {1}}, p));
  EXPECT_FALSE(inside(Kdop<double>{{p}, {-1}, {1}}, p));
  EXPECT_FALSE(inside(Kdop<double>{}, p));
  // slabs that leave a direction open
  EXPECT_FALSE(inside(Kdop<double>{{x}, {-1}, {1}}, p));
  EXPECT_FALSE(inside(Kdop<double>{{x, x * 2, x * -3}, {-1, -1, -1}, {1, 1, 1}}, p));
  EXPECT_FALSE(inside(Kdop<double>{{x, y, x + y, x - y}, {-1, -1, -1, -1}, {1, 1, 1, 1}}, p));
  EXPECT_TRUE(inside(Kdop<double>{{x, x + y * 1e-3, z}, {-1, -1, -1}, {1, 1, 1}}, p));
  for (const double s : {1e-30, 1.0, 1e30, 1e300}) {
    EXPECT_FALSE(inside(Lozenge<double>{p, x * s, x * s, s}, p)) << s;
    EXPECT_FALSE(inside(Lozenge<double>{p, x * s, (x + y) * s, s}, p)) << s;
    EXPECT_FALSE(inside(Lozenge<double>{p, x * s, (x * 1e-5 + y) * s, s}, p)) << s;
    EXPECT_TRUE(inside(Lozenge<double>{p, x * s, (x * 1e-7 + y) * s, s}, p)) << s;
  }
}

TEST(Certify, SegmentsAndEdgesOfNoLengthArePoints) {
  const Double3 o{0, 0, 0};
  EXPECT_TRUE(inside(Capsule<double>{o, o, 1}, {0, 1, 0}));
  EXPECT_FALSE(inside(Capsule<double>{o, o, 1}, {0, 1, 1e-100}));
  EXPECT_TRUE(inside(Lozenge<double>{o, {2, 0, 0}, o, 1}, {1, 1, 0}));
  EXPECT_TRUE(inside(Lozenge<double>{o, o, o, 1}, {0, 0, -1}));
}

TEST(Certify, EveryScaleThatDoublesHoldIsDecided) {
  for (const double s : {1e-300, 1e-160, 1e-30, 1e30, 1e150, 1e300}) {
    const BoundingSphere<double> ball{{s, s, s}, s};
    EXPECT_TRUE(inside(ball, {2 * s, s, s})) << s;
    EXPECT_FALSE(inside(ball, {2.0001 * s, s, s})) << s;
    const Lozenge<double> lozenge{{0, 0, 0}, {4 * s, 0, 0}, {0, 2 * s, 0}, s};
    EXPECT_TRUE(inside(lozenge, {2 * s, s, s})) << s;
    EXPECT_FALSE(inside(lozenge, {2 * s, s, 1.0001 * s})) << s;
  }
}

TEST(Certify, Float32NumbersAreTakenAsTheyAre) {
  const Points p{{0.1f, 0, 0}};
  EXPECT_TRUE(certify(Volume<float>(BoundingSphere<float>{{0, 0, 0}, 0.1f}), p).holds());
  EXPECT_FALSE(
      certify(Volume<float>(BoundingSphere<float>{{0, 0, 0}, std::nextafter(0.1f, 0.0f)}), p).holds());
}

}  // namespace
}  // namespace copse
