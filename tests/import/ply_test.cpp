#include "tests/import/testing.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace copse {
namespace {

using namespace copse::testing;

Import ply(const std::string& text) {
  return good(read(text, MeshFormat::ply));
}
std::string refusal(const std::string& text, bool strict = false) {
  return error_of(read(text, MeshFormat::ply, strict));
}

template <class Number>
void put(std::string& out, Number value, bool big = false) {
  auto bytes = std::bit_cast<std::array<char, sizeof(Number)>>(value);
  if (big) std::reverse(bytes.begin(), bytes.end());
  out.append(bytes.data(), bytes.size());
}

constexpr const char* k_ascii =
    "ply\nformat ascii 1.0\ncomment made by hand\nobj_info none\nelement vertex 4\nproperty float "
    "x\nproperty float y\n"
    "property float z\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
    "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n4 0 1 2 3\n";

TEST(Ply, AsciiVerticesAndFaces) {
  const Import m = ply(k_ascii);
  EXPECT_EQ(m.mesh.positions, (std::vector<Double3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
  EXPECT_EQ(triangles(m), (std::vector<Triangle>{{0, 1, 2}, {0, 1, 2}, {0, 2, 3}}));
  EXPECT_EQ(m.mesh.face_of, (std::vector<std::uint32_t>{0, 1, 1}));
  EXPECT_TRUE(m.warnings.empty());
}

TEST(Ply, HeadersMayEndTheirLinesAnyWay) {
  std::string dos, mac;
  for (const char* p = k_ascii; *p != 0; ++p) {
    dos += *p == '\n' ? std::string("\r\n") : std::string(1, *p);
    mac += *p == '\n' ? '\r' : *p;
  }
  EXPECT_EQ(triangles(ply(dos)), triangles(ply(k_ascii)));
  EXPECT_EQ(triangles(ply(mac)), triangles(ply(k_ascii)));
}

// Every number type, odd order, lists among the vertices, an extra element in front and one behind.
std::string rich(bool big) {
  std::string out =
      std::string("ply\r\nformat binary_") + (big ? "big" : "little") +
      "_endian 1.0\r\nelement camera 2\r\nproperty double fov\r\nproperty list int8 uint16 lens\r\n"
      "element vertex 3\r\nproperty uint8 red\r\nproperty double z\r\nproperty list uint16 int8 links\r\n"
      "property int16 x\r\nproperty float32 ny\r\nproperty float nx\r\nproperty float nz\r\n"
      "property ushort y\r\nproperty double t\r\nproperty float s\r\nelement face 1\r\n"
      "property int quality\r\nproperty list uint uint32 vertex_index\r\nproperty list uchar float extra\r\n"
      "element edge 1\r\nproperty int a\r\nend_header\r\n";
  for (int i = 0; i < 2; ++i) {
    put(out, 0.5, big);
    put(out, std::int8_t{2}, big);
    put(out, std::uint16_t{7}, big);
    put(out, std::uint16_t{8}, big);
  }
  for (int i = 0; i < 3; ++i) {
    put(out, std::uint8_t{255}, big);
    put(out, 0.1 + i, big);
    put(out, static_cast<std::uint16_t>(i), big);
    for (int k = 0; k < i; ++k) put(out, std::int8_t{-1}, big);
    put(out, static_cast<std::int16_t>(-5 * i), big);
    put(out, 1.0f, big);
    put(out, 0.0f, big);
    put(out, 0.0f, big);
    put(out, static_cast<std::uint16_t>(40000 * (i % 2)), big);
    put(out, 0.25, big);
    put(out, 0.75f, big);
  }
  put(out, 42, big);
  put(out, std::uint32_t{3}, big);
  for (const std::uint32_t i : {2u, 1u, 0u}) put(out, i, big);
  put(out, std::uint8_t{1}, big);
  put(out, 0.5f, big);
  put(out, 1, big);
  return out;
}

TEST(Ply, BothBinariesWithEveryTypeOrderAndExtraElement) {
  for (const bool big : {false, true}) {
    const Import m = ply(rich(big));
    EXPECT_EQ(m.mesh.positions, (std::vector<Double3>{{0, 0, 0.1}, {-5, 40000, 1.1}, {-10, 0, 2.1}}));
    EXPECT_EQ(triangles(m), (std::vector<Triangle>{{2, 1, 0}}));
    EXPECT_EQ(m.mesh.normals, (std::vector<Float3>(3, {0, 1, 0})));
    EXPECT_EQ(m.mesh.normal_triangles, m.mesh.triangles);
    EXPECT_EQ(m.mesh.texcoords, (std::vector<Float2>(3, {0.75f, 0.25f})));
    EXPECT_TRUE(m.warnings.empty());
  }
}

TEST(Ply, EveryTruncationIsRefused) {
  for (const std::string& text : {rich(false), rich(true)}) {
    for (std::size_t size = 4; size < text.size(); ++size)
      EXPECT_FALSE(read(text.substr(0, size), MeshFormat::ply)) << size;
  }
  const std::string ascii(k_ascii);
  for (std::size_t size = 4; size + 2 < ascii.size(); ++size)
    EXPECT_FALSE(read(ascii.substr(0, size), MeshFormat::ply)) << size;
}

TEST(Ply, FacesMayComeBeforeTheirVertices) {
  EXPECT_EQ(
      triangles(ply(
          "ply\nformat ascii 1.0\nelement face 1\nproperty list uchar int vertex_indices\nelement vertex 3\n"
          "property float x\nproperty float y\nproperty float z\nend_header\n3 0 1 2\n0 0 0 1 0 0 0 1 0\n")),
      (std::vector<Triangle>{{0, 1, 2}}));
}

TEST(Ply, TriangleStripsAreUnrolled) {
  const Import m =
      ply("ply\nformat ascii 1.0\nelement vertex 6\nproperty float x\nproperty float y\nproperty float z\n"
          "element tristrips 1\nproperty list int int vertex_indices\nend_header\n"
          "0 0 0 1 0 0 0 1 0 1 1 0 0 2 0 1 2 0\n9 0 1 2 3 -1 2 3 4 5\n");
  EXPECT_EQ(triangles(m), (std::vector<Triangle>{{0, 1, 2}, {1, 3, 2}, {2, 3, 4}, {3, 5, 4}}));
}

TEST(Ply, TexturesAndTexcoordsOfCornersAreRead) {
  const Import m = ply(
      "ply\nformat ascii 1.0\ncomment TextureFile bark.png\ncomment TextureFile leaf.png\nelement vertex 3\n"
      "property float x\nproperty float y\nproperty float z\nelement face 2\n"
      "property list uchar float texcoord\nproperty list uchar int vertex_indices\nproperty int "
      "texnumber\nend_header\n"
      "0 0 0 1 0 0 0 1 0\n6 0 0 1 0 0.5 1 3 0 1 2 1\n0 3 2 1 0 0\n");
  ASSERT_EQ(m.mesh.textures.size(), 2u);
  EXPECT_EQ(m.mesh.textures[1].uri, "leaf.png");
  EXPECT_EQ(m.mesh.parts, (std::vector<Part>{{"", "", 1}, {"", "", 0}}));
  EXPECT_EQ(m.mesh.texcoord_triangles, (std::vector<Triangle>{{0, 1, 2}, {k_none, k_none, k_none}}));
  EXPECT_EQ(m.mesh.texcoords, (std::vector<Float2>{{0, 0}, {1, 0}, {0.5f, 1}}));
}

TEST(Ply, PointsWithoutFacesAreAMeshWithoutTriangles) {
  const Import m =
      ply("ply\nformat ascii 1.0\nelement vertex 2\nproperty double x\nproperty double y\nproperty double z\n"
          "end_header\n1 2 3\n0.1 0.2 0.3\n");
  EXPECT_EQ(m.mesh.positions, (std::vector<Double3>{{1, 2, 3}, {0.1, 0.2, 0.3}}));
  EXPECT_TRUE(m.mesh.triangles.empty());
}

std::string face(const std::string& row) {
  return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float "
         "z\nelement face 1\n"
         "property list int int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n" +
         row;
}

TEST(Ply, FacesThatNameMissingVerticesAreDroppedOrRefused) {
  const Import m = ply(face("3 0 1 3\n"));
  EXPECT_EQ(m.counts.dropped_faces, 1u);
  EXPECT_EQ(m.warnings,
            (std::vector<std::string>{"line 13: the face names vertex 3 of 3 (faces dropped: 1)"}));
  EXPECT_EQ(ply(face("3 0 -1 2\n")).counts.dropped_faces, 1u);
  EXPECT_EQ(ply(face("2 0 1\n")).counts.dropped_faces, 1u);
  EXPECT_EQ(refusal(face("3 0 1 3\n"), true),
            "import: error: tree: line 13: the face names vertex 3 of 3; export the mesh again, or drop "
            "--strict to leave "
            "it out");
}

TEST(Ply, CountsThatTheFileIsTooShortForAreRefusedBeforeMemoryIsTaken) {
  EXPECT_EQ(refusal("ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nproperty float y\n"
                    "property float z\nend_header\n0 0 0\n"),
            "import: error: tree: claims 4000000000 of element 'vertex', but only 7 bytes are left for them; "
            "copy the file "
            "again: its end is missing");
  EXPECT_NE(refusal("ply\nformat ascii 1.0\nelement vertex 99999999999\nproperty float x\nproperty float y\n"
                    "property float z\nend_header\n")
                .find("claims 99999999999 of element"),
            std::string::npos);
  EXPECT_EQ(refusal(face("2000000000 0 1 2\n")),
            "import: error: tree: line 13: face 0: a list of 2000000000 does not fit into the rest of the "
            "file; export the "
            "mesh again");
  EXPECT_NE(refusal(face("-3 0 1 2\n")).find("a list of -3 does not fit"), std::string::npos);
}

TEST(Ply, AnElementWithoutPropertiesCostsNothing) {
  EXPECT_TRUE(ply("ply\nformat ascii 1.0\nelement nothing 4000000000\nelement vertex 0\nproperty float "
                  "x\nproperty float y\n"
                  "property float z\nend_header\n")
                  .mesh.positions.empty());
}

TEST(Ply, CoordinatesThatAreNotFiniteAreRefusedAndNormalsDropped) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
      "property float nx\nproperty float ny\nproperty float nz\nelement face 1\n"
      "property list int int vertex_indices\nend_header\n";
  EXPECT_EQ(refusal(head + "0 0 0 0 0 1\n1 nan 0 0 0 1\n0 1 0 0 0 1\n3 0 1 2\n"),
            "import: error: tree: line 14: vertex 1 is not finite; export the mesh again");
  const Import m = ply(head + "0 0 0 0 0 1\n1 0 0 inf 0 1\n0 1 0 0 0 1\n3 0 1 2\n");
  EXPECT_EQ(m.mesh.normal_triangles, (std::vector<Triangle>{{0, k_none, 2}}));
  EXPECT_EQ(m.counts.dropped_normals, 1u);
}

TEST(Ply, DamagedHeadersAreRefusedWithTheirLine) {
  const auto with = [](const std::string& line) {
    return refusal("ply\nformat ascii 1.0\n" + line + "\nend_header\n");
  };
  EXPECT_EQ(with("element vertex"),
            "import: error: tree: line 3: the element has no name or no count; export the mesh again");
  EXPECT_EQ(with("element vertex -1"), with("element vertex"));
  EXPECT_EQ(with("property float x"),
            "import: error: tree: line 3: the property belongs to no element; export the mesh again");
  EXPECT_EQ(with("wat"),
            "import: error: tree: line 3: 'wat' is not known in a PLY header; export the mesh again");
  EXPECT_EQ(with("element v 1\nproperty quad x"),
            "import: error: tree: line 4: the type 'quad' is not known; export the mesh again");
  EXPECT_EQ(with("element v 1\nproperty list float int x"),
            "import: error: tree: line 4: the list has no whole number for a count; export the mesh again");
  EXPECT_EQ(with("element face 0"), "import: error: tree: has no element 'vertex'; export the mesh again");
  EXPECT_EQ(with("element vertex 0\nproperty float x"),
            "import: error: tree: its vertices lack x, y or z; export the mesh again");
  EXPECT_EQ(refusal("ply\nformat ascii 2.0\nend_header\n"),
            "import: error: tree: line 2: PLY version '2.0' is not read; export the mesh again");
  EXPECT_EQ(refusal("ply\nformat pdp_endian 1.0\nend_header\n"),
            "import: error: tree: line 2: the format 'pdp_endian' is not known; export the mesh again");
  EXPECT_EQ(refusal("ply\nend_header\n"),
            "import: error: tree: line 2: the header names no format; export the mesh again");
  EXPECT_EQ(refusal("plyx\n"),
            "import: error: tree: line 1: the first line is not 'ply'; export the mesh again");
  EXPECT_EQ(refusal("ply\nformat ascii 1.0\n"),
            "import: error: tree: ends in the middle of its header; copy the file again");
}

TEST(Ply, IndicesThatAreNoWholeNumbersAreRefused) {
  EXPECT_NE(
      refusal(
          "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nproperty float y\nproperty float z\n"
          "element face 1\nproperty list int float vertex_indices\nend_header\n3 0 1 2\n")
          .find("has no list vertex_indices of whole numbers"),
      std::string::npos);
  EXPECT_NE(refusal(face("3 0 x 2\n")).find("line 13: face 0 holds what is not a number"), std::string::npos);
}

}  // namespace
}  // namespace copse
