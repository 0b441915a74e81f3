// Pictures for pages: a mesh seen along a direction, softly lit, with lines drawn over it.
#pragma once

#include "lib/analysis/measure/drawn_mesh.h"
#include "lib/analysis/measure/raster.h"
#include "lib/formats/mesh.h"
#include "lib/formats/report.h"
#include "lib/formats/result.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace copse {

inline constexpr int k_picture_width = 560, k_picture_height = 640;

struct MeshPicture {
  std::string title, caption;
  double opacity = 1;  // of the mesh
  // Whether a triangle is a leaf, which is green; the others are brown.
  std::function<bool(std::uint32_t triangle)> is_leaf;
  // SVG drawn over the mesh, in the view's pixels.
  std::function<std::string(const OrthographicView&)> overlay;
  // What the alpha of each material's texture lets through; empty: everything.
  std::vector<AlphaMask> masks = {};
};

// `view` is of k_picture_width by k_picture_height.
Result<ReportPicture> draw_picture(const Mesh& mesh, const OrthographicView& view, const MeshPicture& what);

}  // namespace copse
