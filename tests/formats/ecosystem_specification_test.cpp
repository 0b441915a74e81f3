// Writes an .eco byte by byte as docs/formats.md gives it: the reader must take it, and the encoder must give
// the same bytes for the same ecosystem.
#include "lib/formats/ecosystem/ecosystem_file.h"
#include "lib/formats/ecosystem/instance_codec.h"
#include "tests/formats/by_hand.h"

#include <cmath>

#include <gtest/gtest.h>

namespace copse {
namespace {

using namespace by_hand;  // NOLINT: the whole file writes by hand

constexpr std::uint32_t k_no = 0xffffffff;

// A flat of two triangles, a material, a tree by reference and a packed one, three instances in two blocks.
Bytes head(bool exact) {
  Bytes b;
  b.f64({100, 0, 200}).f64({100, 200, 104, 208});
  b.f32({-1, 0, -1, 5, 3, 9});
  b.u32({exact ? 3u : 2u, 2, 2, 3, 1, 0, 0});  // flags, types, blocks, instances, materials, textures, depth
  b.u32({2, 2, 0});                            // columns, rows, material of the terrain
  b.f64({100, 0, 200}).f64({4, 8});
  b.f32({2.5f, 0.25f, 0.125f, 0.0625f}).u64(7);
  return b.zeros_to(256);
}

Bytes material() {
  Bytes b;
  b.u32({4, 0, k_no});
  b.f32({0.2f, 0.2f, 0.2f, 0.8f, 0.8f, 0.8f, 0, 0, 0, 0, 0, 0, 0, 1, 0, 1, 1, 1, 1});
  return b;
}

Bytes types() {
  Bytes b;
  b.u32({3, 9, 0, 2}).f32({-1, 0, -1, 1, 2, 1, 0.5f, 1, 40}).u32({0}).u64(0x1122334455667788);
  b.u32({5, 0, 1, 1}).f32({0, 0, 0, 1, 1, 1, 1, 1, 0}).u32({0}).u64(9);
  return b;
}

Bytes blocks(bool exact) {
  const float step = exact ? 0 : 0.5f;
  Bytes b;
  b.u32({0, 0, 2, 0}).f64({101, 0, 201}).f32({step, 0, step}).f32({-1, 0, -1, 4, 3, 4}).u32({0});
  b.u32({1, 2, 1, 0}).f64({104, 0, 208}).f32({0, 0, 0}).f32({3, 0, 7, 5, 2, 9}).u32({0});
  return b;
}

// Steps (0, 0, 0) and (2, 0, 4); no turn, and a half turn about y (x, y, z, w = 0, 1, 0, 0).
Bytes instances() {
  const std::uint64_t up = 2097151 | std::uint64_t{2097151} << 22;
  const std::uint64_t none = up | std::uint64_t{524287} << 44;
  const std::uint64_t half = up | std::uint64_t{2 * 524287} << 44;
  const auto rest = [](std::uint32_t scale, std::uint8_t trunk) {
    std::string s;
    for (const std::uint32_t byte : {scale & 255, scale >> 8, 255u, 128u, 0u, std::uint32_t{trunk}, 255u, 6u})
      s += static_cast<char>(byte);
    return s;
  };
  Bytes b;
  b.u64(0).u64(none).text(rest(0, 255));
  b.u64(2 | std::uint64_t{4} << 42).u64(half).text(rest(65535, 0));
  b.u64(0).u64(none).text(rest(0, 255));
  return b;
}

Bytes exact_instances() {
  Bytes b;
  const auto one = [&](float x, float z, bool turned, float scale, std::uint32_t trunk) {
    b.f32({x, 0, z, 0, turned ? 1.0f : 0.0f, 0, turned ? 0.0f : 1.0f, scale})
        .u32({trunk, k_no, 6})
        .text({"\xff\x80\0\0", 4});
  };
  one(0, 0, false, 0.5f, k_no);
  one(1, 2, true, 1, 0);
  one(0, 0, false, 1, k_no);
  return b;
}

std::vector<Part> parts(bool exact) {
  std::vector<Part> p{{"EHED", 1, head(exact)},
                      {"PROV", 1, Bytes().text("{}")},
                      {"MATL", 88, material()},
                      {"MNAM", 1, Bytes().text("Soil")},
                      {"ETYP", 64, types()},
                      {"ENAM", 1, Bytes().text("oaktrees/oakgrass")},
                      {"EVOL", 16, Bytes().u32({0, 0, 1, 4}).u32({0, 1, 0, 6}).u32({1, 0, 0, 6})},
                      {"EVNM", 4, Bytes().f32({0, 1, 0, 4, -1, 0, -1, 1, 2, 1, 0, 0, 0, 1, 1, 1})},
                      {"EHGT", 4, Bytes().f32({0, 0, 0, 0})},
                      {"EBOX", 32, Bytes().f32({-1, 0, -1, 5, 3, 9}).u32({0, 2})},
                      {"EBLK", 80, blocks(exact)}};
  if (exact) p.push_back({"EINX", 48, exact_instances()});
  if (!exact) p.push_back({.name = "EINS", .stride = 24, .bytes = instances(), .version = 2});
  p.push_back({"P001", 1, Bytes().text("a tree's file")});
  return p;
}

Ecosystem ecosystem(bool exact) {
  Ecosystem e;
  e.origin = {100, 0, 200};
  e.area = {100, 200, 104, 208};
  e.bounds = {{-1, 0, -1}, {5, 3, 9}};
  e.terrain.columns = e.terrain.rows = 2;
  e.terrain.material = 0;
  e.terrain.origin = {100, 0, 200};
  e.terrain.spacing_x = 4, e.terrain.spacing_z = 8;
  e.terrain.texture_size = 2.5f;
  e.terrain.heights = std::vector<float>(4);
  e.position_error = 0.25f, e.rotation_error = 0.125f, e.scale_error = 0.0625f;
  e.seed = 7;
  e.provenance = "{}";
  e.materials.resize(1);
  e.materials[0].name = "Soil";
  e.types.resize(2);
  e.types[0] = {.name = "oak",
                .uri = "trees/oak",
                .hash = 0x1122334455667788,
                .bounds = {{-1, 0, -1}, {1, 2, 1}},
                .instances = 2,
                .scale_min = 0.5f,
                .scale_max = 1,
                .view_range = 40};
  e.types[0].volumes = {BoundingSphere<float>{{0, 1, 0}, 4}};
  e.types[0].envelopes = {FloatBox{{-1, 0, -1}, {1, 2, 1}}};
  e.types[1] = {.name = "grass", .uri = "", .hash = 9, .bounds = {{0, 0, 0}, {1, 1, 1}}, .instances = 1};
  e.types[1].volumes = {FloatBox{{0, 0, 0}, {1, 1, 1}}};
  const std::string packed = "a tree's file";
  e.types[1].packed = std::vector<std::uint8_t>(packed.begin(), packed.end());
  const float step = exact ? 0 : 0.5f;
  e.blocks = std::vector<InstanceBlock>{{.type = 0,
                                         .first = 0,
                                         .count = 2,
                                         .origin = {101, 0, 201},
                                         .step = {step, 0, step},
                                         .bounds = {{-1, 0, -1}, {4, 3, 4}}},
                                        {.type = 1,
                                         .first = 2,
                                         .count = 1,
                                         .origin = {104, 0, 208},
                                         .step = {},
                                         .bounds = {{3, 0, 7}, {5, 2, 9}}}};
  e.boxes = std::vector<QuadNode>{{.bounds = {{-1, 0, -1}, {5, 3, 9}}, .first_block = 0, .block_count = 2}};
  Instance plain{.position = {101, 0, 201}, .scale = 0.5, .motion = 6, .tint = {255, 128, 0}};
  Instance turned{.position = {102, 0, 203},
                  .rotation = {0, 1, 0, 0},
                  .scale = 1,
                  .trunk_material = 0,
                  .motion = 6,
                  .tint = {255, 128, 0}};
  Instance grass{.position = {104, 0, 208}, .scale = 1, .type = 1, .motion = 6, .tint = {255, 128, 0}};
  if (exact) {
    e.exact = std::vector<ExactInstance>{pack_exactly(plain, e.blocks[0]), pack_exactly(turned, e.blocks[0]),
                                         pack_exactly(grass, e.blocks[1])};
  } else {
    e.packed = std::vector<PackedInstance>{pack(plain, e.blocks[0], e.types[0]),
                                           pack(turned, e.blocks[0], e.types[0]),
                                           pack(grass, e.blocks[1], e.types[1])};
  }
  return e;
}

class EcosystemSpecification : public testing::TestWithParam<bool> {};

TEST_P(EcosystemSpecification, AFileWrittenByThePageLoads) {
  const auto opened = EcosystemFile::from_bytes(file(3, parts(GetParam())), "by hand");
  ASSERT_TRUE(opened) << opened.error().what;
  EXPECT_EQ(opened->verify(), std::vector<std::string>{});
  const auto loaded = opened->load();
  ASSERT_TRUE(loaded) << loaded.error().what;
  const Ecosystem wanted = ecosystem(GetParam());
  EXPECT_EQ(loaded->blocks.to_vector(), wanted.blocks.to_vector());
  EXPECT_EQ(loaded->materials, wanted.materials);
  EXPECT_EQ(loaded->types[0].uri, "trees/oak");
  for (std::size_t t = 0; t < 2; ++t) {
    EXPECT_EQ(loaded->types[t].volumes, wanted.types[t].volumes);
    EXPECT_EQ(loaded->types[t].envelopes, wanted.types[t].envelopes);
  }
  EXPECT_EQ(loaded->types[1].packed.to_vector(), wanted.types[1].packed.to_vector());
  const Instance i = instance_of(*loaded, loaded->blocks[0], 1);
  EXPECT_EQ(i.position, (Double3{102, 0, 203}));
  EXPECT_EQ(i.rotation, (Quaternion{0, 1, 0, 0}));
  EXPECT_EQ(i.scale, 1);
  EXPECT_EQ(i.trunk_material, 0u);
  EXPECT_EQ(i.leaf_material, k_none);
  EXPECT_EQ(i.motion, 6u);
  EXPECT_EQ(loaded->seed, 7u);
}

TEST_P(EcosystemSpecification, TheEncoderWritesTheSameBytes) {
  const auto bytes = encode_ecosystem(ecosystem(GetParam()));
  ASSERT_TRUE(bytes) << bytes.error().what;
  EXPECT_EQ(*bytes, file(3, parts(GetParam())));
}

INSTANTIATE_TEST_SUITE_P(Encoding, EcosystemSpecification, testing::Bool(),
                         [](const auto& exact) { return exact.param ? "Exact" : "Packed"; });

TEST(EcosystemSpecificationOf, NothingIsAHeadAlone) {
  const auto bytes = encode_ecosystem(Ecosystem{});
  ASSERT_TRUE(bytes);
  const auto opened = EcosystemFile::from_bytes(*bytes, "empty");
  ASSERT_TRUE(opened) << opened.error().what;
  EXPECT_EQ(opened->container().sections().size(), 1u);
  EXPECT_TRUE(opened->load());
  EXPECT_EQ(opened->verify(), std::vector<std::string>{});
}

}  // namespace
}  // namespace copse
