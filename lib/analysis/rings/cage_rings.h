// cage_rings: the square rings that a skin's cage is made of, and the forks where their limbs meet.
#pragma once

#include "lib/analysis/rings/ring_graph.h"
#include "lib/analysis/surface/bands.h"
#include "lib/analysis/surface/lists.h"
#include "lib/analysis/surface/reverse_subdivision.h"
#include "lib/analysis/surface/surface.h"

#include <cstdint>
#include <vector>

namespace copse {

// A cage as triangles and bands of quads. A limb's end is a ring as one of its bands has it (2 * band, + 1
// for the second one), because two limbs may begin with the same vertices. A fork is where three ends or more
// meet.
struct CageRings {
  Surface surface;                         // with every smoothing of hulls undone
  std::vector<std::uint32_t> local;        // one a vertex of the cage: its number in the surface
  std::vector<std::uint32_t> triangle_of;  // one a face of the cage: a triangle of it
  Bands bands;
  RingGraph graph;
  Lists ends_of;                          // one a fork: its ends
  std::vector<std::uint32_t> fork_of;     // one an end: its fork or k_none
  std::vector<std::uint8_t> is_hull;      // one a band: whether it lies between the ends of a fork
  std::vector<std::uint8_t> was_regular;  // one a node of the graph: even before smoothing was undone
  double precision = 0;                   // of the cage

  std::span<const std::uint32_t> ring(std::uint32_t node) const { return bands.ring(graph.ring[node]); }
  // How far a ring of that radius may be off by rounding alone.
  double noise(double radius) const;
  // Whether a ring lies evenly about its centre.
  bool is_regular(std::uint32_t node) const;
};

// Bands are strips of quads; those that happen to close across a hull are left out. Where three bands or more
// meet in one ring, limbs' first rings were merged wholly, and the band that leads back is the hull. O(n log
// n).
CageRings read_cage_rings(const Cage& cage);

}  // namespace copse
