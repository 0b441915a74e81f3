// picture: what a viewer sees of a mesh, with the alpha of its textures: colour and coverage a pixel.
#pragma once

#include "lib/analysis/measure/alpha_raster.h"

#include <array>
#include <span>
#include <vector>

namespace copse {

struct Picture {
  int width = 0, height = 0;
  std::vector<Float3> colour;   // linear, over a white ground; row 0 is the top
  std::vector<float> coverage;  // share of the pixel that something covers, 0 to 1
};

// Each pixel is the mean of samples x samples points, each of which sees the nearest triangle that its alpha
// test lets through; both sides are drawn; of two at the same depth the lower index wins. A triangle is
// shaded as a whole: two-sided Lambert from a light high in front of +Z, with half of the light from all
// around. Deterministic. Cost: samples covered, plus the picture.
Picture draw_picture(const DrawnMesh& mesh, const Looks& looks, const OrthographicView& view,
                     int samples = 2);

// What a triangle looks like there, linear. `normals`: the sum of its corners', 0 for flat shading.
Float3 shaded(const std::array<Double3, 3>& corners, const Double3& normals, const Material* material);

// The share of the picture that is covered, as draw_picture finds it, without the rest.
double covered_pixels(const Picture& picture);

}  // namespace copse
