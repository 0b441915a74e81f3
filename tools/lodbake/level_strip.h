// The levels side by side, with their figures: for the page.
#pragma once

#include "lib/analysis/lod/impostor.h"
#include "lib/analysis/measure/picture.h"
#include "lib/formats/levels/spectrum.h"
#include "lib/formats/report.h"
#include "lib/formats/result.h"
#include "tools/lodbake/impostor_stage.h"
#include "tools/lodbake/measure_stage.h"

#include <vector>

namespace copse::lodbake {

// What is known of the levels, full detail first. `figures` and `surfaces` may be empty; `impostor` null.
struct StripContents {
  const std::vector<LodLevel>& levels;
  const std::vector<LevelFigures>& figures;
  const std::vector<SurfaceDistances>& surfaces;
  const BakedImpostor* impostor = nullptr;
};

Result<ReportPicture> level_strip(const LodSpectra& spectra, const Looks& looks,
                                  const StripContents& contents);

}  // namespace copse::lodbake
