// A tree in few bytes: the section PACK, which stands for all array sections of a .stree (docs/formats.md).
//
// Positions lie on a grid whose step is a power of two, normals on an octahedron, texture coordinates on a
// grid; leaves are shapes and frames, rings follow from the rings before, and what follows from the rest
// (derive_tree.h) is not stored at all. What a reader gets is a tree like any other, whose sections are those
// that treeprep would write for the moved vertices.
#pragma once

#include "lib/formats/container/container.h"
#include "lib/formats/packing/range_coder.h"
#include "lib/formats/result.h"
#include "lib/formats/tree/tree.h"
#include "lib/formats/tree/tree_header.h"

#include <cstdint>
#include <expected>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace copse {

inline constexpr std::uint32_t k_pack_version = 2;

struct PackOptions {
  int position_bits = 14;  // of the longest side of the box, about; 8 to 20
  int texcoord_bits = 12;  // of 1, or of the largest coordinate when it is larger; 8 to 20
};

// Why this tree cannot be packed: it is a .tree, or sections of it were left out. Empty: it can.
std::string why_unpackable(const Tree& tree);

struct PackPlan;

struct PackedTree {
  std::vector<std::uint8_t> bytes;
  Tree tree;  // as it will be read
  // The largest distance of a vertex from where it was, metres.
  double trunk_error = 0, leaf_error = 0;
  std::vector<StreamCost> streams;       // of `bytes`
  std::shared_ptr<const PackPlan> plan;  // of `bytes`; for renumbered()
};

// Deterministic. Linear in the tree but for sorting. Leaves are renumbered: the leaves of group 0 come first,
// then those of group 1. Errors: an unpackable tree is a mistake of the caller; coordinates that no grid of
// this fineness holds are refused.
Result<PackedTree> pack_tree(const Tree& tree, const PackOptions& options);

// The same with other numbers for the leaves: in the order of `leaves`, each group's together. Every vertex
// and normal stays what it is. Where the file says how a group's leaves are ordered, that order stands.
Result<PackedTree> renumbered(const PackedTree& packed, std::span<const std::uint32_t> leaves);

// The tree, but for what `head` and `materials` do not hold. What is wrong is told; nothing is trusted but
// that `head` is a sound HEAD. Memory is bounded by the counts of the head, which are refused when the bytes
// cannot justify them.
std::expected<Tree, std::string> unpack_tree(std::span<const std::uint8_t> bytes, const Head& head,
                                             const std::vector<Material>& materials);

// Compresses what stays beside PACK, but for images: provenance, materials, textures and their names, as
// `source`, which `writer` was made of, has them.
Result<void> compress_records(ContainerWriter& writer, const Container& source);

// Puts HEAD and PACK in place of all sections that PACK stands for.
Result<void> put_packed(ContainerWriter& writer, const PackedTree& packed);

// The file as if it had never been packed: every section of the tree raw, all others as they are.
Result<Container> unpacked(const Container& file);

}  // namespace copse
