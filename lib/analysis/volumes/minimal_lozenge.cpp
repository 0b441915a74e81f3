#include "lib/analysis/volumes/minimal_lozenge.h"

#include "lib/analysis/volumes/lozenge.h"
#include "lib/analysis/volumes/minimal_capsule.h"
#include "lib/analysis/volumes/swept_search.h"

namespace copse {
namespace {

constexpr double k_flat = 1e-14;  // of the size of the points: below it, rounding decides what is flat

}  // namespace

BoundedFit<Lozenge<double>> minimal_lozenge(std::span<const Double3> points) {
  return minimal_lozenge(points, minimal_capsule(points).volume);
}

BoundedFit<Lozenge<double>> minimal_lozenge(std::span<const Double3> points, const Capsule<double>& capsule) {
  Lozenge<double> best = gaussian_lozenge(points);
  if (best.radius <= k_flat * length(best.edge0)) return {best, 0};
  const auto take = [&](const Lozenge<double>& l) {
    if (interior_volume(l) < interior_volume(best)) best = l;
  };
  take(enclosing(Lozenge<double>{capsule.a, capsule.b - capsule.a, {}, 0}, points));
  const SweptFit fit = search_around(Swept::lozenge, points);
  take(enclosing(placed(fit.rectangle, fit.frame), points));
  return {best, 0};
}

}  // namespace copse
