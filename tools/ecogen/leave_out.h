// What a scene does not show is not written: types without instances, materials and textures that nothing
// uses.
#pragma once

#include "tools/ecogen/build.h"

#include <vector>

namespace copse::ecogen {

// Drops them from `built.eco` and renumbers what remains, in the instances too; notes what went.
void leave_out(std::vector<Instance>& instances, Built& built);

// Trees and textures by name, relative to the output's folder, or packed. A packed tree has no provenance,
// and no materials when every instance brings its own.
Result<void> resolve_files(const BuildOptions& options, Built& built, Context& context);

}  // namespace copse::ecogen
