// leaf_pieces: the leaves of a tree cut into what is connected: cards, triangles, fronds.
#pragma once

#include "lib/formats/levels/part_triangles.h"
#include "lib/formats/tree/tree.h"

#include <array>
#include <cstdint>
#include <vector>

namespace copse {

enum class LeafCut : std::uint8_t { triangle, card };  // three corners or four

struct LeafPiece {
  std::uint32_t leaf = 0;
  std::uint32_t first = 0, last = 0;  // its triangles: LeafPieces::triangles[first .. last)
  std::uint32_t material = k_none;
  std::uint32_t group = k_none, radius = k_none;  // that it hangs on
  bool card = false;  // its texture has alpha: it is cut out of a picture, and must keep it whole
  LeafCut cut =
      LeafCut::triangle;  // what can replace it: a card for a piece with alpha of more than one triangle
};

struct LeafPieces {
  PartTriangles part;
  std::vector<LeafPiece> list;           // leaf after leaf
  std::vector<std::uint32_t> triangles;  // of `part`, piece after piece
  std::vector<double> opacity;           // one a material: share that its alpha test lets through

  double opacity_of(std::size_t triangle) const {
    const std::uint32_t m = part.materials[triangle];
    return m < opacity.size() ? opacity[m] : 1;
  }
  // The direction in space, length 1 or 0, in which the texture's v grows on the triangle.
  Double3 up_of(std::uint32_t triangle) const;
  // Of a leaf's corners as leaf_shape makes them: of a card the box of the piece's texture coordinates, from
  // its lower left on; of a triangle those of `triangle`, its lowest corner first.
  std::array<Float2, 4> texcoords(std::uint32_t piece, std::uint32_t triangle) const;
};

// Triangles of one leaf are connected when they share a vertex of the tree. Near linear.
LeafPieces leaf_pieces(const Tree& tree);

}  // namespace copse
