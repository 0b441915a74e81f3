#include "lib/analysis/boxes/minimal_box.h"

#include "lib/analysis/boxes/box_bound.h"
#include "lib/analysis/boxes/box_search.h"
#include "lib/analysis/boxes/oriented_boxes.h"
#include "lib/analysis/volumes/volume_measures.h"

#include <algorithm>
#include <cmath>

namespace copse {
namespace {

// Relative: what the rounding of the hull's volume and of the widths can come to.
constexpr double k_rounding = 1e-12;

FrameVolume flat_box(const ConvexHull& hull) {
  return {hull.dimension == 2 ? turned_to_rectangle(hull.vertices, hull.axes, 2) : hull.axes, 0};
}

}  // namespace

BoundedFit<OrientedBox<double>> minimal_box(const ConvexHull& hull, const MinimalBoxOptions& options) {
  if (hull.dimension < 3) return {box_in_axes(hull.boundary, flat_box(hull).axes), 0};
  const VertexWidths widths(hull.vertices);
  FrameVolume best = search_box(hull, widths, options.deadline);
  double bound = hull.least_volume;
  if (std::isfinite(options.gap)) {
    // What a kernel gives away counts as a part of the gap.
    const double given = measures_of(box_in_axes(hull.boundary, best.axes)).volume / best.volume;
    BoxBoundOptions how{reachable_gap(options.gap, given), options.max_cells, options.deadline, {}};
    how.improve = [&](const Axes& axes, double volume) {
      const FrameVolume low = descend(hull.vertices, widths, {axes, volume});
      if (low.volume < best.volume * (1 - k_rounding)) best = low;
      return best.volume;
    };
    bound = std::max(bound, box_bound(hull.vertices, best.axes, best.volume, how).lower_bound);
  }
  return {box_in_axes(hull.boundary, best.axes), std::min(bound, best.volume)};
}

}  // namespace copse
