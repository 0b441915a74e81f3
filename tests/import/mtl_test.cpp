#include "tests/import/testing.h"

namespace copse {
namespace {

using namespace copse::testing;

constexpr const char* k_triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

// A triangle of material "leaf", whose library has that text.
Import with_library(const std::string& mtl, bool strict = false) {
  const Folder folder;
  folder.write("tree.mtl", mtl);
  return good(import_mesh(
      folder.write("tree.obj", std::string("mtllib tree.mtl\n") + k_triangle + "usemtl leaf\nf 1 2 3\n"),
      {.strict = strict}));
}

TEST(Mtl, ColoursAreTakenAsTheyStand) {
  const Import m = with_library(
      "# leaf\nnewmtl leaf\nKa 0.1 0.2 0.3\nKd 0.25 0.5 0.75\nKs 1 0.5 0\nKe 2 0 0\nNs 96.5\nd 0.5\nillum "
      "2\nNi 1\n");
  ASSERT_EQ(m.mesh.materials.size(), 1u);
  Material expected{.name = "leaf",
                    .ambient = {0.1f, 0.2f, 0.3f},
                    .diffuse = {0.25f, 0.5f, 0.75f},
                    .specular = {1, 0.5f, 0},
                    .emission = {2, 0, 0},
                    .shininess = 96.5f,
                    .alpha = 0.5f};
  EXPECT_EQ(m.mesh.materials[0], expected);
  EXPECT_TRUE(m.warnings.empty());
}

TEST(Mtl, TransparencyAndHaloAndASingleGreyNumberAreKnown) {
  EXPECT_FLOAT_EQ(with_library("newmtl leaf\nTr 0.25\n").mesh.materials[0].alpha, 0.75f);
  EXPECT_EQ(with_library("newmtl leaf\nd -halo 0.25\n").mesh.materials[0].alpha, 0.25f);
  EXPECT_EQ(with_library("newmtl leaf\nKd 0.5\n").mesh.materials[0].diffuse, (Float3{0.5f, 0.5f, 0.5f}));
}

TEST(Mtl, MaterialsThatFacesNameAndNoLibraryDefinesAreTold) {
  EXPECT_TRUE(with_library("newmtl leaf\n").undefined_materials.empty());
  EXPECT_EQ(with_library("newmtl bark\nKd 1 0 0\n").undefined_materials, (std::vector<std::uint32_t>{1}));
  EXPECT_EQ(with_library("Kd 1 0 0\n").undefined_materials, (std::vector<std::uint32_t>{0}));
}

TEST(Mtl, TheColourMapIsTheTextureWhateverItsOptions) {
  for (const char* options :
       {"", "-clamp on ", "-s 2 2 1 -o 0.5 0 -mm 0 1 ", "-blendu off -bm 0.5 -texres 512 ", "-o 1 "}) {
    const Import m = with_library(std::string("newmtl leaf\nmap_Kd ") + options + "maps/my leaf.png\n");
    ASSERT_EQ(m.mesh.textures.size(), 1u) << options;
    EXPECT_EQ(m.mesh.textures[0].uri, "maps/my leaf.png") << options;
    EXPECT_EQ(m.mesh.materials[0].texture, 0u);
    EXPECT_EQ(m.mesh.materials[0].alpha_cutoff, 0);
  }
}

TEST(Mtl, AnOpacityMapMakesAnAlphaTest) {
  const Import m =
      with_library("newmtl leaf\nmap_d leaf.png\nmap_Kd leaf.png\nnewmtl bark\nmap_Kd leaf.png\n");
  EXPECT_EQ(m.mesh.materials[0].alpha_cutoff, 0.5f);
  EXPECT_EQ(m.mesh.materials[1].alpha_cutoff, 0);
  EXPECT_EQ(m.mesh.textures.size(), 1u) << "one image, however many materials";
  EXPECT_TRUE(m.warnings.empty());
  EXPECT_EQ(with_library("newmtl leaf\nmap_Kd leaf.png\nmap_d alpha.png\n").warnings,
            (std::vector<std::string>{
                "tree.mtl: material 'leaf': the opacity map 'alpha.png' is not the colour map; its "
                "alpha is taken from the colour map (opacity maps left out: 1)"}));
}

TEST(Mtl, ImagesOutsideTheFolderAreLeftOutAndAbsoluteNamesLookedForBesideTheMesh) {
  const Import outside = with_library("newmtl leaf\nmap_Kd ../secret.png\n");
  EXPECT_TRUE(outside.mesh.textures.empty());
  EXPECT_EQ(outside.mesh.materials[0].texture, k_none);
  EXPECT_EQ(outside.warnings.size(), 1u);
  EXPECT_EQ(with_library("newmtl leaf\nmap_Kd C:\\art\\leaf.png\n").mesh.textures[0].uri, "leaf.png");
  EXPECT_EQ(with_library("newmtl leaf\nmap_Kd /home/me/leaf.png\n").mesh.textures[0].uri, "leaf.png");
  EXPECT_EQ(with_library("newmtl leaf\nmap_Kd maps\\leaf.png\n").mesh.textures[0].uri, "maps/leaf.png");
}

TEST(Mtl, NumbersOutOfRangeAreClampedAndDamagedOnesSkippedWithAWarning) {
  const Import m = with_library("newmtl leaf\nKd 7 -1 0.5\nNs -3\nd 9\nKs red\nKa nan 0 0\nKe 1 2\n");
  EXPECT_EQ(m.mesh.materials[0].diffuse, (Float3{1, 0, 0.5f}));
  EXPECT_EQ(m.mesh.materials[0].shininess, 0);
  EXPECT_EQ(m.mesh.materials[0].alpha, 1);
  EXPECT_EQ(m.mesh.materials[0].ambient, Material{}.ambient);
  EXPECT_EQ(
      m.warnings,
      (std::vector<std::string>{
          "tree.mtl: line 5: the numbers cannot be read (statements of material libraries left out: 3)"}));
}

TEST(Mtl, SeveralLibrariesAreReadAndNamedForDepfiles) {
  const Folder folder;
  folder.write("a.mtl", "newmtl bark\nKd 1 0 0\n");
  folder.write("b.mtl", "newmtl leaf\nKd 0 1 0\n");
  folder.write("sub/c d.mtl", "newmtl moss\nKd 0 0 1\n");
  const auto path = folder.write("tree.obj", std::string("mtllib a.mtl b.mtl\nmtllib sub/c d.mtl\n") +
                                                 k_triangle + "usemtl leaf\nf 1 2 3\n");
  const Import m = good(import_mesh(path));
  EXPECT_EQ(m.mesh.materials.size(), 3u);
  EXPECT_EQ(m.mesh.materials[m.mesh.parts[0].material].diffuse, (Float3{0, 1, 0}));
  EXPECT_EQ(m.files,
            (std::vector<std::filesystem::path>{path, folder.path() / "a.mtl", folder.path() / "b.mtl",
                                                folder.path() / "sub/c d.mtl"}));
}

TEST(Mtl, AMissingLibraryIsAWarningAndWhenStrictARefusal) {
  const Folder folder;
  const auto path =
      folder.write("tree.obj", std::string("mtllib gone.mtl\n") + k_triangle + "usemtl leaf\nf 1 2 3\n");
  const Import m = good(import_mesh(path));
  EXPECT_EQ(m.mesh.materials[0].name, "leaf");
  EXPECT_EQ(
      m.warnings,
      (std::vector<std::string>{
          "line 1: 'gone.mtl' cannot be read: No such file or directory (material libraries missing: 1)"}));
  EXPECT_EQ(error_of(import_mesh(path, {.strict = true})),
            "import: error: " + path.string() +
                ": line 1: the material library 'gone.mtl' cannot be read: No such file or directory; put it "
                "beside the "
                "mesh, or drop --strict to do without");
}

TEST(Mtl, ALibraryOutsideTheFolderIsNotOpened) {
  const Folder folder;
  folder.write("secret.mtl", "newmtl leaf\nKd 1 0 0\n");
  for (const std::string& name : {std::string("../secret.mtl"), std::string("sub/../../secret.mtl")}) {
    const auto path =
        folder.write("sub/tree.obj", "mtllib " + name + "\n" + k_triangle + "usemtl leaf\nf 1 2 3\n");
    const Import m = good(import_mesh(path));
    EXPECT_EQ(m.files.size(), 1u);
    EXPECT_EQ(m.mesh.materials[0].diffuse, Material{}.diffuse);
    EXPECT_EQ(m.warnings.size(), 1u);
  }
}

TEST(Mtl, AMeshInMemoryOpensNothing) {
  const Import m =
      good(read(std::string("mtllib /etc/passwd\n") + k_triangle + "f 1 2 3\n", MeshFormat::obj));
  EXPECT_EQ(
      m.warnings,
      (std::vector<std::string>{"line 1: a mesh in memory has no folder (material libraries not read: 1)"}));
}

}  // namespace
}  // namespace copse
