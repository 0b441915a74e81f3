// hull_relaxation: undoes the smoothing of the hulls round the forks of a skin.
#pragma once

#include "lib/analysis/surface/lists.h"
#include "lib/formats/vec.h"

#include <cstddef>
#include <functional>
#include <span>
#include <vector>

namespace copse {

// Where positions were before each was moved by its weight times `factor` towards the mean of itself and its
// neighbours; nothing where that is not told (Gauss and Seidel's iteration runs away, as it may for weights
// above a half). Linear in the lists.
std::vector<Double3> before_hull_relaxation(const std::vector<Double3>& moved, const Lists& neighbours,
                                            std::span<const double> weights, double factor);

// A tool that hulls the rings round a fork may then move each of their vertices by a factor towards the mean
// of itself and its neighbours, all at once. The factor is not known, but it shows: with the right one rings
// are regular again. `neighbours` has one list a position, empty where nothing moved; `regular_rings` counts,
// for given positions, the rings that are regular; `weights`, one a position, is how much of the factor
// counts there. Tries the factors that a slider offers, 0.05 to 1 in steps of 0.05, and puts back the
// positions for the one that makes most rings regular. Returns it; 0, and nothing has changed, where none
// makes at least `least` more of them regular than there were. Linear in the lists.
double undo_hull_relaxation(std::vector<Double3>& positions, const Lists& neighbours,
                            std::span<const double> weights,
                            const std::function<std::size_t(const std::vector<Double3>&)>& regular_rings,
                            std::size_t least);

}  // namespace copse
