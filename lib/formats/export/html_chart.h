// Curves as an inline SVG: one chart for all curves that share both axes.
#pragma once

#include "lib/formats/report.h"

#include <span>
#include <string>

namespace copse {

// A chart of 940 by 390 units that scales with the page. An axis is logarithmic when all its values are
// positive and they span more than a factor of 50. Curves whose points carry no labels are lines; labelled
// points stand alone, with as many labels as fit; of trials a line joins the best so far. Colours and fonts
// come from the page's style sheet; series differ by shape too. Points that are not finite are left out.
// Empty when none is left.
std::string chart_svg(std::span<const Curve> curves, const std::string& id);

// The sign of the curve that stands at `index` in a chart.
std::string legend_svg(const Curve& curve, std::size_t index);

}  // namespace copse
