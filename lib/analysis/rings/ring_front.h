// ring_front: from one ring of a tube, all the others, by topology alone.
//
// If a ring is known, the next one is known: the vertices that edges lead to and that no ring has yet (digest
// 000, section 1.3). However the quads between two rings are cut, the band between them is an annulus of
// |ring| + |next ring| triangles, and everything is checked against that. Coordinates only choose which
// vertex of a ring comes first.
#pragma once

#include "lib/analysis/surface/fans.h"
#include "lib/analysis/surface/trunk_mesh.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace copse {

// The rings of one connected surface, parents first: ring 0 is the one that reading started from.
struct RingTree {
  std::vector<std::uint32_t> parent;           // k_none for ring 0
  std::vector<std::uint32_t> first_vertex{0};  // rings + 1 offsets
  // In cyclic order; vertex j continues vertex j of the parent's ring where both have the same number. Rings
  // of one vertex are points: cap centres and rings that were collapsed. Rings of two are the rungs of a
  // strip.
  std::vector<std::uint32_t> vertices;

  std::uint32_t size() const { return static_cast<std::uint32_t>(parent.size()); }
  std::span<const std::uint32_t> ring(std::uint32_t r) const {
    return std::span(vertices).subspan(first_vertex[r], first_vertex[r + 1] - first_vertex[r]);
  }
};

enum class RingSizes : std::uint8_t {
  any,       // rings of one surface may differ in size
  constant,  // all rings but points have the same size
};

class RingFront {
 public:
  RingFront(const TrunkMesh& mesh, const Fans& fans);

  // Reads the surface from `start` (in cyclic order; `closed` says of two vertices whether they are a flat
  // tube rather than a rung of a strip). True when every triangle that can be reached lies in a band between
  // two rings or in a lid of one ring. Forgets what was read before. Linear in what is touched.
  bool read(std::span<const std::uint32_t> start, bool closed, RingSizes sizes);

  const RingTree& rings() const { return rings_; }
  // The triangles that were read, and of each the ring at the far end of its band, or the ring that it is a
  // lid of.
  std::span<const std::uint32_t> triangles() const { return touched_; }
  std::uint32_t owner(std::uint32_t triangle) const { return owner_[triangle]; }
  bool is_lid(std::uint32_t triangle) const { return lid_[triangle] != 0; }

 private:
  // A triangle between ring and fresh vertices.
  struct Band {
    std::uint32_t triangle;
    std::uint32_t at;     // edge of the ring (two ring vertices) or position on it (one)
    std::uint32_t a, b;   // fresh vertices, as indices into fresh_; b is k_none when there is one
    std::uint32_t chain;  // of the fresh vertices
  };
  // Fresh vertices in cyclic order: chain_vertices_[first, first + size).
  struct Chain {
    std::uint32_t first, size;
    bool closed;
  };

  void forget();
  bool expand(std::uint32_t ring, RingSizes sizes);
  bool collect(std::uint32_t ring);
  bool collect(std::uint32_t ring, std::uint32_t triangle);
  bool link_fresh();
  bool trace_chains();
  bool check_band(std::uint32_t ring, const Chain& chain, std::span<const Band> bands);
  bool check_winding(const Chain& chain);
  std::uint32_t nearest_in_first_fan(std::uint32_t ring, const Chain& chain) const;
  void append_ring(std::uint32_t parent, const Chain& chain, std::span<const Band> bands);
  bool is_closed(std::uint32_t ring) const { return closed_[ring] != 0; }

  const TrunkMesh& mesh_;
  const Fans& fans_;
  RingTree rings_;
  std::vector<std::uint8_t> closed_;                      // one a ring
  std::vector<std::uint32_t> ring_of_, place_;            // one a vertex: its ring, its place in it
  std::vector<std::uint32_t> owner_;                      // one a triangle
  std::vector<std::uint8_t> lid_;                         // one a triangle
  std::vector<std::uint32_t> touched_;                    // triangles
  std::vector<std::uint32_t> fresh_;                      // vertices beyond the current ring
  std::vector<std::array<std::uint32_t, 2>> neighbour_;   // along the next ring, of each fresh vertex
  std::vector<std::uint8_t> degree_;                      // of each fresh vertex
  std::vector<std::uint32_t> chain_of_, place_in_chain_;  // of each fresh vertex
  std::vector<std::uint32_t> chain_vertices_;             // indices into fresh_
  std::vector<Chain> chains_;
  std::vector<Band> bands_;
  std::vector<std::uint32_t> over_edge_, fan_size_;  // of the band in hand, by place on the ring
  bool forward_ = true;                              // the chain runs as the ring does
};

}  // namespace copse
