#include "lib/analysis/tree/corner_columns.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

Mesh two_triangles() {
  Mesh mesh;
  mesh.positions.resize(4);
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  mesh.normals = {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}};
  mesh.normal_triangles = {{2, 2, k_none}, {1, 2, 2}};
  mesh.texcoords = {{0, 0}, {1, 1}};
  mesh.texcoord_triangles = {{1, 1, 1}, {1, 0, 1}};
  return mesh;
}

TEST(CornerColumns, KeepWhatIsUsedOnceInTheOrderOfFirstUse) {
  const Mesh mesh = two_triangles();
  CornerColumns columns(mesh, mesh.triangles.size());
  EXPECT_EQ(columns.corners(0).normal, (std::array<std::uint32_t, 3>{0, 0, k_none}));
  EXPECT_EQ(columns.corners(1).normal, (std::array<std::uint32_t, 3>{1, 0, 0}));
  EXPECT_EQ(columns.normals, (std::vector<Float3>{{0, 0, 1}, {1, 0, 0}}));
  EXPECT_EQ(columns.texcoords, (std::vector<Float2>{{1, 1}, {0, 0}}));
}

TEST(CornerColumns, OfAMeshWithoutThemAreEmpty) {
  Mesh mesh = two_triangles();
  mesh.normal_triangles.clear();
  mesh.texcoord_triangles.clear();
  CornerColumns columns(mesh, mesh.triangles.size());
  const CornerTriangle t = columns.corners(1);
  EXPECT_EQ(t.normal, (std::array<std::uint32_t, 3>{k_none, k_none, k_none}));
  EXPECT_EQ(t.texcoord, (std::array<std::uint32_t, 3>{k_none, k_none, k_none}));
  EXPECT_TRUE(columns.normals.empty());
}

TEST(CornerColumns, StoreOneMaterialOnceAndSeveralEach) {
  std::uint32_t constant = 0;
  Array<std::uint32_t> each;
  store_materials({3, 3, 3}, constant, each);
  EXPECT_EQ(constant, 3u);
  EXPECT_TRUE(each.empty());
  store_materials({3, 1}, constant, each);
  EXPECT_EQ(constant, k_none);
  EXPECT_EQ(each.to_vector(), (std::vector<std::uint32_t>{3, 1}));
  Array<std::uint32_t> none;
  store_materials({}, constant, none);
  EXPECT_EQ(constant, k_none);
}

}  // namespace
}  // namespace copse
