// The spectra of a tree, by the methods that were asked for, coupled.
#pragma once

#include "lib/analysis/lod/leaf_collapse.h"
#include "lib/analysis/measure/picture.h"
#include "lib/formats/levels/foliage_cells.h"
#include "lib/formats/levels/spectrum.h"
#include "lib/formats/tree/tree.h"
#include "tools/common/tool.h"
#include "tools/lodbake/options.h"

#include <optional>

namespace copse::lodbake {

// By what the options say, or by edges where the tree has no limbs.
Spectrum trunk_spectrum(const Tree& tree, const Options& options);

struct LeafParts {
  Spectrum spectrum;
  std::optional<FoliageCells> cells;  // of --foliage prune
  CollapsedLumps lumps;               // of --foliage collapse
};
LeafParts leaf_spectrum(const Tree& tree, const Looks& looks, const Options& options, std::uint64_t seed);

// Fills the schedule of both spectra, which divides triangles between them, and puts the steps of the leaves
// into the order that it needs.
void divide(const Tree& tree, const Looks& looks, const Options& options, LodSpectra& spectra);

struct BakedSpectra {
  LodSpectra spectra;
  LodSpectra as_made;                 // of --sweep: before they were divided
  std::optional<FoliageCells> cells;  // of --foliage prune
};

// All of that, stage by stage.
Result<BakedSpectra> make_spectra(const Tree& tree, const Looks& looks, const Options& options,
                                  Context& context);

}  // namespace copse::lodbake
