// Descent of a box's volume over its rotation, and where to start it: the two halves of minimal_box's search.
#pragma once

#include "lib/analysis/hull/convex_hull.h"
#include "lib/analysis/hull/deadline.h"
#include "lib/analysis/hull/vertex_widths.h"

#include <vector>

namespace copse {

struct FrameVolume {
  Axes axes = k_world_axes;
  double volume = 0;
};

// Axes[i] kept, the two others along the minimal rectangle across it.
Axes turned_to_rectangle(std::span<const Double3> vertices, const Axes& axes, int i);

// Simplex steps from `start`, at most `evaluations` of them; `step` 1 is a turn that about doubles the
// volume.
FrameVolume simplex_descent(const VertexWidths& widths, const FrameVolume& start, double step,
                            int evaluations);

// Both kinds of step in turn until neither gains.
FrameVolume descend(std::span<const Double3> vertices, const VertexWidths& widths, const FrameVolume& start);

// The best frame that is found from all starts, or from as many as the time allows.
FrameVolume search_box(const ConvexHull& hull, const VertexWidths& widths, const Deadline& deadline = {});

}  // namespace copse
