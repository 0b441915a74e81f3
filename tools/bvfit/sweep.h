// --sweep: excess volume against time, for every method at every quality.
#pragma once

#include "tools/bvfit/fits.h"

#include <string>

namespace copse::bvfit {

// Runs them one after the other on one set, so that times do not disturb each other, the searches also with
// shares of their time; puts a curve a type into the report (x: seconds, with the hull's where it is needed;
// y: volume over the best known minus 1) and gives the table.
Result<std::string> sweep(const PartSet& set, const std::vector<FitMethod>& methods, Context& context);

}  // namespace copse::bvfit
