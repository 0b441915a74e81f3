// Looks under the materials: mean colour and alpha coverage of the textures where the mesh uses them.
#pragma once

#include "tools/common/tool.h"
#include "tools/treeprep/input.h"
#include "tools/treeprep/options.h"

namespace copse::treeprep {

// Fills Material::mean_colour and alpha_coverage. A texture that cannot be read is warned about and counts as
// white and opaque; with --strict it is refused. Image files that are read are noted for the depfile.
Result<void> texture_stage(Input& input, const Options& options, Context& context);

}  // namespace copse::treeprep
