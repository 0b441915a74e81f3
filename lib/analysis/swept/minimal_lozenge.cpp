#include "lib/analysis/swept/minimal_lozenge.h"

#include "lib/analysis/boxes/minimal_rectangle.h"
#include "lib/analysis/swept/lozenge.h"
#include "lib/analysis/swept/minimal_capsule.h"
#include "lib/analysis/swept/swept_search.h"

namespace copse {
namespace {

Lozenge<double> rectangle_around(const ConvexHull& hull) {
  std::vector<Double2> plane;
  for (const Double3& p : hull.vertices) plane.push_back({dot(p, hull.axes[0]), dot(p, hull.axes[1])});
  const Double2 along = minimal_rectangle(hull_of_plane(plane)).along;
  const Double3 u = normalized(hull.axes[0] * along.x + hull.axes[1] * along.y);
  const Axes axes{u, cross(hull.axes[2], u), hull.axes[2]};
  DoubleBox box;
  for (const Double3& p : hull.vertices) box.grow(into(axes, p));
  return placed({box.min.x, box.max.x, box.min.y, box.max.y, box.centre().z, 0}, axes);
}

}  // namespace

BoundedFit<Lozenge<double>> minimal_lozenge(const ConvexHull& hull, const SweptBoundOptions& options) {
  SweptBoundOptions no_proof;
  no_proof.deadline = options.deadline;
  return minimal_lozenge(hull, minimal_capsule(hull, no_proof).volume, options);
}

BoundedFit<Lozenge<double>> minimal_lozenge(const ConvexHull& hull, const Capsule<double>& capsule,
                                            const SweptBoundOptions& options) {
  const Lozenge<double> swept_segment{capsule.a, capsule.b - capsule.a, {}, capsule.radius};
  if (hull.dimension < 2) return {enclosing(swept_segment, hull.boundary), 0};
  if (hull.dimension == 2) return {enclosing(rectangle_around(hull), hull.boundary), 0};
  const std::span<const Double3> points = hull.vertices;
  BoundedFit<Lozenge<double>> best{enclosing(gaussian_lozenge(points), hull.boundary), 0};
  const auto take = [&](const Lozenge<double>& l) {
    const Lozenge<double> whole = enclosing(l, hull.boundary);
    if (interior_volume(whole) < interior_volume(best.volume)) best.volume = whole;
  };
  take(swept_segment);
  if (options.deadline.has_passed()) return best;
  SweptFit fit = search_around(Swept::lozenge, points, options.deadline);
  if (options.gap < std::numeric_limits<double>::infinity()) {
    const Lozenge<double> whole = enclosing(placed(fit.rectangle, fit.frame), hull.boundary);
    SweptBoundOptions how = options;
    how.least_radius = inner_radius(hull);
    how.gap = reachable_gap(options.gap, interior_volume(whole) / fit.volume());
    best.lower_bound = bound_swept(Swept::lozenge, points, how, fit).lower_bound;
  }
  take(placed(fit.rectangle, fit.frame));
  return best;
}

}  // namespace copse
