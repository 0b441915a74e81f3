// volume_mesh: the surface of a volume as triangles, to be drawn or exported.
#pragma once

#include "lib/formats/mesh.h"
#include "lib/formats/volumes/volume.h"

#include <vector>

namespace copse {

struct VolumeMesh {
  std::vector<Double3> positions;
  std::vector<Triangle> triangles;  // counter-clockwise from outside
};

// `steps` segments a quarter circle (at least 1) where the surface is round; flat parts are not divided. A
// volume without thickness gives a surface without thickness; a point gives nothing. Curved surfaces are
// inscribed: a picture, not a bound.
VolumeMesh volume_mesh(const Volume<double>& volume, int steps = 8);

}  // namespace copse
