// ring_graph: how the rings of bands hang together: by bands, and at sites, where limbs meet or end.
#pragma once

#include "lib/analysis/surface/bands.h"
#include "lib/analysis/surface/lists.h"
#include "lib/analysis/surface/surface.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

// A node is a distinct ring (rings of the same vertices are one). A site is a place where the ends of several
// tubes meet: rings that share an edge without being the same, or that a patch (a connected set of triangles
// in no band) touches. The surface is connected, and so is the graph of bands and sites.
struct RingGraph {
  std::vector<std::uint32_t> ring;     // one a node: a ring of the bands
  std::vector<RingCircle> circle;      // one a node
  std::vector<std::uint32_t> node_of;  // one a ring
  Lists bands_of;                      // one a node
  Lists nodes_of;                      // one a vertex of the surface: the nodes whose rings hold it
  std::vector<std::uint32_t> site_of;  // one a node: its site or k_none
  Lists ends;                          // one a site: its nodes
  Lists patch;                         // one a site: its triangles
  std::vector<std::uint8_t> is_open;   // one a site: whether a border of the surface runs through it
  std::uint32_t sites = 0;

  std::uint32_t nodes() const { return static_cast<std::uint32_t>(ring.size()); }
  // The node at the other end of a band of `node`.
  std::uint32_t across(std::uint32_t node, std::uint32_t band) const {
    return node_of[2 * band] == node ? node_of[2 * band + 1] : node_of[2 * band];
  }
};

// O(n log n) in rings, linear in triangles.
RingGraph make_ring_graph(const Surface& surface, const Bands& bands);

}  // namespace copse
