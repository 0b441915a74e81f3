// reverse_subdivision: the cage that a surface was subdivided from.
#pragma once

#include "lib/analysis/surface/lists.h"
#include "lib/analysis/surface/surface.h"

#include <optional>

namespace copse {

// The polygons that Catmull-Clark subdivision made a surface of. Every vertex of a cage is still there in the
// surface, moved.
struct Cage {
  std::vector<Double3> positions;      // as they were before the subdivision
  std::vector<std::uint32_t> vertex;   // one a position: the vertex of the surface that it became
  Lists faces;                         // the corners of each, in order round it; three or more
  std::vector<std::uint32_t> face_of;  // one a triangle of the surface: the face that it lies in
  std::uint32_t levels = 0;            // how often it was subdivided: 1 or more
  bool is_on_limit = false;            // whether the surface's vertices were then moved to the limit surface
  double precision = 0;                // metres: how far the surface is off the cage's subdivision
};

// Undoes Catmull and Clark's subdivision (1978): after one step every face is a quad of a vertex, two
// edge points and a face point, and each edge point has two vertices of the cage beside it, so two colourings
// of the graph of edges tell which is which. The cage's positions follow from those of its moved vertices
// alone (Chebyshev iteration; the mask's eigenvalues lie between 1/9 or 1/4 and 1); subdivided again they
// foretell every edge point and face point, and unless they are where they should be, as far as a file's
// rounding goes, nothing was subdivided. Both are tried: points as a step puts them, and pushed to the limit
// surface (Halstead, Kass and DeRose 1993) as modelling programs show them. Edges of one or of more than two
// faces count as sharp. Vertices that the program kept where they were, and edges between them that it kept
// straight (it does so beside faces within the surface that it then leaves out, so that nothing else tells),
// are found where the points beside them contradict and agree once that is taken to be so. Repeated for as
// long as what is left is a subdivision of something coarser. None where the surface is not of quads, where
// the connectivity or the positions say that it was not subdivided, or where it is not connected through
// edges. O(n log n).
std::optional<Cage> reverse_subdivision(const Surface& surface);

}  // namespace copse
