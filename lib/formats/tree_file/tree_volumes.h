// The bounding volumes of a tree, as sections of its file: VSET, VOLU, VNUM and VNOD (docs/formats.md).
//
// bvfit adds them to a .tree or .stree; a reader that does not know them skips them. Coordinates are those of
// the tree: relative to its header's origin.
#pragma once

#include "lib/formats/array.h"
#include "lib/formats/container/container.h"
#include "lib/formats/material.h"
#include "lib/formats/result.h"
#include "lib/formats/volumes/volume_numbers.h"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace copse {

class TreeFile;
struct TreeCounts;

// What a set of points is: a part of the tree, by `index` where there are several.
enum class VolumePart : std::uint32_t {
  whole = 0,
  trunk = 1,
  leaves = 2,
  group = 3,    // a leaf group
  segment = 4,  // a segment of the trunk
  cell = 5,     // a foliage cell
  node = 6,     // everything below a node of the hierarchy
};
inline constexpr std::uint32_t k_volume_parts = 7;

enum class VolumeMotion : std::uint32_t {
  rest = 0,      // the part as the tree stands: for tests of the part itself, moved along with it
  envelope = 1,  // everywhere that it can be: for everything above it, which then never needs an update
};

struct VolumeSet {
  VolumePart part = VolumePart::whole;
  std::uint32_t index = k_none;  // of the group, segment, cell or node; k_none for the others
  VolumeMotion motion = VolumeMotion::rest;
  std::uint32_t first = 0, count = 0;  // its volumes
  std::uint32_t chosen = 0;            // which of them (0 .. count - 1) to test with
  std::uint32_t points = 0;            // how many vertices it holds
  float sway = 0;  // of an envelope, degrees: how far every link turns (motion_envelope.h); 0: not known
  friend bool operator==(const VolumeSet&, const VolumeSet&) = default;
};
static_assert(sizeof(VolumeSet) == 32);

struct VolumeRecord {
  enum Flags : std::uint32_t { certified = 1 };  // proven to hold every vertex of its set, as stored
  VolumeKind kind = VolumeKind::aabb;
  std::uint32_t flags = 0;
  std::uint32_t first = 0, count = 0;  // its numbers
  std::array<char, 24> method{};       // ASCII, filled up with zeros
  double volume = 0;                   // of the interior
  double lower_bound = 0;              // of any volume of this kind round these points; 0: none is known
  std::string_view method_name() const;
  friend bool operator==(const VolumeRecord&, const VolumeRecord&) = default;
};
static_assert(sizeof(VolumeRecord) == 56);

// A node of one hierarchy over groups, segments or cells: depth first, as BoxNode of lib/analysis/bvh.
struct VolumeNode {
  std::uint32_t skip = 0;       // the next node that is not below this one
  std::uint32_t item = k_none;  // of a bottom node: its group, segment or cell
  std::uint32_t set = 0;        // the volumes of what is below, fitted to its vertices
  friend bool operator==(const VolumeNode&, const VolumeNode&) = default;
};
static_assert(sizeof(VolumeNode) == 12);

struct TreeVolumes {
  Array<VolumeSet> sets;
  Array<VolumeRecord> volumes;
  Array<float> numbers;
  Array<VolumeNode> nodes;

  bool empty() const { return sets.empty(); }
  Volume<float> volume(std::size_t i) const {
    return volume_of(volumes[i].kind, numbers.span().subspan(volumes[i].first, volumes[i].count));
  }
  Volume<float> chosen(const VolumeSet& set) const { return volume(set.first + set.chosen); }
};

// "whole", "group 12", "segment 3 envelope".
std::string set_name(const VolumeSet& set);

// The file with these volumes instead of those that it may have; all other sections as they are stored.
// Precondition: check_volumes finds nothing.
Result<std::vector<std::uint8_t>> with_volumes(const Container& file, const TreeVolumes& volumes);

// What the file has; empty when it has none. Refused when anything in them is not sound, unless the file was
// opened as trusted (then only sizes are checked).
Result<TreeVolumes> load_volumes(const TreeFile& file);

// Everything that is wrong, one line each: indices out of range, numbers that make no volume, overlapping or
// missing runs, hierarchies that are none. That certified volumes hold their vertices is not looked at here
// (bvfit --verify and treedump --verify do).
std::vector<std::string> check_volumes(const TreeVolumes& volumes, const TreeCounts& counts);

}  // namespace copse
