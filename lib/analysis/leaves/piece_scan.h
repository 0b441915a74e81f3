// piece_scan: the pieces of a mesh with what is known of each: who decides it, and its shape where names do
// not.
#pragma once

#include "lib/analysis/leaves/part_verdicts.h"
#include "lib/analysis/leaves/piece_shape.h"
#include "lib/analysis/leaves/pieces.h"
#include "lib/formats/mesh.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace copse {

// Few bytes a piece: there may be millions.
struct PieceFact {
  bool decided = false;  // by a firm verdict; its shape was not looked at, and what follows is not set
  ShapeKind shape = ShapeKind::sheet;
  bool planar = false, solid = false, layered = false;  // layered: a sheet without a border
  bool capped = false;  // a sheet all of whose border lies on triangles of other keys
  // Sheets only. A strip is a row of triangles, each with a side on the border; it stands when it reaches
  // down to the lowest tenth of the mesh, has a foot when it reaches out of that and a whole side of it lies
  // in there, and is rooted when a whole side of it lies below y = 0 (thesis 2.1).
  bool strip = false, stands = false, footed = false, rooted = false;
};

// The pieces whose place matters: stems, blobs, and sheets half as wide as the mesh.
struct PlacedPiece {
  std::uint32_t piece = 0;
  PieceShape shape;
};

class PieceScan {
 public:
  // `verdicts`: one a part of the mesh. Firm trunk and firm leaf parts must have keys of their own.
  PieceScan(const Mesh& mesh, std::span<const std::uint32_t> welded, Pieces pieces,
            std::span<const PartVerdict> verdicts);

  const Pieces& pieces() const { return pieces_; }
  const PieceTriangles& triangles() const { return triangles_; }
  const PieceFact& fact(std::uint32_t piece) const { return facts_[piece]; }
  const std::vector<PlacedPiece>& placed() const { return placed_; }  // ascending
  std::uint32_t part(std::uint32_t piece) const { return part_of_[triangles_.of(piece)[0]]; }
  // How many undecided pieces have this one's shape and number of triangles.
  std::uint32_t alike(std::uint32_t piece) const;
  const DoubleBox& bounds() const { return bounds_; }  // of all triangles
  const DoubleBox& feet() const { return feet_; }      // of the sides that strips with a foot stand on

  template <class Use>
  void for_each_bent_piece(Use&& use) const {
    for (std::uint32_t p = 0; p < pieces_.count; ++p) {
      if (!facts_[p].decided && !facts_[p].planar) use(triangles_.of(p));
    }
  }
  std::vector<std::uint32_t> take_piece_of() && { return std::move(pieces_.of); }

 private:
  PieceFact read(const Mesh& mesh, std::span<const std::uint32_t> welded, std::uint32_t piece);

  Pieces pieces_;
  PieceTriangles triangles_;
  std::span<const std::uint32_t> part_of_;  // the mesh's
  std::vector<PieceFact> facts_;
  std::vector<PlacedPiece> placed_;
  std::vector<std::uint32_t> alike_[3];  // by shape and number of triangles
  DoubleBox bounds_, feet_;
};

}  // namespace copse
