#include "lib/analysis/measure/cylinder_error.h"

#include <numbers>

#include <gtest/gtest.h>

namespace copse {
namespace {

// A prism of k sides and two rings, radius 1, height 2; vertex i of the upper ring pushed out by `bulge`.
struct Prism {
  TrunkMesh mesh;
  Hierarchy hierarchy;
};

Prism prism(int k, double bulge = 0) {
  Prism p;
  for (int ring = 0; ring < 2; ++ring) {
    for (int i = 0; i < k; ++i) {
      const double a = 2 * std::numbers::pi * i / k, r = 1 + (ring == 1 && i == 0 ? bulge : 0);
      p.mesh.positions.push_back({r * std::cos(a), 2.0 * ring, r * std::sin(a)});
    }
  }
  for (int i = 0; i < k; ++i) {
    const auto a = static_cast<std::uint32_t>(i), b = static_cast<std::uint32_t>((i + 1) % k),
               n = static_cast<std::uint32_t>(k);
    p.mesh.triangles.push_back({a, a + n, b});
    p.mesh.triangles.push_back({b, a + n, b + n});
  }
  p.hierarchy.radii = {{{0, 0, 0}, 2, k_none}, {{0, 2, 0}, 2, 0}};
  p.hierarchy.segment_of.assign(p.mesh.triangles.size(), 1);
  return p;
}

TEST(CylinderError, OfARegularPrismIsWhatItsSidesAreInsideTheCircle) {
  for (const int k : {3, 6, 12}) {
    const Prism p = prism(k);
    const CylinderError e = cylinder_error(p.mesh, p.hierarchy, 2);
    EXPECT_NEAR(e.of_radius.max, 1 - std::cos(std::numbers::pi / k), 1e-12) << k;
    EXPECT_GT(e.of_radius.mean, 0.3 * e.of_radius.max) << k;
    EXPECT_EQ(e.explained_triangles, 1) << k;
    EXPECT_EQ(e.explained_area, 1) << k;
  }
}

TEST(CylinderError, ALidLiesInTheEndsDisc) {
  Prism p = prism(60);
  p.mesh.positions.push_back({0, 2, 0});
  const auto middle = static_cast<std::uint32_t>(p.mesh.positions.size() - 1);
  for (std::uint32_t i = 0; i < 60; ++i) p.mesh.triangles.push_back({60 + i, middle, 60 + (i + 1) % 60});
  p.hierarchy.segment_of.assign(p.mesh.triangles.size(), 1);
  const CylinderError e = cylinder_error(p.mesh, p.hierarchy, 2);
  EXPECT_LT(e.of_radius.max, 0.002);
  EXPECT_EQ(e.explained_triangles, 1);
}

TEST(CylinderError, WhatLiesFarFromItsSegmentIsNotExplained) {
  Prism p = prism(8);  // a flat plane that somebody calls a tube
  for (Double3& v : p.mesh.positions) v.y = 0;
  p.hierarchy.radii[1].diameter = 0.1;
  p.hierarchy.radii[0].diameter = 0.1;
  EXPECT_EQ(cylinder_error(p.mesh, p.hierarchy, 2).explained_triangles, 0);
}

TEST(CylinderError, MeasuresABulgeAsAShareOfRadiusAndHeight) {
  const Prism p = prism(8, 0.25);
  const CylinderError e = cylinder_error(p.mesh, p.hierarchy, 2);
  EXPECT_NEAR(e.of_radius.max, 0.25, 1e-12);  // a corner of the upper ring, farther out than any side is in
  EXPECT_NEAR(e.of_height.max, 0.125, 1e-12);
  EXPECT_GT(e.of_radius.rms, e.of_radius.mean);
}

TEST(CylinderError, ThePercentileIsThatOfTheArea) {
  const Prism p = prism(400, 0.25);  // one corner of 800: less than 5 % of the area is near it
  const CylinderError e = cylinder_error(p.mesh, p.hierarchy, 2);
  EXPECT_LT(e.of_radius.p95, 1e-4);
  const Prism round = prism(6);  // sides and middles are off by two different lengths
  const CylinderError six = cylinder_error(round.mesh, round.hierarchy, 2);
  EXPECT_NEAR(six.of_radius.p95, six.of_radius.max, 0.011 * six.of_radius.max);
}

// The upper ring stands aslant: its plane holds nearly the axis.
TEST(CylinderError, OfATubeThatIsShearedIsThatOfTheUprightOneWhereItsRingsAreKnown) {
  Prism p = prism(12);
  for (std::uint32_t i = 12; i < 24; ++i) {
    Double3& v = p.mesh.positions[i];
    v = {0.2 * v.x, 5 + v.x * std::sqrt(0.96), v.z};
  }
  p.hierarchy.radii[1].centre = {0, 5, 0};
  const CylinderError unknown = cylinder_error(p.mesh, p.hierarchy, 2);
  EXPECT_LT(unknown.explained_triangles, 1);
  for (std::uint32_t i = 0; i < 24; ++i) p.hierarchy.ring_vertices.push_back(i);
  p.hierarchy.first_vertex = {0, 12, 24};
  const CylinderError known = cylinder_error(p.mesh, p.hierarchy, 2);
  EXPECT_EQ(known.explained_triangles, 1);
  EXPECT_LT(known.of_radius.mean, 0.5 * unknown.of_radius.mean);
  // What a skeleton only counts to a radius tells nothing about how it stands.
  for (RadiusNode& r : p.hierarchy.radii) r.source = RadiusSource::surface;
  EXPECT_EQ(cylinder_error(p.mesh, p.hierarchy, 2).explained_triangles, unknown.explained_triangles);
}

TEST(CylinderError, ARingThatIsNoCircleIsMeasuredWhereverItStands) {
  Prism p = prism(8, 0.25);
  for (std::uint32_t i = 0; i < 16; ++i) p.hierarchy.ring_vertices.push_back(i);
  p.hierarchy.first_vertex = {0, 8, 16};
  EXPECT_NEAR(cylinder_error(p.mesh, p.hierarchy, 2).of_radius.max, 0.25, 1e-12);
}

TEST(CylinderError, CountsWhatNoSegmentExplains) {
  Prism p = prism(4);
  p.hierarchy.segment_of[0] = p.hierarchy.segment_of[1] = k_none;
  const CylinderError e = cylinder_error(p.mesh, p.hierarchy, 2);
  EXPECT_DOUBLE_EQ(e.explained_triangles, 6.0 / 8);
  EXPECT_DOUBLE_EQ(e.explained_area, 6.0 / 8);
}

TEST(CylinderError, OfAnEmptyTrunkIsNothing) {
  const CylinderError e = cylinder_error({}, {}, 0);
  EXPECT_EQ(e.of_radius.max, 0);
  EXPECT_EQ(e.explained_triangles, 1);
}

TEST(CylinderError, IsDefinedWhereTheSegmentHasNoLength) {
  Prism p = prism(4);
  p.hierarchy.radii[1].centre = p.hierarchy.radii[0].centre;
  EXPECT_TRUE(std::isfinite(cylinder_error(p.mesh, p.hierarchy, 2).of_radius.max));
}

}  // namespace
}  // namespace copse
