#include "lib/analysis/volumes/minimal_capsule.h"

#include "lib/analysis/volumes/capsule.h"
#include "lib/analysis/volumes/minimal_sphere.h"
#include "lib/analysis/volumes/swept_search.h"

namespace copse {
namespace {

constexpr double k_thin = 1e-14;  // of the size of the points: below it, rounding decides what is thin

Capsule<double> searched(std::span<const Double3> points) {
  const SweptFit fit = search_around(Swept::capsule, points);
  const SweptRectangle& s = fit.rectangle;
  const Capsule<double> c{out_of(fit.frame, {s.a0, s.b0, s.h}), out_of(fit.frame, {s.a1, s.b0, s.h}), 0};
  return enclosing(c, points);
}

}  // namespace

BoundedFit<Capsule<double>> minimal_capsule(std::span<const Double3> points) {
  Capsule<double> best = least_squares_capsule(points);
  if (best.radius <= k_thin * distance(best.a, best.b)) return {best, 0};
  const auto take = [&](const Capsule<double>& c) {
    if (interior_volume(c) < interior_volume(best)) best = c;
  };
  const Sphere ball = minimal_sphere(points);
  take(enclosing(Capsule<double>{ball.centre, ball.centre, 0}, points));
  take(projected_circle_capsule(points));
  take(searched(points));
  return {best, 0};
}

}  // namespace copse
