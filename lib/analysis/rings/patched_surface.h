// patched_surface: a surface some of whose holes are closed by triangles that stand for what is missing.
//
// Where one limb was cut into another, the other's bands have holes. Stand-ins close them, so that a band can
// be walked; when the walk shows that it was none, they are taken out again.
#pragma once

#include "lib/analysis/surface/surface.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

class PatchedSurface {
 public:
  // The surface must live as long.
  explicit PatchedSurface(const Surface& surface) : own_(surface.triangles), across_(surface.across) {}

  // The surface's own triangles have the numbers that they have there; stand-ins follow them.
  const Triangle& triangle(std::uint32_t t) const {
    return is_stand_in(t) ? stand_ins_[t - own_.size()] : own_[t];
  }
  std::size_t size() const { return across_.size(); }
  bool is_stand_in(std::uint32_t t) const { return t >= own_.size(); }

  // What lies across an edge of a triangle now: k_none at a border, and behind what a stand-in has covered.
  std::uint32_t across(std::uint32_t t, std::size_t edge) const { return across_[t][edge]; }
  std::uint32_t beyond(std::uint32_t t, std::uint32_t a, std::uint32_t b) const {
    return across_[t][static_cast<std::size_t>(edge_between(triangle(t), a, b))];
  }

  // An edge a -> b of a hole: the triangle of whatever sits in it, and what lies across; k_none at a border.
  struct Side {
    std::uint32_t a, b, inside, outside;
  };
  // Puts triangles into the hole that the sides enclose: what lay across a side lies across them now. The
  // product of sides and triangles is what it costs.
  void close(std::span<const Side> hole, std::span<const Triangle> triangles);
  // Undoes the last close(), of the same hole, which must have had two triangles fewer than sides.
  void reopen(std::span<const Side> hole);

 private:
  void set_beyond(std::uint32_t t, std::uint32_t a, std::uint32_t b, std::uint32_t to) {
    across_[t][static_cast<std::size_t>(edge_between(triangle(t), a, b))] = to;
  }

  std::span<const Triangle> own_;
  std::vector<Triangle> stand_ins_;
  std::vector<Triangle> across_;  // of all
};

}  // namespace copse
