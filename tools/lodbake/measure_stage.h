// --measure: what every level gives away; --sweep: the methods and their peers at the same triangle counts.
#pragma once

#include "lib/analysis/measure/picture.h"
#include "lib/formats/levels/spectrum.h"
#include "lib/formats/tree/tree.h"
#include "tools/common/tool.h"
#include "tools/lodbake/options.h"

#include <vector>

namespace copse::lodbake {

// Adds the table "quality" and curves to the report: of each level area, coverage, silhouette, image error at
// the size on screen at which it is shown (512 pixels from an asked share of .25, 128 from .05, else 32),
// hull growth, surface distances, lost branch length, bytes, time to extract.
void measure_levels(const Tree& tree, const LodSpectra& spectra, const Looks& looks,
                    const std::vector<LodLevel>& levels, const Options& options, Context& context);

// Adds the table "sweep": at several shares of the triangles the levels as divided, with trunk by edges, with
// even division, and meshoptimizer's simplifier on the whole tree as one mesh and on each part.
void sweep(const Tree& tree, const LodSpectra& spectra, const Looks& looks, const Options& options,
           Context& context);

}  // namespace copse::lodbake
