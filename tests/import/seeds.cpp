#include "tests/import/seeds.h"

#include "tests/import/gltf_maker.h"

#include <cmath>

#include <draco/compression/encode.h>
#include <draco/mesh/triangle_soup_mesh_builder.h>
#include <meshoptimizer.h>

namespace copse::testing {
namespace {

std::string binary_ply(const char* order) {
  std::string out =
      std::string("ply\nformat ") + order +
      " 1.0\ncomment TextureFile leaf.png\nelement camera 1\nproperty list uchar ushort lens\nelement vertex "
      "4\n"
      "property double x\nproperty float y\nproperty short z\nproperty uchar red\nproperty float nx\n"
      "property float ny\nproperty float nz\nelement face 2\nproperty int texnumber\n"
      "property list uchar uint vertex_indices\nproperty list uchar float texcoord\nelement tristrips 1\n"
      "property list int int vertex_indices\nend_header\n";
  const bool big = std::string(order) == "binary_big_endian";
  const auto put = [&](auto value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    if (big) std::reverse(bytes, bytes + sizeof value);
    out.append(bytes, sizeof value);
  };
  put(std::uint8_t{2});
  put(std::uint16_t{1});
  put(std::uint16_t{2});
  for (int i = 0; i < 4; ++i) {
    put(0.5 * (i % 2));
    put(0.25f * static_cast<float>(i / 2));
    put(static_cast<std::int16_t>(i));
    put(std::uint8_t{200});
    put(0.0f);
    put(0.0f);
    put(1.0f);
  }
  for (const std::uint8_t corners : {3, 4}) {
    put(std::int32_t{0});
    put(corners);
    for (std::uint32_t i = 0; i < corners; ++i) put(i);
    put(static_cast<std::uint8_t>(2 * corners));
    for (std::uint32_t i = 0; i < 2u * corners; ++i) put(0.1f * static_cast<float>(i));
  }
  put(std::int32_t{6});
  for (const std::int32_t i : {0, 1, 2, -1, 1, 3}) put(i);
  return out;
}

std::string binary_stl() {
  std::string out(80, ' ');
  const std::uint32_t count = 4;
  out.append(reinterpret_cast<const char*>(&count), 4);
  for (std::uint32_t i = 0; i < count; ++i) {
    const float t = static_cast<float>(i);
    const std::array<float, 12> facet{0, 0, 1, t, 0, 0, t + 1, 0, 0, t, 1, 0};
    out.append(reinterpret_cast<const char*>(facet.data()), sizeof facet).append(2, '\0');
  }
  return out;
}

GltfMaker plain_gltf() {
  GltfMaker maker;
  const int order = maker.accessor<std::uint16_t>({0, 1, 2, 0, 2, 3}, "SCALAR");
  const Json attributes = {
      {"POSITION", maker.square()},
      {"NORMAL", maker.accessor<std::int8_t>({0, 0, 127, 0, 0, 127, 0, 0, 127, 0, 0, 127}, "VEC3", true)},
      {"TEXCOORD_0", maker.accessor<std::uint16_t>({0, 0, 65535, 0, 65535, 65535, 0, 65535}, "VEC2", true)}};
  maker.add("images", {{"uri", "leaf.png"}});
  maker.add("textures", {{"source", 0}});
  const Json transform = {
      {"KHR_texture_transform", {{"offset", {0.5, 0}}, {"rotation", 0.1}, {"scale", {2, 2}}}}};
  maker.add("materials",
            {{"name", "leaf"},
             {"alphaMode", "BLEND"},
             {"emissiveFactor", {0, 0.5, 1}},
             {"pbrMetallicRoughness",
              {{"baseColorTexture", {{"index", 0}, {"extensions", transform}}}, {"roughnessFactor", 0.5}}}});
  maker.show(
      {{"attributes", attributes}, {"indices", order}, {"material", 0}},
      {{"name", "tree"}, {"translation", {1, 2, 3}}, {"rotation", {0, 0, 0.6, 0.8}}, {"scale", {-1, 1, 2}}});
  maker.json["meshes"][0]["primitives"].push_back({{"attributes", attributes}, {"mode", 5}});
  return maker;
}

GltfMaker rich_gltf() {
  GltfMaker maker = plain_gltf();
  const Json sparse = {{"count", 1},
                       {"indices", {{"bufferView", maker.view<std::uint8_t>({2})}, {"componentType", 5121}}},
                       {"values", {{"bufferView", maker.view<float>({5, 6, 7})}}}};
  maker.json["accessors"][1]["sparse"] = sparse;
  const Json places = {{"TRANSLATION", maker.accessor<float>({0, 0, 0, 5, 0, 0}, "VEC3")}};
  maker.json["nodes"][0]["extensions"] = {{"EXT_mesh_gpu_instancing", {{"attributes", places}}}};
  const Json skinned = {
      {"POSITION", maker.triangle()},
      {"JOINTS_0", maker.accessor<std::uint8_t>({0, 1, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0}, "VEC4")},
      {"WEIGHTS_0", maker.accessor<float>({1, 0, 0, 0, 1, 0, 0, 0, 0.5, 0.5, 0, 0}, "VEC4")}};
  maker.show({{"attributes", skinned}}, {{"skin", 0}});
  maker.add("nodes", {{"matrix", {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 9, 1}}, {"children", {3}}});
  maker.add("nodes", {{"mesh", 0}});
  maker.add("skins", {{"joints", {2, 3}}});
  maker.json["scenes"][0]["nodes"].push_back(2);
  return maker;
}

GltfMaker draco_gltf(int method) {
  draco::TriangleSoupMeshBuilder builder;
  constexpr int k_faces = 24;
  builder.Start(k_faces);
  const int p = builder.AddAttribute(draco::GeometryAttribute::POSITION, 3, draco::DT_FLOAT32);
  const int n = builder.AddAttribute(draco::GeometryAttribute::NORMAL, 3, draco::DT_FLOAT32);
  for (std::uint32_t f = 0; f < k_faces; ++f) {
    std::array<std::array<float, 3>, 3> v{}, up{};
    for (std::uint32_t c = 0; c < 3; ++c) {
      const float a = static_cast<float>((f / 2 + (f % 2 == 0 ? c / 2 : (c + 1) / 2)) % 12) * 0.5f;
      v[c] = {std::cos(a), static_cast<float>((f % 2 + c) % 2), std::sin(a)};
      up[c] = {std::cos(a), 0, std::sin(a)};
    }
    builder.SetAttributeValuesForFace(p, draco::FaceIndex(f), &v[0], &v[1], &v[2]);
    builder.SetAttributeValuesForFace(n, draco::FaceIndex(f), &up[0], &up[1], &up[2]);
  }
  const auto mesh = builder.Finalize();
  draco::Encoder encoder;
  encoder.SetEncodingMethod(method);
  encoder.SetAttributeQuantization(draco::GeometryAttribute::POSITION, 10);
  encoder.SetAttributeQuantization(draco::GeometryAttribute::NORMAL, 8);
  draco::EncoderBuffer buffer;
  EXPECT_TRUE(encoder.EncodeMeshToBuffer(*mesh, &buffer).ok());
  GltfMaker maker;
  const int view = maker.view(std::vector<char>(buffer.data(), buffer.data() + buffer.size()));
  const auto accessor = [&](const char* type, std::size_t count) {
    return maker.add("accessors", {{"componentType", 5126}, {"count", count}, {"type", type}});
  };
  const std::size_t points = encoder.num_encoded_points();
  maker.show({{"attributes", {{"POSITION", accessor("VEC3", points)}, {"NORMAL", accessor("VEC3", points)}}},
              {"indices", accessor("SCALAR", encoder.num_encoded_faces() * 3)},
              {"extensions",
               {{"KHR_draco_mesh_compression",
                 {{"bufferView", view}, {"attributes", {{"POSITION", 0}, {"NORMAL", 1}}}}}}}});
  return maker;
}

GltfMaker meshopt_gltf() {
  GltfMaker maker;
  const std::vector<float> positions{0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0};
  const std::vector<unsigned> indices{0, 1, 2, 0, 2, 3};
  std::vector<std::uint8_t> vertices(meshopt_encodeVertexBufferBound(4, 12)),
      order(meshopt_encodeIndexBufferBound(6, 4));
  vertices.resize(meshopt_encodeVertexBuffer(vertices.data(), vertices.size(), positions.data(), 4, 12));
  order.resize(meshopt_encodeIndexBuffer(order.data(), order.size(), indices.data(), 6));
  const auto add = [&](const std::vector<std::uint8_t>& bytes, int count, int stride, const char* mode) {
    const int view = maker.view(bytes);
    Json extension = maker.json["bufferViews"].back();
    extension.update({{"byteStride", stride}, {"count", count}, {"mode", mode}});
    maker.json["bufferViews"].back()["extensions"] = {{"EXT_meshopt_compression", extension}};
    return view;
  };
  const int p = add(vertices, 4, 12, "ATTRIBUTES");
  const int i = add(order, 6, 2, "TRIANGLES");
  maker.add("accessors", {{"bufferView", p}, {"componentType", 5126}, {"count", 4}, {"type", "VEC3"}});
  maker.add("accessors", {{"bufferView", i}, {"componentType", 5123}, {"count", 6}, {"type", "SCALAR"}});
  maker.show({{"attributes", {{"POSITION", 0}}}, {"indices", 1}});
  return maker;
}

std::string as_text(const GltfMaker& maker) {
  Json whole = maker.json;
  whole["buffers"] =
      Json::array({{{"byteLength", maker.bin.size()}, {"uri", "data:;base64," + base64(maker.bin)}}});
  return whole.dump();
}

}  // namespace

std::vector<std::string> seeds_of(MeshFormat format) {
  switch (format) {
    case MeshFormat::obj:
      return {
          "mtllib tree.mtl\no oak\ng bark\nusemtl bark\nv 0 0 0\nv 1 0 0\nv 1 1.5e-1 0\nv 0 1 0\nv .5 2 "
          "-1\nvt 0 0\nvt 1 0\nvt 1 1\n"
          "vn 0 0 1\nvn 0 1 0\ns 1\nf 1/1/1 2/2/1 3/3/2\nf -5 -4 -3 -2\nf 1//1 2//1 3//2 5//1 4//1\nusemtl "
          "leaf\ng leaf\nf 1/1 \\\n2/2 3/3\n"
          "l 1 2\n# end\n",
          "v 0 0 0 1 0 0\nv 4 0 0\nv 4 4 0\nv 3 4 0\nv 3 1 0\nv 1 1 0\nv 1 4 0\nv 0 4 0\nf 1 2 3 4 5 6 7 "
          "8\nf 8 7 6 5 4 3 2 1 1\n"};
    case MeshFormat::ply:
      return {binary_ply("binary_little_endian"), binary_ply("binary_big_endian"),
              "ply\nformat ascii 1.0\ncomment x\nelement vertex 4\nproperty float x\nproperty float "
              "y\nproperty float z\nproperty float s\n"
              "property float t\nelement face 2\nproperty list uchar int vertex_index\nend_header\n0 0 0 0 "
              "0\n1 0 0 1 0\n1 1 0 1 1\n"
              "0 1 0 0 1\n3 0 1 2\n4 0 1 2 3\n"};
    case MeshFormat::off:
      return {"OFF\n# square\n4 2 5\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2 255 0 0\n4 0 1 2 3\n",
              "STCNOFF\n3 1 0\n0 0 0 0 0 1 255 0 0 0.25 0.5\n1 0 0 0 1 0 255 0 0 1 0\n0 1 0 1 0 0 9 9 9 0 "
              "1\n3 0 1 2\n"};
    case MeshFormat::stl:
      return {binary_stl(),
              "solid oak\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
              "0\nendloop\nendfacet\nendsolid oak\n"
              "solid leaf\nfacet normal 0 0 1\nouter loop\nvertex 0 0 1e0\nvertex 1 0 0\nvertex 0 1 "
              "0\nendloop\nendfacet\nendsolid leaf\n"};
    case MeshFormat::gltf:
      return {as_text(plain_gltf()), as_text(rich_gltf())};
    case MeshFormat::glb:
      return {plain_gltf().glb(), rich_gltf().glb(), draco_gltf(draco::MESH_EDGEBREAKER_ENCODING).glb(),
              draco_gltf(draco::MESH_SEQUENTIAL_ENCODING).glb(), meshopt_gltf().glb()};
    case MeshFormat::unknown:
      break;
  }
  return {};
}

}  // namespace copse::testing
