#include "lib/analysis/swept/minimal_lozenge.h"

#include "lib/analysis/boxes/minimal_box.h"
#include "lib/analysis/boxes/minimal_rectangle.h"
#include "lib/analysis/hull/principal_axes.h"
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

// Thinner than this, of its width, it is a plate.
constexpr double k_plate = 1e-2;

bool is_plate(std::span<const Double3> points) {
  const std::array<double, 3> v = principal_axes(points).variances;
  return v[2] < k_plate * k_plate * v[1];
}

// The axes of the least box, the thinnest last.
Axes axes_of_least_box(const ConvexHull& hull, const Deadline& deadline) {
  MinimalBoxOptions search;
  search.deadline = deadline;
  const OrientedBox<double> box = minimal_box(hull, search).volume;
  int thin = 0;
  for (int i = 1; i < 3; ++i) {
    if (box.half_extents[i] < box.half_extents[thin]) thin = i;
  }
  return {box.axes[(thin + 1) % 3], box.axes[(thin + 2) % 3], box.axes[thin]};
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
  if (is_plate(points)) {
    const Axes axes = axes_of_least_box(hull, options.deadline);
    take(lozenge_in_frame(points, axes));
    const SweptFit in_it = descend_around(Swept::lozenge, points, axes);
    if (in_it.volume() < fit.volume()) fit = in_it;
  }
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
