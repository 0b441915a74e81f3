// The HEAD section of .tree and .stree: every header item of digest 000 (section 3.2, items 1-14; section
// 4.1; erratum E12), at fixed offsets. docs/formats.md gives the bytes.
#pragma once

#include "lib/formats/tree/tree.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace copse {

// How many elements each array of a tree has. Arrays of one entry a segment (or a leaf) share a count, and
// may each be left out.
struct TreeCounts {
  std::uint32_t trunk_triangles = 0;
  std::uint32_t trunk_vertices = 0;  // of an .stree: its vertex vectors
  std::uint32_t trunk_normals = 0;
  std::uint32_t trunk_texcoords = 0;
  std::uint32_t segments = 0;  // the thesis' "lines"
  std::uint32_t line_vertices = 0;
  std::uint32_t leaf_triangles = 0;
  std::uint32_t leaves = 0;
  std::uint32_t leaf_vertices = 0;
  std::uint32_t leaf_normals = 0;
  std::uint32_t leaf_texcoords = 0;
  std::uint32_t groups = 0;
  std::uint32_t group_nodes = 0;
  std::uint32_t radii = 0;
  std::uint32_t materials = 0;
  std::uint32_t textures = 0;
  friend bool operator==(const TreeCounts&, const TreeCounts&) = default;
};

inline constexpr std::size_t k_head_size = 256;

struct Head {
  TreeHeader header;
  TreeCounts counts;
  std::uint32_t trunk_material = k_none;
  std::uint32_t leaf_material = k_none;
  bool trunk_materials = false;  // each trunk triangle has its own material (TMAT)
  bool leaf_materials = false;   // each leaf has its own material (LMAT)
};

// The head of a tree in memory. Precondition: check_sizes(tree) found nothing.
Head head_of(const Tree& tree);

std::vector<std::uint8_t> encode_head(const Head& head);

// Fills everything but header.kind. Answers what is wrong (reserved bytes, unknown flags or orders) and at
// which offset, or nothing.
struct HeadFault {
  std::size_t offset = 0;
  std::string what;  // empty: sound
};
HeadFault decode_head(std::span<const std::uint8_t> bytes, Head& head);

}  // namespace copse
