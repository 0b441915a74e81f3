// The sections of .tree and .stree that are plain arrays: their names in file order, their element, how many
// elements each has, and where a Tree keeps them. Writer, reader and checker all go by this one list.
#pragma once

#include "lib/formats/tree/tree.h"
#include "lib/formats/tree/tree_header.h"

#include <cstdint>
#include <string_view>

namespace copse {

inline constexpr std::uint32_t k_tree_section_version = 1;

enum class Presence : std::uint8_t {
  required,  // whenever its count is not 0
  optional,  // may be left out although its count is not 0; the file then lists it as omitted
};

// How many offsets a table of `owners` runs has: none when every run has `constant` elements.
inline std::uint64_t offset_count(std::uint32_t owners, std::uint32_t constant, std::uint32_t elements) {
  return owners == 0 || constant != 0 || elements == 0 ? 0 : std::uint64_t{owners} + 1;
}

// Calls visit(name, array, count, presence) for every array section, in file order (digest 000, sections 3.2
// and 4.1: the hierarchy before the trunk, the trunk before the leaves). `head` gives the counts that a file
// must have.
template <class TreeRef, class Visit>
void for_each_array(TreeRef& tree, const Head& head, Visit&& visit) {
  const TreeCounts& c = head.counts;
  const TreeHeader& h = head.header;
  const bool sensitive = h.kind == TreeKind::sensitive;
  const auto required = Presence::required, optional = Presence::optional;
  if (sensitive) {
    visit("RADI", tree.hierarchy.radii, std::uint64_t{c.radii}, required);
    visit("RFIR", tree.hierarchy.first_vector, offset_count(c.radii, h.ring_size, c.trunk_vertices),
          required);
    visit("RVEC", tree.hierarchy.vectors, std::uint64_t{c.trunk_vertices}, required);
  }
  visit("TTRI", tree.trunk.triangles, std::uint64_t{c.trunk_triangles}, required);
  visit("TFIR", tree.trunk.first_triangle, offset_count(c.segments, h.segment_factor, c.trunk_triangles),
        required);
  visit("TLIN", tree.trunk.lines, std::uint64_t{c.segments}, optional);
  visit("TDIA", tree.trunk.diameters, std::uint64_t{c.segments}, optional);
  visit("TACC", tree.trunk.accumulated_lengths, std::uint64_t{c.segments}, optional);
  visit("TMAT", tree.trunk.materials, std::uint64_t{head.trunk_materials ? c.trunk_triangles : 0}, required);
  if (!sensitive) {
    visit("TVTX", tree.trunk.vertices, std::uint64_t{c.trunk_vertices}, required);
    visit("TLVX", tree.trunk.line_vertices, std::uint64_t{c.line_vertices}, required);
  }
  visit("TNRM", tree.trunk.normals, std::uint64_t{c.trunk_normals}, required);
  visit("TTEX", tree.trunk.texcoords, std::uint64_t{c.trunk_texcoords}, required);
  visit("LTRI", tree.leaves.triangles, std::uint64_t{c.leaf_triangles}, required);
  visit("LFIR", tree.leaves.first_triangle, offset_count(c.leaves, h.leaf_factor, c.leaf_triangles),
        required);
  visit("LCEN", tree.leaves.centres, std::uint64_t{c.leaves}, optional);
  visit("LMAT", tree.leaves.materials, std::uint64_t{head.leaf_materials ? c.leaves : 0}, required);
  visit("LVTX", tree.leaves.vertices, std::uint64_t{c.leaf_vertices}, required);
  visit("LNRM", tree.leaves.normals, std::uint64_t{c.leaf_normals}, required);
  visit("LTEX", tree.leaves.texcoords, std::uint64_t{c.leaf_texcoords}, required);
  visit("LGRP", tree.leaves.groups, std::uint64_t{c.groups}, required);
  visit("LORD", tree.leaves.order, std::uint64_t{c.leaves}, optional);
  visit("LGHI", tree.leaves.group_hierarchy, std::uint64_t{c.group_nodes}, required);
}

}  // namespace copse
