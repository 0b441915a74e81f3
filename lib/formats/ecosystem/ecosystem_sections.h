// The sections of .eco files that are plain arrays, in file order: writer and reader go by this one list.
#pragma once

#include "lib/formats/ecosystem/ecosystem.h"
#include "lib/formats/ecosystem/ecosystem_header.h"

#include <cstdint>
#include <string_view>

namespace copse {

// EINS is 2 since rotations are stored as an axis and a head; all others are 1.
inline std::uint32_t section_version(std::string_view name) {
  return name == "EINS" ? 2 : 1;
}

// Files from before it have none.
inline bool may_be_missing(std::string_view name) {
  return name == "EHSH";
}

// Calls visit(name, array, count): `counts` and the head of `eco` give the counts that a file must have.
template <class EcosystemRef, class Visit>
void for_each_array(EcosystemRef& eco, const EcosystemCounts& counts, Visit&& visit) {
  const std::uint64_t vertices = eco.terrain.vertex_count();
  visit("EHGT", eco.terrain.heights, counts.regular_terrain ? vertices : 0);
  visit("EPNT", eco.terrain.points, counts.regular_terrain ? 0 : vertices);
  visit("EBOX", eco.boxes, std::uint64_t{counts.box_nodes(eco.depth)});
  visit("EKDT", eco.kd_tree, std::uint64_t{counts.kd_nodes});
  visit("ERTR", eco.rtree, std::uint64_t{counts.rtree_nodes});
  visit("EBLK", eco.blocks, std::uint64_t{counts.blocks});
  visit("EHSH", eco.block_hashes, std::uint64_t{counts.blocks});
  visit("EINS", eco.packed, std::uint64_t{counts.exact ? 0 : counts.instances});
  visit("EINX", eco.exact, std::uint64_t{counts.exact ? counts.instances : 0});
}

}  // namespace copse
