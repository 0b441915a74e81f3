// --lines-points: how wrong the estimates are by which a runtime chooses lines and points.
#pragma once

#include "lib/formats/tree/tree.h"
#include "tools/common/tool.h"

namespace copse::lodbake {

// Adds the table "lines and points": the estimates of projected leaf area, trunk area and length against sums
// over all triangles and segments, over at least `views` directions, with the tree over all, half and a tenth
// of the picture (digest 000, section 3.1); and the largest error of each as an error of the report.
void report_projections(const Tree& tree, int views, Context& context);

}  // namespace copse::lodbake
