// Spreads discs over a density field so that none overlap: a Poisson-disk pattern of variable radius that is
// maximal, and follows the density as long as there is room.
//
// Every disc first tries its own piece of the field's mass (spread.h), in a random order. For those that find
// none there, gaps are searched: patches of ground that the discs together do not cover (disc_cover.h), grown
// by the smallest radius that waits, are thrown darts at and halved, first those of 32 pieces side by side,
// then of twice as many, up to the whole field. So a disc leaves its part of the field only when that is
// full, and one that is left over found no gap anywhere. Ground that is full is known to be so and not looked
// at again. Where a patch is too small for darts a disc goes into the middle of its opening: what can be
// missed is one of several gaps within an eighth of the disc's radius, a gap there of which the rules forbid
// the middle, and ground of which they allow less than a part in some hundred.
//
// Source: patches and darts are those of Ebeida, Mitchell, Patney, Davidson, Owens, "A simple algorithm for
// maximal Poisson-disk sampling in high dimensions" (Eurographics 2012). O((discs + cells) log discs).
#pragma once

#include "lib/analysis/ecosystem/density_field.h"
#include "lib/analysis/ecosystem/spacing.h"
#include "lib/analysis/ecosystem/spread.h"
#include "lib/formats/random.h"

#include <cstdint>
#include <functional>
#include <vector>

namespace copse {

struct DiscsApart {
  std::uint64_t count = 0;
  std::function<double(std::uint64_t disc, const GroundPlace& at)> radius;  // m, above 0
  bool by_place = false;                      // the radius is that of the place, whichever disc it is
  std::function<double(const Patch&)> least;  // no disc has a smaller one here
  double least_anywhere = 0;                  // above 0
  std::vector<GroundPlace> feet{};            // what no disc may have inside
  std::function<void(double)> progress{};     // 0 to 1, now and then; may be empty
  std::function<void(std::uint64_t disc, const GroundPlace& at)> place;  // is called for each that found room
};

struct ApartCounts {
  std::uint64_t missing = 0;   // found no room
  std::uint64_t hindered = 0;  // found the place taken where they would have stood
};

// Where disc number `disc` would stand if there were room for all.
GroundPlace unhindered_place(std::uint64_t disc, std::uint64_t count, const Spreader& spreader,
                             const PlacementTest& test, const Random& random);

// Adds the discs to those that are in the way already. `spreader` and `test` are of `field`;
// spreader.total() > 0.
ApartCounts spread_apart(const DiscsApart& wanted, const DensityField& field, const Spreader& spreader,
                         const PlacementTest& test, const Random& random, Spacing& discs);

}  // namespace copse
