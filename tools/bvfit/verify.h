// --verify: judges volumes, whoever wrote them.
#pragma once

#include "tools/bvfit/input.h"
#include "tools/bvfit/options.h"

namespace copse::bvfit {

// Every volume of the file against the points of its set, in exact arithmetic; prints a line each. Refused
// (after all are judged) when any leaves a point outside; the error names the worst.
Result<void> verify_volumes(const Options& options, Context& context);

}  // namespace copse::bvfit
