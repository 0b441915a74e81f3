// Writes files byte by byte as docs/formats.md gives them, sharing no code with the encoder: a reader must
// take them, and the encoder must give the same bytes for the same tree.
#include "lib/formats/tree_file/tree_file.h"
#include "tests/formats/by_hand.h"

#include <cmath>

#include <gtest/gtest.h>

namespace copse {
namespace {

constexpr float k_inf = std::numeric_limits<float>::infinity();

using namespace by_hand;  // NOLINT: the whole file writes by hand

constexpr std::uint32_t k_no = 0xffffffff;

// A trunk of one segment between two rings of two vertices (a strip), one leaf that is a 3-4-5 triangle.
Bytes head(bool sensitive) {
  Bytes b;
  b.f64({1000, 0, -2000});
  b.f32({-1, 0, 0, 3, 9, 0});       // box of all
  b.f32({-1, 0, 0, 1, 4, 0});       // of the trunk
  b.f32({0, 16.0f / 9, 0});         // (4 (1/6, 4/3) + 2 (-1/3, 8/3)) / 6
  b.f32({3, 3});                    // mean areas: (4 + 2) / 2 and 6 times the coverage 0.5
  b.u32({sensitive ? 1u : 0u, 0});  // monotone; leaves by distance from the group's centre
  b.u32({2, 4, 1, 1});              // trunk: triangles, vertices, normals, texture coordinates
  b.u32({1, sensitive ? 0u : 2u});  // segments, line vertices
  b.u32({1, 1, 3, 1, 0});           // leaves: triangles, leaves, vertices, normals, texture coordinates
  b.u32({1, 1});                    // groups, nodes
  b.u32({sensitive ? 1u : 0u, sensitive ? 2u : 0u, sensitive ? 2u : 0u});  // roots, radii, k
  b.u32({2, 1, 0});  // segment factor, leaf factor, unexplained
  b.u32({0, 1});     // materials of the trunk and of the leaves
  b.u32({2, 1});     // materials, textures
  return b.zeros_to(256);
}

Bytes materials() {
  Bytes b;
  for (const bool leaf : {false, true}) {
    b.u32({leaf ? 4u : 5u, leaf ? 1u : 0u, leaf ? 0u : k_no});  // length of the name, double-sided, texture
    b.f32({0.2f, 0.2f, 0.2f, 0.8f, leaf ? 1.0f : 0.8f, 0.8f, 0, 0, 0, 0, 0, 0});
    b.f32({0, 1, leaf ? 0.5f : 0.0f, 1, 1, 1, leaf ? 0.5f : 1.0f});
  }
  return b;
}

Bytes trunk_triangles() {
  return Bytes().u32({0, 2, 1, 0, 0, 0, k_no, k_no, k_no, 1, 2, 3, 0, 0, k_no, 0, 0, 0});
}

std::vector<Part> parts(bool sensitive) {
  std::vector<Part> p{{"HEAD", 1, head(sensitive)},
                      {"OMIT", 16, Bytes().text("LTEX").u32({0}).u64(24)},
                      {"PROV", 1, Bytes().text(R"({"tool":"a hand"})")},
                      {"MATL", 88, materials()},
                      {"MNAM", 1,
                       Bytes().text("Bark\xc3"
                                    "Leaf")},
                      {"TEXR", 16, Bytes().u32({0, 9}).u64(3)},
                      {"TNAM", 1, Bytes().text("image/png")}};
  if (sensitive) {
    Bytes radii;
    radii.f32({0, 0, 0, 2, 1, 0}).u32({1, 1, 0});
    radii.f32({0, 4, 0, 1, 0.5f, 4}).u32({0, 1, 1});  // terminal: its child is leaf group 0
    p.push_back({"RADI", 36, radii});
    p.push_back({"RVEC", 12, Bytes().f32({1, 0, 0, -1, 0, 0, 0.5f, 0, 0, -0.5f, 0, 0})});
  }
  p.push_back({"TTRI", 36, trunk_triangles()});
  p.push_back({"TLIN", 8, Bytes().u32({0, 1})});
  p.push_back({"TDIA", 4, Bytes().f32({2})});
  p.push_back({"TACC", 8, Bytes().f64({4})});
  if (!sensitive) {
    p.push_back({"TVTX", 12, Bytes().f32({1, 0, 0, -1, 0, 0, 0.5f, 4, 0, -0.5f, 4, 0})});
    p.push_back({"TLVX", 12, Bytes().f32({0, 0, 0, 0, 4, 0})});
  }
  p.push_back({"TNRM", 12, Bytes().f32({0, 0, 1})});
  p.push_back({"TTEX", 8, Bytes().f32({0.25f, -0.5f})});
  p.push_back({"LTRI", 36, Bytes().u32({0, 1, 2, 0, 0, 0, k_no, k_no, k_no})});
  p.push_back({"LCEN", 12, Bytes().f32({1, 19.0f / 3, 0})});
  p.push_back({"LVTX", 12, Bytes().f32({0, 5, 0, 3, 5, 0, 0, 9, 0})});
  p.push_back({"LNRM", 12, Bytes().f32({0, 0, -1})});
  p.push_back({"LGRP", 28, Bytes().f32({1.5f, 7, 0, 2.5f, 3}).u32({0, 1})});
  p.push_back({"LORD", 4, Bytes().u32({0})});
  p.push_back({"LGHI", 24, Bytes().f32({1.5f, 7, 0, 2.5f}).u32({1, 0})});
  p.push_back({"TDAT", 1, Bytes().text("PNG")});
  return p;
}

// The same tree, in memory; its leaves still have the texture coordinates that the file leaves out.
Tree tree(bool sensitive) {
  Tree t;
  TreeHeader& h = t.header;
  h.kind = sensitive ? TreeKind::sensitive : TreeKind::still;
  h.origin = {1000, 0, -2000};
  h.bounds = {{-1, 0, 0}, {3, 9, 0}};
  h.trunk_bounds = {{-1, 0, 0}, {1, 4, 0}};
  h.area_density_centre = {0, 16.0f / 9, 0};
  h.mean_trunk_area = h.mean_leaf_area = 3;
  h.segment_factor = 2, h.leaf_factor = 1;
  t.provenance = R"({"tool":"a hand"})";
  t.materials.resize(2);
  t.materials[0].name = "Bark\xc3";
  t.materials[1].name = "Leaf";
  t.materials[1].diffuse.y = 1;
  t.materials[1].double_sided = true;
  t.materials[1].texture = 0;
  t.materials[1].alpha_cutoff = t.materials[1].alpha_coverage = 0.5f;
  t.textures = {{.uri = "", .mime = "image/png", .bytes = {'P', 'N', 'G'}}};
  const std::vector<Float3> vectors{{1, 0, 0}, {-1, 0, 0}, {0.5f, 0, 0}, {-0.5f, 0, 0}};
  if (sensitive) {
    h.roots = 1, h.ring_size = 2, h.monotone = true;
    t.hierarchy.radii = std::vector<Radius>{
        {.centre = {0, 0, 0}, .diameter = 2, .outer_radius = 1, .first_child = 1, .child_count = 1},
        {.centre = {0, 4, 0},
         .diameter = 1,
         .outer_radius = 0.5f,
         .distance = 4,
         .first_child = 0,
         .child_count = 1,
         .flags = Radius::terminal}};
    t.hierarchy.vectors = vectors;
  } else {
    t.trunk.vertices = std::vector<Float3>{{1, 0, 0}, {-1, 0, 0}, {0.5f, 4, 0}, {-0.5f, 4, 0}};
    t.trunk.line_vertices = std::vector<Float3>{{0, 0, 0}, {0, 4, 0}};
  }
  t.trunk.triangles =
      std::vector<CornerTriangle>{{.vertex = {0, 2, 1}, .normal = {0, 0, 0}},
                                  {.vertex = {1, 2, 3}, .normal = {0, 0, k_none}, .texcoord = {0, 0, 0}}};
  t.trunk.lines = std::vector<std::array<std::uint32_t, 2>>{{0, 1}};
  t.trunk.diameters = std::vector<float>{2};
  t.trunk.accumulated_lengths = std::vector<double>{4};
  t.trunk.material = 0;
  t.trunk.normals = std::vector<Float3>{{0, 0, 1}};
  t.trunk.texcoords = std::vector<Float2>{{0.25f, -0.5f}};
  t.leaves.triangles =
      std::vector<CornerTriangle>{{.vertex = {0, 1, 2}, .normal = {0, 0, 0}, .texcoord = {0, 1, 2}}};
  t.leaves.centres = std::vector<Float3>{{1, 19.0f / 3, 0}};
  t.leaves.material = 1;
  t.leaves.vertices = std::vector<Float3>{{0, 5, 0}, {3, 5, 0}, {0, 9, 0}};
  t.leaves.normals = std::vector<Float3>{{0, 0, -1}};
  t.leaves.texcoords = std::vector<Float2>{{0, 0}, {1, 0}, {0, 1}};
  t.leaves.groups = std::vector<LeafGroup>{
      {.centre = {1.5f, 7, 0}, .radius = 2.5f, .mean_area = 3, .first = 0, .count = 1}};
  t.leaves.order = std::vector<std::uint32_t>{0};
  t.leaves.group_hierarchy =
      std::vector<GroupNode>{{.centre = {1.5f, 7, 0}, .radius = 2.5f, .skip = 1, .group = 0}};
  return t;
}

class Specification : public testing::TestWithParam<bool> {};

TEST_P(Specification, AFileWrittenByThePageLoads) {
  const auto opened = TreeFile::from_bytes(file(GetParam() ? 2 : 1, parts(GetParam())), "by hand");
  ASSERT_TRUE(opened) << opened.error().what;
  EXPECT_EQ(opened->verify(), std::vector<std::string>{});
  EXPECT_EQ(opened->omissions(), (std::vector<Omitted>{{"LTEX", 24}}));
  const auto loaded = opened->load();
  ASSERT_TRUE(loaded) << loaded.error().what;
  const Tree wanted = tree(GetParam());
  EXPECT_EQ(loaded->header, wanted.header);
  EXPECT_EQ(loaded->materials, wanted.materials);
  EXPECT_EQ(loaded->textures, wanted.textures);
  EXPECT_EQ(loaded->hierarchy.radii.to_vector(), wanted.hierarchy.radii.to_vector());
  EXPECT_EQ(loaded->trunk.triangles.to_vector(), wanted.trunk.triangles.to_vector());
  EXPECT_EQ(loaded->leaves.groups.to_vector(), wanted.leaves.groups.to_vector());
  EXPECT_EQ(trunk_vertices(*loaded),
            (std::vector<Float3>{{1, 0, 0}, {-1, 0, 0}, {0.5f, 4, 0}, {-0.5f, 4, 0}}));
}

TEST_P(Specification, TheEncoderWritesTheSameBytes) {
  const auto bytes = encode_tree(tree(GetParam()), {.omit = {"LTEX"}});
  ASSERT_TRUE(bytes) << bytes.error().what;
  EXPECT_EQ(*bytes, file(GetParam() ? 2 : 1, parts(GetParam())));
}

// A zstd frame by RFC 8878: magic, a descriptor that says "single segment, content size in 4 bytes", the
// size, one last raw block.
TEST_P(Specification, ACompressedSectionWrittenByThePageLoads) {
  std::vector<Part> compressed = parts(GetParam());
  for (Part& p : compressed) {
    if (p.name != "TTRI") continue;
    const std::vector<std::uint8_t> raw = p.bytes.get();
    const auto size = static_cast<std::uint32_t>(raw.size());
    Bytes frame;
    frame.u32({0xFD2FB528u}).text("\xa0").u32({size});
    const std::uint32_t block = size << 3 | 1;  // raw, last
    frame.text({static_cast<char>(block & 255), static_cast<char>(block >> 8 & 255),
                static_cast<char>(block >> 16)});
    frame.text({raw.begin(), raw.end()});
    p.bytes = frame, p.encoding = 1, p.decoded = size;
  }
  const auto opened = TreeFile::from_bytes(file(GetParam() ? 2 : 1, compressed), "by hand");
  ASSERT_TRUE(opened) << opened.error().what;
  const auto loaded = opened->load();
  ASSERT_TRUE(loaded) << loaded.error().what;
  EXPECT_EQ(loaded->trunk.triangles.to_vector(), tree(GetParam()).trunk.triangles.to_vector());
}

INSTANTIATE_TEST_SUITE_P(Kind, Specification, testing::Bool(),
                         [](const auto& kind) { return kind.param ? "Sensitive" : "Still"; });

TEST(SpecificationOf, AnEmptyTreeIsAHeadAlone) {
  Bytes head;
  head.f64({0, 0, 0}).f32(
      {k_inf, k_inf, k_inf, -k_inf, -k_inf, -k_inf, k_inf, k_inf, k_inf, -k_inf, -k_inf, -k_inf});
  head.zeros_to(176).u32({k_no, k_no}).zeros_to(256);
  const auto bytes = encode_tree(Tree{});
  ASSERT_TRUE(bytes);
  EXPECT_EQ(*bytes, file(1, {{"HEAD", 1, head}}));
  EXPECT_TRUE(TreeFile::from_bytes(*bytes, "empty")->load());
}

}  // namespace
}  // namespace copse
