#include "lib/formats/tree_file/tree_file.h"

#include "lib/formats/container/atomic_file.h"
#include "lib/formats/tree/check_tree.h"
#include "tests/formats/tampering.h"
#include "tests/formats/tree_maker.h"

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>
#include <unistd.h>

namespace copse {
namespace {

TreeShape any_shape() {
  TreeShape s;
  s.kind = *rc::gen::element(TreeKind::still, TreeKind::sensitive);
  s.radii = *rc::gen::inRange(0u, 40u);
  s.roots = *rc::gen::inRange(1u, 4u);
  s.leaves = *rc::gen::inRange(0u, 30u);
  s.groups = *rc::gen::inRange(0u, 8u);
  s.ring = *rc::gen::element(0u, 1u, 4u);
  s.segment = *rc::gen::element(0u, 1u, 8u);
  s.leaf = *rc::gen::element(0u, 1u, 2u);
  s.joints = *rc::gen::element(0u, 1u, 4u);
  s.materials = *rc::gen::inRange(0u, 4u);
  s.textures = *rc::gen::inRange(0u, 4u);
  s.one_material = *rc::gen::arbitrary<bool>();
  s.normals = *rc::gen::arbitrary<bool>();
  s.texcoords = *rc::gen::arbitrary<bool>();
  s.leaf_order = *rc::gen::element(LeafOrder::group, LeafOrder::terminal, LeafOrder::random);
  return s;
}

RC_GTEST_PROP(TreeFile, EveryTreeComesBackToTheBit, ()) {
  const Tree tree = make_tree(any_shape(), *rc::gen::arbitrary<std::uint64_t>());
  for (const auto& line : check_tree(tree)) RC_FAIL(line);
  for (const Encoding encoding : {Encoding::raw, Encoding::zstd}) {
    const auto bytes = encode_tree(tree, {.encoding = encoding});
    RC_ASSERT(bytes.has_value());
    for (const Trust trust : {Trust::nothing, Trust::checksums, Trust::file}) {
      const auto file = TreeFile::from_bytes(*bytes, "any.stree", trust);
      if (!file) RC_FAIL(file.error().what);
      const auto loaded = file->load();
      if (!loaded) RC_FAIL(loaded.error().what);
      RC_ASSERT(same(tree, *loaded));
      RC_ASSERT(file->verify().empty());
    }
    RC_ASSERT(*encode_tree(tree, {.encoding = encoding}) == *bytes);
  }
}

using tampering::Bytes;
using tampering::section_at;
using testing::HasSubstr;

Tree sample() {
  return make_tree({.radii = 12, .leaves = 9, .groups = 3}, 7);
}

TEST(TreeFile, OpensAFileOnDiskAndOutlivesIt) {
  const auto path =
      std::filesystem::temp_directory_path() / ("copse_tree_" + std::to_string(::getpid()) + ".stree");
  ASSERT_TRUE(write_file(path, *encode_tree(sample())));
  Tree tree;
  {
    const auto file = TreeFile::open(path);
    ASSERT_TRUE(file) << file.error().what;
    EXPECT_EQ(file->size(), std::filesystem::file_size(path));
    EXPECT_EQ(file->header(), sample().header);
    EXPECT_EQ(file->counts().leaves, 9u);
    tree = *file->load();
  }
  std::filesystem::remove(path);
  EXPECT_TRUE(same(tree, sample()));
  EXPECT_EQ(TreeFile::open(path).error().fault, Fault::io);
}

TEST(TreeFile, PiecesShareRawArraysAndAreTheSameFile) {
  const Tree tree = sample();
  const auto pieces = encode_tree_pieces(tree);
  ASSERT_TRUE(pieces);
  EXPECT_EQ(pieces->joined(), *encode_tree(tree));
  const auto* triangles = reinterpret_cast<const std::uint8_t*>(tree.trunk.triangles.data());
  EXPECT_TRUE(std::ranges::any_of(pieces->list(), [&](const auto& p) { return p.data() == triangles; }));
}

TEST(TreeFile, UsesRawArraysWhereTheyLie) {
  const auto file = TreeFile::from_bytes(*encode_tree(sample()), "f");
  const auto first = file->load(), second = file->load();
  EXPECT_EQ(first->trunk.triangles.data(), second->trunk.triangles.data());
}

TEST(TreeFile, LoadsOnlyWhatIsNamed) {
  const auto file = TreeFile::from_bytes(*encode_tree(sample()), "f");
  const auto tree = file->load({"TDIA", "MATL", "TVTX"});  // a .tree's vertices: known, and not here
  ASSERT_TRUE(tree) << tree.error().what;
  EXPECT_EQ(tree->trunk.diameters.to_vector(), sample().trunk.diameters.to_vector());
  EXPECT_EQ(tree->materials, sample().materials);
  EXPECT_EQ(tree->header, sample().header);
  EXPECT_TRUE(tree->trunk.triangles.empty());
  EXPECT_TRUE(tree->textures.empty());
  EXPECT_EQ(file->load({"TDIO"}).error().fault, Fault::usage);
}

TEST(TreeFile, TrustDecidesWhatIsLookedAt) {
  const Bytes sound = *encode_tree(sample());
  Bytes damaged = sound;
  damaged[section_at(damaged, "TTRI") + 3] ^= 0x80;  // a vertex index, checksum not mended
  Bytes forged = sound;
  tampering::set<std::uint8_t>(forged, section_at(forged, "TTRI") + 3, 0x80);
  const auto refusal = [](const Bytes& bytes, Trust trust) {
    const auto file = TreeFile::from_bytes(bytes, "f", trust);
    EXPECT_TRUE(file) << "opening looks at no array";
    EXPECT_TRUE(file->load({"RADI", "LTRI"})) << "nor does loading others";
    const auto tree = file->load();
    return tree ? "" : tree.error().what;
  };
  EXPECT_EQ(refusal(sound, Trust::nothing), "");
  EXPECT_THAT(refusal(damaged, Trust::nothing), HasSubstr("section TTRI"));
  EXPECT_THAT(refusal(damaged, Trust::checksums), HasSubstr("checksum"));
  EXPECT_EQ(refusal(damaged, Trust::file), "");
  EXPECT_THAT(refusal(forged, Trust::nothing), HasSubstr("vertex index out of range"));
  EXPECT_EQ(refusal(forged, Trust::checksums), "");
  EXPECT_EQ(refusal(forged, Trust::file), "");
}

TEST(TreeFile, VerifyListsAllThatIsWrong) {
  Bytes bytes = *encode_tree(sample());
  bytes[section_at(bytes, "TNRM")] ^= 1;
  bytes[section_at(bytes, "LNRM")] ^= 1;
  bytes[section_at(bytes, "LORD") + 3] = 1;
  const auto failures = TreeFile::from_bytes(bytes, "f")->verify();
  EXPECT_THAT(failures, testing::IsSupersetOf(
                            {HasSubstr("section TNRM at offset"), HasSubstr("section LNRM at offset"),
                             HasSubstr("section LORD at offset"), HasSubstr("LORD[0]: index out of range")}));
}

TEST(TreeFile, ATreeThatDoesNotFitTogetherIsABugOfTheCaller) {
  Tree tree = sample();
  tree.leaves.order = std::vector<std::uint32_t>{0};
  const auto bytes = encode_tree(tree);
  ASSERT_FALSE(bytes);
  EXPECT_EQ(bytes.error().fault, Fault::bug);
  EXPECT_THAT(bytes.error().what, HasSubstr("LORD: not parallel: 1 entries for 9 leaves"));
}

}  // namespace
}  // namespace copse
