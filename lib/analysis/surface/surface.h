// surface: the connectivity of one triangle surface, whatever its state: which triangle lies across each
// edge.
#pragma once

#include "lib/analysis/surface/trunk_mesh.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace copse {

// A piece of a TrunkMesh with its own compact vertex numbers (ascending in those of the whole). Coincident
// triangles (same three vertices) are kept once, and so are quads of a surface that is laid double, cut by
// one diagonal and by the other.
struct Surface {
  std::vector<Double3> positions;
  std::vector<Triangle> triangles;
  // One an edge of each triangle (edge e runs from corner e to corner e + 1): the triangle across it, k_none
  // at a border. Where more than two triangles meet at an edge they are paired as make_surface() says, and
  // those that have no partner see a border. Symmetric: across[across[t][e]] names t at the same edge.
  std::vector<Triangle> across;
  std::vector<std::uint32_t> vertex;       // one a position: its id in the whole
  std::vector<std::uint32_t> order;        // one a triangle: its place in the source file, for reading quads
  std::vector<std::uint32_t> triangle_of;  // one a triangle that was asked for: the one it became
  std::uint32_t non_manifold_edges = 0;
  std::uint32_t border_edges = 0;  // edges of one triangle
};

// `triangles` are ids of whole.triangles. An edge of more than two triangles is pulled apart: triangles of
// the same piece (TrunkMesh::piece) belong together when there are just two of it; otherwise, where the
// triangles around the edge alternate in direction, those that enclose matter are paired, so that solids that
// touch along an edge come apart. O(n).
Surface make_surface(const TrunkMesh& whole, std::span<const std::uint32_t> triangles);

// The corner of `t` that is neither `a` nor `b`.
inline std::uint32_t third_corner(const Triangle& t, std::uint32_t a, std::uint32_t b) {
  if (t[0] != a && t[0] != b) return t[0];
  return t[1] != a && t[1] != b ? t[1] : t[2];
}

// The edge (0, 1 or 2) of `t` between its corners `a` and `b`.
inline int edge_between(const Triangle& t, std::uint32_t a, std::uint32_t b) {
  if (t[2] != a && t[2] != b) return 0;
  return t[0] != a && t[0] != b ? 1 : 2;
}

// The border through edge `edge` of `triangle`, which must be one: its vertices in order. Turns about each
// vertex through the triangles that are partners across edges. Linear in what it passes.
std::vector<std::uint32_t> border_loop(const Surface& surface, std::uint32_t triangle, std::size_t edge);

}  // namespace copse
