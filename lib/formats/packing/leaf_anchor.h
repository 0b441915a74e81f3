// Leaves that sit on the axis of a limb, as those of most tree generators do: where a leaf is follows from
// how far along a segment it sits, how it is turned roughly from the way that the limb goes there. + - * /
// and square roots alone: the same everywhere.
#pragma once

#include "lib/formats/packing/leaf_frame.h"
#include "lib/formats/packing/pack_leaves.h"
#include "lib/formats/packing/pack_trunk.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace copse {

inline constexpr std::uint32_t k_most_up =
    64;  // radii from a group's to the root that are told by how far up they are

// In steps, from the trunk's base on.
struct LeafLimb {
  Double3 from{}, to{};
  Double3 from_axis{}, to_axis{};  // across the rings at both ends
  int along_bits() const;          // so many positions that half of one is less than half a step
  Double3 point(std::uint32_t along) const;
  Double3 axis(std::uint32_t along) const;
};

class LeafAnchors {
 public:
  LeafAnchors(const PackedTrunk& trunk, std::uint32_t roots);

  // The limb that ends at this radius; nothing where none does.
  std::optional<LeafLimb> limb(std::uint32_t radius) const;
  // From the radius of this leaf group so many up to the root; none where that is beyond the root, or the
  // group is at no radius.
  std::uint32_t radius_above(std::size_t group, std::uint32_t up) const;
  std::uint32_t parent(std::uint32_t radius) const { return parent_[radius]; }
  std::uint32_t count() const { return static_cast<std::uint32_t>(parent_.size()); }

 private:
  std::vector<std::uint32_t> parent_, radius_of_group_;
  std::vector<Double3> centres_, normals_;  // normals_ may be 0
};

// How a leaf's plane leans against the limb: y of its frame, in the plane across its first edge, as cosine
// and sine against the limb's axis there.
using LeafLean = std::array<double, 2>;
LeafLean lean_of(const LeafFrame& frame, const Double3& axis);
// The turn that leans so; `half` as in PackedLeaf.
struct LeafTurn {
  bool half = false;
  double t = 0;  // as in leaf_frame
};
LeafTurn turn_of(const LeafLean& lean, const Double3& edge, const Double3& axis);
// The same with the other half: just across the border between both.
double turn_of(const LeafLean& lean, const Double3& edge, const Double3& axis, bool half);

}  // namespace copse
