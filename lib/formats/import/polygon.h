// Cuts a polygon in space into triangles.
//
// n corners give n - 2 triangles, always, with the polygon's winding and with no new corner. A simple
// polygon, flat or nearly so, convex or not, is covered exactly: quads along the better diagonal, larger ones
// by clipping ears of the polygon projected along its Newell normal. A polygon that crosses itself or has no
// area gives some n - 2 triangles. Deterministic.
//
// Cost: O(n log n) for polygons as they occur (only reflex corners are tested, found along a Morton curve).
// The work is bounded by k_cut_budget * n * log2(n); when an adversarial polygon uses that up the rest is cut
// as a fan.
#pragma once

#include "lib/formats/vec.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace copse {

inline constexpr std::uint64_t k_cut_budget = 64;

class PolygonCutter {
 public:
  using Cut = std::array<std::uint32_t, 3>;  // indices into the corners

  // n >= 3 finite corners, in order. The answer is valid until the next call.
  std::span<const Cut> cut(std::span<const Double3> corners);

  // True when the last polygon's budget ran out.
  bool gave_up() const { return gave_up_; }

 private:
  struct Point {
    double x, y;
  };
  bool project(std::span<const Double3> corners);
  void cut_quad(std::span<const Double3> corners);
  void clip_ears();
  void index_reflex();
  bool is_ear(std::uint32_t i);
  bool blocks(std::uint32_t corner, std::uint32_t ear) const;
  double turn(std::uint32_t i) const;
  std::uint32_t clip(std::uint32_t i);
  void update_reflex(std::uint32_t i);
  void fan(std::uint32_t first);
  std::uint32_t morton(const Point& p) const;

  bool gave_up_ = false;
  std::uint64_t work_ = 0;
  std::size_t reflex_count_ = 0;
  std::vector<Cut> cuts_;
  std::vector<Point> points_;
  std::vector<std::uint32_t> next_, previous_;
  std::vector<std::uint8_t> reflex_;
  struct Key {
    std::uint32_t code, corner;
  };
  std::vector<Key> keys_;  // reflex corners along the Morton curve; convex ones are swept out now and then
};

}  // namespace copse
