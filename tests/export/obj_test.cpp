#include "lib/formats/export/export.h"
#include "lib/formats/import/import.h"
#include "tests/export/meshes.h"

#include <filesystem>
#include <fstream>
#include <string>

#include <gtest/gtest.h>
#include <unistd.h>

namespace copse {
namespace {

namespace fs = std::filesystem;

TEST(Obj, WritesFacesWithWhateverIndicesTheirCornersHave) {
  const auto files = export_mesh(small_mesh(), ExportFormat::obj, "a.obj");
  ASSERT_TRUE(files);
  const std::string& text = files->front().bytes;
  EXPECT_NE(text.find("\nf 1/1/1 2/2/1 3/3/1\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\nf 5/1/1 6/2 7//2\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\nf 7 6 5\n"), std::string::npos) << text;
}

TEST(Obj, NumbersRoundTrip) {
  const auto files = export_mesh(small_mesh(), ExportFormat::obj, "a.obj");
  EXPECT_NE(files->front().bytes.find("v 0.1 2.000000001 0\n"), std::string::npos);
}

TEST(Obj, MaterialsGoIntoALibraryAndEmbeddedTexturesIntoFiles) {
  const auto files = export_mesh(small_mesh(), ExportFormat::obj, "big oak.obj");
  ASSERT_EQ(files->size(), 3u);
  EXPECT_NE((*files)[0].bytes.find("mtllib big oak.mtl\n"), std::string::npos);
  EXPECT_EQ((*files)[1].name, "big oak.mtl");
  EXPECT_EQ((*files)[2].name, "big oak_texture1.png");
  const std::string& library = (*files)[1].bytes;
  EXPECT_NE(library.find("newmtl leaf <1>\n"), std::string::npos);
  EXPECT_NE(library.find("map_Kd tex/bark 1.png\n"), std::string::npos);
  EXPECT_NE(library.find("map_d big oak_texture1.png\n"), std::string::npos);
}

TEST(Obj, AMeshWithoutMaterialsHasNoLibrary) {
  Mesh mesh = small_mesh();
  mesh.materials.clear();
  mesh.textures.clear();
  for (Part& part : mesh.parts) part.material = k_none;
  const auto files = export_mesh(mesh, ExportFormat::obj, "a.obj");
  ASSERT_EQ(files->size(), 1u);
  EXPECT_EQ(files->front().bytes.find("usemtl"), std::string::npos);
}

TEST(Obj, MaterialNamesStayOneLineAndApart) {
  Mesh mesh = small_mesh();
  mesh.materials[0].name = "x\ny";
  mesh.materials[1].name = "x_y";
  mesh.parts[2].material = k_none;
  const auto files = export_mesh(mesh, ExportFormat::obj, "a.obj");
  const std::string& library = (*files)[1].bytes;
  EXPECT_NE(library.find("newmtl x_y\n"), std::string::npos);
  EXPECT_NE(library.find("newmtl x_y_2\n"), std::string::npos);
  // Nothing ends the use of a material, so "none" is a material too.
  EXPECT_NE(library.find("newmtl no_material\n"), std::string::npos);
  EXPECT_NE(files->front().bytes.find("usemtl no_material\n"), std::string::npos);
}

TEST(Obj, ComesBackFromTheImporterAsItWas) {
  const Mesh mesh = small_mesh();
  const fs::path folder =
      fs::temp_directory_path() / (std::string("copse_obj_") + std::to_string(::getpid()));
  fs::create_directories(folder);
  const auto files = export_mesh(mesh, ExportFormat::obj, "a.obj");
  for (const ExportedFile& file : *files) std::ofstream(folder / file.name, std::ios::binary) << file.bytes;
  const auto import = import_mesh(folder / "a.obj");
  fs::remove_all(folder);
  ASSERT_TRUE(import) << import.error().what;
  const Mesh& back = import->mesh;
  EXPECT_EQ(back.positions, mesh.positions);
  EXPECT_EQ(back.triangles, mesh.triangles);
  EXPECT_EQ(back.texcoords, mesh.texcoords);
  EXPECT_EQ(back.texcoord_triangles, mesh.texcoord_triangles);
  EXPECT_EQ(back.normal_triangles, mesh.normal_triangles);
  EXPECT_EQ(back.part_of, mesh.part_of);
  ASSERT_EQ(back.parts.size(), 3u);
  EXPECT_EQ(back.parts[1].object, "crown");
  EXPECT_EQ(back.materials[back.parts[1].material].name, "leaf <1>");
  EXPECT_GT(back.materials[back.parts[1].material].alpha_cutoff, 0);
}

}  // namespace
}  // namespace copse
