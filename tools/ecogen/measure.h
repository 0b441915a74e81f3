// How wrong an ecosystem is: the numbers of the report.
#pragma once

#include "lib/analysis/ecosystem/ground.h"
#include "lib/analysis/ecosystem/populate.h"
#include "lib/formats/ecosystem.h"
#include "tools/common/tool.h"

namespace copse::ecogen {

// How far the thesis' two angles (digest 000, erratum E3) would lean each instance away from the normal under
// it.
void tell_tilts(const Population& population, const TerrainGround& ground, Context& context);

// How far the feet, as stored, are off the ground, in shares of their tree's size.
void tell_feet(const Ecosystem& eco, const TerrainGround& ground, Context& context);

}  // namespace copse::ecogen
