// A state of LOD spectra as a mesh, for export and for measuring.
#pragma once

#include "lib/formats/levels/spectrum.h"
#include "lib/formats/mesh.h"

#include <string>

namespace copse {

// Appends what is drawn of `spectrum` after `steps` steps (clamped to its range): vertices that are used,
// unified corners (the three index lists are the same), one part a material, named `name`. Materials
// themselves are the caller's. Linear in the spectrum.
void append_state(Mesh& mesh, const Spectrum& spectrum, std::uint32_t steps, const std::string& name,
                  const Double3& origin = {});

// Both parts at a level, trunk first; without materials. A spectrum without elements adds nothing.
Mesh level_mesh(const LodSpectra& spectra, const LodLevel& level, const Double3& origin = {});

}  // namespace copse
