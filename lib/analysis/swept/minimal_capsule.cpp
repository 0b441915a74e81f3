#include "lib/analysis/swept/minimal_capsule.h"

#include "lib/analysis/round/minimal_sphere.h"
#include "lib/analysis/swept/capsule.h"
#include "lib/analysis/swept/swept_search.h"

namespace copse {
namespace {

Capsule<double> capsule_of(const SweptFit& fit) {
  const SweptRectangle& s = fit.rectangle;
  return {out_of(fit.frame, {s.a0, s.b0, s.h}), out_of(fit.frame, {s.a1, s.b0, s.h}), s.r};
}

}  // namespace

BoundedFit<Capsule<double>> minimal_capsule(const ConvexHull& hull, const SweptBoundOptions& options) {
  return minimal_capsule(hull, projected_circle_capsule(hull.vertices, options.deadline), options);
}

BoundedFit<Capsule<double>> minimal_capsule(const ConvexHull& hull, const Capsule<double>& projected_circle,
                                            const SweptBoundOptions& options) {
  const std::span<const Double3> points = hull.vertices;
  if (hull.dimension < 2) {
    const Capsule<double> segment{points.front(), points.back(), 0};
    return {enclosing(segment, hull.boundary), 0};
  }
  BoundedFit<Capsule<double>> best{enclosing(least_squares_capsule(points), hull.boundary), 0};
  const auto take = [&](const Capsule<double>& c) {
    const Capsule<double> whole = enclosing(c, hull.boundary);
    if (interior_volume(whole) < interior_volume(best.volume)) best.volume = whole;
  };
  const Double3 centre = minimal_sphere(points).centre;
  take({centre, centre, 0});
  take(projected_circle);
  if (options.deadline.has_passed()) return best;
  SweptFit fit = search_around(Swept::capsule, points, options.deadline);
  if (options.gap < std::numeric_limits<double>::infinity()) {
    SweptBoundOptions how = options;
    how.least_radius = inner_radius(hull);
    how.gap =
        reachable_gap(options.gap, interior_volume(enclosing(capsule_of(fit), hull.boundary)) / fit.volume());
    best.lower_bound = bound_swept(Swept::capsule, points, how, fit).lower_bound;
  }
  take(capsule_of(fit));
  return best;
}

}  // namespace copse
