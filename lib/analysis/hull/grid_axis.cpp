#include "lib/analysis/hull/grid_axis.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace copse {
namespace {

constexpr double k_enough = 1e-4;  // of the volume: less need not be sought
constexpr int k_lengths = 1024;    // that are tried for the other end
constexpr int k_short = 128;       // shortest ones, that are tried first
constexpr int k_places = 64;       // and for the first one
constexpr double k_longer = 1e-5;  // of the length: what its places may add
constexpr int k_widenings = 6;     // of the grid, where an end has passed a power of two
constexpr int k_doublings = 64;    // of the length, until a direction is told well enough

// What numbers up to `most` in size are multiples of.
double unit_of(double most, int bits) {
  const int least = bits == 24 ? -149 : -1074;
  return std::ldexp(1.0, most > 0 ? std::max(std::ilogb(most) - (bits - 1), least) : least);
}

double to_grid(double x, double unit) {
  return std::nearbyint(x / unit) * unit;
}
Double3 to_grid(const Double3& p, const Double3& unit) {
  return {to_grid(p.x, unit.x), to_grid(p.y, unit.y), to_grid(p.z, unit.z)};
}

Double3 across(const Double3& d, const Double3& direction) {
  return d - direction * dot(d, direction);
}

class AxisSearch {
 public:
  AxisSearch(const AxisToRound& axis, const Double3& unit) : axis_(axis), unit_(unit) {
    step_ = std::numeric_limits<double>::infinity();
    for (int i = 0; i < 3; ++i) {
      if (axis.direction[i] != 0) step_ = std::min(step_, unit[i] / std::abs(axis.direction[i]));
      half_along_ += unit[i] * std::abs(axis.direction[i]) / 2;
    }
    half_ = length(unit) / 2;
    const bool is_needle = half_ > 0.1 * k_enough * axis.radius;
    if (is_needle) room_ = std::min(k_places * step_, k_longer * axis.length);
    if (axis.reach > 0) room_ += 2 * half_along_;  // the rounding of the first end
  }

  GridAxis run() {
    // Directions along the grid, or of few bits, are told by short vectors.
    try_lengths(axis_.length, k_short);
    // Of others no shorter a vector of some thousand tells the direction so well that its planes hold what
    // has no length.
    double from = std::max(axis_.length, std::sqrt(2 * axis_.reach * step_ / k_places));
    double more = k_lengths * step_;
    for (int i = 0; i < k_doublings && !found_; ++i, from += more, more *= 2) try_lengths(from, k_lengths);
    if (!found_) return {to_grid(axis_.low, unit_), to_grid(axis_.low + axis_.direction * from, unit_)};
    const Double3 a = first_end();
    return {a, a + edge_};
  }

 private:
  double volume(double across, double along) const {
    const double r = axis_.radius + across;
    return r * r * (along + (axis_.reach > 0 ? 0 : 4.0 / 3.0 * r));
  }

  void try_lengths(double from, int lengths) {
    const double enough = volume(0, axis_.length) * (1 + k_enough);
    for (int n = 0; n < lengths; ++n) {
      const Double3 d = to_grid(axis_.direction * (from + room_ + n * step_), unit_);
      const double along = dot(d, axis_.direction), off = length(copse::across(d, axis_.direction));
      if (found_ && volume(0, along) >= least_) return;
      if (!(along > 0)) continue;
      // The planes through the ends fall by this at the rim.
      const double rim = axis_.reach * off / along;
      if (axis_.reach > 0 && length(d) < axis_.length + 2 * rim + room_) continue;
      const double v = volume(off, along);
      if (found_ && v >= least_) continue;
      found_ = true, least_ = v, edge_ = d, rim_ = rim;
      if (v <= enough) return;
    }
  }

  // On the line before its beginning, as far as the edge has length to spare.
  Double3 first_end() const {
    const double spare = length(edge_) - axis_.length - 2 * rim_;
    const double margin = axis_.reach > 0 ? half_along_ : 0, free = std::max(0.0, spare - 2 * margin);
    const Double3 off = copse::across(edge_, axis_.direction);
    const int places = std::clamp(static_cast<int>(std::min(free / step_, 1.0 * k_places)) + 1, 1, k_places);
    Double3 best;
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < places; ++k) {
      const double before = rim_ + margin + (places > 1 ? free * k / (places - 1) : free / 2);
      const Double3 a = to_grid(axis_.low - axis_.direction * before, unit_);
      const Double3 moved = copse::across(a - axis_.low, axis_.direction);
      const double most = std::max(length(moved), length(moved + off));
      if (most < least) least = most, best = a;
    }
    return best;
  }

  const AxisToRound& axis_;
  Double3 unit_;
  double step_ = 0;        // along the axis to the next point of the grid
  double half_along_ = 0;  // by so much rounding moves a point along the axis at most
  double half_ = 0;        // a point of the grid is no farther
  double room_ = 0;        // by which the ends are farther apart than they must be, to choose their place
  bool found_ = false;
  double least_ = 0, rim_ = 0;
  Double3 edge_;
};

}  // namespace

GridAxis grid_axis(const AxisToRound& axis, int bits) {
  const double least = std::max(axis.length, std::ldexp(4 * axis.reach, -bits));
  const Double3 high = axis.low + axis.direction * least;
  Double3 most;
  for (int i = 0; i < 3; ++i)
    most[i] = std::max({std::abs(axis.low[i]), std::abs(high[i]), std::abs(axis.direction[i]) * least});
  Double3 unit{unit_of(most.x, bits), unit_of(most.y, bits), unit_of(most.z, bits)};
  const Double3 nearest = to_grid(axis.low, unit);
  if (!is_finite(most) || !is_finite(axis.direction) || axis.direction == Double3{} || !(least > 0))
    return {nearest, nearest};
  GridAxis found;
  for (int k = 0; k < k_widenings; ++k) {
    found = AxisSearch(axis, unit).run();
    bool fits = true;
    for (int i = 0; i < 3; ++i) {
      const double reached =
          std::max({std::abs(found.a[i]), std::abs(found.b[i]), std::abs(found.b[i] - found.a[i])});
      if (reached > std::ldexp(unit[i], bits)) unit[i] *= 2, fits = false;
    }
    if (fits) break;
  }
  return found;
}

}  // namespace copse
