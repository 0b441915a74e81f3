// The spectra of a tree, by the methods that were asked for, coupled.
#pragma once

#include "lib/analysis/measure/picture.h"
#include "lib/formats/spectrum.h"
#include "lib/formats/tree.h"
#include "tools/common/tool.h"
#include "tools/lodbake/options.h"

namespace copse::lodbake {

// Trunk and leaves, and the schedule that divides triangles between them.
Result<LodSpectra> make_spectra(const Tree& tree, const Looks& looks, const Options& options,
                                Context& context);

}  // namespace copse::lodbake
