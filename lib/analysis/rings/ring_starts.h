// ring_starts: where a surface may show its first ring.
//
// One true ring is enough to read a tube (ring_front.h). An open tube shows it as a boundary loop. A closed
// one shows it as the vertex in the middle of a cap or at the end of a point, or as the rim of a lid without
// a centre. The rungs of a strip (k = 2) start at one of its two ears.
#pragma once

#include "lib/analysis/surface/fans.h"
#include "lib/analysis/surface/trunk_mesh.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace copse {

class RingStarts {
 public:
  using Ring = std::vector<std::uint32_t>;

  RingStarts(const TrunkMesh& mesh, const Fans& fans);

  // The first vertex of `vertices` that lies on a boundary edge; k_none for a closed surface.
  std::uint32_t first_on_boundary(std::span<const std::uint32_t> vertices);
  // The boundary loop through a vertex, in order; empty where it is no simple loop.
  Ring loop_through(std::uint32_t vertex);
  // All simple boundary loops, by their lowest vertex.
  std::vector<Ring> loops(std::span<const std::uint32_t> vertices);

  // Whether a tube whose rings all have the size of the vertex's link can start here, by counting alone: a
  // quick test that most vertices of a tube fail.
  bool may_be_apex(std::uint32_t vertex) const;

  // The rims of all lids (lids.h) without a vertex in the middle.
  std::vector<Ring> lids(std::span<const std::uint32_t> triangles, double smooth);

  // The rungs and points that a strip (a disc without inner vertices) may start with.
  std::vector<Ring> rungs(std::span<const std::uint32_t> vertices) const;

  // The edges that have been looked at so far, each once a vertex and triangle: the work that was done.
  std::size_t edges_looked_at() const { return looked_at_; }

 private:
  struct Side {
    std::uint32_t neighbour, triangle;
    friend auto operator<=>(const Side&, const Side&) = default;
  };
  using Pair = std::array<std::uint32_t, 2>;
  // (neighbour, triangle) of every edge at the vertex, sorted.
  void sides_at(std::uint32_t vertex);
  // The two ends of the boundary edges at the vertex; k_no_boundary unless there are exactly two. Each fan is
  // looked at once: many loops may ask for the hub of a large one.
  Pair boundary_neighbours(std::uint32_t vertex);
  Pair look_for_boundary(std::uint32_t vertex);
  // The boundary from a vertex on, up to what was given up; whether it comes back to the vertex.
  template <class GivenUp>
  bool follow(std::uint32_t vertex, const GivenUp& given_up, Ring& way);

  static constexpr Pair k_no_boundary{k_none, k_none}, k_not_looked{k_none, 0};

  const TrunkMesh& mesh_;
  const Fans& fans_;
  std::vector<Side> sides_;
  std::vector<std::uint32_t> local_;  // scratch: one a triangle
  std::vector<Pair> boundary_;        // one a vertex
  std::vector<std::uint8_t> met_;     // scratch: one a vertex
  std::size_t looked_at_ = 0;
};

}  // namespace copse
