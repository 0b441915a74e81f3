// What a scene does not show is not written: types without instances, materials and textures that nothing
// uses, volumes that bound nothing; with --pack, of trees what no frame shows (pack_tree.h).
#pragma once

#include "tools/ecogen/build.h"

#include <vector>

namespace copse::ecogen {

// Drops them from `built.eco` and renumbers what remains, in the instances too; notes what went. Trees and
// textures are then named relative to the output's folder, or packed.
Result<void> leave_out(std::vector<Instance>& instances, const BuildOptions& options, Built& built,
                       Context& context);

}  // namespace copse::ecogen
