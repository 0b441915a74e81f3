// The trunk's surface: rings, bands, joints and ends, with the exact hierarchy as it goes.
#pragma once

#include "tools/treegrow/breaks.h"
#include "tools/treegrow/layout.h"
#include "tools/treegrow/skeleton.h"
#include "tools/treegrow/surface.h"
#include "tools/treegrow/truth.h"

#include <cstdint>
#include <vector>

namespace copse::grow {

struct Tubes {
  std::vector<Double3> centres;             // of each of the layout's rings, generator's frame
  std::vector<double> radii;                // the same
  std::vector<std::uint32_t> first_vertex;  // of each of the layout's rings: its k vertices follow
  std::vector<Double3> shift;               // of each stem: its parent's tube is straight between rings, its
                                            // curve is not; the stem is moved onto the tube
};

Tubes build_tubes(const Species& species, const Skeleton& skeleton, const Layout& layout,
                  const Breaks& breaks, Surface& surface, Truth& truth);

// A stem's tube at parameter t: between two rings it is a straight cone.
struct TubePlace {
  Double3 centre;
  Double3 along;  // unit vector
  double radius = 0;
};
TubePlace tube_place(const Layout& layout, const Tubes& tubes, std::size_t stem, double t);

}  // namespace copse::grow
