#include "lib/analysis/lod/ring_places.h"

#include <algorithm>
#include <cmath>

namespace copse {
namespace {

constexpr double k_steps = 16;  // in a radius
constexpr double k_apart = 4;   // radii: what stands farther aside is as wrong as it can be, nearly
constexpr double k_parts[] = {1, 0.5, 0.25};

// Calls each(ring, k, t, off) for every ring between kept rings k and k + 1: it stands at t of the way and
// lies `off` the chord.
template <class Each>
void between(const LimbAxis& axis, std::span<const std::uint32_t> kept, Each&& each) {
  for (std::size_t k = 0; k + 1 < kept.size(); ++k) {
    const std::uint32_t a = kept[k], b = kept[k + 1];
    const Double3 from = axis.centres[a], chord = axis.centres[b] - from;
    const double span = axis.along[b] - axis.along[a];
    const Double3 ahead = normalized(chord, {0, 0, 0});
    for (std::uint32_t i = a + 1; i < b; ++i) {
      const double t = span > 0 ? (axis.along[i] - axis.along[a]) / span : 0.5;
      const Double3 off = axis.centres[i] - from - chord * t;
      each(i, k, t, off - ahead * dot(off, ahead));
    }
  }
}

double share_of_length(const LimbAxis& axis, std::size_t i) {
  const std::size_t last = axis.along.size() - 1;
  return 0.5 * (axis.along[std::min(i + 1, last)] - axis.along[i == 0 ? 0 : i - 1]);
}

// The normal equations: each unknown meets its neighbours alone.
struct Rows {
  std::vector<double> own, next;  // next[k]: of k and k + 1
  std::vector<Double3> right;
};

Rows normal_equations(const LimbAxis& axis, std::span<const std::uint32_t> kept) {
  Rows rows{
      .own = {}, .next = std::vector<double>(kept.size(), 0), .right = std::vector<Double3>(kept.size())};
  for (const std::uint32_t i : kept) rows.own.push_back(share_of_length(axis, i));
  between(axis, kept, [&](std::uint32_t i, std::size_t k, double t, const Double3& off) {
    const double trust = 1 + length(off) / (k_apart * axis.radii[i] + 1e-300);
    const double w = share_of_length(axis, i) / (trust * trust);
    rows.own[k] += w * (1 - t) * (1 - t), rows.own[k + 1] += w * t * t, rows.next[k] += w * t * (1 - t);
    rows.right[k] += off * (w * (1 - t)), rows.right[k + 1] += off * (w * t);
  });
  return rows;
}

// What is fixed stays at 0: its row is left out. Positive definite, so no pivots.
std::vector<Double3> solve(Rows rows, const std::vector<std::uint8_t>& fixed) {
  const std::size_t n = fixed.size();
  for (std::size_t k = 0; k < n; ++k) {
    if (!fixed[k] && rows.own[k] > 0) continue;
    rows.own[k] = 1, rows.right[k] = {}, rows.next[k] = 0;
    if (k > 0) rows.next[k - 1] = 0;
  }
  for (std::size_t k = 1; k < n; ++k) {
    const double factor = rows.next[k - 1] / rows.own[k - 1];
    rows.own[k] -= factor * rows.next[k - 1];
    rows.right[k] -= rows.right[k - 1] * factor;
  }
  std::vector<Double3> shifts(n);
  for (std::size_t k = n; k-- > 0;) {
    if (k + 1 < n) rows.right[k] -= shifts[k + 1] * rows.next[k];
    shifts[k] = rows.right[k] / rows.own[k];
  }
  return shifts;
}

double farthest(const LimbAxis& axis, std::span<const std::uint32_t> kept,
                const std::vector<Double3>& shifts) {
  double most = 0;
  for (const Double3& s : shifts) most = std::max(most, length(s));
  between(axis, kept, [&](std::uint32_t, std::size_t k, double t, const Double3& off) {
    most = std::max(most, length(off - shifts[k] * (1 - t) - shifts[k + 1] * t));
  });
  return most;
}

double in_steps(double x, double step) {
  return step > 0 ? std::round(x / step) * step : 0;
}

}  // namespace

std::vector<Double3> ring_shifts(const LimbAxis& axis, std::span<const std::uint32_t> kept,
                                 std::span<const std::uint8_t> fixed) {
  const std::vector<Double3> none(kept.size());
  if (kept.size() < 3) return none;
  std::vector<std::uint8_t> stays(fixed.begin(), fixed.end());
  stays.front() = stays.back() = 1;
  const std::vector<Double3> best = solve(normal_equations(axis, kept), stays);
  const double before = farthest(axis, kept, none);
  for (const double part : k_parts) {
    std::vector<Double3> shifts = none;
    for (std::size_t k = 0; k < kept.size(); ++k) {
      const double step = axis.radii[kept[k]] / k_steps;
      const Double3 s = best[k] * part;
      shifts[k] = {in_steps(s.x, step), in_steps(s.y, step), in_steps(s.z, step)};
    }
    if (farthest(axis, kept, shifts) <= before) return shifts;
  }
  return none;
}

}  // namespace copse
