// A tree as a GPU draws it: one array of interleaved vertices, one of indices, and a range of indices for
// each material. Built once when a tree is loaded; what is drawn of it afterwards is a choice of sub-ranges.
//
// The order of the file is kept inside every range, because the level of detail lives in it (digest 000,
// sections 3.5 and 3.6): trunk triangles by ascending segment diameter, so the thick part of a trunk is the
// end of its range; leaves group after group in the order of the groups, so the far or near part of a group
// is one run of triangles.
#pragma once

#include "lib/formats/mesh.h"
#include "lib/formats/tree/tree.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

struct DrawVertex {
  Float3 position;  // relative to TreeGeometry::origin
  Float3 normal;    // length 1
  Float2 texcoord;  // (0, 0) where the tree has none; v up
  friend bool operator==(const DrawVertex&, const DrawVertex&) = default;
};
static_assert(sizeof(DrawVertex) == 32);

enum class DrawPart : std::uint8_t { trunk, leaves, mesh, ground };  // mesh: nobody knows what it is

struct DrawRange {
  DrawPart part = DrawPart::trunk;
  std::uint32_t material = k_none;
  std::uint32_t first_index = 0;
  std::uint32_t index_count = 0;
  friend bool operator==(const DrawRange&, const DrawRange&) = default;
};

struct TreeGeometry {
  Double3 origin;
  FloatBox bounds;  // of the vertices that are drawn, relative to the origin
  std::vector<DrawVertex> vertices;
  std::vector<std::uint32_t> indices;  // three a triangle, counter-clockwise seen from the front
  std::vector<DrawRange> ranges;       // trunk first, then leaves; inside each by ascending material
};

// A corner that names no normal gets one: the mean of the faces round its vertex, weighted by their angle
// there, unless that differs from its own face by more than 60 degrees; then the face's own normal. The faces
// that are averaged are those of the same part (trunk or leaves) that share the vertex. A triangle without an
// area gets (0, 1, 0). Linear in the number of corners.
//
// Every triangle of the tree is in `indices` exactly once; vertices are shared by all corners of one part
// that have the same vertex, normal and texture coordinate.
TreeGeometry make_geometry(const Tree& tree);

// The mesh as it is, in the order of the file inside each material; the origin is the middle of its bounds
// when they lie farther from 0 than 1000 times their size, otherwise 0.
TreeGeometry make_geometry(const Mesh& mesh);

}  // namespace copse
