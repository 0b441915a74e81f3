#include "lib/formats/export/export.h"
#include "tests/export/meshes.h"

#include <cstring>
#include <string>

#include <gtest/gtest.h>

namespace copse {
namespace {

std::string ply_of(const Mesh& mesh) {
  const auto files = export_mesh(mesh, ExportFormat::ply, "a.ply");
  EXPECT_TRUE(files);
  EXPECT_EQ(files->size(), 1u);
  return files->front().bytes;
}

std::size_t body_of(const std::string& ply) {
  const std::string end = "end_header\n";
  return ply.find(end) + end.size();
}

TEST(Ply, IsBinaryLittleEndianWithNormalsAndTextureCoordinates) {
  const std::string ply = ply_of(small_mesh());
  EXPECT_TRUE(ply.starts_with("ply\nformat binary_little_endian 1.0\n"));
  // 4 vertices of the square; 3 of each leaf triangle, which share no normal.
  EXPECT_NE(ply.find("element vertex 10\n"), std::string::npos) << ply.substr(0, 300);
  EXPECT_NE(ply.find("element face 4\n"), std::string::npos);
  EXPECT_NE(ply.find("property float nz\nproperty float s\nproperty float t\n"), std::string::npos);
  // 2.000000001 is not a float32, so positions are double.
  EXPECT_NE(ply.find("property double x\n"), std::string::npos);
  EXPECT_EQ(ply.size() - body_of(ply), 10u * (24 + 12 + 8) + 4u * 13);
}

TEST(Ply, PositionsAreFloatWhenThatLosesNothing) {
  Mesh mesh = small_mesh();
  mesh.positions[4] = {0.5, 2, 0};
  mesh.positions[5] = {1, 2, 0.25};
  const std::string ply = ply_of(mesh);
  EXPECT_NE(ply.find("property float x\n"), std::string::npos);
  float first[3];
  std::memcpy(first, ply.data() + body_of(ply) + 32, sizeof first);
  EXPECT_EQ(first[0], 1.0f);
}

TEST(Ply, ABareMeshKeepsItsVerticesAndTheirNumbers) {
  Mesh mesh = small_mesh();
  mesh.normal_triangles.clear();
  mesh.texcoord_triangles.clear();
  mesh.positions.push_back({9, 9, 9});  // no triangle uses it
  const std::string ply = ply_of(mesh);
  EXPECT_NE(ply.find("element vertex 8\n"), std::string::npos);
  std::uint32_t last[3];
  std::memcpy(last, ply.data() + ply.size() - sizeof last, sizeof last);
  EXPECT_EQ(last[0], 6u);
  EXPECT_EQ(last[2], 4u);
}

TEST(Ply, AnEmptyMeshIsAHeader) {
  const std::string ply = ply_of(Mesh{});
  EXPECT_EQ(body_of(ply), ply.size());
}

}  // namespace
}  // namespace copse
