#include "lib/formats/tree_file/tree_pack.h"

#include "lib/formats/random.h"
#include "lib/formats/tree/check_tree.h"
#include "lib/formats/tree/derive_tree.h"
#include "lib/formats/tree_file/tree_file.h"
#include "tests/formats/read_everything.h"
#include "tests/formats/tree_maker.h"

#include <algorithm>
#include <cmath>
#include <initializer_list>
#include <string_view>
#include <tuple>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace copse {
namespace {

using Bytes = std::vector<std::uint8_t>;

PackedTree packed(const Tree& tree, const PackOptions& options = {}) {
  auto p = pack_tree(tree, options);
  EXPECT_TRUE(p.has_value()) << p.error().what;
  return p ? std::move(*p) : PackedTree{};
}

Bytes packed_file(const Tree& tree) {
  const auto file = Container::from_bytes(*encode_tree(tree), "plain");
  ContainerWriter writer(*file);
  EXPECT_TRUE(put_packed(writer, packed(tree)));
  return *writer.finish();
}

std::vector<TreeShape> shapes() {
  return {{},
          {.roots = 1, .radii = 40, .leaves = 60, .groups = 7, .ring = 6, .segment = 12, .leaf = 2},
          {.radii = 30, .leaves = 25, .groups = 25, .joints = 4},
          {.leaves = 0, .groups = 0},
          {.one_material = true, .normals = false, .texcoords = false},
          {.leaves = 30, .groups = 3, .leaf_order = LeafOrder::terminal},
          {.leaves = 30, .groups = 3, .leaf_order = LeafOrder::random}};
}

// Corners as bags of places: leaves are renumbered, and what is on the grid twice is one.
double farthest_match(const std::vector<Float3>& a, const std::vector<Float3>& b) {
  double worst = 0;
  for (const Float3& p : a) {
    double nearest = 1e30;
    for (const Float3& q : b) nearest = std::min(nearest, distance(to_double(p), to_double(q)));
    worst = std::max(worst, nearest);
  }
  return worst;
}

TEST(TreePack, WhatIsReadIsWhatWasPromised) {
  for (const TreeShape& shape : shapes()) {
    for (std::uint64_t seed = 0; seed < 5; ++seed) {
      const Tree tree = make_tree(shape, seed);
      ASSERT_EQ(why_unpackable(tree), "");
      const PackedTree p = packed(tree);
      const auto back = unpack_tree(p.bytes, head_of(p.tree), tree.materials);
      ASSERT_TRUE(back.has_value()) << back.error();
      Tree whole = *back;
      whole.textures = tree.textures, whole.provenance = tree.provenance;
      EXPECT_TRUE(same(whole, p.tree));
      EXPECT_THAT(check_tree(whole), testing::IsEmpty());
    }
  }
}

TEST(TreePack, NoVertexIsFartherAwayThanItSays) {
  for (const int bits : {8, 12, 16}) {
    double before = 1e30;
    const Tree tree = make_tree({.radii = 20, .leaves = 40, .groups = 4}, 2);
    const PackedTree p = packed(tree, {.position_bits = bits});
    EXPECT_LE(farthest_match(trunk_vertices(tree), trunk_vertices(p.tree)), p.trunk_error * 1.0001 + 1e-6);
    EXPECT_LE(farthest_match(tree.leaves.vertices.to_vector(), p.tree.leaves.vertices.to_vector()),
              p.leaf_error * 1.0001 + 1e-6);
    const Float3 e = tree.header.bounds.extent();
    const double step = std::max({e.x, e.y, e.z}) / (1 << bits) * std::sqrt(2.0);
    EXPECT_LE(std::max(p.trunk_error, p.leaf_error), step);
    EXPECT_LT(p.trunk_error, before);
    before = p.trunk_error;
  }
}

TEST(TreePack, LeavesOfOneShapeAreStoredAsFrames) {
  // The same bent leaf of four triangles, moved, turned and scaled, beside leaves of random corners.
  const auto leaves_alike = [](bool alike) {
    Tree tree = make_tree(
        {.roots = 1, .radii = 8, .leaves = 200, .groups = 5, .leaf = 4, .normals = false, .texcoords = false},
        9);
    Random random(1);
    std::vector<Float3> vertices;
    std::vector<CornerTriangle> triangles = tree.leaves.triangles.to_vector();
    const Double3 corners[6] = {{0, 0, 0},   {1, 0, 0},   {1.1, 0.9, 0.1},
                                {0.1, 1, 0}, {0, 2, 0.4}, {1, 2.1, 0.3}};
    const std::array<std::uint32_t, 3> faces[4] = {{0, 1, 2}, {0, 2, 3}, {3, 2, 5}, {3, 5, 4}};
    for (std::uint32_t leaf = 0; leaf < 200; ++leaf) {
      const Double3 x = normalized({random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)});
      const Double3 y = normalized(cross(x, {0.3, 0.5, 0.8})), z = cross(x, y);
      const double size = random.uniform(0.05, 0.1);
      const Double3 at{random.uniform(-1, 1), random.uniform(0, 2), random.uniform(-1, 1)};
      for (std::uint32_t v = 0; v < 6; ++v) {
        Double3 c = corners[v];
        if (!alike) c += {random.uniform(), random.uniform(), random.uniform()};
        vertices.push_back(to_float(at + (x * c.x + y * c.y + z * c.z) * size));
      }
      for (std::uint32_t t = 0; t < 4; ++t)
        for (int c = 0; c < 3; ++c) triangles[4 * leaf + t].vertex[c] = 6 * leaf + faces[t][c];
    }
    tree.leaves.vertices = std::move(vertices), tree.leaves.triangles = std::move(triangles);
    return packed(tree);
  };
  const PackedTree same_shape = leaves_alike(true), all_different = leaves_alike(false);
  EXPECT_LT(same_shape.bytes.size() + 200 * 6, all_different.bytes.size());
}

// Leaves whose first edge has its middle on a limb, or anywhere; across the limb, and all alike, or of
// several shapes in turn.
Tree with_leaves_on_limbs(bool on_limbs, std::uint32_t leaves = 200, std::uint32_t shapes = 1) {
  Tree tree = make_tree({.roots = 1, .radii = 24, .leaves = leaves, .groups = 5, .leaf = 2}, 9);
  Random random(1);
  const std::vector<Double3> centres = absolute_centres(tree);
  const std::vector<std::uint32_t> parent = parents(tree);
  std::vector<Float3> vertices;
  std::vector<CornerTriangle> triangles = tree.leaves.triangles.to_vector();
  for (std::uint32_t leaf = 0; leaf < leaves; ++leaf) {
    const auto r = static_cast<std::uint32_t>(1 + random.below(23));
    const Double3 from = centres[parent[r]], way = normalized(centres[r] - from);
    const Double3 x = normalized(cross(way, {random.uniform(-1, 1), random.uniform(-1, 1), 0.3}));
    const Double3 y = way * 0.8 + cross(x, way) * 0.6;
    const double size = random.uniform(0.3, 0.6);
    Double3 at = from + (centres[r] - from) * random.uniform();
    if (!on_limbs) at += Double3{random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 1)};
    const double longer = 1 + 0.02 * (leaf % shapes);
    for (const auto& [u, v] : {std::pair{-0.5, 0.0}, {0.5, 0.0}, {0.5, longer}, {-0.5, longer}})
      vertices.push_back(to_float(at + (x * u + y * v) * size));
    for (std::uint32_t t = 0; t < 2; ++t)
      for (std::uint32_t c = 0; c < 3; ++c)
        triangles[2 * leaf + t].vertex[c] = 4 * leaf + (t == 0 ? c : c == 0 ? 0 : c + 1);
  }
  tree.leaves.vertices = std::move(vertices), tree.leaves.triangles = std::move(triangles);
  return tree;
}

double bytes_of(const PackedTree& p, std::initializer_list<std::string_view> streams) {
  double bytes = 0;
  for (const StreamCost& s : p.streams)
    if (std::find(streams.begin(), streams.end(), s.name) != streams.end()) bytes += s.bits / 8;
  return bytes;
}

TEST(TreePack, LeavesThatSitOnLimbsAreToldByThem) {
  const PackedTree on = packed(with_leaves_on_limbs(true)), off = packed(with_leaves_on_limbs(false));
  const auto places = {"leaves: limbs", "leaves: places on limbs", "leaves: edges",        "leaves: anchors",
                       "leaves: turns", "leaves: first corners",   "leaves: other corners"};
  const std::vector<std::string_view> names(places.begin(), places.end());
  double with = 0, without = 0;
  for (const std::string_view name : names) with += bytes_of(on, {name}), without += bytes_of(off, {name});
  EXPECT_LT(with + 200, without);
  EXPECT_GT(bytes_of(on, {"leaves: places on limbs"}), 0);
  for (const bool on_limbs : {true, false}) {
    const Tree tree = with_leaves_on_limbs(on_limbs);
    const PackedTree p = packed(tree);
    const auto back = unpack_tree(p.bytes, head_of(p.tree), tree.materials);
    ASSERT_TRUE(back.has_value()) << back.error();
    EXPECT_EQ(back->leaves.vertices.to_vector(), p.tree.leaves.vertices.to_vector());
    EXPECT_LE(farthest_match(tree.leaves.vertices.to_vector(), p.tree.leaves.vertices.to_vector()),
              p.leaf_error * 1.0001 + 1e-6);
  }
}

TEST(TreePack, ShapesThatWereForgottenAreToldAgain) {
  for (const int bits : {9, 11, 14}) {
    const PackedTree p = packed(with_leaves_on_limbs(true, 1600, 400), {.position_bits = bits});
    const auto back = unpack_tree(p.bytes, head_of(p.tree), p.tree.materials);
    ASSERT_TRUE(back.has_value()) << bits << ": " << back.error();
    EXPECT_EQ(back->leaves.vertices.to_vector(), p.tree.leaves.vertices.to_vector());
  }
}

TEST(TreePack, TheStreamsAddUpToTheBytes) {
  const PackedTree p = packed(make_tree({.radii = 30, .leaves = 50}, 4));
  double bits = 0;
  for (const StreamCost& s : p.streams) bits += s.bits;
  EXPECT_NEAR(bits / 8, static_cast<double>(p.bytes.size()), 16);
}

TEST(TreePack, TheSameTreeGivesTheSameBytes) {
  const Tree tree = make_tree({.radii = 30, .leaves = 50}, 4);
  EXPECT_EQ(packed(tree).bytes, packed(tree).bytes);
}

TEST(TreePack, LeavesComeInTheOrderThatIsAskedFor) {
  const Tree tree = make_tree({.leaves = 12, .groups = 1, .leaf = 1}, 6);
  std::vector<std::uint32_t> order(12);
  for (std::uint32_t i = 0; i < 12; ++i) order[i] = 11 - i;
  const PackedTree before = packed(tree, {.position_bits = 20});
  auto after = renumbered(before, order);
  ASSERT_TRUE(after.has_value());
  const PackedTree& p = *after;
  std::vector<Float3> vertices = p.tree.leaves.vertices.to_vector(),
                      same_vertices = before.tree.leaves.vertices.to_vector();
  const auto less = [](const Float3& a, const Float3& b) {
    return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
  };
  std::sort(vertices.begin(), vertices.end(), less),
      std::sort(same_vertices.begin(), same_vertices.end(), less);
  EXPECT_EQ(vertices, same_vertices);
  for (std::uint32_t i = 0; i < 12; ++i)
    EXPECT_LT(distance(to_double(p.tree.leaves.centres[i]), to_double(tree.leaves.centres[11 - i])), 1e-3);
}

TEST(TreePack, AFileThatIsPackedReadsLikeAnyOther) {
  const Tree tree = make_tree({.radii = 20, .leaves = 30}, 1);
  const Bytes bytes = packed_file(tree);
  const auto file = TreeFile::from_bytes(bytes, "p.stree");
  ASSERT_TRUE(file.has_value()) << file.error().what;
  EXPECT_TRUE(file->has("LVTX"));
  EXPECT_TRUE(file->container().find("PACK") != nullptr);
  EXPECT_TRUE(file->container().find("LVTX") == nullptr);
  EXPECT_THAT(file->verify(), testing::IsEmpty());
  const auto loaded = file->load();
  ASSERT_TRUE(loaded.has_value()) << loaded.error().what;
  EXPECT_TRUE(same(*loaded, packed(tree).tree));
  EXPECT_LT(bytes.size(), encode_tree(tree)->size());
}

TEST(TreePack, WhatStaysBesideItIsCompressedAndReadsTheSame) {
  const Tree tree = make_tree({.radii = 30, .leaves = 25, .groups = 5}, 3);
  const auto file = Container::from_bytes(*encode_tree(tree), "plain");
  ContainerWriter writer(*file);
  ASSERT_TRUE(compress_records(writer, *file));
  ASSERT_TRUE(put_packed(writer, packed(tree)));
  const auto plain = Container::from_bytes(packed_file(tree), "plain"),
             small = Container::from_bytes(*writer.finish(), "small");
  ASSERT_TRUE(small.has_value());
  EXPECT_EQ(small->find("MATL")->encoding, Encoding::zstd);
  EXPECT_LT(small->size(), plain->size());
  for (const SectionInfo& s : plain->sections()) {
    const SectionInfo* other = small->find(s.name);
    ASSERT_NE(other, nullptr) << s.name;
    EXPECT_EQ(plain->read(s)->to_vector(), small->read(*other)->to_vector()) << s.name;
  }
}

TEST(TreePack, WhatWasLeftOutIsNotPacked) {
  const auto reduced = TreeFile::from_bytes(*encode_tree(make_tree({}, 1), {.omit = {"LORD"}}), "r");
  EXPECT_NE(why_unpackable(*reduced->load()), "");
  EXPECT_NE(why_unpackable(make_tree({.kind = TreeKind::still}, 1)), "");
}

TEST(TreePack, CoordinatesThatNoGridHoldsAreRefused) {
  Tree tree = make_tree({.radii = 4, .leaves = 3, .groups = 1}, 1);
  std::vector<Radius> radii = tree.hierarchy.radii.to_vector();
  for (std::uint32_t r = 0; r < tree.header.roots; ++r) radii[r].centre.x += 1e7f;
  tree.hierarchy.radii = std::move(radii);
  const auto p = pack_tree(tree, {});
  ASSERT_FALSE(p.has_value());
  EXPECT_THAT(p.error().remedy, testing::HasSubstr("--encode fast"));
}

void expect_mutants_harmless(const Bytes& sound, int mutants) {
  const auto at = tampering::section_at(sound, "PACK");
  const auto size =
      get<std::uint64_t>(sound, tampering::entry_of(sound, "PACK") + container_layout::k_entry_stored);
  Random random(11);
  int refused = 0;
  for (int i = 0; i < mutants; ++i) {
    Bytes bytes = sound;
    const int damage = 1 + static_cast<int>(random.uniform(0, 3));
    for (int k = 0; k < damage; ++k)
      bytes[at + static_cast<std::size_t>(random.uniform(0, double(size)))] =
          static_cast<std::uint8_t>(random.uniform(0, 256));
    tampering::mend_checksums(bytes);
    const auto file = TreeFile::from_bytes(std::move(bytes), "m");
    if (!file) {
      ++refused;
      EXPECT_THAT(file.error().what, testing::HasSubstr("section PACK at offset")) << i;
      continue;
    }
    if (const auto tree = file->load()) {
      ASSERT_THAT(check_tree(*tree), testing::IsEmpty()) << i;
    }
  }
  EXPECT_GT(refused, mutants * 9 / 10);
}

TEST(TreePack, MutantsAreRefusedOrSound) {
  expect_mutants_harmless(packed_file(make_tree({.roots = 1, .radii = 9, .leaves = 12, .groups = 3}, 5)),
                          9000);
}

TEST(TreePack, MutantsOfLeavesOnLimbsAreRefusedOrSound) {
  expect_mutants_harmless(packed_file(with_leaves_on_limbs(true)), 1000);
}

TEST(TreePack, ForgedCountsTakeNoMemory) {
  Bytes bytes = packed_file(make_tree({.radii = 9, .leaves = 12}, 5));
  const std::size_t head = tampering::section_at(bytes, "HEAD");
  for (const std::size_t field : {100u, 104u, 116u, 124u, 128u, 144u, 148u, 156u}) {
    Bytes forged = bytes;
    tampering::set(forged, head + field, std::uint32_t{0x7fffffff});
    EXPECT_FALSE(TreeFile::from_bytes(std::move(forged), "f").has_value()) << field;
  }
}

}  // namespace
}  // namespace copse
