// view_sphere: directions spread evenly over a sphere, with the triangles between them.
//
// An icosahedron whose triangles are cut in four `subdivisions` times: 12, 42, 162, 642 directions. The set
// is symmetric: with a direction it holds the opposite one. (Digest 001, section 5.3: "a convex-hull
// triangulated direction set"; between three of them a value is interpolated.)
#pragma once

#include "lib/analysis/measure/raster.h"
#include "lib/formats/mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace copse {

struct ViewSphere {
  std::vector<Double3> directions;  // unit, from the object toward the viewer
  std::vector<Triangle> triangles;  // counter-clockwise seen from outside; they cover the sphere once
};

// subdivisions 0..6; the twelve first directions are the icosahedron's, whatever the subdivision.
ViewSphere view_sphere(int subdivisions);

// The fewest subdivisions with at least `views` directions (at most 6: 40962).
int subdivisions_for(int views);

// A view along -`toward` of a sphere that just fits a square picture of `size` pixels. The picture's up is +Y
// as far as it can be; looking along Y, it is +Z.
OrthographicView view_of_sphere(const Double3& centre, double radius, const Double3& toward, int size);

}  // namespace copse
