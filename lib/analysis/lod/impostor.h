// impostor: a tree as pictures of it: the last level, from where it is a few pixels tall.
//
// The atlas of lib/formats/levels/impostors.h, painted: beside colour and alpha the normal and the depth, for
// light and parallax. (Digest 003, section 9.)
#pragma once

#include "lib/analysis/measure/drawn_mesh.h"
#include "lib/analysis/measure/picture.h"
#include "lib/formats/levels/impostors.h"

#include <cstdint>
#include <vector>

namespace copse {

struct ImpostorOptions {
  ImpostorLayout layout = ImpostorLayout::octahedral;
  int views =
      8;  // along a side of the atlas: views x views of them; of a billboard, their number, in one row
  int size = 64;    // pixels of a view's side
  int samples = 3;  // a pixel's side, averaged
};

// Rows from the top, four bytes a pixel. Alpha is the share of the pixel that the tree covers, in both
// pictures.
struct Impostor {
  ImpostorLayout layout = ImpostorLayout::octahedral;
  int width = 0, height = 0, size = 0;
  std::vector<std::uint8_t>
      albedo;  // sRGB and alpha; where nothing is, all but alpha is the nearest covered pixel's of its view
  std::vector<std::uint8_t> normal;  // 127.5 (n + 1) in the view's frame: right, up, toward the viewer; alpha
  std::vector<std::uint8_t> depth;   // one byte a pixel: toward the viewer, 0 at -radius, 255 at radius
  std::vector<Double3> views;        // toward the viewer, in the order of the atlas, row by row
  Double3 centre{};                  // of the sphere that every view frames
  double radius = 0;
};

// Textures come from `images` (drawn as the nearest texel); a material without one has its diffuse and mean
// colour. Views are drawn in parallel; the result does not depend on the number of threads. Cost: views x
// (triangles + samples).
Impostor make_impostor(const DrawnMesh& mesh, std::span<const Material> materials, const ImageSource& images,
                       const ImpostorOptions& options);

// What a player shows of it: the nearest views blended, each read where its depth says that the ray meets the
// tree; shaded as draw_picture shades. For measuring. Cost: pixels.
Picture draw_impostor(const Impostor& impostor, const OrthographicView& view);

}  // namespace copse
