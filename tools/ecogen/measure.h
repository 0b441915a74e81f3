// How wrong an ecosystem is: the numbers of the report.
#pragma once

#include "lib/analysis/ecosystem/ground.h"
#include "lib/analysis/ecosystem/populate.h"
#include "lib/formats/ecosystem/ecosystem.h"
#include "tools/common/tool.h"

#include <cstdint>
#include <vector>

namespace copse::ecogen {

// How far the thesis' two angles (digest 000, erratum E3) would lean each instance away from the normal under
// it.
void tell_tilts(const Population& population, const TerrainGround& ground, Context& context);

// How far what is stored is off the ground under it: feet, in shares of their tree's size, of all instances
// that stand on it; axes, of those that lean with it. Slot i of the file is instance order[i].
void tell_ties(const Ecosystem& eco, const std::vector<Instance>& instances,
               const std::vector<std::uint32_t>& order, const TerrainGround& ground, Context& context);

}  // namespace copse::ecogen
