#include "lib/analysis/rings/patched_surface.h"

#include <algorithm>

namespace copse {

namespace {

bool holds(const Triangle& t, std::uint32_t a, std::uint32_t b) {
  return std::ranges::count(t, a) != 0 && std::ranges::count(t, b) != 0;
}

}  // namespace

void PatchedSurface::close(std::span<const Side> hole, std::span<const Triangle> triangles) {
  const auto first = static_cast<std::uint32_t>(size());
  stand_ins_.insert(stand_ins_.end(), triangles.begin(), triangles.end());
  across_.resize(size() + triangles.size(), {k_none, k_none, k_none});
  for (std::uint32_t t = first; t < size(); ++t) {
    for (std::size_t e = 0; e < 3; ++e) {
      const std::uint32_t a = triangle(t)[e], b = triangle(t)[(e + 1) % 3];
      for (std::uint32_t u = first; u < size(); ++u) {
        if (u != t && holds(triangle(u), a, b)) across_[t][e] = u;
      }
      for (const Side& s : hole) {
        if (!((s.a == a && s.b == b) || (s.a == b && s.b == a))) continue;
        across_[t][e] = s.outside;
        if (s.outside == k_none) continue;
        set_beyond(s.outside, a, b, t);
        set_beyond(s.inside, a, b, k_none);
      }
    }
  }
}

void PatchedSurface::reopen(std::span<const Side> hole) {
  for (const Side& s : hole) {
    if (s.outside == k_none) continue;
    set_beyond(s.outside, s.a, s.b, s.inside);
    set_beyond(s.inside, s.a, s.b, s.outside);
  }
  stand_ins_.resize(stand_ins_.size() - (hole.size() - 2));
  across_.resize(own_.size() + stand_ins_.size());
}

}  // namespace copse
