// Which triangles of a mesh are trunk and which are leaves, component by component, with a reason for each.
#pragma once

#include "lib/formats/mesh.h"
#include "lib/formats/result.h"

#include <cstdint>
#include <string>
#include <vector>

namespace copse {

enum class PartClass : std::uint8_t { trunk, leaf };

struct ClassifyOptions {
  // Globs (* ? [..], case-insensitive) over material, object and group names; empty: decided by the mesh
  // itself.
  std::vector<std::string> trunk_patterns, leaf_patterns;
};

// A component: a connected piece of the surface whose triangles share a class.
struct Component {
  PartClass kind = PartClass::trunk;
  std::string
      reason;  // "material 'Bark_NormalTree' names bark", "tube of 14 rings", "flat card of 2 triangles"
  std::uint32_t part = 0;  // of its first triangle
  std::uint64_t triangles = 0;
};

struct Classification {
  std::vector<std::uint32_t> component_of;  // one a mesh triangle: index into components
  std::vector<Component> components;        // ordered by their first triangle
  // One a mesh triangle: the leaf it belongs to (0-based, ordered by first triangle), k_none on the trunk.
  // A leaf is what an artist would call one: a card, a quad pair that crosses, a frond, a disc, a blob.
  std::vector<std::uint32_t> leaf_of;
  std::uint32_t leaf_count = 0;
};

}  // namespace copse
