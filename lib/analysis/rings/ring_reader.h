// ring_reader: reads a connected surface as a tree of rings, if it is one.
#pragma once

#include "lib/analysis/rings/limbs.h"
#include "lib/analysis/rings/ring_front.h"
#include "lib/analysis/rings/ring_starts.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace copse {

// Tubes of k-gons whose quads are cut in any way; ends open, closed by a lid with or without a centre, or
// collapsed to a point; seams (the mesh is welded); rings that several tubes share; k constant or not;
// strips (k = 2), double-sided or not. Topology decides; where it leaves a choice (a box can be read along
// three axes) one whose rings are all regular polygons is taken, then the longest and thinnest. Everything
// else is left to recover_welded().
class RingReader {
 public:
  RingReader(const TrunkMesh& mesh, const Fans& fans);

  // Appends the limb that the surface is and sets the owners of its triangles (repeated ones excepted).
  // False: the surface is no tree of rings, nothing was changed. Linear: what is tried and dropped is bounded
  // by k_ring_attempts times the surface.
  bool read(std::span<const std::uint32_t> triangles, std::span<const std::uint32_t> vertices, Limbs& limbs);

 private:
  // A start from which the whole surface can be read.
  struct Reading {
    RingStarts::Ring start;
    double oblique = 0;
    std::size_t pointed = 0;
    std::pair<bool, double> rank;
  };

  bool read_open(std::uint32_t boundary_vertex, std::span<const std::uint32_t> vertices);
  void try_starts(std::span<const RingStarts::Ring> starts, RingSizes sizes, std::vector<Reading>& readings);
  bool read_best(std::span<const Reading> readings, RingSizes sizes);
  bool read_closed(std::span<const std::uint32_t> triangles, std::span<const std::uint32_t> vertices);
  bool attempt(std::span<const std::uint32_t> start, bool closed, RingSizes sizes);
  double slenderness() const;
  double obliqueness() const;
  bool has_foot() const;
  bool is_regular() const;
  std::size_t pointed_ends() const;
  bool closes_flat(std::uint32_t point, std::span<const std::uint32_t> ring) const;
  bool is_flat(std::span<const std::uint32_t> ring) const;
  std::vector<std::uint32_t> lid_ring_of(std::span<const RingMeasure> measures) const;
  void append(Limbs& limbs) const;

  const TrunkMesh& mesh_;
  RingStarts starts_;
  RingFront front_;
  std::size_t budget_ = 0;  // triangles that attempts on the surface in hand may still touch
};

}  // namespace copse
