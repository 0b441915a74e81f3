// --measure and --max-error: what every level gives away; --sweep: the methods and their peers at the same
// triangle counts.
#pragma once

#include "lib/analysis/measure/lod_quality.h"
#include "lib/analysis/measure/picture.h"
#include "lib/analysis/measure/surface_distance.h"
#include "lib/formats/levels/spectrum.h"
#include "lib/formats/tree/tree.h"
#include "tools/common/tool.h"
#include "tools/lodbake/options.h"
#include "tools/lodbake/spectra.h"

#include <optional>
#include <vector>

namespace copse::lodbake {

struct LevelFigures {
  LodQuality quality;
  double share = 1;                 // of full detail's triangles
  std::optional<double> leaf_area;  // of full detail's; nothing without leaves
  int pixels = 512;                 // of the pictures that are compared
};

// Adds the tables "quality" and "cost" and curves to the report: of each level area, coverage, silhouette,
// hull growth and image error at the size on screen that it has where it begins (levels.h), 16 to 512 pixels
// across the sphere round the tree; bytes, time to extract.
std::vector<LevelFigures> measure_levels(const Tree& tree, const LodSpectra& spectra, const Looks& looks,
                                         const std::vector<LodLevel>& levels, const Options& options,
                                         Context& context);

// Adds the table "surface": distances both ways, mean and largest, and lost branch length.
std::vector<SurfaceDistances> measure_surfaces(const Tree& tree, const LodSpectra& spectra,
                                               const std::vector<LodLevel>& levels, Context& context);

// Adds the tables "sweep" (at several shares of the triangles) and "last geometric level": the levels as
// divided; what the tool makes when one option is the other way (division, trunk, leaves, quality); and the
// peers, on the whole tree as one mesh and on each part.
void sweep(const Tree& tree, const BakedSpectra& baked, const Looks& looks, const Options& options,
           Context& context);

}  // namespace copse::lodbake
