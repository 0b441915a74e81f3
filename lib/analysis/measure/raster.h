// A small orthographic rasteriser: which triangle is seen at each pixel, how deep, and how it faces the
// viewer.
#pragma once

#include "lib/formats/mesh.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

// Looks along -`toward`; `right` and `up` are unit vectors at right angles. `centre` falls on the middle of
// the picture; a pixel is `pixel` wide (same unit as the positions, > 0). Row 0 is the top.
struct OrthographicView {
  Double3 right{1, 0, 0}, up{0, 1, 0}, toward{0, 0, 1};
  Double3 centre{};
  double pixel = 1;
  int width = 0, height = 0;

  // Pixel coordinates (x to the right, y down; pixel (i, j) covers [i, i+1) x [j, j+1)) and depth toward the
  // viewer.
  Double3 project(const Double3& p) const {
    const Double3 d = p - centre;
    return {dot(d, right) / pixel + width / 2.0, height / 2.0 - dot(d, up) / pixel, dot(d, toward)};
  }
};

// A view from +Z (`azimuth` 0) or turned about +Y by `azimuth` radians that frames `box` with a margin of 4
// %.
OrthographicView frame_box(const DoubleBox& box, double azimuth, int width, int height);

struct Raster {
  int width = 0, height = 0;
  std::vector<std::uint32_t>
      triangle;              // seen at each pixel's centre, k_none where nothing is; row 0 is the top
  std::vector<float> depth;  // of that triangle there, toward the viewer; -inf where nothing is
};

// Both sides of a triangle are drawn; of two at the same depth the lower index wins. Cost: pixels covered.
Raster rasterize(std::span<const Double3> positions, std::span<const Triangle> triangles,
                 const OrthographicView& view);

}  // namespace copse
