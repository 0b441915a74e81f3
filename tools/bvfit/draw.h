// The volumes round the mesh, to be seen: as GLB and as pictures.
#pragma once

#include "lib/formats/report.h"
#include "tools/bvfit/fits.h"

#include <span>
#include <string>
#include <vector>

namespace copse::bvfit {

// The mesh (if there is one) and, each with a material of its own name and colour, translucent: all volumes
// of a single set, or the chosen volumes of several.
Result<std::string> volumes_glb(const Input& input, std::span<const SetFit> sets, const std::string& name);

// The outlines of the smallest volume of each type over the mesh, from the front and from the side, and of
// the chosen volumes of all parts. Nothing for points alone.
Result<std::vector<ReportPicture>> volume_pictures(const Input& input, std::span<const SetFit> sets);

}  // namespace copse::bvfit
