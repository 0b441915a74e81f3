// What bvfit tells a person.
#pragma once

#include "lib/formats/report.h"
#include "tools/bvfit/fits.h"

#include <span>
#include <string>

namespace copse::bvfit {

// Type, method, volume, excess over the bound, seconds, certified, chosen: of the first sets in full, of many
// sets a summary by what was chosen.
std::string table_text(const Input& input, std::span<const SetFit> sets);

// The same for report and page.
void report_fits(std::span<const SetFit> sets, Report& report);

}  // namespace copse::bvfit
