#include "tests/import/testing.h"

namespace copse {
namespace {

using namespace copse::testing;

constexpr const char* k_square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\n";

Import obj(const std::string& text) {
  return good(read(text, MeshFormat::obj));
}
std::string refusal(const std::string& text, bool strict = false) {
  return error_of(read(text, MeshFormat::obj, strict));
}

TEST(Obj, VerticesAndFaces) {
  const Import m = obj("v 0 0 0\nv 1.5e0 -2 3\nv 4 5 6\nf 1 2 3\n");
  EXPECT_EQ(m.mesh.positions, (std::vector<Double3>{{0, 0, 0}, {1.5, -2, 3}, {4, 5, 6}}));
  EXPECT_EQ(triangles(m), (std::vector<Triangle>{{0, 1, 2}}));
  EXPECT_EQ(m.mesh.parts, (std::vector<Part>{{"", "", k_none}}));
  EXPECT_TRUE(m.mesh.face_of.empty());
  EXPECT_TRUE(m.warnings.empty());
}

TEST(Obj, PositionsKeepAllDigitsOfADouble) {
  EXPECT_EQ(obj("v 10000000.123456789 0.1 -1e-17\n").mesh.positions[0],
            (Double3{10000000.123456789, 0.1, -1e-17}));
}

TEST(Obj, NegativeIndicesCountBackFromWhereTheyStand) {
  const Import m = obj("v 9 9 9\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 5 5 5\nf 1 2 -1\n");
  EXPECT_EQ(triangles(m), (std::vector<Triangle>{{1, 2, 3}, {0, 1, 4}}));
}

TEST(Obj, FacesMayComeBeforeTheirVertices) {
  EXPECT_EQ(triangles(obj("f 1 2 3 4\n" + std::string(k_square))).size(), 2u);
}

TEST(Obj, CornersMayMixAllForms) {
  const Import m =
      obj(std::string(k_square) +
          "vt 0 0\nvt 1 0.25\nvn 0 0 1\nvn 0 1 0\nf 1 2/1 3//1\nf 1/2/2 2/1/1 3/-1/-2\nf 1/ 2// 3\n");
  EXPECT_EQ(m.mesh.texcoord_triangles,
            (std::vector<Triangle>{{k_none, 0, k_none}, {1, 0, 1}, {k_none, k_none, k_none}}));
  EXPECT_EQ(m.mesh.normal_triangles,
            (std::vector<Triangle>{{k_none, k_none, 0}, {1, 0, 0}, {k_none, k_none, k_none}}));
  EXPECT_EQ(m.mesh.texcoords, (std::vector<Float2>{{0, 0}, {1, 0.25f}}));
  EXPECT_TRUE(m.warnings.empty());
}

TEST(Obj, ThirdTextureNumbersAndVertexColoursAreSkipped) {
  const Import m = obj("v 0 0 0 1 0.5 0.25\nv 1 0 0 1\nv 0 1 0\nvt 0.5\nvt 0.5 0.25 0.125\nf 1/1 2/2 3/2\n");
  EXPECT_EQ(m.mesh.texcoords, (std::vector<Float2>{{0.5f, 0}, {0.5f, 0.25f}}));
  EXPECT_EQ(m.mesh.positions[1], (Double3{1, 0, 0}));
}

TEST(Obj, LineEndsBlanksContinuationsAndCommentsDoNotMatter) {
  const Import expected = obj(std::string(k_square) + "f 1 2 3\nf 1 3 4\n");
  const Import m =
      obj("\xef\xbb\xbf# made\\\r\n  v 0 0 0  \r\nv\t1 0 0\r\nv 1 \\\r\n1 \\\r\n0\r\nv 0 1 0\r\n\r\n"
          "f  1\t2 3 \r\nf 1 \\\r\n 3 4 ");
  EXPECT_EQ(m.mesh.positions, expected.mesh.positions);
  EXPECT_EQ(triangles(m), triangles(expected));
  const Import cr = obj("v 0 0 0\rv 1 0 0\rv 1 1 0\rf 1 2 3\r");
  EXPECT_EQ(triangles(cr).size(), 1u);
}

TEST(Obj, PartsAreObjectGroupAndMaterialInOrderOfUse) {
  const Import m =
      obj(std::string(k_square) +
          "o oak\nusemtl bark\nf 1 2 3\ng leaf one\nusemtl leaf green\nf 1 3 4\nusemtl bark\nf 1 2 4\n"
          "g\nf 2 3 4\nusemtl\nf 1 2 3\n");
  EXPECT_EQ(m.mesh.parts,
            (std::vector<Part>{
                {"oak", "", 0}, {"oak", "leaf one", 1}, {"oak", "leaf one", 0}, {"oak", "", k_none}}));
  EXPECT_EQ(m.mesh.part_of, (std::vector<std::uint32_t>{0, 1, 2, 0, 3}));
  ASSERT_EQ(m.mesh.materials.size(), 2u);
  EXPECT_EQ(m.mesh.materials[0].name, "bark");
  EXPECT_EQ(m.mesh.materials[1].name, "leaf green");
}

TEST(Obj, ObjectsOfOneNameAreApartAndGroupsOfOneNameInAnObjectAreOne) {
  const Import m = obj(std::string(k_square) +
                       "f 1 2 3\no oak\nf 1 2 3\ng leaves\nf 1 3 4\nusemtl bark\nf 1 2 4\ng bark\nf 2 3 4\n"
                       "g leaves\nf 1 2 3 4\ng\no oak\nf 1 2 3\n");
  ASSERT_EQ(m.groups.size(), 4u);
  const std::vector<std::pair<std::string, std::uint32_t>> expected{
      {"oak", k_none}, {"leaves", 0}, {"bark", 0}, {"oak", k_none}};
  for (std::size_t g = 0; g < expected.size(); ++g) {
    EXPECT_EQ(m.groups[g].name, expected[g].first);
    EXPECT_EQ(m.groups[g].parent, expected[g].second);
  }
  EXPECT_EQ(m.group_of, (std::vector<std::uint32_t>{k_none, 0, 1, 1, 2, 1, 1, 3}));
  EXPECT_TRUE(obj(std::string(k_square) + "f 1 2 3\n").groups.empty());
}

TEST(Obj, PolygonsAreCutAndRemembered) {
  const Import m = obj(std::string(k_square) + "v 0.5 2 0\nf 1 2 3\nf 1 2 3 4\nf 1 2 3 5 4\nf 2 3 4\n");
  EXPECT_EQ(m.counts.cut_polygons, 2u);
  EXPECT_EQ(m.mesh.triangles.size(), 7u);
  EXPECT_EQ(m.mesh.face_of, (std::vector<std::uint32_t>{0, 1, 1, 2, 2, 2, 3}));
  EXPECT_TRUE(m.warnings.empty());
}

TEST(Obj, CornersOfACutPolygonKeepTheirNormalsAndTexcoords) {
  const Import m =
      obj(std::string(k_square) + "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\nf 1/1/1 2/2/1 3/3/1 4/4/1\n");
  EXPECT_EQ(m.mesh.texcoord_triangles, m.mesh.triangles);
  EXPECT_EQ(m.mesh.normal_triangles, (std::vector<Triangle>(2, {0, 0, 0})));
}

TEST(Obj, RepeatedCornersAreMergedAndFacesWithoutAreaOfIndicesDropped) {
  const Import m = obj(std::string(k_square) + "f 1 2 2 3\nf 1 1 2\nf 1 2\nf 1 2 1 2\nf 1 2 3\n");
  EXPECT_EQ(triangles(m), (std::vector<Triangle>{{0, 1, 2}, {0, 1, 2}}));
  EXPECT_EQ(m.counts.dropped_faces, 3u);
  EXPECT_EQ(m.mesh.face_of, (std::vector<std::uint32_t>{0, 4}));
  EXPECT_EQ(m.warnings,
            (std::vector<std::string>{
                "line 6: the face has 3 corners, fewer than 3 of them distinct (faces dropped: 3)"}));
}

TEST(Obj, FacesThatNameMissingVerticesAreDroppedWithACount) {
  const Import m =
      obj("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\nf 1 2 3\nf 0 1 2\nf -4 1 2\nf 1 2 99999999999999999999\n");
  EXPECT_EQ(triangles(m), (std::vector<Triangle>{{0, 1, 2}}));
  EXPECT_EQ(m.counts.dropped_faces, 4u);
  EXPECT_EQ(m.warnings,
            (std::vector<std::string>{"line 4: the face names vertex 9 of 3 (faces dropped: 4)"}));
  EXPECT_EQ(
      refusal("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n", true),
      "import: error: tree: line 4: the face names vertex 9 of 3; export the mesh again, or drop --strict to "
      "leave it out");
}

TEST(Obj, TextureAndNormalIndicesOutOfRangeAreDroppedWithACount) {
  const std::string text =
      std::string(k_square) + "vt 0 0\nvn 0 0 1\nf 1/1/1 2/298/1 3/1/0\nf 1/2/3 2/-9/-9 4/1/1\n";
  const Import m = obj(text);
  EXPECT_EQ(m.counts.dropped_texcoords, 3u);
  EXPECT_EQ(m.counts.dropped_normals, 3u);
  EXPECT_EQ(m.mesh.texcoord_triangles, (std::vector<Triangle>{{0, k_none, 0}, {k_none, k_none, 0}}));
  EXPECT_EQ(m.warnings,
            (std::vector<std::string>{
                "line 7: the face names texture coordinate 298 of 1 (texture coordinates dropped: 3)",
                "line 7: the face names normal 0 of 1 (normals dropped: 3)"}));
  EXPECT_EQ(refusal(text, true),
            "import: error: tree: line 7: the face names texture coordinate 298 of 1; export the mesh again, "
            "or drop "
            "--strict to leave it out");
}

TEST(Obj, WhenEveryTextureIndexIsMissingThereAreNoneLeft) {
  EXPECT_TRUE(obj(std::string(k_square) + "vt 0 0\nf 1/5 2/5 3/5\n").mesh.texcoord_triangles.empty());
}

TEST(Obj, ACoordinateThatIsNotFiniteIsAlwaysRefused) {
  EXPECT_EQ(refusal("v 0 0 0\nv 1 nan 0\n"),
            "import: error: tree: line 2: vertex 2 is not finite: '1 nan 0'; export the mesh again");
  for (const char* word : {"inf", "-inf", "1e999", "1.#QNAN"})
    EXPECT_NE(refusal(std::string("v 0 0 ") + word + "\n").find("line 1: vertex 1 is not finite"),
              std::string::npos);
}

TEST(Obj, ANormalOrTexcoordThatIsNotFiniteIsDroppedOrRefused) {
  const std::string text =
      std::string(k_square) + "vn nan nan nan\nvn 0 0 1\nvt 1e39 0\nvt 0 0\nf 1/1/1 2/2/2 3/2/1\n";
  const Import m = obj(text);
  EXPECT_EQ(m.mesh.normal_triangles, (std::vector<Triangle>{{k_none, 1, k_none}}));
  EXPECT_EQ(m.mesh.texcoord_triangles, (std::vector<Triangle>{{k_none, 1, 1}}));
  EXPECT_EQ(m.counts.dropped_normals, 2u);
  EXPECT_EQ(m.counts.dropped_texcoords, 1u);
  expect_sound(m.mesh);
  EXPECT_EQ(refusal(text, true),
            "import: error: tree: line 5: the normal is not finite; export the mesh again, or drop --strict "
            "to leave "
            "it out");
}

TEST(Obj, DamagedStatementsAreRefusedWithTheirLine) {
  EXPECT_EQ(refusal("v 0 0\n"),
            "import: error: tree: line 1: the vertex has too few numbers; export the mesh again");
  EXPECT_EQ(refusal("v 0 0 0\nv 1 x 0\n"),
            "import: error: tree: line 2: the vertex's 'x' is not a number; export the mesh again");
  EXPECT_EQ(refusal("v 0 0 0\nf 1 b 2\n"),
            "import: error: tree: line 2: 'b' is not a corner of a face; export the mesh again");
  EXPECT_EQ(refusal("v 0 0 0\nf 1/2/3/4 1 1\n"),
            "import: error: tree: line 2: '1/2/3/4' is not a corner of a face; export the mesh again");
  EXPECT_EQ(refusal("vn 0 0\n"),
            "import: error: tree: line 1: the normal has too few numbers; export the mesh again");
}

TEST(Obj, LinesPointsCurvesAndUnknownStatementsAreSkippedWithAWarning) {
  const Import m = obj(std::string(k_square) + "l 1 2\np 1\ncstype bspline\nf 1 2 3\nwat 3\ns off\nlod 1\n");
  EXPECT_EQ(triangles(m).size(), 1u);
  EXPECT_EQ(m.warnings, (std::vector<std::string>{"line 5: not a face (lines and points skipped: 2)",
                                                  "line 7: 'cstype' is not read; convert curves and surfaces "
                                                  "to a mesh (statements of free-form geometry "
                                                  "skipped: 1)",
                                                  "line 9: 'wat' (unknown statements skipped: 1)"}));
}

TEST(Obj, AFileThatIsSomethingElseIsRefused) {
  EXPECT_EQ(refusal("<html>\n<body>\n"),
            "import: error: tree: line 1: '<html>' is not a statement of an OBJ file; give the file the "
            "extension of its "
            "true format");
}

TEST(Obj, AnUnknownStatementOverSeveralLinesIsQuotedWhole) {
  EXPECT_EQ(refusal("wat\\\n now\nso\\\n on\n"),
            "import: error: tree: line 1: 'wat' is not a statement of an OBJ file; give the file the "
            "extension of its "
            "true format");
}

TEST(Obj, AnEmptyMeshIsAMeshWithoutTriangles) {
  const Import m = obj("# nothing\n");
  EXPECT_TRUE(m.mesh.positions.empty());
  EXPECT_TRUE(m.mesh.triangles.empty());
  EXPECT_EQ(obj(k_square).mesh.positions.size(), 4u);
}

TEST(Obj, ALongNameCannotBeMultiplied) {
  EXPECT_NE(refusal("o " + std::string(5000, 'x') + "\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n")
                .find("4096 are allowed"),
            std::string::npos);
  std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\no " + std::string(4000, 'x') + "\n";
  for (int i = 0; i < 20'000; ++i) text += "g " + std::to_string(i) + "\nf 1 2 3\n";
  EXPECT_NE(refusal(text).find("the names of its parts take more than"), std::string::npos);
}

TEST(Obj, NamesBecomeUtf8) {
  EXPECT_EQ(obj(std::string(k_square) + "o \xe9rable\nf 1 2 3\n").mesh.parts[0].object, "\xc3\xa9rable");
}

}  // namespace
}  // namespace copse
