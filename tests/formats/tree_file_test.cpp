#include "lib/formats/tree_file.h"

#include "tests/formats/tree_maker.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

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

}  // namespace
}  // namespace copse
