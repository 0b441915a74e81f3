#include "tools/ecogen/map_legend.h"

#include "lib/analysis/ecosystem/ground.h"
#include "lib/formats/export/html_text.h"
#include "tools/picture/base64.h"
#include "tools/picture/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

#include <fmt/format.h>

namespace copse::ecogen {
namespace {

using Colour = std::array<std::uint8_t, 3>;

constexpr Colour k_ink{40, 40, 40};
constexpr std::size_t k_most_lines = 24;
constexpr int k_line = 34, k_margin = 24;

struct Line {
  std::size_t type = 0;
  std::string text;
};

struct Legend {
  std::vector<Line> lines;
  std::string rest;  // of types that have no line
  std::string total;
  double metres = 0;  // of the scale bar; 0: the terrain has no size
  int bar = 0;        // its pixels on the map
};

std::string metres_text(double m) {
  return m >= 1000 ? fmt::format("{:g} km", m / 1000) : fmt::format("{:g} m", m);
}

// 1, 2 or 5 times a power of ten, at most `most`.
double round_length(double most) {
  const double ten = std::pow(10, std::floor(std::log10(most)));
  for (const double step : {5.0, 2.0})
    if (step * ten <= most) return step * ten;
  return ten;
}

Legend legend_of(const Ecosystem& eco, int map_width) {
  Legend l;
  // One line is as good as saying how many lines there are not.
  const std::size_t shown = eco.types.size() <= k_most_lines ? eco.types.size() : k_most_lines - 1;
  for (std::size_t t = 0; t < shown; ++t) {
    std::string name = eco.types[t].name;
    if (name.size() > 24) name = name.substr(0, 22) + "..";
    l.lines.push_back({t, fmt::format("{}  {}", name, eco.types[t].instances)});
  }
  if (shown < eco.types.size()) l.rest = fmt::format("and {} types more", eco.types.size() - shown);
  l.total = fmt::format("{} in all", eco.instance_count());
  const TerrainGround ground(eco.terrain);
  const double width = ground.x1() - ground.x0();
  if (!(width > 0)) return l;
  l.metres = round_length(std::min(width, 220 * width / map_width));
  l.bar = static_cast<int>(std::lround(l.metres / width * map_width));
  return l;
}

Colour byte_colour(std::size_t type) {
  const Double3 c = type_colour(type);
  Colour out;
  for (int a = 0; a < 3; ++a)
    out[static_cast<std::size_t>(a)] =
        static_cast<std::uint8_t>(std::lround(255 * std::clamp(c[a], 0.0, 1.0)));
  return out;
}

void fill(Image& image, int x0, int y0, int x1, int y1, const Colour& colour) {
  for (int y = std::max(y0, 0); y < std::min(y1, image.height); ++y)
    for (int x = std::max(x0, 0); x < std::min(x1, image.width); ++x)
      std::copy(colour.begin(), colour.end(),
                image.rgba.begin() + 4 * (static_cast<std::ptrdiff_t>(y) * image.width + x));
}

int panel_width(const Legend& l) {
  int widest = std::max({text_width(l.total), text_width(l.rest), l.bar});
  for (const Line& line : l.lines) widest = std::max(widest, k_line + text_width(line.text));
  return widest + 2 * k_margin;
}

int panel_height(const Legend& l) {
  const auto lines = static_cast<int>(l.lines.size()) + (l.rest.empty() ? 1 : 2);
  return 2 * k_margin + lines * k_line + (l.bar > 0 ? 3 * k_line : 0);
}

void draw_panel(Image& image, const Legend& l, int x) {
  int y = k_margin;
  for (const Line& line : l.lines) {
    fill(image, x, y + 3, x + 20, y + 23, byte_colour(line.type));
    draw_text(image, x + k_line, y, line.text, k_ink);
    y += k_line;
  }
  for (const std::string& text : {l.rest, l.total}) {
    if (text.empty()) continue;
    draw_text(image, x, y, text, k_ink);
    y += k_line;
  }
  if (l.bar == 0) return;
  y += k_line;
  fill(image, x, y, x + l.bar, y + 6, k_ink);
  for (const int end : {x, x + l.bar - 3}) fill(image, end, y - 6, end + 3, y + 12, k_ink);
  draw_text(image, x, y + 18, metres_text(l.metres), k_ink);
}

}  // namespace

Image map_with_legend(ForestMap& drawn) {
  const Image& map = drawn.image();
  const Legend legend = legend_of(drawn.ecosystem(), map.width);
  Image out;
  out.width = map.width + panel_width(legend);
  out.height = std::max(map.height, panel_height(legend));
  out.rgba.assign(std::size_t{4} * static_cast<std::size_t>(out.width) * static_cast<std::size_t>(out.height),
                  255);
  for (int y = 0; y < map.height; ++y)
    std::copy_n(map.rgba.begin() + std::ptrdiff_t{4} * y * map.width, std::ptrdiff_t{4} * map.width,
                out.rgba.begin() + std::ptrdiff_t{4} * y * out.width);
  draw_panel(out, legend, map.width + k_margin);
  return out;
}

Result<ReportPicture> map_for_page(ForestMap& drawn) {
  const Image& map = drawn.image();
  const auto png = encode_png(map);
  if (!png) return std::unexpected(png.error());
  const Legend legend = legend_of(drawn.ecosystem(), map.width);
  const int x = map.width + k_margin, width = map.width + 420,
            height = std::max(map.height, panel_height(legend));
  std::string svg = fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {0} {1}" width="{0}" role="img" style="max-width:100%;height:auto" font-family="sans-serif" font-size="24" fill="currentColor">)"
      R"(<title>the forest from above</title><image width="{2}" height="{3}" href="data:image/png;base64,{4}"/>)",
      width, height, map.width, map.height, base64(*png));
  int y = k_margin;
  for (const Line& line : legend.lines) {
    const Colour c = byte_colour(line.type);
    svg += fmt::format(
        R"(<circle cx="{}" cy="{}" r="10" fill="#{:02x}{:02x}{:02x}"/><text x="{}" y="{}">{}</text>)", x + 10,
        y + 13, c[0], c[1], c[2], x + k_line, y + 21, escape_html(line.text));
    y += k_line;
  }
  for (const std::string& text : {legend.rest, legend.total}) {
    if (text.empty()) continue;
    svg += fmt::format(R"(<text x="{}" y="{}">{}</text>)", x, y + 21, escape_html(text));
    y += k_line;
  }
  if (legend.bar > 0) {
    y += k_line;
    svg += fmt::format(
        R"(<path d="M{0} {1}v16m0-8h{2}m0-8v16" fill="none" stroke="currentColor" stroke-width="3"/><text x="{0}" y="{3}">{4}</text>)",
        x, y - 5, legend.bar, y + 42, metres_text(legend.metres));
  }
  return ReportPicture{"The forest from above",
                       "x runs to the right, z down; a disc is a crown, the tallest on top", svg + "</svg>"};
}

}  // namespace copse::ecogen
