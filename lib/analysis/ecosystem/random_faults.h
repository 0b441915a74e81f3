// Random faults: a terrain broken again and again along straight lines, one side raised and the other
// lowered.
//
// Source: digest 000, section 2.5 (the thesis gives words only). Both sides move by half a step, so the mean
// height stays near that of the surface (hazard H34). Directions come without sine and cosine, so that every
// machine breaks alike.
#pragma once

#include "lib/formats/random.h"
#include "lib/formats/vec.h"

#include <cstddef>
#include <cstdint>
#include <span>

namespace copse {

struct FaultOptions {
  std::uint32_t count = 0;
  double first = 0, last = 0;  // height difference of the first and of the last fault, m; linear between
  std::uint32_t smooth = 0;    // times that rows and columns are averaged 1-2-1 afterwards, borders held
};

// Moves the y of `vertices`, a grid of `columns` to a row. Fault i is drawn from random.fork(i). In parallel;
// cost O(vertices * (count + smooth)).
void apply_faults(std::span<Double3> vertices, std::size_t columns, const FaultOptions& options,
                  const Random& random);

}  // namespace copse
