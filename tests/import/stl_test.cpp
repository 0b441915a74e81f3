#include "tests/import/testing.h"

#include <cmath>
#include <cstring>
#include <limits>

namespace copse {
namespace {

using namespace copse::testing;

Import stl(const std::string& text) {
  return good(read(text, MeshFormat::stl));
}
std::string refusal(const std::string& text, bool strict = false) {
  return error_of(read(text, MeshFormat::stl, strict));
}

std::string facet(const std::string& a, const std::string& b, const std::string& c) {
  return "facet normal 0 0 1\n outer loop\n  vertex " + a + "\n  vertex " + b + "\n  vertex " + c +
         "\n endloop\nendfacet\n";
}

std::string binary(const std::vector<std::array<float, 9>>& facets,
                   const std::string& header = "made by hand") {
  std::string out = header;
  out.resize(80, ' ');
  const auto count = static_cast<std::uint32_t>(facets.size());
  out.append(reinterpret_cast<const char*>(&count), 4);
  for (const auto& f : facets) {
    out.append(12, '\0');
    out.append(reinterpret_cast<const char*>(f.data()), sizeof f);
    out.append(2, '\x7f');
  }
  return out;
}

const std::vector<std::array<float, 9>> k_two{{0, 0, 0, 1, 0, 0, 1, 1, 0}, {0, 0, 0, 1, 1, 0, 0, 1, 0}};

TEST(Stl, TextFacetsShareTheVerticesThatAreEqual) {
  const Import m = stl("solid oak tree\n" + facet("0 0 0", "1 0 0", "1e0 1 0") +
                       facet("-0 0 0", "1 1 0", "0 1 0") + "endsolid\n");
  EXPECT_EQ(m.mesh.positions, (std::vector<Double3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(triangles(m), (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(m.mesh.parts, (std::vector<Part>{{"oak tree", "", k_none}}));
}

TEST(Stl, VerticesThatDifferInTheLastBitStayApart) {
  const float next = std::nextafter(1.0f, 2.0f);
  const Import m = stl(binary({{0, 0, 0, 1, 0, 0, 1, 1, 0}, {0, 0, 0, next, 0, 0, 1, 1, 0}}));
  EXPECT_EQ(m.mesh.positions.size(), 4u);
}

TEST(Stl, EverySolidIsAnObject) {
  const Import m = stl("SOLID a\n" + facet("0 0 0", "1 0 0", "0 1 0") + "ENDSOLID a\nsolid b\n" +
                       facet("0 0 0", "1 0 0", "0 0 1") + "endsolid b\n");
  EXPECT_EQ(m.mesh.parts, (std::vector<Part>{{"a", "", k_none}, {"b", "", k_none}}));
  EXPECT_EQ(m.mesh.part_of, (std::vector<std::uint32_t>{0, 1}));
  EXPECT_EQ(m.mesh.positions.size(), 4u);
}

TEST(Stl, BinaryFacetsEvenWhenTheirHeaderSaysSolid) {
  for (const char* header : {"made by hand", "solid of a certain exporter"}) {
    const Import m = stl(binary(k_two, header));
    EXPECT_EQ(m.mesh.positions.size(), 4u);
    EXPECT_EQ(triangles(m), (std::vector<Triangle>{{0, 1, 2}, {0, 2, 3}}));
    EXPECT_TRUE(m.warnings.empty());
  }
}

TEST(Stl, EveryTruncationIsRefused) {
  const std::string file = binary(k_two);
  for (std::size_t size = 1; size < file.size(); ++size)
    EXPECT_FALSE(read(file.substr(0, size), MeshFormat::stl)) << size;
  EXPECT_EQ(refusal(file.substr(0, 183)),
            "import: error: tree: has 183 bytes, and its 2 triangles need 184; copy the file again: its end "
            "is missing");
  const std::string text =
      "solid a\n" + facet("0 0 0", "1 0 0", "0 1 0") + facet("0 0 0", "1 0 0", "0 1 0") + "endsolid a";
  for (std::size_t size = 1; size + 2 < text.size(); ++size)
    EXPECT_FALSE(read(text.substr(0, size), MeshFormat::stl)) << size;
  EXPECT_EQ(refusal("solid a\n" + facet("0 0 0", "1 0 0", "0 1 0")),
            "import: error: tree: ends before 'endsolid'; copy the file again: its end is missing");
}

TEST(Stl, BytesAfterTheEndAreAWarning) {
  EXPECT_EQ(stl(binary(k_two) + "tail").warnings,
            (std::vector<std::string>{"byte 184: data follow the last triangle (bytes after the end: 1)"}));
}

TEST(Stl, FacetsWithoutAreaOfVerticesAreDroppedOrRefused) {
  const std::string file = binary({k_two[0], {0, 0, 0, 1, 0, 0, 1, 0, 0}});
  const Import m = stl(file);
  EXPECT_EQ(m.counts.dropped_faces, 1u);
  EXPECT_EQ(m.warnings,
            (std::vector<std::string>{
                "triangle 1: the face has 3 corners, fewer than 3 of them distinct (faces dropped: 1)"}));
  EXPECT_NE(refusal(file, true).find("triangle 1: the face has 3 corners"), std::string::npos);
}

TEST(Stl, CoordinatesThatAreNotFiniteAreRefused) {
  auto facets = k_two;
  facets[1][4] = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(refusal(binary(facets)),
            "import: error: tree: triangle 1: a vertex is not finite; export the mesh again");
  EXPECT_EQ(refusal("solid a\n" + facet("0 0 0", "1 inf 0", "0 1 0") + "endsolid\n"),
            "import: error: tree: line 5: the vertex is not finite; export the mesh again");
}

TEST(Stl, DamagedTextIsRefusedWithItsLine) {
  EXPECT_EQ(refusal("solid a\nwat\n"),
            "import: error: tree: line 2: 'wat' is not known in an STL file; export the mesh again");
  EXPECT_EQ(refusal("solid a\n" + facet("0 0", "1 0 0", "0 1 0")),
            "import: error: tree: line 4: the vertex is not three numbers; export the mesh again");
  EXPECT_EQ(refusal("solid a\nendsolid\nvertex 0 0 0\n"),
            "import: error: tree: line 3: a vertex outside a solid; export the mesh again");
  EXPECT_EQ(refusal("solid a\nendsolid\nendloop\n"),
            "import: error: tree: line 3: a loop outside a solid; export the mesh again");
  EXPECT_EQ(refusal("solid a\nfacet\nvertex 0 0 0\nendfacet\n"),
            "import: error: tree: line 4: 'endfacet' in the middle of a loop; export the mesh again");
  EXPECT_EQ(refusal("solid a\nvertex 0 0 0\nendsolid\n"),
            "import: error: tree: line 3: the solid ends in the middle of a loop; export the mesh again");
}

TEST(Stl, AnEmptySolidIsAMeshWithoutTriangles) {
  EXPECT_TRUE(stl("solid nothing\nendsolid nothing\n").mesh.triangles.empty());
  EXPECT_TRUE(stl(binary({})).mesh.triangles.empty());
}

}  // namespace
}  // namespace copse
