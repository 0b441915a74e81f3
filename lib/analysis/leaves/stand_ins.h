// stand_ins: parts of a mesh that stand in for a tree that is there besides: collision hulls, and coarser
// levels of detail in the same file.
//
// Game engines know them by their names alone, and so it is told here: Unreal's prefixes UCX_, UBX_, USP_,
// UCP_ and MCDCX_, Godot's suffixes -colonly and -convcolonly, the words collision, collider and hitbox, and
// _LOD1, _LOD2, ... beside a lower one of the same name.
#pragma once

#include "lib/formats/mesh.h"

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace copse {

// The word of a name that says collision hull ("ucx", "collision"); empty where none does.
std::string_view hull_word(std::string_view name);

// "Oak_LOD2_bark" is level 2 of "oak_".
struct LodName {
  std::string of;  // what stands before, in lower case
  std::uint32_t level = 0;
  friend bool operator==(const LodName&, const LodName&) = default;
};
std::optional<LodName> lod_name(std::string_view name);

// A part that may be left out, and why.
struct StandIn {
  std::uint32_t part = 0;
  std::string name;  // the object's or group's, which tells it
  bool hull = false;
  friend bool operator==(const StandIn&, const StandIn&) = default;
};

// Ascending. Object and group names count, materials do not: leaves share those with their levels. `kept`:
// globs of the user's (--trunk, --leaf); one that matches the name and spells what tells it ("*lod1*",
// "UCX_*") keeps a part. Nothing where all triangles would be gone. O(parts log parts + triangles).
std::vector<StandIn> find_stand_ins(const Mesh& mesh, std::span<const std::string> kept);

// Takes the triangles of these parts out, and the positions that nothing else uses. The answer: which
// triangle each one that is left was. O(n).
std::vector<std::uint32_t> remove_parts(Mesh& mesh, std::span<const std::uint32_t> parts);

}  // namespace copse
