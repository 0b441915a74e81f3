#include "tools/lodbake/impostor_stage.h"

#include "lib/analysis/measure/picture_error.h"
#include "lib/analysis/measure/view_sphere.h"
#include "lib/formats/import/image.h"
#include "tools/lodbake/level_pictures.h"
#include "tools/lodbake/levels.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace copse::lodbake {
namespace {

Result<Array<std::uint8_t>> png_of(const Impostor& impostor, const std::vector<std::uint8_t>& rgba) {
  auto bytes =
      encode_png({.width = impostor.width, .height = impostor.height, .rgba = rgba, .has_alpha = true});
  if (!bytes) return std::unexpected(bytes.error());
  return Array<std::uint8_t>(std::move(*bytes));
}

// The depth goes where the normals' alpha would be: that of the colours says it already.
std::vector<std::uint8_t> normals_and_depth(const Impostor& impostor) {
  std::vector<std::uint8_t> out = impostor.normal;
  for (std::size_t p = 0; p < impostor.depth.size(); ++p) out[4 * p + 3] = impostor.depth[p];
  return out;
}

ImpostorFidelity measure(const Impostor& impostor, const DrawnMesh& source, const Looks& looks, int views) {
  ImpostorFidelity out;
  double shown = 0, there = 0;
  const ViewSphere sphere = view_sphere(subdivisions_for(views));
  for (const Double3& toward : sphere.directions) {
    const OrthographicView view = view_of_sphere(impostor.centre, impostor.radius, toward, impostor.size);
    const Picture drawn = draw_impostor(impostor, view), real = draw_picture(source, looks, view, 3);
    double both = 0, either = 0;
    for (std::size_t p = 0; p < drawn.coverage.size(); ++p) {
      shown += drawn.coverage[p], there += real.coverage[p];
      // Shares, not whole pixels: a twig is thinner than a pixel of a small picture.
      both += std::min(drawn.coverage[p], real.coverage[p]);
      either += std::max(drawn.coverage[p], real.coverage[p]);
    }
    const PictureError error = picture_error(drawn, real);
    out.iou += either > 0 ? both / either : 1;
    out.rmse += error.rmse * error.rmse, out.ssim += error.ssim;
  }
  const auto n = static_cast<double>(sphere.directions.size());
  out.iou /= n, out.ssim /= n, out.rmse = std::sqrt(out.rmse / n);
  out.coverage = there > 0 ? shown / there : 1;
  return out;
}

void tell(const Impostor& impostor, const ImpostorAtlas& atlas, const ImpostorFidelity& f, Report& report) {
  report.tables.push_back(
      {.name = "impostor",
       .columns = {"Views", "Pixels", "Bytes", "From (m)", "Coverage", "Silhouette IoU", "RMSE", "SSIM"},
       .rows = {{fmt::format("{}", impostor.views.size()), fmt::format("{}", impostor.size),
                 fmt::format("{}", atlas.albedo.size() + atlas.normal.size()),
                 fmt::format("{:.4g}", atlas.distance), fmt::format("{:.3f}", f.coverage),
                 fmt::format("{:.3f}", f.iou), fmt::format("{:.4f}", f.rmse),
                 fmt::format("{:.3f}", f.ssim)}}});
}

double distance_of(const LodSpectra& spectra, const Impostor& impostor) {
  const double seen = distance_for_pixels(2 * impostor.radius, impostor.size);
  const double last = spectra.discrete.empty() ? 0.0 : double{spectra.discrete.back().distance};
  // Beyond both bands of the hysteresis, so that the last level is drawn somewhere (digest 003, H-10).
  const double h = spectra.hysteresis;
  return std::max(seen, last * (1 + h) / (1 - h) * 1.01);
}

}  // namespace

Result<BakedImpostor> bake_impostor(const LodSpectra& spectra, const TreeLooks& looks, const Options& options,
                                    Context& context) {
  Stage stage = context.stage("impostor");
  const DrawnMesh source = drawn_level(spectra, {});
  Impostor impostor = make_impostor(
      source, looks.looks().materials, looks.images(),
      {.layout = options.impostor_layout, .views = options.impostor_views, .size = options.impostor});
  stage.items(impostor.views.size(), "views");
  auto albedo = png_of(impostor, impostor.albedo), normal = png_of(impostor, normals_and_depth(impostor));
  if (!albedo) return std::unexpected(albedo.error());
  if (!normal) return std::unexpected(normal.error());
  ImpostorAtlas atlas{.layout = options.impostor_layout,
                      .views = static_cast<std::uint32_t>(options.impostor_views),
                      .size = static_cast<std::uint32_t>(options.impostor),
                      .centre = to_float(impostor.centre),
                      .radius = static_cast<float>(impostor.radius),
                      .distance = static_cast<float>(distance_of(spectra, impostor)),
                      .albedo = std::move(*albedo),
                      .normal = std::move(*normal)};
  const ImpostorFidelity fidelity = measure(impostor, source, looks.looks(), options.views);
  tell(impostor, atlas, fidelity, context.report());
  return BakedImpostor{std::move(atlas), std::move(impostor), fidelity};
}

}  // namespace copse::lodbake
