// bands: closed strips of triangles round a limb, each between two rings; what fork_rings is made of.
#pragma once

#include "lib/formats/vec.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

// Band b has the triangles `triangles[first_triangle[b] .. first_triangle[b + 1])` and two rings, 2b and 2b
// + 1. All vertices of its triangles lie on the two rings, which share none. A ring is a simple cycle of
// three vertices or more; the second may be a single vertex, at a pointed end.
struct Bands {
  std::vector<std::uint32_t> first_triangle{0}, triangles;
  std::vector<std::uint32_t> first_vertex{0}, vertices;  // ring r: vertices[first_vertex[r] .. [r + 1])
  std::vector<std::uint32_t> band_of;                    // one a triangle of the surface: its band or k_none
  std::vector<std::uint32_t> lids;                       // triangles in no band that close the end of a limb

  std::size_t explained() const { return triangles.size() + lids.size(); }
  std::uint32_t count() const { return static_cast<std::uint32_t>(first_triangle.size() - 1); }
  std::span<const std::uint32_t> ring(std::uint32_t r) const {
    return std::span(vertices).subspan(first_vertex[r], first_vertex[r + 1] - first_vertex[r]);
  }
  std::span<const std::uint32_t> triangles_of(std::uint32_t b) const {
    return std::span(triangles).subspan(first_triangle[b], first_triangle[b + 1] - first_triangle[b]);
  }
  // Adds a band and claims its triangles; those beyond band_of (stand-ins for no real triangle) are not kept.
  void add(std::span<const std::uint32_t> from, std::span<const std::uint32_t> to,
           std::span<const std::uint32_t> of);
};

// The circle that stands for a ring: centre and mean distance of its vertices.
struct RingCircle {
  Double3 centre;
  double radius = 0;
};
RingCircle ring_circle(std::span<const Double3> positions, std::span<const std::uint32_t> ring);

}  // namespace copse
