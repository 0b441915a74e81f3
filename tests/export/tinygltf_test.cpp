// An outside reader: what the exporter writes, as tinygltf reads it.
#include "lib/formats/export/export.h"
#include "tests/export/meshes.h"

#include <gtest/gtest.h>
#include <tiny_gltf.h>

namespace copse {
namespace {

TEST(TinyGltf, ReadsEveryPrimitiveMaterialAndImageOfAGlb) {
  Mesh mesh = small_mesh();
  mesh.textures[0] = {.uri = {}, .mime = "image/png", .bytes = png_bytes()};
  const auto files = export_mesh(mesh, ExportFormat::glb, "a.glb", {});
  ASSERT_TRUE(files);
  const auto& bytes = files->front().bytes;
  tinygltf::TinyGLTF reader;
  tinygltf::Model model;
  std::string errors, warnings;
  ASSERT_TRUE(reader.LoadBinaryFromMemory(&model, &errors, &warnings,
                                          reinterpret_cast<const unsigned char*>(bytes.data()),
                                          static_cast<unsigned>(bytes.size())))
      << errors;
  EXPECT_EQ(errors + warnings, "");
  ASSERT_EQ(model.meshes.size(), 2u);
  std::size_t corners = 0;
  for (const tinygltf::Mesh& m : model.meshes) {
    for (const tinygltf::Primitive& p : m.primitives)
      corners += model.accessors[static_cast<std::size_t>(p.indices)].count;
  }
  EXPECT_EQ(corners, 3 * mesh.triangles.size());
  ASSERT_EQ(model.materials.size(), 3u) << "the bark also stands where there are no texture coordinates";
  EXPECT_EQ(model.materials[1].alphaMode, "MASK");
  EXPECT_NEAR(model.materials[1].alphaCutoff, 0.4, 1e-6);
  EXPECT_TRUE(model.materials[1].doubleSided);
  ASSERT_EQ(model.images.size(), 2u);
  EXPECT_EQ(model.images[0].width, 1);
}

}  // namespace
}  // namespace copse
