// The room that a tree takes, seen from above: what its footprint is when the page does not say.
#pragma once

#include "lib/analysis/ecosystem/degrees.h"
#include "lib/formats/ecosystem/ecosystem.h"
#include "tools/ecogen/scene.h"

namespace copse::ecogen {

// The slope of the terrain's steepest triangle, however its cells are cut.
SinCos steepest_slope(const Terrain& terrain);

// Metres from its foot, at scale 1, that a tree of this box reaches, whichever way it is turned and however
// far its type leans it: along the ground's normal by at most `steepest`.
double crown_reach(const FloatBox& box, const TypeSource& type, const SinCos& steepest);

}  // namespace copse::ecogen
