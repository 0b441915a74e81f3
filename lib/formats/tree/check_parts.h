// What check_elements is made of; each part is a .cpp of its own.
#pragma once

#include "lib/formats/tree/check_tree.h"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace copse {

// What all parts of a check share. An index is followed only after the section that holds it was found sound.
struct Check {
  const Tree& tree;
  const Head& head;
  Findings& findings;

  const TreeCounts& counts() const { return head.counts; }
  bool sensitive() const { return head.header.kind == TreeKind::sensitive; }
  // As Findings::add.
  template <class Detail = std::string>
  void add(std::string_view section, std::size_t element, std::string_view kind, Detail&& detail = {}) const {
    findings.add(section, element, kind, std::forward<Detail>(detail));
  }

  // Each answers whether all is well.
  template <class T>
  bool finite(std::string_view section, const Array<T>& values) const;
  bool below(std::string_view section, const Array<std::uint32_t>& values, std::uint32_t limit,
             std::string_view of, bool or_none) const;
  bool corners(std::string_view section, const Array<CornerTriangle>& triangles, std::uint32_t vertices,
               std::uint32_t normals, std::uint32_t texcoords) const;
  // Offsets of `owners` runs over `elements`: from 0, never back, to the end.
  bool offsets(std::string_view section, const Array<std::uint32_t>& values, std::uint32_t elements) const;
  bool inside(std::string_view section, std::span<const Float3> points, const FloatBox& box,
              std::string_view which) const;
  template <class T>
  bool sorted(std::string_view section, const Array<T>& values) const;
};

void check_header(const Check& check);     // boxes, numbers, materials
bool check_hierarchy(const Check& check);  // radii and their vectors; answers whether links can be followed
void check_trunk(const Check& check, bool hierarchy_is_sound);
bool check_leaves(const Check& check);  // answers whether all leaves are there and can be followed
void check_groups(const Check& check, bool leaves_are_sound);
void check_group_hierarchy(const Check& check);

}  // namespace copse
