#include "tools/treegrow/joints.h"

#include <cmath>
#include <numbers>

namespace copse::grow {

void add_band(Surface& surface, const Loop& lower, const Loop& upper, std::size_t skip_first,
              std::size_t skip_count) {
  const std::size_t n = lower.columns();
  for (std::size_t c = 0; c < n; ++c) {
    if ((c + n - skip_first % n) % n < skip_count) continue;
    surface.quad({lower.vertex[c], lower.vertex[c + 1], upper.vertex[c + 1], upper.vertex[c]},
                 {lower.texcoord[c], lower.texcoord[c + 1], upper.texcoord[c + 1], upper.texcoord[c]});
  }
}

void add_zipper(Surface& surface, const Loop& lower, const Loop& upper) {
  const std::size_t n = lower.columns(), m = upper.columns();
  std::size_t i = 0, j = 0;
  while (i < n || j < m) {
    // The side that is behind, by its share of the way round, makes the next step.
    const bool step_lower = j == m || (i < n && (2 * i + 1) * m <= (2 * j + 1) * n);
    if (step_lower) {
      surface.triangle({lower.vertex[i], lower.vertex[i + 1], upper.vertex[j]},
                       {lower.texcoord[i], lower.texcoord[i + 1], upper.texcoord[j]});
      ++i;
    } else {
      surface.triangle({lower.vertex[i], upper.vertex[j + 1], upper.vertex[j]},
                       {lower.texcoord[i], upper.texcoord[j + 1], upper.texcoord[j]});
      ++j;
    }
  }
}

void add_fan(Surface& surface, const Loop& loop, const Double3& middle, const Double3& outward,
             bool reversed) {
  const std::uint32_t centre = surface.vertex(middle, outward);
  const Float2 uv = surface.mesh().texcoords[loop.texcoord[0]];
  const std::uint32_t texcoord = surface.texcoord(uv.x, uv.y + 0.1);
  for (std::size_t c = 0; c < loop.columns(); ++c) {
    const std::size_t a = reversed ? c + 1 : c, b = reversed ? c : c + 1;
    surface.triangle({loop.vertex[a], loop.vertex[b], centre},
                     {loop.texcoord[a], loop.texcoord[b], texcoord});
  }
}

void add_ngon(Surface& surface, const Loop& loop, bool reversed) {
  std::vector<std::uint32_t> v(loop.vertex.begin(), loop.vertex.end() - 1);
  std::vector<std::uint32_t> t(loop.texcoord.begin(), loop.texcoord.end() - 1);
  if (reversed)
    v.assign(loop.vertex.rbegin() + 1, loop.vertex.rend()),
        t.assign(loop.texcoord.rbegin() + 1, loop.texcoord.rend());
  surface.polygon(v, t);
}

double best_phase(const Surface& surface, const Loop& loop, const Double3& centre, const Double3& side,
                  const Double3& up) {
  // Least squares over the turn: the sum of squared distances is a constant less C cos + S sin.
  double c = 0, s = 0;
  const std::size_t n = loop.columns();
  for (std::size_t i = 0; i < n; ++i) {
    const Double3 p = surface.placement().undo(surface.position(loop.vertex[i])) - centre;
    const double angle = 2 * std::numbers::pi * static_cast<double>(i) / static_cast<double>(n);
    const double a = dot(p, side), b = dot(p, up);
    c += a * std::cos(angle) + b * std::sin(angle);
    s += b * std::cos(angle) - a * std::sin(angle);
  }
  return std::atan2(s, c);
}

}  // namespace copse::grow
