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
  std::vector<std::uint32_t> first_vertex;  // of each of the layout's rings: its k vertices follow
  std::vector<Double3> shift;               // of each stem: its parent's tube is straight between rings, its
                                            // curve is not; the stem is moved onto the tube
};

// `bark_repeat` < 0: texture coordinates stay in [0, 0.5] x R (one material for bark and leaves).
Tubes build_tubes(const Species& species, const Skeleton& skeleton, const Layout& layout,
                  const Breaks& breaks, Surface& surface, Truth& truth);

// The point of a stem's tube at parameter t: between rings on the straight line that joins their centres.
Double3 tube_point(const Layout& layout, const Tubes& tubes, std::size_t stem, double t);

}  // namespace copse::grow
