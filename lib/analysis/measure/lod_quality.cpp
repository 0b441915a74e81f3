#include "lib/analysis/measure/lod_quality.h"

#include "lib/analysis/measure/picture_error.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <tbb/parallel_for.h>

namespace copse {
namespace {

constexpr int k_hull_subdivisions = 3;  // 642 directions: a hull's support is known to 0.5 % between them

std::vector<std::uint8_t> mask_of(const DrawnMesh& mesh, const Looks& looks, const OrthographicView& view) {
  const Picture p = draw_picture(mesh, looks, view, 1);
  std::vector<std::uint8_t> mask(p.coverage.size());
  std::transform(p.coverage.begin(), p.coverage.end(), mask.begin(), [](float c) { return c > 0 ? 1 : 0; });
  return mask;
}

std::vector<double> supports(const DrawnMesh& mesh, const std::vector<Double3>& directions) {
  std::vector<std::uint8_t> used(mesh.positions.size());
  for (const Triangle& t : mesh.triangles)
    for (const std::uint32_t v : t) used[v] = 1;
  std::vector<double> out(directions.size(), -std::numeric_limits<double>::infinity());
  tbb::parallel_for(std::size_t{0}, directions.size(), [&](std::size_t d) {
    for (std::size_t v = 0; v < used.size(); ++v)
      if (used[v]) out[d] = std::max(out[d], dot(mesh.positions[v], directions[d]));
  });
  return out;
}

// The widest extent: with a direction the set holds its opposite.
double widest(const std::vector<Double3>& directions, const std::vector<double>& support) {
  double width = 0;
  for (std::size_t i = 0; i < directions.size(); ++i)
    for (std::size_t j = i + 1; j < directions.size(); ++j)
      if (dot(directions[i], directions[j]) < -1 + 1e-9) width = std::max(width, support[i] + support[j]);
  return width;
}

struct Overlap {
  std::uint64_t source = 0, level = 0, both = 0, either = 0;
};

Overlap overlap(const std::vector<std::uint8_t>& source, const std::vector<std::uint8_t>& level) {
  Overlap o;
  for (std::size_t i = 0; i < source.size(); ++i) {
    o.source += source[i], o.level += level[i];
    o.both += source[i] & level[i], o.either += source[i] | level[i];
  }
  return o;
}

double ratio(double a, double b) {
  return b > 0 ? a / b : a > 0 ? std::numeric_limits<double>::infinity() : 1;
}

// Views in which neither shows a pixel (a sheet, edge on) say nothing.
void summarise(const std::vector<Overlap>& views, LodQuality& out) {
  Overlap sum;
  double iou = 0, seen = 0;
  for (const Overlap& o : views) {
    if (o.either == 0) continue;
    const double one = ratio(double(o.both), double(o.either)),
                 cover = ratio(double(o.level), double(o.source));
    out.iou_low = seen == 0 ? one : std::min(out.iou_low, one);
    out.coverage_low = seen == 0 ? cover : std::min(out.coverage_low, cover);
    out.coverage_high = seen == 0 ? cover : std::max(out.coverage_high, cover);
    sum.source += o.source, sum.level += o.level, iou += one, seen += 1;
  }
  if (seen == 0) return;
  out.iou = iou / seen;
  out.coverage_ratio = ratio(double(sum.level), double(sum.source));
}

}  // namespace

LodJudge::LodJudge(const DrawnMesh& source, const Looks& looks, const LodQualityOptions& options)
    : looks_(looks), area_(area(source)), triangles_(source.triangles.size()) {
  const DoubleBox box = bounds(source);
  const Double3 centre = box.empty() ? Double3{} : box.centre();
  double radius = 0;
  for (const Triangle& t : source.triangles)
    for (const std::uint32_t v : t) radius = std::max(radius, distance(source.positions[v], centre));
  radius *= 1.1;  // a level that grows a little is still seen whole
  for (const Double3& d : view_sphere(subdivisions_for(options.views)).directions) {
    image_views_.push_back(view_of_sphere(centre, radius, d, options.image_size));
    mask_views_.push_back(view_of_sphere(centre, radius, d, options.mask_size));
  }
  images_.resize(image_views_.size()), masks_.resize(mask_views_.size());
  tbb::parallel_for(std::size_t{0}, images_.size(), [&](std::size_t v) {
    images_[v] = draw_picture(source, looks_, image_views_[v], 2);
    masks_[v] = mask_of(source, looks_, mask_views_[v]);
  });
  hull_directions_ = view_sphere(k_hull_subdivisions).directions;
  support_ = supports(source, hull_directions_);
  width_ = widest(hull_directions_, support_);
}

double LodJudge::rmse(const DrawnMesh& level) const {
  std::vector<double> squares(images_.size());
  tbb::parallel_for(std::size_t{0}, images_.size(), [&](std::size_t v) {
    const double e = picture_rmse(images_[v], draw_picture(level, looks_, image_views_[v], 2));
    squares[v] = e * e;
  });
  return std::sqrt(std::accumulate(squares.begin(), squares.end(), 0.0) /
                   static_cast<double>(squares.size()));
}

LodQuality LodJudge::measure(const DrawnMesh& level) const {
  LodQuality out;
  out.triangles = level.triangles.size(), out.source_triangles = triangles_;
  out.area_ratio = ratio(area(level), area_);
  std::vector<Overlap> overlaps(masks_.size());
  std::vector<PictureError> errors(images_.size());
  tbb::parallel_for(std::size_t{0}, images_.size(), [&](std::size_t v) {
    overlaps[v] = overlap(masks_[v], mask_of(level, looks_, mask_views_[v]));
    errors[v] = picture_error(images_[v], draw_picture(level, looks_, image_views_[v], 2));
  });
  summarise(overlaps, out);
  double square = 0, ssim = 0;
  for (const PictureError& e : errors) square += e.rmse * e.rmse, ssim += e.ssim;
  out.rmse = std::sqrt(square / static_cast<double>(errors.size()));
  out.ssim = ssim / static_cast<double>(errors.size());
  if (level.triangles.empty() || !(width_ > 0)) return out;
  const std::vector<double> support = supports(level, hull_directions_);
  for (std::size_t d = 0; d < support.size(); ++d)
    out.hull_growth = std::max(out.hull_growth, (support[d] - support_[d]) / width_);
  return out;
}

}  // namespace copse
