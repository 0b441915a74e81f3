#include "lib/formats/tree_file/omit.h"

#include "lib/formats/tree/check_tree.h"
#include "lib/formats/tree_file/tree_file.h"
#include "tests/formats/tree_maker.h"

#include <algorithm>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace copse {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

Tree whole(TreeKind kind) {
  return make_tree({.kind = kind, .radii = 12, .leaves = 9, .groups = 3}, 5);
}

std::vector<std::string> names(const std::vector<Omitted>& omitted) {
  std::vector<std::string> out;
  for (const Omitted& o : omitted) out.push_back(o.name);
  return out;
}

Tree written_and_loaded(const Tree& tree, const std::vector<std::string>& omit,
                        std::vector<Omitted>& omitted) {
  const auto bytes = encode_tree(tree, {.omit = omit});
  EXPECT_TRUE(bytes) << bytes.error().what;
  const auto file = TreeFile::from_bytes(*bytes, "f");
  EXPECT_TRUE(file) << file.error().what;
  omitted = file->omissions();
  EXPECT_THAT(file->verify(), IsEmpty());
  const auto loaded = file->load();
  EXPECT_TRUE(loaded) << loaded.error().what;
  return *loaded;
}

TEST(Omit, EverySectionAndEveryPairCanBeLeftOutSoundly) {
  for (const TreeKind kind : {TreeKind::still, TreeKind::sensitive}) {
    const Tree tree = whole(kind);
    for (const Omissible& a : omissible_sections()) {
      for (const Omissible& b : omissible_sections()) {
        std::vector<Omitted> omitted;
        const Tree loaded = written_and_loaded(tree, {std::string(a.name), std::string(b.name)}, omitted);
        ASSERT_THAT(check_tree(loaded), IsEmpty()) << a.name << " " << b.name;
        // Written again it is the same: what is gone stays gone, and listed where a reader must know.
        ASSERT_TRUE(same(*TreeFile::from_bytes(*encode_tree(loaded), "g")->load(), loaded))
            << a.name << " " << b.name;
      }
    }
  }
}

TEST(Omit, ListsWhatWentWithItAndWhatThatSaved) {
  std::vector<Omitted> omitted;
  const Tree tree = whole(TreeKind::sensitive);
  const Tree loaded = written_and_loaded(tree, {"LVTX"}, omitted);
  EXPECT_THAT(names(omitted), ElementsAre("LTRI", "LVTX", "LNRM", "LTEX"));
  const Leaves& l = tree.leaves;
  EXPECT_EQ(omitted[0].bytes, l.triangles.size() * 36 + l.first_triangle.size() * 4);
  EXPECT_EQ(omitted[1].bytes, l.vertices.size() * 12);
  EXPECT_EQ(omitted[3].bytes, l.texcoords.size() * 8);
  EXPECT_EQ(loaded.leaf_count(), tree.leaf_count());
  EXPECT_EQ(loaded.first_triangle_of_leaf(3), 0u);
}

TEST(Omit, TheSumOfWhatWasSavedIsWhatTheFileIsShorter) {
  const Tree tree = whole(TreeKind::sensitive);
  const auto decoded_total = [](const std::vector<std::uint8_t>& bytes) {
    std::uint64_t total = 0;
    const auto file = TreeFile::from_bytes(bytes, "f");
    for (const SectionInfo& s : file->sections()) {
      if (s.name != "OMIT") total += s.decoded_size;
    }
    return total;
  };
  const std::uint64_t all = decoded_total(*encode_tree(tree));
  for (const Omissible& o : omissible_sections()) {
    const auto bytes = *encode_tree(tree, {.omit = {std::string(o.name)}});
    std::uint64_t saved = 0;
    const auto file = TreeFile::from_bytes(bytes, "f");
    for (const Omitted& gone : file->omissions()) saved += gone.bytes;
    EXPECT_EQ(decoded_total(bytes) + saved, all) << o.name;
  }
}

TEST(Omit, CornersForgetTheNormalsThatAreGone) {
  std::vector<Omitted> omitted;
  const Tree loaded = written_and_loaded(whole(TreeKind::still), {"TNRM"}, omitted);
  ASSERT_FALSE(loaded.trunk.triangles.empty());
  for (const CornerTriangle& t : loaded.trunk.triangles) {
    EXPECT_EQ(t.normal, (std::array<std::uint32_t, 3>{k_none, k_none, k_none}));
  }
  EXPECT_TRUE(std::any_of(loaded.trunk.triangles.begin(), loaded.trunk.triangles.end(),
                          [](const auto& t) { return t.texcoord[0] != k_none; }));
}

TEST(Omit, TerminalRadiiForgetTheGroupsThatAreGone) {
  std::vector<Omitted> omitted;
  const Tree loaded = written_and_loaded(whole(TreeKind::sensitive), {"LGRP"}, omitted);
  EXPECT_THAT(names(omitted), ElementsAre("LGRP", "LORD", "LGHI"));
  for (const Radius& r : loaded.hierarchy.radii) {
    const bool forgotten = r.first_child == k_none && r.child_count == 0;
    EXPECT_TRUE(forgotten || !(r.flags & Radius::terminal));
  }
}

TEST(Omit, GroupsWithoutLeavesKeepTheirNumbers) {
  std::vector<Omitted> omitted;
  const Tree tree = whole(TreeKind::sensitive);
  const Tree loaded = written_and_loaded(tree, {"LTRI", "LCEN", "LMAT", "LORD"}, omitted);
  EXPECT_EQ(loaded.leaf_count(), 0u);
  EXPECT_EQ(loaded.leaves.groups.to_vector(), tree.leaves.groups.to_vector());
}

TEST(Omit, WithoutVectorsThereIsNoSurfaceToRebuild) {
  std::vector<Omitted> omitted;
  const Tree loaded = written_and_loaded(whole(TreeKind::sensitive), {"RVEC"}, omitted);
  EXPECT_THAT(trunk_vertices(loaded), IsEmpty());
  EXPECT_EQ(loaded.first_vector_of(loaded.radius_count()), 0u);
}

TEST(Omit, AFileThatIsWrittenAgainStillListsWhatIsMissing) {
  std::vector<Omitted> first, second;
  const Tree once = written_and_loaded(whole(TreeKind::sensitive), {"LCEN", "TLIN"}, first);
  written_and_loaded(once, {}, second);
  EXPECT_EQ(first, second);
  EXPECT_THAT(names(first), ElementsAre("TLIN", "LCEN"));
}

TEST(Omit, RefusesWhatCannotBeLeftOut) {
  for (const char* name : {"HEAD", "RADI", "TFIR", "NONE", "tnrm", ""}) {
    const auto reduced = leave_out(whole(TreeKind::sensitive), {name});
    ASSERT_FALSE(reduced) << name;
    EXPECT_EQ(reduced.error().fault, Fault::usage);
    EXPECT_THAT(reduced.error().what, HasSubstr("cannot be left out"));
  }
}

TEST(Omit, WhatIsKeptIsSharedNotCopied) {
  const Tree tree = whole(TreeKind::sensitive);
  const auto reduced = leave_out(tree, {"TNRM"});
  EXPECT_EQ(reduced->tree.leaves.vertices.data(), tree.leaves.vertices.data());
}

}  // namespace
}  // namespace copse
