// --impostor: the tree as pictures, behind the last level.
#pragma once

#include "lib/analysis/lod/impostor.h"
#include "lib/formats/levels/impostors.h"
#include "lib/formats/levels/spectrum.h"
#include "tools/common/tool.h"
#include "tools/lodbake/looks.h"
#include "tools/lodbake/options.h"

namespace copse::lodbake {

// From all around, also between the pictures that were taken, as large as one of them.
struct ImpostorFidelity {
  double coverage = 0, iou = 0, rmse = 0, ssim = 0;
};

struct BakedImpostor {
  ImpostorAtlas atlas;  // as it is stored
  Impostor painted;
  ImpostorFidelity fidelity;
};

// Takes the pictures of full detail, measures them against it (table "impostor" of the report) and says from
// where on they are drawn: where the tree fills one of them, but not before the last level has had its place.
Result<BakedImpostor> bake_impostor(const LodSpectra& spectra, const TreeLooks& looks, const Options& options,
                                    Context& context);

}  // namespace copse::lodbake
