// The EHED section of .eco files and the records of its types, at fixed offsets. docs/formats.md gives the
// bytes.
#pragma once

#include "lib/formats/ecosystem/ecosystem.h"
#include "lib/formats/materials.h"
#include "lib/formats/tree/tree_header.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace copse {

inline constexpr std::size_t k_ecosystem_head_size = 256;
inline constexpr std::size_t k_type_record = 64;

struct EcosystemCounts {
  std::uint32_t types = 0, blocks = 0, instances = 0, materials = 0, textures = 0;
  std::uint32_t kd_nodes = 0, rtree_nodes = 0;
  bool exact = false;            // 48 bytes an instance
  bool regular_terrain = false;  // EHGT, otherwise EPNT
  std::uint32_t box_nodes(std::uint32_t depth) const { return blocks ? first_quad_node(depth + 1) : 0; }
};

std::vector<std::uint8_t> encode_ecosystem_head(const Ecosystem& eco);
// Fills everything of `eco` that the head holds. What is wrong and where, or nothing.
HeadFault decode_ecosystem_head(std::span<const std::uint8_t> bytes, Ecosystem& eco, EcosystemCounts& counts);

// Records in one section, names and URIs one after the other in a second.
struct EncodedTypes {
  std::vector<std::uint8_t> records, texts;
};
EncodedTypes encode_types(const std::vector<TreeType>& types);
// `packed[i]` says whether type i lies in the file.
RecordFault decode_types(std::span<const std::uint8_t> records, std::span<const std::uint8_t> texts,
                         std::vector<TreeType>& types, std::vector<bool>& packed);

// "P000", "P001", ...: the section of a packed tree.
std::string packed_section(std::size_t type);

}  // namespace copse
