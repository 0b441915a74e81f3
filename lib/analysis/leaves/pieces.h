// pieces: the pieces of a surface whose triangles are joined by edges.
//
// Two triangles are joined when they share an edge by position: seams and flat-shaded splits, which repeat
// positions, are mended. Triangles that merely touch in a point are not: leaves that grow from one point, or
// whose tips happen to meet, stay themselves.
#pragma once

#include "lib/formats/mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

struct Pieces {
  // What is known of a triangle's edges; edge i runs from corner i to corner (i + 1) % 3.
  enum Edges : std::uint8_t {
    border_0 = 1,      // border_0 << i: no other triangle of the same key has edge i
    neighbour_0 = 8,   // neighbour_0 << i: a triangle of another key has edge i
    non_manifold = 64  // more than two triangles of the same key share one of the edges
  };

  std::vector<std::uint32_t> of;    // one a triangle: its piece, numbered by first triangle
  std::vector<std::uint8_t> edges;  // one a triangle: Edges
  std::uint32_t count = 0;
};

// `welded`: one representative a position (weld.h). Triangles of different keys are never joined; the key of
// triangle t is key_of_part[part_of[t]]. A triangle that is welded to a line joins through what is left of
// its edges; one that is welded to a point joins whatever triangle of its key has that point, if any.
// At most 2^32 / 3 triangles. Time: linear but for sorting the edges around each vertex.
Pieces edge_pieces(std::span<const Triangle> triangles, std::span<const std::uint32_t> welded,
                   std::span<const std::uint32_t> part_of, std::span<const std::uint32_t> key_of_part);

// The triangles of every piece, piece after piece, ascending inside one.
struct PieceTriangles {
  std::vector<std::uint32_t> first;  // pieces + 1 offsets
  std::vector<std::uint32_t> triangle;
  std::span<const std::uint32_t> of(std::uint32_t piece) const {
    return std::span(triangle).subspan(first[piece], first[piece + 1] - first[piece]);
  }
};
PieceTriangles triangles_of(std::span<const std::uint32_t> piece_of, std::uint32_t pieces);

// Some triangles without what a damaged file adds, those that are there twice and those without area: their
// welded corners, ascending in each and among them. O(n log n).
std::vector<Triangle> sound_triangles(const Mesh& mesh, std::span<const std::uint32_t> welded,
                                      std::span<const std::uint32_t> triangles);

}  // namespace copse
