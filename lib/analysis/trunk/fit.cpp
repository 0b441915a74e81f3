#include "lib/analysis/trunk/fit.h"

#include "lib/analysis/measure/cylinder_error.h"

namespace copse {

Fit fit_of(const Surface& surface, const Hierarchy& hierarchy) {
  TrunkMesh mesh;
  mesh.positions = surface.positions;
  mesh.triangles = surface.triangles;
  DoubleBox box;
  for (const Double3& p : surface.positions) box.grow(p);
  const CylinderError error = cylinder_error(mesh, hierarchy, length(box.extent()));
  return {error.of_height.mean, error.explained_area};
}

}  // namespace copse
