#include "lib/analysis/surface/surfaces.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(Surfaces, HaveTheirTrianglesAndVerticesAscending) {
  TrunkMesh mesh;
  mesh.positions.resize(8);
  mesh.triangles = {{6, 5, 4}, {0, 2, 1}, {4, 3, 6}};
  const Surfaces surfaces = make_surfaces(mesh);
  ASSERT_EQ(surfaces.size(), 2u);
  const auto list = [](auto span) { return std::vector<std::uint32_t>(span.begin(), span.end()); };
  EXPECT_EQ(list(surfaces.triangles(0)), (std::vector<std::uint32_t>{0, 2}));
  EXPECT_EQ(list(surfaces.vertices(0)), (std::vector<std::uint32_t>{3, 4, 5, 6}));
  EXPECT_EQ(list(surfaces.triangles(1)), (std::vector<std::uint32_t>{1}));
  EXPECT_EQ(list(surfaces.vertices(1)), (std::vector<std::uint32_t>{0, 1, 2}));
}

TEST(Surfaces, OfNothingAreNone) {
  EXPECT_EQ(make_surfaces(TrunkMesh{}).size(), 0u);
}

}  // namespace
}  // namespace copse
