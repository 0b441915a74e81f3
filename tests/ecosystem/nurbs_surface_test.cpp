#include "lib/analysis/ecosystem/nurbs_surface.h"

#include "lib/formats/random.h"

#include <cmath>

#include <gtest/gtest.h>

namespace copse {
namespace {

// A quarter of a sphere's octant grid: a quarter circle (weights 1, 1/sqrt 2, 1) turned about +Y by another.
NurbsSurface octant(double radius) {
  NurbsSurface s;
  s.degree_u = s.degree_v = 2;
  s.count_u = s.count_v = 3;
  s.knots_u = s.knots_v = {0, 0, 0, 1, 1, 1};
  const double w = std::sqrt(0.5);
  const Double3 profile[3] = {{1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const Double3 turn[3] = {{1, 0, 0}, {1, 0, 1}, {0, 0, 1}};
  const double weight[3] = {1, w, 1};
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) {
      s.points.push_back(Double3{profile[i].x * turn[j].x, profile[i].y, profile[i].x * turn[j].z} * radius);
      s.weights.push_back(weight[i] * weight[j]);
    }
  return s;
}

NurbsSurface flat(std::size_t count, int degree) {
  NurbsSurface s;
  s.degree_u = s.degree_v = degree;
  s.count_u = s.count_v = count;
  s.knots_u = s.knots_v = clamped_knots(count, degree);
  const auto g = greville(s.knots_u, degree);
  for (std::size_t j = 0; j < count; ++j)
    for (std::size_t i = 0; i < count; ++i) s.points.push_back({g[i] * 10, 3, g[j] * 20});
  return s;
}

TEST(NurbsSurface, ASphereIsExact) {
  const NurbsSurface s = octant(7);
  ASSERT_EQ(fault_of(s), "");
  for (double u = 0; u <= 1; u += 0.0625)
    for (double v = 0; v <= 1; v += 0.0625) EXPECT_NEAR(length(evaluate(s, u, v)), 7, 1e-14);
}

TEST(NurbsSurface, ACircleWithKnotsOfFullMultiplicityIsExactInEveryPiece) {
  NurbsSurface s;  // a half circle of two quarters, swept along z
  s.degree_u = 2, s.degree_v = 1, s.count_u = 5, s.count_v = 2;
  s.knots_u = {0, 0, 0, 1, 1, 2, 2, 2};
  s.knots_v = {0, 0, 1, 1};
  const double w = std::sqrt(0.5);
  for (const double z : {0.0, 5.0}) {
    for (const Double3& p : {Double3{1, 0, z}, {1, 1, z}, {0, 1, z}, {-1, 1, z}, {-1, 0, z}})
      s.points.push_back(p);
    for (const double weight : {1.0, w, 1.0, w, 1.0}) s.weights.push_back(weight);
  }
  ASSERT_EQ(fault_of(s), "");
  for (double u = 0; u <= 2; u += 0.01) {
    const Double3 p = evaluate(s, u, 0.3);
    EXPECT_NEAR(p.x * p.x + p.y * p.y, 1, 1e-14);
    EXPECT_NEAR(p.z, 1.5, 1e-14);
  }
}

TEST(NurbsSurface, GrevillePointsMakeCoordinatesLinear) {
  for (const int degree : {1, 2, 3, 5}) {
    const NurbsSurface s = flat(7, degree);
    ASSERT_EQ(fault_of(s), "");
    for (double u = 0; u <= 1; u += 0.05) {
      const Double3 p = evaluate(s, u, 1 - u);
      EXPECT_NEAR(p.x, 10 * u, 1e-13);
      EXPECT_NEAR(p.y, 3, 1e-14);
      EXPECT_NEAR(p.z, 20 * (1 - u), 1e-13);
    }
  }
}

TEST(NurbsSurface, TheEndsOfTheDomainAreItsOuterPoints) {
  Random random(5);
  NurbsSurface s = flat(6, 3);
  for (Double3& p : s.points) p.y = random.uniform(-5, 5);
  EXPECT_EQ(evaluate(s, 0, 0), s.points.front());
  EXPECT_EQ(evaluate(s, 1, 1), s.points.back());
  EXPECT_EQ(evaluate(s, 2, 2), s.points.back());  // clamped
}

// De Boor's corner cutting, another algorithm, as the judge.
double de_boor(std::vector<double> d, const std::vector<double>& knots, int degree, double t) {
  const auto p = static_cast<std::size_t>(degree);
  std::size_t k = p;
  while (k + 1 < d.size() && t >= knots[k + 1]) ++k;
  std::vector<double> c(d.begin() + static_cast<std::ptrdiff_t>(k - p),
                        d.begin() + static_cast<std::ptrdiff_t>(k + 1));
  for (std::size_t r = 1; r <= p; ++r)
    for (std::size_t j = p; j >= r; --j) {
      const double a = knots[j + k - p], b = knots[j + 1 + k - r];
      c[j] = c[j - 1] + (t - a) / (b - a) * (c[j] - c[j - 1]);
    }
  return c[p];
}

TEST(NurbsSurface, AgreesWithDeBoorsAlgorithm) {
  Random random(9);
  NurbsSurface s = flat(9, 4);
  s.knots_u = {0, 0, 0, 0, 0, 0.2, 0.2, 0.5, 0.9, 1, 1, 1, 1, 1};
  std::vector<double> heights(9);
  for (std::size_t i = 0; i < 9; ++i) {
    heights[i] = random.uniform(-3, 3);
    for (std::size_t j = 0; j < 9; ++j) s.points[j * 9 + i].y = heights[i];
  }
  ASSERT_EQ(fault_of(s), "");
  for (double u = 0; u < 1; u += 0.013)
    EXPECT_NEAR(evaluate(s, u, 0.4).y, de_boor(heights, s.knots_u, 4, u), 1e-13) << u;
}

TEST(NurbsSurface, SamplesAreTheSurfaceAtEqualSteps) {
  const NurbsSurface s = octant(2);
  const auto grid = sample(s, 5, 3);
  ASSERT_EQ(grid.size(), 15u);
  EXPECT_EQ(grid[0 * 5 + 3], evaluate(s, 0.75, 0));
  EXPECT_EQ(grid[2 * 5 + 1], evaluate(s, 0.25, 1));
}

TEST(NurbsSurface, FaultsAreNamed) {
  const auto with = [](auto change) {
    NurbsSurface s = octant(1);
    change(s);
    return fault_of(s);
  };
  EXPECT_EQ(with([](auto& s) { s.weights[4] = 0; }), "weight 4 is 0, not above 0");
  EXPECT_EQ(with([](auto& s) { s.knots_u[2] = -1; }), "knots_u[2] is below the knot before it");
  EXPECT_NE(with([](auto& s) { s.knots_v.pop_back(); }).find("has 5 knots"), std::string::npos);
  EXPECT_NE(with([](auto& s) { s.knots_v = {1, 1, 1, 1, 1, 1}; }).find("repeated"), std::string::npos);
  EXPECT_NE(with([](auto& s) { s.degree_u = 5; }).find("too few"), std::string::npos);
  EXPECT_NE(with([](auto& s) { s.degree_u = 0; }).find("degree 0"), std::string::npos);
  EXPECT_NE(with([](auto& s) { s.points[0].x = NAN; }).find("control point 0"), std::string::npos);
  EXPECT_NE(with([](auto& s) { s.points.pop_back(); }).find("8 control points, expected 9"),
            std::string::npos);
}

}  // namespace
}  // namespace copse
