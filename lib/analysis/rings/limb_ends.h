// limb_ends: which patches of a surface may be the flat ends of limbs, and which rings may lie round a limb.
#pragma once

#include "lib/analysis/surface/lids.h"
#include "lib/analysis/surface/surface.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace copse {

// What shape says about ends; whether rings follow behind them is for others to tell (band_growth.h).
class LimbEnds {
 public:
  explicit LimbEnds(const Surface& surface) : surface_(surface) {}  // must outlive this

  // The lids (lids.h) of an angle; found once for each angle, O(n log n). References stay valid until another
  // angle is asked for.
  const std::vector<Lid>& lids(double smooth);

  // The same where some triangles (one entry each, not 0) are known to be no part of a lid: the side of a
  // limb may be flush with the lid beside it.
  std::vector<Lid> lids_beside(double smooth, std::span<const std::uint8_t> settled) const;

  // Whether vertices may lie round a limb: their polygon is about as round as one of so many corners can be.
  // What surrounds a corner, and a strip along a limb's side, is long; so is the end of a slab.
  bool is_round(std::span<const std::uint32_t> ring) const;

  // Whether a lid may be the end of a limb, of any shape or about as round as a regular polygon; a vertex in
  // its middle must not draw the limb out to a point.
  enum class Lids : std::uint8_t { round, any };
  bool may_close(const Lid& lid, Lids which) const;

  // Whether a lid fans out from this corner. What lies round such a corner, across the lid and down the side,
  // looks like a ring round a blunt point, and the slanted rings behind it like a tube.
  bool is_lid_corner(std::uint32_t vertex);

 private:
  std::vector<SharedEdge> edges() const;

  const Surface& surface_;
  std::vector<std::pair<double, std::vector<Lid>>> lids_;  // by angle
  std::vector<std::uint8_t> lid_corner_;                   // one a vertex, or none yet
};

}  // namespace copse
