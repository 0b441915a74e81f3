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
  // How many corners were looked at for it.
  std::uint64_t work() const { return work_; }

 private:
  struct Point {
    double x, y;
  };
  struct Box2 {
    Point low, high;
    std::uint32_t reflex;  // how many corners in it still are
  };
  bool project(std::span<const Double3> corners);
  void cut_quad(std::span<const Double3> corners);
  void clip_ears();
  void index_reflex();
  bool is_ear(std::uint32_t i);
  std::uint32_t find_blocker(std::uint32_t i);
  std::uint32_t choose(std::uint32_t& from);
  void enqueue(std::uint32_t i);
  bool blocks(std::uint32_t corner, std::uint32_t ear) const;
  bool misses(const Box2& box, std::uint32_t ear) const;
  double turn(std::uint32_t i) const;
  std::uint32_t clip(std::uint32_t i);
  void forget_reflex(std::uint32_t i);
  void fan(std::uint32_t first);
  std::uint32_t morton(const Point& p) const;

  bool gave_up_ = false;
  std::uint64_t work_ = 0;
  std::vector<Cut> cuts_;
  std::vector<Point> points_;
  std::vector<std::uint32_t> next_, previous_;

  // The corners that are reflex at first, along a Morton curve, and boxes over every k_fan_out of them, of
  // those, ...
  static constexpr std::uint32_t k_fan_out = 8;
  std::vector<std::uint32_t> sorted_;
  std::vector<std::vector<Box2>> boxes_;  // from the smallest to one that holds all
  std::vector<std::uint32_t> rank_;       // of a corner in sorted_; k_convex when it is not reflex (any more)
  std::vector<std::array<std::uint32_t, 2>> stack_;

  // Corners that may be ears, first come first served, so that slender fans are avoided. One that is no ear
  // because of a reflex corner waits in that one's list until it is gone.
  struct Waiting {
    std::uint32_t corner, next;
  };
  std::vector<std::uint32_t> queue_;
  std::size_t queue_front_ = 0;
  std::vector<bool> queued_;
  std::vector<std::uint32_t> first_waiting_;
  std::vector<Waiting> waiting_;
};

}  // namespace copse
