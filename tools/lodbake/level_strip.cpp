#include "tools/lodbake/level_strip.h"

#include "lib/analysis/measure/drawn_mesh.h"
#include "lib/analysis/measure/raster.h"
#include "lib/formats/import/image.h"
#include "tools/lodbake/level_pictures.h"
#include "tools/picture/base64.h"

#include <algorithm>
#include <cmath>
#include <string>

#include <fmt/format.h>

namespace copse::lodbake {
namespace {

constexpr int k_size = 240, k_gap = 8, k_line = 17, k_row = 4;

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

using Lines = std::vector<std::string>;

Lines lines_of(const StripContents& contents, std::size_t i) {
  const LodLevel& level = contents.levels[i];
  const double full = std::max(1u, contents.levels[0].triangles);
  Lines out;
  if (i == 0) {
    out.push_back("Full detail");
    out.push_back(fmt::format("{} triangles", level.triangles));
    return out;
  }
  out.push_back(fmt::format("Level {}, from {:.3g} m", i, level.distance));
  out.push_back(fmt::format("{} triangles ({:.3g} %)", level.triangles, 100 * level.triangles / full));
  if (i < contents.figures.size()) {
    const LevelFigures& f = contents.figures[i];
    if (f.leaf_area)
      out.push_back(fmt::format("coverage {:.3f}, leaf area {:.3f}", f.quality.coverage_ratio, *f.leaf_area));
    else
      out.push_back(
          fmt::format("coverage {:.3f}, area {:.3f}", f.quality.coverage_ratio, f.quality.area_ratio));
    out.push_back(fmt::format("silhouette {:.3f}, worst {:.3f}", f.quality.iou, f.quality.iou_low));
    out.push_back(fmt::format("RMSE {:.4f} at {} pixels", f.quality.rmse, f.pixels));
  }
  if (i < contents.surfaces.size())
    out.push_back(
        fmt::format("surface off by {:.2g} m, mean",
                    std::max(contents.surfaces[i].from_level.mean, contents.surfaces[i].from_source.mean)));
  return out;
}

Lines lines_of(const BakedImpostor& impostor) {
  return {fmt::format("Impostor, from {:.3g} m", impostor.atlas.distance),
          fmt::format("{} views of {} pixels", impostor.painted.views.size(), impostor.painted.size),
          fmt::format("coverage {:.3f}", impostor.fidelity.coverage),
          fmt::format("silhouette {:.3f}", impostor.fidelity.iou),
          fmt::format("RMSE {:.4f} at {} pixels", impostor.fidelity.rmse, impostor.painted.size)};
}

// The colours are those of the page by day: pictures keep their ground by night.
void add(std::string& svg, int x, int y, const std::string& png, const Lines& lines) {
  svg +=
      fmt::format("<image x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" href=\"data:image/png;base64,{}\"/>",
                  x, y, k_size, k_size, png);
  for (std::size_t i = 0; i < lines.size(); ++i)
    svg +=
        fmt::format("<text x=\"{}\" y=\"{}\" font-size=\"13\" text-anchor=\"middle\" fill=\"{}\"{}>{}</text>",
                    x + k_size / 2, y + k_size + k_line * static_cast<int>(i + 1),
                    i == 0 ? "#1c211d" : "#4c554e", i == 0 ? " font-weight=\"600\"" : "", lines[i]);
}

}  // namespace

Result<ReportPicture> level_strip(const LodSpectra& spectra, const Looks& looks,
                                  const StripContents& contents) {
  const DoubleBox box = bounds(drawn_level(spectra, {}));
  const OrthographicView view = frame_box(box, 0.4, k_size, k_size);
  std::vector<Picture> pictures;
  std::vector<Lines> lines;
  for (std::size_t i = 0; i < contents.levels.size(); ++i) {
    pictures.push_back(draw_picture(drawn_level(spectra, contents.levels[i]), looks, view, 2));
    lines.push_back(lines_of(contents, i));
  }
  if (contents.impostor != nullptr) {
    pictures.push_back(draw_impostor(contents.impostor->painted, view));
    lines.push_back(lines_of(*contents.impostor));
  }
  std::size_t most = 0;
  for (const Lines& l : lines) most = std::max(most, l.size());
  const int count = static_cast<int>(pictures.size()), height = k_size + k_line * static_cast<int>(most) + 14;
  const int columns = std::min(count, k_row), rows = (count + k_row - 1) / k_row;
  std::string svg =
      fmt::format("<svg viewBox=\"0 0 {} {}\" xmlns=\"http://www.w3.org/2000/svg\" role=\"img\">",
                  columns * (k_size + k_gap), rows * height);
  for (int i = 0; i < count; ++i) {
    const auto png = png_of(pictures[static_cast<std::size_t>(i)]);
    if (!png) return std::unexpected(png.error());
    add(svg, i % k_row * (k_size + k_gap), i / k_row * height, *png, lines[static_cast<std::size_t>(i)]);
  }
  return ReportPicture{
      "Levels", "Full detail first; all from the same side. What the figures mean says the table Columns.",
      svg + "</svg>"};
}

}  // namespace copse::lodbake
