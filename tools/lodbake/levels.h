// Which levels of a schedule are the discrete ones, and from which distance on each is drawn.
#pragma once

#include "lib/formats/levels/spectrum.h"
#include "tools/common/tool.h"
#include "tools/lodbake/options.h"

#include <vector>

namespace copse::lodbake {

// From how far `metres` take up so many pixels on that screen.
double distance_for_pixels(double metres, double pixels);
// How many they take up from a distance.
double pixels_at_distance(double metres, double distance);

// Fills discrete, near, far and hysteresis of `spectra`, whose schedule is there. By themselves levels begin
// where the tree, `size` metres (above 0) along the longest side of its box, is 1024 pixels x sqrt(share of
// its triangles) large on a screen of 1080 lines that sees 60 degrees: pixels and triangles fall alike. What
// was named moves them, and so does the hysteresis (level_distances.h), which is warned of. `options` are
// checked.
void choose_levels(const Options& options, double size, LodSpectra& spectra, Context& context);

// The shares of the triangles that the discrete levels were asked to have; none with --discrete-error.
std::vector<double> asked_shares(const Options& options);

}  // namespace copse::lodbake
