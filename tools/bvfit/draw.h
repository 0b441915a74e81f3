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
// Textures that are files are put into it; what cannot be read is left out, with a warning.
Result<std::string> volumes_glb(const Input& input, std::span<const SetFit> sets, const std::string& name,
                                Context& context);

// The outlines of the smallest volume of each type over the mesh, from the front and from the side, and of
// the chosen volumes of all parts. What the textures' alpha cuts out is not drawn. Nothing for points alone.
Result<std::vector<ReportPicture>> volume_pictures(const Input& input, std::span<const SetFit> sets,
                                                   Context& context);

}  // namespace copse::bvfit
