// How wrong an ecosystem is: the numbers of the report.
#pragma once

#include "lib/analysis/ecosystem/ground.h"
#include "lib/analysis/ecosystem/populate.h"
#include "lib/formats/ecosystem/ecosystem.h"
#include "tools/common/tool.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse::ecogen {

// How far the thesis' two angles (digest 000, erratum E3) would lean each instance away from the normal under
// it.
void tell_tilts(const Population& population, const TerrainGround& ground, Context& context);

// Of types with spacing and a density: how many were asked for and stand in its thinner and denser parts, and
// how full of discs those are. Warns where the ground was too full for what the density asks.
void tell_densities(std::span<const TypePlan> plans, const Population& population, Context& context);

// How far what is stored is off the ground under it: feet, in shares of their tree's size, of all instances
// that stand on it; axes, of those that lean with it. Slot i of the file is instance order[i].
void tell_ties(const Ecosystem& eco, const std::vector<Instance>& instances,
               const std::vector<std::uint32_t>& order, const TerrainGround& ground, Context& context);

}  // namespace copse::ecogen
