// limbs: the rings of every connected surface of the trunk, before the surfaces are attached to one another.
#pragma once

#include "lib/analysis/rings/hierarchy.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace copse {

// Mean of the points, twice their mean distance from it, and the unit normal of the polygon that they are in
// this order (0 for fewer than three, or where they span nothing).
struct RingMeasure {
  Double3 centre;
  double diameter = 0;
  Double3 normal;
};
RingMeasure measure_ring(std::span<const Double3> positions, std::span<const std::uint32_t> ring);

// A limb is a tree of rings that surface joins: band r is the surface
// between ring r and its parent as they were read. Rerooting changes which ring lies at the far end of a
// band.
struct Limbs {
  std::vector<Double3> centre;
  std::vector<double> diameter;
  std::vector<Double3> normal;        // of the ring's plane, unit; 0 where the ring has none
  std::vector<std::uint32_t> parent;  // within the limb; k_none for the limb's root
  std::vector<std::uint32_t> band;    // that joins the ring to its parent; k_none for the limb's root
  std::vector<RadiusSource> source;
  std::vector<std::uint32_t> first_vertex{0};  // rings + 1
  std::vector<std::uint32_t> vertices;
  std::vector<std::uint32_t> limb;         // that the ring is part of
  std::vector<std::uint32_t> merged_into;  // the ring that this one is a copy of; k_none for most
  // One a triangle of the TrunkMesh: the band that it lies in, or, where lid is set, the ring that it closes.
  // k_none where nothing explains it.
  std::vector<std::uint32_t> owner;
  std::vector<std::uint8_t> lid;
  std::vector<std::string> notes;

  std::uint32_t rings() const { return static_cast<std::uint32_t>(parent.size()); }
  std::span<const std::uint32_t> ring(std::uint32_t r) const {
    return std::span(vertices).subspan(first_vertex[r], first_vertex[r + 1] - first_vertex[r]);
  }

  // The ring that `r` stands for: itself, or what it was merged into.
  std::uint32_t alive(std::uint32_t r) const {
    while (merged_into[r] != k_none) r = merged_into[r];
    return r;
  }
  // The parent that counts; k_none for a root.
  std::uint32_t parent_of(std::uint32_t r) const { return parent[r] == k_none ? k_none : alive(parent[r]); }

  std::uint32_t size = 0;  // limbs
  std::vector<std::uint8_t>
      is_plate;  // one a limb, or none where there is no plate: ground that trees stand on
  bool plate(std::uint32_t l) const { return l < is_plate.size() && is_plate[l] != 0; }

  // Appends a ring to limb number `size`; its band has its own number. Finish with ++size.
  void append(const RingMeasure& measure, std::uint32_t ring_parent, RadiusSource ring_source,
              std::span<const std::uint32_t> ring_vertices);
};

// Makes `ring` (alive) the root of its limb by turning round the parents between it and the present root.
// Rings keep their numbers, so parents need no longer come before children. Linear in the length of the way.
void reroot(Limbs& limbs, std::uint32_t ring);

// Makes the alive ring `copy` and the alive ring `ring` of another limb one ring, and their limbs one: the
// limb of `copy` is rerooted at it and hung on `ring`. limb[] is left to the caller.
void merge_rings(Limbs& limbs, std::uint32_t copy, std::uint32_t ring);

}  // namespace copse
