// Which levels of a schedule are the discrete ones, and from which distance on each is drawn.
#pragma once

#include "lib/formats/levels/spectrum.h"
#include "lib/formats/result.h"
#include "tools/lodbake/options.h"

#include <vector>

namespace copse::lodbake {

// From how far `metres` take up so many pixels on that screen.
double distance_for_pixels(double metres, double pixels);

// Fills discrete, near, far and hysteresis of `spectra`, whose schedule is there. Distances that were not
// given are those at which the tree, `height` metres high, is 1024 pixels x sqrt(share of its triangles) high
// on a screen of 1080 lines that sees 60 degrees: pixels and triangles fall alike.
// Errors: distances, given or of levels so close to one another that a level would be drawn nowhere (digest
// 003, H-10). A level that is not to be had as it was asked for is moved out of the way instead.
Result<void> choose_levels(const Options& options, double height, LodSpectra& spectra);

// The shares of the triangles that the discrete levels were asked to have; none with --discrete-error.
std::vector<double> asked_shares(const Options& options);

}  // namespace copse::lodbake
