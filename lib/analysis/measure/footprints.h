// footprints: the different triangles that a set of triangles cuts out of a texture, with their shares.
#pragma once

#include "lib/formats/mesh.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace copse {

// Texture coordinates of a triangle, moved by whole repeats so that the smallest u and v lie in [0, 1).
struct Footprint {
  std::array<Float2, 3> corners;
  double area = 0;  // of all triangles (in space) that have it
  friend bool operator==(const Footprint& a, const Footprint& b) { return a.corners == b.corners; }
};

struct Footprints {
  std::vector<Footprint> list;  // by first use
  double whole_area = 0;        // of triangles without usable coordinates, or too large
  std::uint64_t whole = 0;      // their number
};

// Cards that are cut from one texture in one way share a footprint: a million leaves have a few. A triangle
// is too large when it spans more than `tiles` repeats along u or v. O(n), hashed.
Footprints footprints(const Mesh& mesh, std::span<const std::uint32_t> triangles, double tiles);

}  // namespace copse
