#include "lib/analysis/measure/footprints.h"

#include <limits>
#include <numeric>

#include <gtest/gtest.h>

namespace copse {
namespace {

// Right triangles of area 1/2, one for each set of texture corners.
Mesh mesh_of(const std::vector<std::array<Float2, 3>>& corners) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.parts.emplace_back();
  for (const auto& uv : corners) {
    const auto first = static_cast<std::uint32_t>(mesh.texcoords.size());
    mesh.texcoords.insert(mesh.texcoords.end(), uv.begin(), uv.end());
    mesh.triangles.push_back({0, 1, 2});
    mesh.texcoord_triangles.push_back({first, first + 1, first + 2});
    mesh.part_of.push_back(0);
  }
  return mesh;
}
Footprints of(const Mesh& mesh, double tiles = 16) {
  std::vector<std::uint32_t> all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0u);
  return footprints(mesh, all, tiles);
}

TEST(Footprints, CardsCutInOneWayShareOneWhateverTheirFirstCornerWindingAndRepeat) {
  const Footprints f = of(mesh_of({{Float2{0, 0}, {1, 0}, {0, 1}},
                                   {Float2{1, 0}, {0, 1}, {0, 0}},
                                   {Float2{0, 1}, {1, 0}, {0, 0}},
                                   {Float2{3, -2}, {4, -2}, {3, -1}}}));
  ASSERT_EQ(f.list.size(), 1u);
  EXPECT_DOUBLE_EQ(f.list[0].area, 2);
}

TEST(Footprints, DifferentCutsStayApartInTheOrderOfTheirFirstUse) {
  const Footprints f = of(mesh_of({{Float2{0, 0}, {0.5f, 0}, {0, 1}},
                                   {Float2{0, 0}, {1, 0}, {0, 1}},
                                   {Float2{0, 0}, {0.5f, 0}, {0, 1}}}));
  ASSERT_EQ(f.list.size(), 2u);
  EXPECT_EQ(f.list[0].corners[2].x, 0.5f);
  EXPECT_DOUBLE_EQ(f.list[0].area, 1);
}

TEST(Footprints, WithoutUsableCoordinatesATriangleIsTheWholeTexture) {
  constexpr float k_nan = std::numeric_limits<float>::quiet_NaN(),
                  k_inf = std::numeric_limits<float>::infinity();
  Mesh mesh = mesh_of({{Float2{0, 0}, {k_nan, 0}, {0, 1}},
                       {Float2{0, 0}, {k_inf, 0}, {0, 1}},
                       {Float2{0, 0}, {1e9f, 0}, {0, 1}},
                       {Float2{0, 0}, {20, 0}, {0, 1}},
                       {Float2{0, 0}, {1, 0}, {0, 1}}});
  mesh.texcoord_triangles[4][1] = k_none;
  const Footprints f = of(mesh);
  EXPECT_EQ(f.whole, 5u);
  EXPECT_DOUBLE_EQ(f.whole_area, 2.5);
  mesh.texcoord_triangles.clear();
  EXPECT_EQ(of(mesh).whole, 5u);
}

TEST(Footprints, AHundredThousandDifferentOnesAreFound) {
  std::vector<std::array<Float2, 3>> corners;
  for (int i = 0; i < 100000; ++i) corners.push_back({Float2{0, 0}, {i / 100000.0f, 0}, {0, 1}});
  EXPECT_EQ(of(mesh_of(corners)).list.size(), 100000u);
}

}  // namespace
}  // namespace copse
