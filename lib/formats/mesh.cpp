#include "lib/formats/mesh.h"

namespace copse {

DoubleBox bounds(const Mesh& mesh) {
  DoubleBox box;
  for (const Double3& p : mesh.positions) box.grow(p);
  return box;
}

void orient(Mesh& mesh, UpAxis up, double scale) {
  if (up == UpAxis::z) {
    for (Double3& p : mesh.positions) p = {p.x, p.z, -p.y};
    for (Float3& n : mesh.normals) n = {n.x, n.z, -n.y};
  }
  if (scale != 1) {
    for (Double3& p : mesh.positions) p *= scale;
  }
}

}  // namespace copse
