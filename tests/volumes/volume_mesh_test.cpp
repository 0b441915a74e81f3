#include "lib/analysis/volumes/volume_mesh.h"

#include "lib/analysis/volumes/volume_measures.h"

#include <cmath>
#include <map>

#include <gtest/gtest.h>

namespace copse {
namespace {

std::vector<Volume<double>> one_of_each() {
  const Double3 u = normalized(Double3{2, -1, 3}), v = normalized(cross(u, {0, 1, 0})), w = cross(u, v);
  const Double3 c{5, 6, -7};
  return {DoubleBox{{1, 2, 3}, {2, 4, 6}},
          BoundingSphere<double>{c, 2},
          OrientedBox<double>{c, {u, v, w}, {1, 2, 3}},
          Capsule<double>{c, c + u * 3, 0.5},
          Cylinder<double>{c, c + u * 3, 0.5},
          Lozenge<double>{c, u * 3, v * 2, 0.5},
          Ellipsoid<double>{c, {u, v, w}, {1, 2, 3}},
          Kdop<double>{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}}, {0, 0, 0, 0.5}, {1, 1, 1, 2.5}}};
}

double signed_volume(const VolumeMesh& mesh) {
  double six = 0;
  const Double3 o = mesh.positions.empty() ? Double3{} : mesh.positions[0];
  for (const Triangle& t : mesh.triangles) {
    six += dot(mesh.positions[t[0]] - o, cross(mesh.positions[t[1]] - o, mesh.positions[t[2]] - o));
  }
  return six / 6;
}

TEST(VolumeMesh, HasTheVolumeOfWhatItShowsAndFacesOutward) {
  for (const Volume<double>& v : one_of_each()) {
    const double drawn = signed_volume(volume_mesh(v, 24)), truth = measures_of(v).volume;
    EXPECT_LE(drawn, truth * (1 + 1e-9)) << v.index();
    EXPECT_GE(drawn, truth * 0.995) << v.index();
  }
}

TEST(VolumeMesh, IsClosed) {
  for (const Volume<double>& v : one_of_each()) {
    const VolumeMesh mesh = volume_mesh(v, 3);
    // edges by position, since seams and poles repeat vertices
    std::map<std::pair<std::array<double, 3>, std::array<double, 3>>, int> edges;
    const auto key = [&](std::uint32_t i) {
      const Double3& p = mesh.positions[i];
      const auto r = [](double x) { return std::round(x * 1e9) / 1e9 + 0.0; };
      return std::array<double, 3>{r(p.x), r(p.y), r(p.z)};
    };
    for (const Triangle& t : mesh.triangles) {
      for (std::size_t i = 0; i < 3; ++i) ++edges[{key(t[i]), key(t[(i + 1) % 3])}];
    }
    for (const auto& [edge, count] : edges) {
      if (edge.first == edge.second) continue;
      EXPECT_EQ(count, (edges[{edge.second, edge.first}])) << v.index();
    }
  }
}

TEST(VolumeMesh, WhatHasNoThicknessIsDrawnFlatAndAPointNotAtAll) {
  EXPECT_TRUE(volume_mesh(BoundingSphere<double>{{1, 2, 3}, 0}).triangles.empty());
  const VolumeMesh flat = volume_mesh(Lozenge<double>{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, 0});
  EXPECT_FALSE(flat.triangles.empty());
  for (const Double3& p : flat.positions) EXPECT_EQ(p.z, 0);
  EXPECT_FALSE(volume_mesh(Capsule<double>{{1, 1, 1}, {1, 1, 1}, 1}).triangles.empty());
}

}  // namespace
}  // namespace copse
