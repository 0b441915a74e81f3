// Through the exporter and back through the importer.
#include "lib/formats/export/export.h"
#include "lib/formats/import/import.h"
#include "tests/grow/mesh_facts.h"
#include "tools/treegrow/join_faces.h"

#include <algorithm>
#include <map>
#include <sstream>

#include <gtest/gtest.h>

namespace copse::grow {
namespace {

std::span<const std::uint8_t> bytes_of(const std::string& text) {
  return {reinterpret_cast<const std::uint8_t*>(text.data()), text.size()};
}

TEST(Files, GlbLoadsWithTheSameTrianglesMaterialsAndBounds) {
  for (const char* list : {"none", "artist", "no-names", "one-material", "far-offset,z-up"}) {
    const Grown tree = small_tree("birch", list);
    const auto files = export_mesh(tree.mesh, ExportFormat::glb, "birch.glb");
    ASSERT_TRUE(files) << files.error().what;
    const auto back = import_mesh(bytes_of(files->front().bytes), MeshFormat::glb, "birch.glb");
    ASSERT_TRUE(back) << back.error().what;
    EXPECT_EQ(back->mesh.triangles.size(), tree.mesh.triangles.size());
    if (!tree.mesh.materials.empty()) {
      EXPECT_EQ(back->mesh.materials.size(), tree.mesh.materials.size());
    }
    const DoubleBox a = bounds(back->mesh), b = bounds(tree.mesh);
    EXPECT_LT(distance(a.min, b.min), 1e-5) << list;
    EXPECT_LT(distance(a.max, b.max), 1e-5) << list;
  }
}

TEST(Files, ObjKeepsEveryPositionExactly) {
  for (const char* list : {"none", "artist", "far-offset", "centimetres,z-up"}) {
    const Grown tree = small_tree("birch", list);
    const auto files = export_mesh(tree.mesh, ExportFormat::obj, "birch.obj");
    ASSERT_TRUE(files);
    const auto back = import_mesh(bytes_of(files->front().bytes), MeshFormat::obj, "birch.obj");
    ASSERT_TRUE(back) << back.error().what;
    EXPECT_EQ(back->mesh.positions, tree.mesh.positions);
  }
}

TEST(Files, CoordinatesArePrintedInSixDecimals) {
  const Grown tree = small_tree("birch", "none");
  const std::string obj = export_mesh(tree.mesh, ExportFormat::obj, "b.obj")->front().bytes;
  std::istringstream lines(obj);
  std::string line;
  std::size_t longest = 0;
  while (std::getline(lines, line))
    if (line.starts_with("v ")) longest = std::max(longest, line.size());
  EXPECT_LE(longest, 2 + 3 * 10 + 2u);  // -12.345678
}

std::map<std::size_t, std::size_t> corners_of_faces(const std::string& obj) {
  std::map<std::size_t, std::size_t> count;
  std::istringstream lines(obj);
  std::string line;
  while (std::getline(lines, line))
    if (line.starts_with("f ")) ++count[static_cast<std::size_t>(std::count(line.begin(), line.end(), ' '))];
  return count;
}

TEST(JoinFaces, MakesFacesOfFourAndMoreCornersAgain) {
  const Grown tree = small_tree("birch", "free-tubes,quads,capped-ngon,discs", 0);
  std::string obj = export_mesh(tree.mesh, ExportFormat::obj, "b.obj")->front().bytes;
  obj = join_faces(std::move(obj), tree.mesh);
  const auto faces = corners_of_faces(obj);
  const std::size_t k = tree.truth.branches[0].k;
  ASSERT_EQ(k, 6u);
  EXPECT_EQ(faces.count(3), 0u);
  EXPECT_GT(faces.at(4), 100u);
  EXPECT_EQ(faces.at(6), 2 * tree.truth.branches.size());
  EXPECT_EQ(faces.at(8), tree.truth.leaf_centres.size());
  const auto back = import_mesh(bytes_of(obj), MeshFormat::obj, "b.obj");
  ASSERT_TRUE(back);
  EXPECT_EQ(back->mesh.triangles.size(), tree.mesh.triangles.size());
  EXPECT_EQ(back->mesh.positions, tree.mesh.positions);
}

TEST(JoinFaces, LeavesTrianglesAlone) {
  const Grown tree = small_tree("birch", "none");
  const std::string obj = export_mesh(tree.mesh, ExportFormat::obj, "b.obj")->front().bytes;
  EXPECT_EQ(join_faces(obj, tree.mesh), obj);
  EXPECT_EQ(join_faces("", Mesh{}), "");
  EXPECT_EQ(join_faces("f 1 2 3", Mesh{}), "f 1 2 3");
}

}  // namespace
}  // namespace copse::grow
