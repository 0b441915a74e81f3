// lod_quality: what a level of detail gives away, seen from all around.
#pragma once

#include "lib/analysis/measure/picture.h"
#include "lib/analysis/measure/view_sphere.h"

#include <cstdint>
#include <vector>

namespace copse {

struct LodQualityOptions {
  int views = 42;        // at least this many, evenly over the sphere (view_sphere.h)
  int image_size = 128;  // pixels across the sphere round the source's box, for rmse and ssim
  int mask_size = 256;   // the same for coverage and silhouettes
};

struct LodQuality {
  std::uint64_t triangles = 0, source_triangles = 0;
  double area_ratio = 1;                       // of all triangles; 1 when the source has none
  double coverage_ratio = 1;                   // covered pixels of all views, level over source
  double coverage_low = 1, coverage_high = 1;  // the lowest and the highest ratio of a single view
  double iou = 1;      // intersection over union of the silhouettes, mean over the views that show anything
  double iou_low = 1;  // the worst view's
  double rmse = 0;     // root of the mean square over the views
  double ssim = 1;     // mean over the views
  double hull_growth = 0;  // how far the level reaches out of the source's convex hull: the largest excess
                           // of its support over the source's in 642 directions, as a share of the source's
                           // largest width
};

// The source, drawn once: every level of a spectrum is measured against it.
class LodJudge {
 public:
  // Keeps references to `looks` and what it refers to. Views are drawn in parallel; the result does not
  // depend on the number of threads. Cost: views x (triangles + pixels).
  LodJudge(const DrawnMesh& source, const Looks& looks, const LodQualityOptions& options = {});
  LodQuality measure(const DrawnMesh& level) const;
  // The image error alone.
  double rmse(const DrawnMesh& level) const;

 private:
  std::vector<OrthographicView> image_views_, mask_views_;
  std::vector<Picture> images_;
  std::vector<std::vector<std::uint8_t>> masks_;
  Looks looks_;
  std::vector<Double3> hull_directions_;
  std::vector<double> support_;
  double width_ = 0, area_ = 0;
  std::uint64_t triangles_ = 0;
};

}  // namespace copse
