// classify: which triangles of a mesh are trunk and which are leaves, piece by piece, with a reason for each.
//
// Digest 000 section 1.1 splits a model into leaves and trunk and leaves open how; docs/leaves.md says how a
// person is imitated here: patterns of the user, then names, then materials and shape.
#pragma once

#include "lib/formats/mesh.h"
#include "lib/formats/result.h"

#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace copse {

enum class PartClass : std::uint8_t { trunk, leaf };

struct ClassifyOptions {
  // Globs (* ? [..], case-insensitive) over material, group and object names; "*" matches what has no name,
  // too. Parts that match none are decided by the mesh itself.
  std::vector<std::string> trunk_patterns, leaf_patterns;
};

// A component: a piece of the surface, connected through edges, whose triangles share a class.
struct Component {
  PartClass kind = PartClass::trunk;
  // "material 'Bark_NormalTree' says bark", "tube, 14 times as long as thick", "flat card of 2 triangles, one
  // of 949 alike". Lives as long as any copy of the Classification that it came with.
  std::string_view reason;
  std::uint32_t part = 0;  // of its first triangle
  std::uint32_t triangles = 0;
};

struct Classification {
  std::vector<std::uint32_t> component_of;  // one a mesh triangle: index into components
  std::vector<Component> components;        // ordered by their first triangle
  // One a mesh triangle: the leaf it belongs to (0-based, ordered by first triangle), k_none on the trunk.
  // A leaf is what an artist would call one: a card, two or more cards that cross in one centre, cards laid
  // back to back, a frond, a disc, a blob.
  std::vector<std::uint32_t> leaf_of;
  std::uint32_t leaf_count = 0;
  std::uint64_t trunk_triangles = 0, leaf_triangles = 0;
  std::shared_ptr<const std::vector<std::string>> reasons;  // what Component::reason looks at, each once
};

// Fails (Fault::usage) when a pattern matches no name or a part is claimed by both lists. Whatever the mesh
// is, empty included, there is an answer. Linear in the triangles but for sorting the edges around a vertex.
Result<Classification> classify(const Mesh& mesh, const ClassifyOptions& options = {});

// The same when the caller has welded the mesh already: `welded` is weld()'s answer for mesh.positions.
Result<Classification> classify(const Mesh& mesh, std::span<const std::uint32_t> welded,
                                const ClassifyOptions& options = {});

}  // namespace copse
