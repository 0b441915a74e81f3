// --compare-hierarchies: what each kind of hierarchy costs to make and to ask.
#pragma once

#include "tools/bvfit/hierarchy.h"

#include <span>
#include <string>
#include <vector>

namespace copse::bvfit {

// Builds and fits every kind. Tells time and size; what finding all that a random ray or plane meets is
// expected to cost; and how many nodes and how many pairs of plane and volume each of 1000 random frustums
// takes, as counted; beside the dissertation's times (T6.1).
Result<std::string> compare_hierarchies(std::span<const PartSet> parts, std::span<const SetFit> fits,
                                        const Input& input, const std::vector<FitMethod>& methods,
                                        const Options& options, const Choosing& choosing, Context& context);

}  // namespace copse::bvfit
