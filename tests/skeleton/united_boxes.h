// A union of two square tubes, made by hand, with what it was made of.
#pragma once

#include "lib/analysis/surface/bands.h"
#include "lib/analysis/surface/surface.h"
#include "lib/analysis/surface/trunk_mesh.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <vector>

namespace copse {

// Triangles by their corners' positions, all turned to the side that is named.
class Soup {
 public:
  void add(const Double3& a, const Double3& b, const Double3& c, const Double3& outward) {
    const bool turned = dot(cross(b - a, c - a), outward) < 0;
    mesh_.triangles.push_back({id(a), id(turned ? c : b), id(turned ? b : c)});
  }
  void quad(const Double3& a, const Double3& b, const Double3& c, const Double3& d, const Double3& outward) {
    add(a, b, c, outward);
    add(a, c, d, outward);
  }
  TrunkMesh take() {
    for (std::uint32_t t = 0; t < mesh_.triangles.size(); ++t) mesh_.source.push_back(t);
    mesh_.piece.assign(mesh_.triangles.size(), 0);
    return mesh_;
  }

 private:
  std::uint32_t id(const Double3& p) {
    const auto [at, is_new] = ids_.try_emplace(std::tuple(p.x, p.y, p.z), mesh_.positions.size());
    if (is_new) mesh_.positions.push_back(p);
    return static_cast<std::uint32_t>(at->second);
  }
  std::map<std::tuple<double, double, double>, std::size_t> ids_;
  TrunkMesh mesh_;
};

// A square trunk of half-width 1 from y = 0 to 5 with a square bough of half-width 0.4 that was united with
// it: it grows from (0, 2, 0) along x to 5 and cuts the trunk's ring at y = 2.
inline TrunkMesh united_boxes(bool has_bough = true) {
  Soup soup;
  const auto at = [](int corner, double y) {
    return Double3{corner == 0 || corner == 3 ? 1.0 : -1.0, y, corner < 2 ? 1.0 : -1.0};
  };
  for (int side = 0; side < 4; ++side) {
    const Double3 out = at(side, 0) + at((side + 1) % 4, 0);
    for (int y = 0; y < 5; ++y) {
      if (has_bough && side == 3 && (y == 1 || y == 2)) continue;
      soup.quad(at(side, y), at((side + 1) % 4, y), at((side + 1) % 4, y + 1), at(side, y + 1), out);
    }
  }
  for (const double y : {0.0, 5.0}) soup.quad(at(0, y), at(1, y), at(2, y), at(3, y), {0, y - 2, 0});
  if (!has_bough) return soup.take();
  const Double3 x{1, 0, 0};
  for (const double side : {-1.0, 1.0}) {  // the faces below and above the cut ring
    const double far = 2 + side, near = 2 + 0.4 * side;
    const Double3 a{1, far, -1}, b{1, far, 1}, c{1, 2, 1}, d{1, 2, 0.4}, e{1, near, 0.4}, f{1, near, -0.4},
        g{1, 2, -0.4}, h{1, 2, -1};
    soup.add(h, a, f, x), soup.add(h, f, g, x), soup.add(a, b, e, x);
    soup.add(a, e, f, x), soup.add(b, c, e, x), soup.add(c, d, e, x);
  }
  for (const double side : {-0.4, 0.4}) {
    for (double from = 1; from < 5; ++from) {
      const double to = from + 1;
      soup.quad({from, 2 + side, -0.4}, {from, 2 + side, 0.4}, {to, 2 + side, 0.4}, {to, 2 + side, -0.4},
                {0, side, 0});
      if (from > 1)
        soup.quad({from, 1.6, side}, {from, 2.4, side}, {to, 2.4, side}, {to, 1.6, side}, {0, 0, side});
    }
    // Beside the trunk with a corner where its ring is cut.
    const Double3 low{1, 1.6, side}, cut{1, 2, side}, high{1, 2.4, side}, z{0, 0, side};
    soup.add(low, cut, {2, 1.6, side}, z);
    soup.add(cut, high, {2, 2.4, side}, z);
    soup.add(cut, {2, 1.6, side}, {2, 2.4, side}, z);
  }
  soup.quad({5, 1.6, -0.4}, {5, 2.4, -0.4}, {5, 2.4, 0.4}, {5, 1.6, 0.4}, x);
  return soup.take();
}

// The bands between whole rings: across `axis` between `low` and `low` + 1.
inline void add_band(const Surface& s, int axis, double low, Bands& bands) {
  std::vector<std::uint32_t> rings[2], of;
  const bool bough = axis == 0;
  const auto at = [&](std::uint32_t v) { return s.positions[v][axis]; };
  const auto beside = [&](std::uint32_t v) { return bough || std::abs(s.positions[v].x) <= 1; };
  for (std::uint32_t v = 0; v < s.positions.size(); ++v) {
    for (int end = 0; end < 2; ++end) {
      if (at(v) == low + end && beside(v)) rings[end].push_back(v);
    }
  }
  const auto angle = [&](std::uint32_t v) {
    const Double3& p = s.positions[v];
    return bough ? std::atan2(p.z, p.y - 2) : std::atan2(p.z, p.x);
  };
  for (auto& ring : rings) std::ranges::sort(ring, {}, angle);
  for (std::uint32_t t = 0; t < s.triangles.size(); ++t) {
    const auto holds = [&](double y) {
      return std::ranges::any_of(s.triangles[t], [&](auto v) { return at(v) == y; });
    };
    const bool within = std::ranges::all_of(
        s.triangles[t], [&](auto v) { return (at(v) == low || at(v) == low + 1) && beside(v); });
    if (within && holds(low) && holds(low + 1)) of.push_back(t);
  }
  bands.add(rings[0], rings[1], of);
}

inline Bands bands_of_boxes(const Surface& s, bool has_bough = true) {
  Bands bands;
  bands.band_of.assign(s.triangles.size(), k_none);
  for (const double y : {0, 3, 4}) add_band(s, 1, y, bands);
  if (has_bough) {
    for (const double x : {2, 3, 4}) add_band(s, 0, x, bands);
  }
  return bands;
}

}  // namespace copse
