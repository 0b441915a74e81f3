#include "tools/lodbake/level_pictures.h"

#include "lib/analysis/measure/picture_error.h"
#include "lib/analysis/measure/raster.h"
#include "lib/analysis/measure/view_sphere.h"
#include "lib/formats/import/image.h"
#include "tools/picture/base64.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <tbb/parallel_for.h>

namespace copse::lodbake {
namespace {

// One of each pair of opposite corners of the icosahedron.
std::vector<Double3> six_sides() {
  std::vector<Double3> sides;
  for (const Double3& d : view_sphere(0).directions) {
    const bool opposite =
        std::any_of(sides.begin(), sides.end(), [&](const Double3& s) { return dot(s, d) < -0.999; });
    if (!opposite) sides.push_back(d);
  }
  return sides;
}

std::uint8_t to_srgb(float linear) {
  const double c = std::clamp(static_cast<double>(linear), 0.0, 1.0);
  return static_cast<std::uint8_t>(
      std::lround(255 * (c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055)));
}

Result<std::string> png_of(const Picture& picture) {
  Image image{.width = picture.width, .height = picture.height, .rgba = {}, .has_alpha = false};
  for (const Float3& c : picture.colour) {
    image.rgba.insert(image.rgba.end(), {to_srgb(c.x), to_srgb(c.y), to_srgb(c.z), 255});
  }
  const auto bytes = encode_png(image);
  if (!bytes) return std::unexpected(bytes.error());
  return base64(*bytes);
}

}  // namespace

DrawnMesh drawn_level(const LodSpectra& spectra, const LodLevel& level) {
  DrawnMesh mesh = drawn_state(spectra.trunk, level.trunk_steps);
  append(mesh, drawn_state(spectra.leaves, level.leaf_steps));
  return mesh;
}

LevelPictures::LevelPictures(const LodSpectra& spectra, const Looks& looks)
    : spectra_(spectra), looks_(looks) {
  const DrawnMesh source = drawn_level(spectra, {});
  full_ = static_cast<double>(source.triangles.size());
  const DoubleBox box = bounds(source);
  if (box.empty()) return;
  centre_ = box.centre();
  radius_ = std::max(0.5 * length(box.extent()), 1e-300);
  for (std::size_t i = 0; i < k_sizes.size(); ++i) {
    for (const OrthographicView& view : views(i)) source_[i].push_back(draw_picture(source, looks_, view, 2));
  }
}

std::vector<OrthographicView> LevelPictures::views(std::size_t size) const {
  std::vector<OrthographicView> out;
  for (const Double3& side : six_sides())
    out.push_back(view_of_sphere(centre_, radius_, side, k_sizes[size]));
  return out;
}

double LevelPictures::error(const TriedLevel& level) const {
  const double share = static_cast<double>(level.triangles) / std::max(full_, 1.0);
  const std::size_t size = share >= 0.25 ? 0 : share >= 0.05 ? 1 : 2;
  DrawnMesh mesh = drawn_state(spectra_.trunk, level.trunk_steps);
  append(mesh, drawn_elements(spectra_.leaves, level.leaves));
  const std::vector<OrthographicView> sides = views(size);
  std::vector<double> squares(source_[size].size());
  tbb::parallel_for(std::size_t{0}, squares.size(), [&](std::size_t i) {
    const double e = picture_rmse(draw_picture(mesh, looks_, sides[i], 2), source_[size][i]);
    squares[i] = e * e;
  });
  const double sum = std::accumulate(squares.begin(), squares.end(), 0.0);
  return sides.empty() ? 0 : std::sqrt(sum / static_cast<double>(sides.size()));
}

Result<ReportPicture> level_strip(const LodSpectra& spectra, const Looks& looks,
                                  const std::vector<LodLevel>& levels,
                                  const std::vector<std::string>& labels) {
  constexpr int k_size = 240, k_gap = 8, k_text = 40, k_row = 4;
  const DoubleBox box = bounds(drawn_level(spectra, {}));
  const auto count = static_cast<int>(levels.size());
  const int columns = std::min(count, k_row), rows = (count + k_row - 1) / k_row;
  std::string svg =
      fmt::format("<svg viewBox=\"0 0 {} {}\" xmlns=\"http://www.w3.org/2000/svg\" role=\"img\">",
                  columns * (k_size + k_gap), rows * (k_size + k_text));
  for (int i = 0; i < count; ++i) {
    const OrthographicView view = frame_box(box, 0.4, k_size, k_size);
    const auto png =
        png_of(draw_picture(drawn_level(spectra, levels[static_cast<std::size_t>(i)]), looks, view, 2));
    if (!png) return std::unexpected(png.error());
    const int x = i % k_row * (k_size + k_gap), y = i / k_row * (k_size + k_text);
    svg +=
        fmt::format("<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" href=\"data:image/png;base64,{}\"/>",
                    x, y, k_size, k_size, *png);
    svg += fmt::format(
        "<text x=\"{}\" y=\"{}\" font-size=\"13\" text-anchor=\"middle\" fill=\"currentColor\">{}</text>",
        x + k_size / 2, y + k_size + 18, labels[static_cast<std::size_t>(i)]);
  }
  return ReportPicture{"Levels", "Full detail first; every level drawn from the same side.", svg + "</svg>"};
}

}  // namespace copse::lodbake
