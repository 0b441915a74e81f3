// The trunk's hierarchy as it is recovered: rings (radii), who hangs on whom, and which triangles each
// generalized cylinder explains. tree/assemble.h turns it into the stored arrays.
#pragma once

#include "lib/formats/material.h"
#include "lib/formats/vec.h"

#include <cstdint>
#include <string>
#include <vector>

namespace copse {

enum class RadiusSource : std::uint8_t {
  ring,     // a ring of mesh vertices, read from topology
  point,    // a ring collapsed to one vertex: diameter 0
  surface,  // a node of a surface skeleton, radius measured on the surface
};

struct RadiusNode {
  Double3 centre;                 // mean of the ring's distinct vertices, or the skeleton's node
  double diameter = 0;            // 2/k sum |v - c|
  std::uint32_t parent = k_none;  // an earlier radius: parents come before children
  bool joint = false;             // no surface joins it to its parent
  RadiusSource source = RadiusSource::ring;
  std::uint32_t branch = 0;  // radii of one tube or one skeleton branch share it
};

struct Hierarchy {
  std::vector<RadiusNode> radii;
  // The vertices of each radius (ids of TrunkMesh::positions), in cyclic order along the ring where there is
  // one: ring_vertices[first_vertex[r] .. first_vertex[r + 1]). first_vertex has radii + 1 entries. A vertex
  // belongs to at most one radius; vertices that belong to none (cap centres, lumps) are given to one by
  // tree/assemble.h.
  std::vector<std::uint32_t> first_vertex{0};
  std::vector<std::uint32_t> ring_vertices;
  // One a trunk triangle: the child radius of the segment that explains it, k_none where none does.
  std::vector<std::uint32_t> segment_of;
  // What a user should know: one line each, with element ids.
  std::vector<std::string> notes;
};

}  // namespace copse
