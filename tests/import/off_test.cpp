#include "tests/import/testing.h"

namespace copse {
namespace {

using namespace copse::testing;

Import off(const std::string& text) {
  return good(read(text, MeshFormat::off));
}
std::string refusal(const std::string& text, bool strict = false) {
  return error_of(read(text, MeshFormat::off, strict));
}

constexpr const char* k_square =
    "OFF\n# a square\n4 2 5\n0 0 0\n1 0 0 # corner\n\n1 1 0\n0 1 0\n3 0 1 2\n4 0 1 2 3\n";

TEST(Off, VerticesAndFaces) {
  const Import m = off(k_square);
  EXPECT_EQ(m.mesh.positions.size(), 4u);
  EXPECT_EQ(triangles(m), (std::vector<Triangle>{{0, 1, 2}, {0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(m.mesh.face_of, (std::vector<std::uint32_t>{0, 1, 1}));
  EXPECT_TRUE(m.warnings.empty());
}

TEST(Off, TheKeywordAndTheCountOfEdgesMayBeMissing) {
  EXPECT_EQ(triangles(off("3 1\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")).size(), 1u);
  EXPECT_EQ(triangles(off("OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")).size(), 1u);
}

TEST(Off, ColoursOfVerticesAndFacesAreSkipped) {
  EXPECT_EQ(
      triangles(off("COFF\n3 1 0\n0 0 0 255 0 0 255\n1 0 0 0.5 0.5 0.5\n0 1 0 7\n3 0 1 2 255 0 0\n")).size(),
      1u);
}

TEST(Off, NormalsAndTexcoordsAreReadInGeomviewsOrder) {
  const Import m =
      off("STCNOFF\n3 1 0\n0 0 0 0 0 1 255 0 0 0.25 0.5\n1 0 0 0 1 0 255 0 0 255 1 0\n0 1 0 1 0 0 9 0 1\n3 0 "
          "1 2\n");
  EXPECT_EQ(m.mesh.normals, (std::vector<Float3>{{0, 0, 1}, {0, 1, 0}, {1, 0, 0}}));
  EXPECT_EQ(m.mesh.texcoords, (std::vector<Float2>{{0.25f, 0.5f}, {1, 0}, {0, 1}}));
  EXPECT_EQ(m.mesh.normal_triangles, m.mesh.triangles);
  EXPECT_EQ(m.mesh.texcoord_triangles, m.mesh.triangles);
}

TEST(Off, KindsThatAreNotReadAreRefusedByName) {
  EXPECT_EQ(refusal("OFF BINARY\n"),
            "import: error: tree: is a binary OFF; store it as a text OFF, or as a PLY");
  EXPECT_EQ(
      refusal("4OFF\n1 0 0\n"),
      "import: error: tree: line 1: '4OFF' is not read: only points in space are; export the mesh again");
  EXPECT_EQ(
      refusal("nOFF\n5\n"),
      "import: error: tree: line 1: 'nOFF' is not read: only points in space are; export the mesh again");
}

TEST(Off, EveryTruncationIsRefused) {
  const std::string text(k_square);
  for (std::size_t size = 0; size + 2 < text.size(); ++size)
    EXPECT_FALSE(read(text.substr(0, size), MeshFormat::off)) << size;
  EXPECT_EQ(refusal(text.substr(0, text.size() - 10)),
            "import: error: tree: ends after 4 of 4 vertices and 1 of 2 faces; copy the file again: its end "
            "is missing");
}

TEST(Off, DamagedLinesAreRefusedWithTheirNumber) {
  EXPECT_EQ(
      refusal("OFF\nx\n"),
      "import: error: tree: line 2: the counts of vertices and faces cannot be read; export the mesh again");
  EXPECT_EQ(refusal("OFF\n-1 0 0\n"), refusal("OFF\nx\n"));
  EXPECT_EQ(refusal("OFF\n4000000000 0 0\n"),
            "import: error: tree: line 2: 4000000000 vertices and 0 faces do not fit into 19 bytes; export "
            "the mesh again");
  EXPECT_EQ(refusal("OFF\n1 0 0\n0 0\n"),
            "import: error: tree: line 3: vertex 0 has 2 of 3 numbers; export the mesh again");
  EXPECT_EQ(refusal("OFF\n1 0 0\n0 a 0\n"),
            "import: error: tree: line 3: vertex 0 holds 'a', which is not a number; export the mesh again");
  EXPECT_EQ(refusal("OFF\n1 0 0\n0 inf 0\n"),
            "import: error: tree: line 3: vertex 0 is not finite; export the mesh again");
  EXPECT_EQ(refusal("OFF\n1 1 0\n0 0 0\n3 0 0\n"),
            "import: error: tree: line 4: the face has 2 of 3 corners; export the mesh again");
  EXPECT_EQ(refusal("OFF\n1 1 0\n0 0 0\n3 0 b 0\n"),
            "import: error: tree: line 4: 'b' is not a vertex's number; export the mesh again");
  EXPECT_EQ(refusal("OFF\n1 1 0\n0 0 0\nx\n"),
            "import: error: tree: line 4: the face's count of corners cannot be read; export the mesh again");
}

TEST(Off, FacesThatNameMissingVerticesAreDroppedOrRefused) {
  const std::string text = "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n3 0 1 2\n";
  const Import m = off(text);
  EXPECT_EQ(m.counts.dropped_faces, 1u);
  EXPECT_EQ(m.mesh.face_of, (std::vector<std::uint32_t>{1}));
  EXPECT_EQ(m.warnings,
            (std::vector<std::string>{"line 6: the face names vertex 3 of 3 (faces dropped: 1)"}));
  EXPECT_EQ(refusal(text, true),
            "import: error: tree: line 6: the face names vertex 3 of 3; export the mesh again, or drop "
            "--strict to leave it "
            "out");
}

}  // namespace
}  // namespace copse
