// Little meshes that the tests of pictures look at.
#pragma once

#include "lib/analysis/measure/drawn_mesh.h"

namespace copse {

// A square of side 2 h round `c`, in the plane z = c.z, with texture coordinates 0..1.
inline DrawnMesh square(const Double3& c, double h, std::uint32_t material = k_none) {
  DrawnMesh m;
  m.positions = {
      {c.x - h, c.y - h, c.z}, {c.x + h, c.y - h, c.z}, {c.x + h, c.y + h, c.z}, {c.x - h, c.y + h, c.z}};
  m.texcoords = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
  m.triangles = {{0, 1, 2}, {0, 2, 3}};
  m.material = {material, material};
  return m;
}

}  // namespace copse
