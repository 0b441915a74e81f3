// The real trees, where they are at hand, against the table of their README.
#include "tests/import/testing.h"

#include <iostream>

namespace copse {
namespace {

using namespace copse::testing;

const std::filesystem::path k_folder = COPSE_SOURCE_DIR "/../shared/trees";

bool absent() {
  if (std::filesystem::exists(k_folder)) return false;
  std::cout << "skipped: the real trees are not at " << k_folder << "\n";
  return true;
}

struct Row {
  const char* file;
  std::size_t vertices, triangles;
};
constexpr Row k_rows[] = {{"ez_oak_small_ideal.obj", 5988, 6504},
                          {"ez_ash_medium.obj.gz", 27110, 20000},
                          {"eztree_oak_medium.obj.gz", 24060, 13806},
                          {"sap_quaking_aspen.obj", 3846, 4674},
                          {"sap_callistemon_quads.obj.gz", 24078, 25044},
                          {"pt_fork_small.obj", 3806, 4916},
                          {"dv_oak_skin.obj.gz", 72518, 140538},
                          {"arbaro_lombardy_poplar.obj.gz", 74839, 63713},
                          {"quaternius_oak_1.obj", 9394, 6211},
                          {"quaternius_oak_1.glb", 9394, 6211},
                          {"quaternius_pine_5.obj", 2238, 1558},
                          {"quaternius_pine_5.glb", 2238, 1558},
                          {"quaternius_dead_1.obj", 7992, 6106},
                          {"quaternius_fern.obj", 243, 288},
                          {"shapespark_tree_1.obj", 808, 646},
                          {"kaykit_tree_dead_large.obj", 148, 256},
                          {"kaykit_tree_pine_orange_large.obj", 169, 318},
                          {"kenney_tree_detailed_fall.obj", 2274, 402},
                          {"kenney_tree_oak_fall.obj", 648, 196},
                          // Two primitives share their 324 vertices; the OBJ repeats them.
                          {"kenney_tree_oak_fall.glb", 324, 196},
                          {"kenney_grass-trees-tall.obj", 884, 472}};

TEST(Trees, HaveTheirVerticesAndTriangles) {
  if (absent()) return;
  for (const Row& row : k_rows) {
    const Import m = good(import_mesh(k_folder / row.file));
    EXPECT_EQ(m.mesh.positions.size(), row.vertices) << row.file;
    EXPECT_EQ(m.mesh.triangles.size(), row.triangles) << row.file;
    EXPECT_EQ(m.counts.dropped_faces, 0u) << row.file;
    expect_sound(m.mesh);
  }
}

TEST(Trees, AnExportersBugIsCountedAndWhenStrictRefused) {
  if (absent()) return;
  const auto path = k_folder / "arbaro_lombardy_poplar.obj.gz";
  const Import m = good(import_mesh(path));
  EXPECT_EQ(m.counts.dropped_texcoords, 97392u);
  EXPECT_EQ(m.counts.cut_polygons, 30394u);
  EXPECT_TRUE(m.mesh.texcoord_triangles.empty());
  EXPECT_EQ(
      m.warnings,
      (std::vector<std::string>{
          "line 84769: the face names texture coordinate 324 of 8 (texture coordinates dropped: 97392)"}));
  EXPECT_EQ(error_of(import_mesh(path, {.strict = true})),
            "import: error: " + path.string() +
                ": line 84769: the face names texture coordinate 324 of 8; export the mesh again, or drop "
                "--strict to "
                "leave it out");
}

TEST(Trees, ASceneThatNamesAChildIsReadWithAWarning) {
  if (absent()) return;
  const Import m = good(import_mesh(k_folder / "kenney_tree_oak_fall.glb"));
  EXPECT_EQ(m.warnings,
            (std::vector<std::string>{"scenes[0] names nodes[1], which is a child of nodes[0] (scene nodes "
                                      "that have a parent: 1)"}));
  // The same tree as the OBJ, which a different exporter wrote with five decimals.
  const Import obj = good(import_mesh(k_folder / "kenney_tree_oak_fall.obj"));
  ASSERT_EQ(m.mesh.triangles.size(), obj.mesh.triangles.size());
  const DoubleBox a = bounds(m.mesh), b = bounds(obj.mesh);
  EXPECT_NEAR(a.max.y, b.max.y, 2e-5);
  EXPECT_NEAR(a.extent().x, b.extent().x, 2e-5);
}

TEST(Trees, MaterialLibrariesAreFoundBesideTheMesh) {
  if (absent()) return;
  const Import m = good(import_mesh(k_folder / "ez_ash_medium.obj.gz"));
  ASSERT_EQ(m.files.size(), 2u);
  EXPECT_EQ(m.files[1], k_folder / "ez_ash_medium.mtl");
  EXPECT_EQ(m.mesh.parts, (std::vector<Part>{{"branches", "", 0}, {"leaves", "", 1}}));
}

TEST(Trees, GlbAndObjOfOneTreeAgree) {
  if (absent()) return;
  for (const std::string& name : {std::string("quaternius_oak_1"), std::string("quaternius_pine_5")}) {
    const Import glb = good(import_mesh(k_folder / (name + ".glb")));
    const Import obj = good(import_mesh(k_folder / (name + ".obj")));
    ASSERT_EQ(glb.mesh.positions.size(), obj.mesh.positions.size());
    double worst = 0, worst_uv = 0;
    for (std::size_t i = 0; i < obj.mesh.positions.size(); ++i) {
      worst = std::max(worst, distance(glb.mesh.positions[i], obj.mesh.positions[i]));
      worst_uv = std::max(worst_uv, std::abs(1.0 * glb.mesh.texcoords[i].y - obj.mesh.texcoords[i].y));
    }
    EXPECT_LT(worst, 2e-5) << name;
    EXPECT_LT(worst_uv, 2e-5) << name << ": v runs up in both";
  }
}

}  // namespace
}  // namespace copse
