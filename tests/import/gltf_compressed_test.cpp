// Draco and meshoptimizer, against what their own encoders make.
#include "lib/formats/import/gltf/draco.h"
#include "lib/formats/import/gltf/meshopt.h"
#include "tests/import/gltf_maker.h"

#include <cmath>

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <meshoptimizer.h>

namespace copse {
namespace {

using namespace copse::testing;

// A tube of 12 sides: positions, normals and texture coordinates of every corner.
struct Soup {
  std::vector<std::array<float, 3>> positions, normals;
  std::vector<std::array<float, 2>> uvs;
};

Soup tube(int rings) {
  Soup soup;
  const auto corner = [&](int ring, int side) {
    const float a = 0.5235988f * static_cast<float>(side);
    soup.positions.push_back({std::cos(a), static_cast<float>(ring), std::sin(a)});
    soup.normals.push_back({std::cos(a), 0, std::sin(a)});
    soup.uvs.push_back({static_cast<float>(side) / 12, static_cast<float>(ring) / static_cast<float>(rings)});
  };
  for (int ring = 0; ring < rings; ++ring) {
    for (int side = 0; side < 12; ++side) {
      for (const auto& [r, s] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 0}, {1, 1}, {0, 1}})
        corner(ring + r, side + s);
    }
  }
  return soup;
}

struct Packed {
  std::string bytes;
  int position, normal, uv;  // unique ids
  std::size_t points, faces;
};

Packed draco_of(const Soup& soup, int method) {
  draco::TriangleSoupMeshBuilder builder;
  const auto faces = static_cast<int>(soup.positions.size() / 3);
  builder.Start(faces);
  const int p = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const int n = builder.AddAttribute(draco::GeometryAttribute::NORMAL, 3, draco::DT_FLOAT32);
  const int t = builder.AddAttribute(draco::GeometryAttribute::TEX_COORD, 2, draco::DT_FLOAT32);
  for (int f = 0; f < faces; ++f) {
    const auto i = static_cast<std::size_t>(3 * f);
    const draco::FaceIndex face(static_cast<std::uint32_t>(f));
    builder.SetAttributeValuesForFace(p, face, &soup.positions[i], &soup.positions[i + 1],
                                      &soup.positions[i + 2]);
    builder.SetAttributeValuesForFace(n, face, &soup.normals[i], &soup.normals[i + 1], &soup.normals[i + 2]);
    builder.SetAttributeValuesForFace(t, face, &soup.uvs[i], &soup.uvs[i + 1], &soup.uvs[i + 2]);
  }
  const auto mesh = builder.Finalize();
  draco::Encoder encoder;
  encoder.SetEncodingMethod(method);
  encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 16);
  encoder.SetAttributeQuantization(draco::GeometryAttribute::NORMAL, 12);
  encoder.SetAttributeQuantization(draco::GeometryAttribute::TEX_COORD, 14);
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
  const auto id = [&](int attribute) { return static_cast<int>(mesh->attribute(attribute)->unique_id()); };
  return {std::string(buffer.data(), buffer.size()),
          id(p),
          id(n),
          id(t),
          encoder.num_encoded_points(),
          encoder.num_encoded_faces()};
}

GltfMaker with_draco(const Packed& packed) {
  GltfMaker maker;
  maker.json["extensionsRequired"] = {"KHR_draco_mesh_compression"};
  const int view = maker.view(std::vector<char>(packed.bytes.begin(), packed.bytes.end()));
  // As every encoder writes it: the accessors say what to expect, and have no buffer view.
  const auto accessor = [&](int type, std::size_t count, const char* shape) {
    return maker.add("accessors", {{"componentType", type}, {"count", count}, {"type", shape}});
  };
  maker.show(
      {{"attributes",
        {{"POSITION", accessor(5126, packed.points, "VEC3")},
         {"NORMAL", accessor(5126, packed.points, "VEC3")},
         {"TEXCOORD_0", accessor(5126, packed.points, "VEC2")}}},
       {"indices", accessor(5125, packed.faces * 3, "SCALAR")},
       {"extensions",
        {{"KHR_draco_mesh_compression",
          {{"bufferView", view},
           {"attributes",
            {{"POSITION", packed.position}, {"NORMAL", packed.normal}, {"TEXCOORD_0", packed.uv}}}}}}}});
  return maker;
}

class Draco : public ::testing::TestWithParam<int> {};

TEST_P(Draco, EveryCornerComesBackWithinItsQuantization) {
  const Soup soup = tube(10);
  const Packed packed = draco_of(soup, GetParam());
  const Import m = with_draco(packed).import();
  expect_sound(m.mesh);
  ASSERT_EQ(m.mesh.triangles.size(), soup.positions.size() / 3);
  // Draco puts the faces into another order: compare each with the nearest of the input, by its three
  // corners.
  double worst = 0, worst_normal = 0, worst_uv = 0;
  for (std::size_t f = 0; f < m.mesh.triangles.size(); ++f) {
    double best = 1e300, best_normal = 0, best_uv = 0;
    for (std::size_t g = 0; g < soup.positions.size(); g += 3) {
      for (std::size_t turn = 0; turn < 3; ++turn) {
        double error = 0, normal_error = 0, uv_error = 0;
        for (std::size_t c = 0; c < 3; ++c) {
          const std::size_t k = g + (c + turn) % 3;
          const Double3& p = m.mesh.positions[m.mesh.triangles[f][c]];
          const Double3 n = to_double(m.mesh.normals[m.mesh.normal_triangles[f][c]]);
          const Float2 t = m.mesh.texcoords[m.mesh.texcoord_triangles[f][c]];
          error += distance(p, {soup.positions[k][0], soup.positions[k][1], soup.positions[k][2]});
          normal_error += distance(n, {soup.normals[k][0], soup.normals[k][1], soup.normals[k][2]});
          uv_error += std::abs(t.x - soup.uvs[k][0]) + std::abs(1 - t.y - soup.uvs[k][1]);
        }
        if (error < best) best = error, best_normal = normal_error, best_uv = uv_error;
      }
    }
    worst = std::max(worst, best);
    worst_normal = std::max(worst_normal, best_normal);
    worst_uv = std::max(worst_uv, best_uv);
  }
  EXPECT_LT(worst, 3 * 3 * 10.0 / 65535);
  EXPECT_LT(worst_normal, 3 * 0.005);
  EXPECT_LT(worst_uv, 3 * 4.0 / 16383);
}

TEST_P(Draco, InstancesDecodeToTheSame) {
  GltfMaker maker = with_draco(draco_of(tube(3), GetParam()));
  maker.json["nodes"].push_back({{"mesh", 0}, {"translation", {100, 0, 0}}});
  maker.json["scenes"][0]["nodes"].push_back(1);
  const Import m = maker.import();
  const std::size_t half = m.mesh.positions.size() / 2;
  for (std::size_t i = 0; i < half; ++i)
    EXPECT_NEAR(distance(m.mesh.positions[i] + Double3{100, 0, 0}, m.mesh.positions[half + i]), 0, 1e-9);
}

TEST_P(Draco, EveryTruncationAndManyMutationsAreRefusedOrSound) {
  const Packed packed = draco_of(tube(4), GetParam());
  const auto bytes = as_bytes(packed.bytes);
  for (std::size_t size = 0; size < bytes.size(); ++size) {
    DracoMesh mesh;
    mesh.decode(bytes.first(size));
  }
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    for (const int flip : {1, 0x80, 0xff}) {
      Packed bent = packed;
      bent.bytes[i] = static_cast<char>(bent.bytes[i] ^ flip);
      if (const auto result = with_draco(bent).read()) expect_sound(result->mesh);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Methods, Draco,
                         ::testing::Values(draco::MESH_SEQUENTIAL_ENCODING,
                                           draco::MESH_EDGEBREAKER_ENCODING));

TEST(DracoHeader, ImplausibleCountsAreRefusedBeforeMemoryIsTaken) {
  const auto reason = [](std::string bytes) {
    DracoMesh mesh;
    return mesh.decode(as_bytes(bytes));
  };
  using namespace std::string_literals;
  EXPECT_EQ(reason("nothing"), "is no Draco bitstream");
  EXPECT_EQ(reason("DRACO\1\3\1\1\0\0"s), "is a Draco bitstream of version 1.3, and glTF allows 2.2 only");
  EXPECT_EQ(reason("DRACO\2\2\0\1\0\0"s), "is a Draco point cloud, no mesh");
  EXPECT_EQ(reason("DRACO\2\2\1\1\0\0"s), "ends in the middle of its header");
  EXPECT_EQ(reason("DRACO\2\2\1\1\0\0\0\xff\xff\xff\xff\x0f\x03"s),
            "claims 4294967295 points and 3 faces in 18 bytes");
  EXPECT_EQ(reason("DRACO\2\2\1\0\0\0\xff\xff\xff\x7f\x03"s),
            "claims 3 points and 268435455 faces in 16 bytes");
  // With metadata in front: one entry a=b and one nested block.
  EXPECT_EQ(reason("DRACO\2\2\1\0\0\x80\0\1\1a\1b\1\1c\0\0\xff\xff\xff\x7f\x03"s).substr(0, 6), "claims");
}

TEST(DracoHeader, AWrongAttributeIsRefused) {
  Packed packed = draco_of(tube(2), draco::MESH_EDGEBREAKER_ENCODING);
  packed.normal = 77;
  EXPECT_NE(with_draco(packed).refusal().find("NORMAL: its Draco mesh has no such attribute 77"),
            std::string::npos);
}

// --- meshoptimizer
// -----------------------------------------------------------------------------------------------

template <class Number>
int packed_view(GltfMaker& maker, const std::vector<Number>& numbers, std::size_t stride, const char* mode,
                const char* filter = nullptr) {
  const std::size_t count = numbers.size() * sizeof(Number) / stride;
  std::vector<std::uint8_t> bytes;
  if (std::string(mode) == "ATTRIBUTES") {
    bytes.resize(meshopt_encodeVertexBufferBound(count, stride));
    bytes.resize(meshopt_encodeVertexBuffer(bytes.data(), bytes.size(), numbers.data(), count, stride));
  } else {
    const std::vector<unsigned> indices(numbers.begin(), numbers.end());
    bytes.resize(meshopt_encodeIndexBufferBound(count, 100));
    bytes.resize(std::string(mode) == "TRIANGLES"
                     ? meshopt_encodeIndexBuffer(bytes.data(), bytes.size(), indices.data(), count)
                     : meshopt_encodeIndexSequence(bytes.data(), bytes.size(), indices.data(), count));
  }
  const int view = maker.view(bytes);
  Json extension = maker.json["bufferViews"].back();
  extension.update({{"byteStride", stride}, {"count", count}, {"mode", mode}});
  if (filter != nullptr) extension["filter"] = filter;
  maker.json["bufferViews"].back() = {{"buffer", 1},
                                      {"byteLength", count * stride},
                                      {"extensions", {{"EXT_meshopt_compression", extension}}}};
  maker.json["buffers"] = {
      {{"byteLength", maker.bin.size()}},
      {{"byteLength", 1}, {"extensions", {{"EXT_meshopt_compression", {{"fallback", true}}}}}}};
  return view;
}

GltfMaker with_meshopt(const char* index_mode) {
  GltfMaker maker;
  maker.json["extensionsRequired"] = {"EXT_meshopt_compression"};
  const int positions = packed_view<float>(maker, {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0}, 12, "ATTRIBUTES");
  const int indices = packed_view<std::uint16_t>(maker, {0, 1, 2, 0, 2, 3}, 2, index_mode);
  const int p = maker.add(
      "accessors", {{"bufferView", positions}, {"componentType", 5126}, {"count", 4}, {"type", "VEC3"}});
  const int i = maker.add(
      "accessors", {{"bufferView", indices}, {"componentType", 5123}, {"count", 6}, {"type", "SCALAR"}});
  maker.show({{"attributes", {{"POSITION", p}}}, {"indices", i}});
  return maker;
}

TEST(Meshopt, AttributesTrianglesAndIndexSequences) {
  for (const char* mode : {"TRIANGLES", "INDICES"}) {
    const Import m = with_meshopt(mode).import();
    EXPECT_EQ(m.mesh.positions, (std::vector<Double3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
    ASSERT_EQ(m.mesh.triangles.size(), 2u);
    for (const Triangle& t : m.mesh.triangles) {
      const auto& p = m.mesh.positions;
      EXPECT_EQ(cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]).z, 1) << mode;
    }
  }
}

TEST(Meshopt, TheExponentialAndOctahedralFiltersAreUndone) {
  std::vector<float> wanted{0.5f, -0.25f, 3, 1, 2, -4, 0.125f, 0, 8};
  std::vector<std::uint32_t> coded(9);
  meshopt_encodeFilterExp(coded.data(), 3, 12, 20, wanted.data());
  GltfMaker maker;
  const int view = packed_view(maker, coded, 12, "ATTRIBUTES", "EXPONENTIAL");
  std::vector<float> normals{0, 0, 1, 0, 1, 0, 0, 0, 0, -1, 0, 0};
  std::vector<std::int8_t> octahedral(12);
  meshopt_encodeFilterOct(octahedral.data(), 3, 4, 8, normals.data());
  const int normal_view = packed_view(maker, octahedral, 4, "ATTRIBUTES", "OCTAHEDRAL");
  const int p =
      maker.add("accessors", {{"bufferView", view}, {"componentType", 5126}, {"count", 3}, {"type", "VEC3"}});
  const int n = maker.add("accessors", {{"bufferView", normal_view},
                                        {"componentType", 5120},
                                        {"count", 3},
                                        {"type", "VEC3"},
                                        {"normalized", true}});
  maker.show({{"attributes", {{"POSITION", p}, {"NORMAL", n}}}});
  const Import m = maker.import();
  for (std::size_t i = 0; i < 9; ++i)
    EXPECT_NEAR(m.mesh.positions[i / 3][static_cast<int>(i % 3)], wanted[i], 1e-5);
  EXPECT_NEAR(m.mesh.normals[0].z, 1, 0.02);
  EXPECT_NEAR(m.mesh.normals[1].x, 1, 0.02);
  EXPECT_NEAR(m.mesh.normals[2].y, -1, 0.02);
}

TEST(Meshopt, WhatTheDecodersWouldAssertIsRefused) {
  const std::vector<std::uint8_t> packed(64, 0xa0);
  std::vector<std::uint8_t> out;
  const auto reason = [&](MeshoptView view) { return decode_meshopt(packed, view, out); };
  EXPECT_EQ(reason({.count = 4, .stride = 12, .mode = "MAGIC", .filter = ""}),
            "the mode 'MAGIC' is not known");
  EXPECT_EQ(reason({.count = 4, .stride = 10, .mode = "ATTRIBUTES", .filter = ""}),
            "byteStride 10 does not fit mode ATTRIBUTES");
  EXPECT_EQ(reason({.count = 4, .stride = 260, .mode = "ATTRIBUTES", .filter = ""}),
            "byteStride 260 does not fit mode ATTRIBUTES");
  EXPECT_EQ(reason({.count = 4, .stride = 3, .mode = "INDICES", .filter = ""}),
            "byteStride 3 does not fit mode INDICES");
  EXPECT_EQ(reason({.count = 4, .stride = 2, .mode = "TRIANGLES", .filter = ""}),
            "4 indices are no triangles");
  EXPECT_EQ(reason({.count = 4, .stride = 12, .mode = "ATTRIBUTES", .filter = "OCTAHEDRAL"}),
            "the filter 'OCTAHEDRAL' does not fit");
  EXPECT_EQ(reason({.count = 1u << 30, .stride = 12, .mode = "ATTRIBUTES", .filter = ""}),
            "64 packed bytes cannot hold 1073741824 elements of 12 bytes");
  EXPECT_EQ(reason({.count = 16, .stride = 12, .mode = "ATTRIBUTES", .filter = ""}).substr(0, 28),
            "the packed data are damaged ");
  EXPECT_EQ(reason({.count = 0, .stride = 12, .mode = "ATTRIBUTES", .filter = ""}), "");
}

}  // namespace
}  // namespace copse
