// --impostor: the tree as pictures, behind the last level.
#pragma once

#include "lib/formats/levels/impostors.h"
#include "lib/formats/levels/spectrum.h"
#include "tools/common/tool.h"
#include "tools/lodbake/looks.h"
#include "tools/lodbake/options.h"

namespace copse::lodbake {

// Takes the pictures of full detail, measures them against it (table "impostor" of the report) and says from
// where on they are drawn: where the tree fills one of them, but not before the last level has had its place.
Result<ImpostorAtlas> bake_impostor(const LodSpectra& spectra, const TreeLooks& looks, const Options& options,
                                    Context& context);

}  // namespace copse::lodbake
