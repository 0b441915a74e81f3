// The spectra of a tree, by the methods that were asked for, coupled.
#pragma once

#include "lib/analysis/measure/picture.h"
#include "lib/formats/levels/foliage_cells.h"
#include "lib/formats/levels/impostors.h"
#include "lib/formats/levels/spectrum.h"
#include "lib/formats/tree/tree.h"
#include "tools/common/tool.h"
#include "tools/lodbake/options.h"

#include <optional>

namespace copse::lodbake {

struct BakedSpectra {
  LodSpectra spectra;
  std::optional<FoliageCells> cells;  // of --foliage prune
  ImpostorAtlas impostor;             // of --impostor
};

// Trunk and leaves, and the schedule that divides triangles between them.
Result<BakedSpectra> make_spectra(const Tree& tree, const Looks& looks, const Options& options,
                                  Context& context);

}  // namespace copse::lodbake
