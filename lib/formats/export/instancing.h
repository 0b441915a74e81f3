// A GLB whose nodes are drawn many times: by EXT_mesh_gpu_instancing, or as so many nodes of one mesh.
#pragma once

#include "lib/formats/result.h"
#include "lib/formats/vec.h"

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace copse {

struct NodeInstances {
  std::string node;  // its name
  std::vector<Float3> translations;
  std::vector<std::array<float, 4>> rotations;  // x, y, z, w; length 1
  std::vector<float> scales;
  // Linear RGB by which the materials' colours are multiplied; empty: none. As attribute _COLOR_0, which the
  // extension leaves to applications and three.js (r158) and Babylon.js (8.31) take for this; other readers
  // pass over it, and nodes have no place for it.
  std::vector<Float3> colours{};
};

enum class Instancing {
  extension,  // attributes of the node: compact, and required of whoever reads it
  nodes,      // a child of the node each: for programs that do not know the extension, at most k_most_nodes
};
inline constexpr std::size_t k_most_nodes = 200'000;

// `glb` (as export_mesh writes it) with instances for the named nodes, and everything moved by `origin`,
// exactly: in the translation of a root node. Nodes that are not named stay as they are. Refused: a name that
// no node has, more than 4 GiB, more than k_most_nodes as nodes.
Result<std::string> with_instances(std::string_view glb, std::span<const NodeInstances> nodes,
                                   const Double3& origin, Instancing form = Instancing::extension);

}  // namespace copse
