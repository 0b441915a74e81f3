#include "lib/analysis/round/minimal_sphere.h"

#include "lib/formats/random.h"
#include "lib/formats/volumes/sphere_contains.h"

#include <chrono>
#include <cstdio>
#include <numbers>
#include <vector>

#include <CGAL/Exact_rational.h>
#include <CGAL/Min_sphere_of_points_d_traits_3.h>
#include <CGAL/Min_sphere_of_spheres_d.h>
#include <CGAL/Min_sphere_of_spheres_d_traits_3.h>
#include <CGAL/Simple_cartesian.h>
#include <gtest/gtest.h>

namespace copse {
namespace {

using Points = std::vector<Double3>;

// The squared radius of the smallest ball in exact rational arithmetic.
template <class Number>
double cgal_squared_radius(const Points& points) {
  using Kernel = CGAL::Simple_cartesian<Number>;
  using Traits = CGAL::Min_sphere_of_points_d_traits_3<Kernel, Number>;
  std::vector<typename Kernel::Point_3> copies;
  for (const Double3& p : points) copies.emplace_back(p.x, p.y, p.z);
  CGAL::Min_sphere_of_spheres_d<Traits> ball(copies.begin(), copies.end());
  const auto radius = ball.radius();
  if constexpr (std::is_same_v<Number, double>) {
    return radius * radius;
  } else {
    // a + b sqrt(c): the radius of an exact ball is such a number
    const double a = CGAL::to_double(radius.first), b = CGAL::to_double(radius.second);
    const double r = a + b * std::sqrt(CGAL::to_double(ball.discriminant()));
    return r * r;
  }
}

// |p - c| <= r in exact rational arithmetic: shares nothing with the fitter.
bool exactly_inside(const StoredSphere& s, const Double3& p) {
  using Q = CGAL::Exact_rational;
  const Q x = Q(p.x) - Q(s.centre.x), y = Q(p.y) - Q(s.centre.y), z = Q(p.z) - Q(s.centre.z);
  return x * x + y * y + z * z <= Q(s.radius) * Q(s.radius);
}

void expect_minimal(const Points& points, const char* what) {
  const double exact = std::sqrt(cgal_squared_radius<CGAL::Exact_rational>(points));
  const Sphere sphere = minimal_sphere(points);
  EXPECT_NEAR(sphere.radius, exact, 1e-12 * exact) << what;
  for (const Double3& p : points) EXPECT_LE(distance(p, sphere.centre), sphere.radius * (1 + 1e-15)) << what;
  const StoredSphere stored = stored_minimal_sphere(points);
  for (const Double3& p : points) {
    EXPECT_TRUE(exactly_inside(stored, p)) << what;
    EXPECT_TRUE(encloses(stored, p)) << what;
  }
  EXPECT_LE(stored.radius, exact * (1 + 1e-6) + 2e-7 * length(sphere.centre)) << what;
}

Double3 on_sphere(Random& random) {
  const double z = random.around(0, 1), a = random.uniform(0, 2 * std::numbers::pi);
  const double r = std::sqrt(std::max(0.0, 1 - z * z));
  return {r * std::cos(a), r * std::sin(a), z};
}
Double3 in_box(Random& random, const Double3& half) {
  return {random.around(0, half.x), random.around(0, half.y), random.around(0, half.z)};
}
template <class Make>
Points repeat(std::size_t n, Make&& make) {
  Points points;
  for (std::size_t i = 0; i < n; ++i) points.push_back(make());
  return points;
}

TEST(MinimalSphere, OfNothingIsAPointAtTheOrigin) {
  EXPECT_EQ(minimal_sphere(Points{}).radius, 0);
  EXPECT_EQ(stored_minimal_sphere(Points{}).radius, 0);
}

TEST(MinimalSphere, OfOnePointOrItsCopiesHasNoRadius) {
  const Points points(7, Double3{3, -4, 5});
  EXPECT_EQ(minimal_sphere(points).radius, 0);
  EXPECT_EQ(minimal_sphere(points).centre, (Double3{3, -4, 5}));
  EXPECT_EQ(stored_minimal_sphere(points).radius, 0);
}

TEST(MinimalSphere, RoundingToFloatIsNotOptimizedAway) {
  const Double3 p{0.1, 0.2, 0.3}, rounded = rounded_to_float(p);
  EXPECT_EQ(rounded, (Double3{0x1.99999ap-4, 0x1.99999ap-3, 0x1.333334p-2}));
}

TEST(MinimalSphere, OfKnownBodiesIsTheKnownOne) {
  const Points cube{{1, 1, 1},  {1, 1, -1},  {1, -1, 1},  {1, -1, -1},
                    {-1, 1, 1}, {-1, 1, -1}, {-1, -1, 1}, {-1, -1, -1}};
  EXPECT_DOUBLE_EQ(minimal_sphere(cube).radius, std::sqrt(3.0));
  EXPECT_LT(length(minimal_sphere(cube).centre), 1e-15);
  const Points segment{{0, 0, 0}, {2, 0, 0}, {0.3, 0.1, 0}};
  EXPECT_DOUBLE_EQ(minimal_sphere(segment).radius, 1);
  const Points triangle{{0, 0, 0}, {1, 0, 0}, {0.5, std::sqrt(0.75), 0}};
  EXPECT_NEAR(minimal_sphere(triangle).radius, 1 / std::sqrt(3.0), 1e-15);
}

TEST(MinimalSphere, AgreesWithExactArithmeticOnEveryKindOfSet) {
  Random random(1);
  for (int round = 0; round < 12; ++round) {
    expect_minimal(repeat(1 + random.below(40), [&] { return in_box(random, {1, 1, 1}); }), "box");
    expect_minimal(repeat(60, [&] { return on_sphere(random); }), "cospherical");
    expect_minimal(repeat(30, [&] { return in_box(random, {1, 1e-6, 1e-7}); }), "needle");
    expect_minimal(repeat(30, [&] { return in_box(random, {1, 1, 1e-7}); }), "plate");
    expect_minimal(repeat(20, [&] { return Double3{1, 2, 3} * random.around(0, 1); }), "collinear");
    expect_minimal(
        repeat(40,
               [&] {
                 return Double3{double(random.below(3)), double(random.below(3)), double(random.below(3))};
               }),
        "grid");
    expect_minimal(repeat(20,
                          [&] {
                            const double a = random.uniform(0, 7);
                            return Double3{std::cos(a), std::sin(a), 0};
                          }),
                   "circle");
    expect_minimal(repeat(20, [&] { return in_box(random, {1, 1, 1}) + Double3{100, -30, 7}; }), "offset");
  }
}

TEST(MinimalSphere, ALateralPointThatBarelySticksOutMovesTheCentre) {
  // The optimum grows by a mere e^2 / 2 although the point is outside by e: growth alone cannot steer.
  for (const double e : {1e-5, 1e-7, 1e-9, 1e-11}) {
    expect_minimal({{-1, 0, 0}, {1, 0, 0}, {0, 1 + e, 0}}, "lateral");
    expect_minimal({{-1, 0, 0}, {1, 0, 0}, {0, 1 + e, 0}, {0, -0.2, 1 + e / 2}}, "two lateral");
  }
}

TEST(MinimalSphere, KeepsItsPrecisionAtAnyScale) {
  Random random(2);
  const Points unit = repeat(50, [&] { return in_box(random, {1, 1, 1}); });
  const double radius = minimal_sphere(unit).radius;
  for (const double scale : {1e-300, 1e-160, 1e-30, 1e30, 1e160, 1e300}) {
    Points scaled = unit;
    for (Double3& p : scaled) p *= scale;
    EXPECT_NEAR(minimal_sphere(scaled).radius / scale, radius, 1e-12 * radius) << scale;
  }
  for (const double scale : {1e-42, 1e-30, 1e-20, 1e20, 1e30}) {
    Points scaled = unit;
    for (Double3& p : scaled) p *= scale;
    const StoredSphere stored = stored_minimal_sphere(scaled);
    for (const Double3& p : scaled) EXPECT_TRUE(exactly_inside(stored, p)) << scale;
    if (scale > 1e-35) {
      EXPECT_NEAR(stored.radius, radius * scale, 1e-6 * radius * scale) << scale;
    }
  }
}

TEST(MinimalSphere, EnclosesWhereItIsStoredFarFromTheOrigin) {
  Random random(3);
  const Points points = repeat(50, [&] { return in_box(random, {1, 1, 1}) + Double3{1e7, 0, -1e7}; });
  const StoredSphere stored = stored_minimal_sphere(points);
  for (const Double3& p : points) EXPECT_TRUE(exactly_inside(stored, p));
  EXPECT_LT(stored.radius, 4);  // a float32 there is 1 wide
}

TEST(MinimalSphere, ASphereThatIsTooSmallByOneStepDoesNotEnclose) {
  const StoredSphere tight = stored_minimal_sphere(Points{{-1, 0.1, 0}, {1, 0, 0}, {0, 0.9, 0.3}});
  StoredSphere small = tight;
  small.radius = std::nextafter(small.radius, 0.0f);
  small.radius = std::nextafter(small.radius, 0.0f);
  EXPECT_TRUE(encloses(tight, {-1, 0.1, 0}));
  EXPECT_FALSE(encloses(small, {-1, 0.1, 0}) && encloses(small, {1, 0, 0}) && encloses(small, {0, 0.9, 0.3}));
}

TEST(MinimalSphere, OfBallsAgreesWithExactArithmeticToo) {
  using Q = CGAL::Exact_rational;
  using Traits = CGAL::Min_sphere_of_spheres_d_traits_3<CGAL::Simple_cartesian<Q>, Q>;
  Random random(5);
  for (int round = 0; round < 60; ++round) {
    std::vector<Sphere> balls;
    std::vector<std::pair<CGAL::Simple_cartesian<Q>::Point_3, Q>> exact_balls;
    const double spread = round % 3 == 0 ? 0.3 : 1;  // in every third round some balls swallow others
    for (std::uint64_t i = 0, n = 1 + random.below(12); i < n; ++i) {
      balls.push_back(
          {in_box(random, {spread, spread, round % 4 == 1 ? 0 : spread}), random.uniform(0, 0.5)});
      const Double3& c = balls.back().centre;
      exact_balls.emplace_back(CGAL::Simple_cartesian<Q>::Point_3(c.x, c.y, c.z), Q(balls.back().radius));
    }
    CGAL::Min_sphere_of_spheres_d<Traits> theirs(exact_balls.begin(), exact_balls.end());
    const double exact =
        CGAL::to_double(theirs.radius().first) +
        CGAL::to_double(theirs.radius().second) * std::sqrt(CGAL::to_double(theirs.discriminant()));
    const Sphere ours = minimal_sphere(balls);
    EXPECT_NEAR(ours.radius, exact, 1e-12 * exact) << round;
    std::vector<StoredSphere> stored;
    for (const Sphere& b : balls) stored.push_back({to_float(b.centre), static_cast<float>(b.radius)});
    const StoredSphere around = stored_minimal_sphere(stored);
    for (const StoredSphere& s : stored) {
      EXPECT_TRUE(sphere_contains(around.centre, around.radius, s.centre, s.radius)) << round;
    }
    EXPECT_LE(around.radius, exact * (1 + 1e-6));
  }
}

TEST(MinimalSphere, TakesAboutAsManyPassesOnAMillionPointsAsOnAThousand) {
  Random random(4);
  for (const bool cospherical : {false, true}) {
    const Points points = repeat(cospherical ? 100000 : 1000000, [&] {
      return cospherical ? on_sphere(random) : in_box(random, {1, 1, 1});
    });
    const auto start = std::chrono::steady_clock::now();
    const Sphere ours = minimal_sphere(points);
    const auto middle = std::chrono::steady_clock::now();
    const double theirs = std::sqrt(cgal_squared_radius<double>(points));
    const auto end = std::chrono::steady_clock::now();
    const auto ns = [&](auto a, auto b) {
      return std::chrono::duration<double, std::nano>(b - a).count() / double(points.size());
    };
    std::printf("  minimal_sphere %.1f ns/point, CGAL %.1f ns/point (%zu points%s)\n", ns(start, middle),
                ns(middle, end), points.size(), cospherical ? ", cospherical" : "");
    EXPECT_NEAR(ours.radius, theirs, 1e-9 * theirs);
    EXPECT_LT(ns(start, middle), 3000);  // some ten passes; hundreds would show
  }
}

}  // namespace
}  // namespace copse
