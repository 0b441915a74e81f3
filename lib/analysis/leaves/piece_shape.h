// piece_shape: is a connected piece of surface a sheet (card, frond, disc), a stem (tube, branching or not)
// or a blob? Told by measures that bending, tessellation and size do not change.
#pragma once

#include "lib/analysis/leaves/pieces.h"
#include "lib/formats/mesh.h"

#include <cstdint>
#include <span>

namespace copse {

enum class ShapeKind : std::uint8_t {
  sheet,  // has two sides but no inside: flat or bent, single or laid back to back, or a thin plate
  stem,   // long for its thickness, straight, bent or branching, its ends open or closed
  blob,   // closed or nearly, about as wide as long
};

struct PieceShape {
  ShapeKind kind = ShapeKind::sheet;
  bool planar = false;  // single sheets: every triangle lies in one plane
  bool solid = false;   // a sheet that encloses a volume: a plate
  DoubleBox box;
  double size = 0;  // diagonal of the box
  double area = 0;  // of all triangles, so both sides where there are two
  // Squared length of the border (of each, where there are several) over the area. Isoperimetric: at least 4
  // pi = 12.6 for whatever can be flattened; 8 pi r / L for an open tube; 0 when closed.
  double border_ratio = 0;
  double elongation = 1;  // largest over second spread along principal axes
  double fill = 0;        // volume over that of the ellipsoid along the principal axes
};

// `triangles` are ids of mesh.triangles, the whole of one piece of `pieces`. Linear; where a piece turns out
// to be laid double (no border, no volume) its triangles are sorted to single the layers.
PieceShape shape_of(const Mesh& mesh, std::span<const std::uint32_t> welded, const Pieces& pieces,
                    std::span<const std::uint32_t> triangles);

}  // namespace copse
