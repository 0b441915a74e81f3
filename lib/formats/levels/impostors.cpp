#include "lib/formats/levels/impostors.h"

#include "lib/formats/little_endian.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include <fmt/format.h>

namespace copse {
namespace {

constexpr std::uint32_t k_version = 1;
constexpr std::size_t k_header = 32;

std::vector<std::uint8_t> header_of(const ImpostorAtlas& a) {
  std::vector<std::uint8_t> out(k_header);
  const std::span<std::uint8_t> bytes(out);
  put(bytes, 0, static_cast<std::uint32_t>(a.layout)), put(bytes, 4, a.views), put(bytes, 8, a.size);
  put(bytes, 12, a.centre), put(bytes, 24, a.radius), put(bytes, 28, a.distance);
  return out;
}

std::uint32_t big_endian(std::span<const std::uint8_t> bytes, std::size_t at) {
  return std::uint32_t{bytes[at]} << 24 | std::uint32_t{bytes[at + 1]} << 16 |
         std::uint32_t{bytes[at + 2]} << 8 | bytes[at + 3];
}

// A PNG file begins with 8 fixed bytes, then the chunk IHDR: length 13, name, width, height, bits, kind.
std::string check_png(const Array<std::uint8_t>& png, std::uint32_t width, std::uint32_t height) {
  static constexpr std::array<std::uint8_t, 16> k_begin{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n',
                                                        0,    0,   0,   13,  'I',  'H',  'D',  'R'};
  const std::span<const std::uint8_t> bytes = png.span();
  if (bytes.size() < 33 || !std::equal(k_begin.begin(), k_begin.end(), bytes.begin()))
    return "is no PNG file";
  const std::uint32_t w = big_endian(bytes, 16), h = big_endian(bytes, 20);
  if (w != width || h != height)
    return fmt::format("has {} x {} pixels, its views give {} x {}", w, h, width, height);
  if (bytes[24] != 8 || bytes[25] != 6) return "has not 8 bits of red, green, blue and alpha";
  return {};
}

// The cell (i, j) of the octahedral map, also one step beyond its border, where the map goes on mirrored.
std::uint32_t octahedral_cell(std::int64_t i, std::int64_t j, std::int64_t n) {
  if (i < 0 || i >= n) i = std::clamp<std::int64_t>(i, 0, n - 1), j = n - 1 - j;
  if (j < 0 || j >= n) j = std::clamp<std::int64_t>(j, 0, n - 1), i = n - 1 - i;
  return static_cast<std::uint32_t>(j * n + i);
}

ImpostorBlend octahedral_blend(std::uint32_t views, const Double3& direction) {
  const std::array<double, 2> place = octahedral_place(direction);
  const double x = (place[0] + 1) / 2 * views - 0.5, y = (place[1] + 1) / 2 * views - 0.5;
  const auto i = static_cast<std::int64_t>(std::floor(x)), j = static_cast<std::int64_t>(std::floor(y));
  const double fx = x - static_cast<double>(i), fy = y - static_cast<double>(j);
  const auto cell = [&](int a, int b) { return octahedral_cell(i + a, j + b, views); };
  if (fx + fy < 1) return {{cell(0, 0), cell(1, 0), cell(0, 1)}, {1 - fx - fy, fx, fy}};
  return {{cell(1, 1), cell(1, 0), cell(0, 1)}, {fx + fy - 1, 1 - fy, 1 - fx}};
}

ImpostorBlend billboard_blend(std::uint32_t views, const Double3& direction) {
  double turn = std::atan2(direction.x, direction.z) / (2 * std::numbers::pi) * views;
  if (turn < 0) turn += views;
  const double whole = std::floor(turn), rest = turn - whole;
  const std::uint32_t first = static_cast<std::uint32_t>(whole) % views;
  return {{first, (first + 1) % views, first}, {1 - rest, rest, 0}};
}

Result<Array<std::uint8_t>> picture(const TreeFile& file, std::string_view name) {
  if (!file.has(name)) return Array<std::uint8_t>{};
  return file.section(name);
}

}  // namespace

Double3 octahedral_direction(double u, double v) {
  Double3 d{u, 1 - std::abs(u) - std::abs(v), v};
  if (d.y < 0) d.x = std::copysign(1 - std::abs(v), u), d.z = std::copysign(1 - std::abs(u), v);
  return normalized(d);
}

std::array<double, 2> octahedral_place(const Double3& d) {
  const double sum = std::abs(d.x) + std::abs(d.y) + std::abs(d.z);
  if (!(sum > 0)) return {0, 0};
  const double u = d.x / sum, v = d.z / sum;
  if (d.y >= 0) return {u, v};
  return {std::copysign(1 - std::abs(v), u), std::copysign(1 - std::abs(u), v)};
}

std::vector<Double3> impostor_views(ImpostorLayout layout, std::uint32_t views) {
  std::vector<Double3> out;
  if (layout == ImpostorLayout::billboard) {
    for (std::uint32_t i = 0; i < views; ++i) {
      const double a = 2 * std::numbers::pi * i / views;
      out.push_back({std::sin(a), 0, std::cos(a)});
    }
    return out;
  }
  for (std::uint32_t j = 0; j < views; ++j) {
    for (std::uint32_t i = 0; i < views; ++i)
      out.push_back(octahedral_direction((2.0 * i + 1) / views - 1, (2.0 * j + 1) / views - 1));
  }
  return out;
}

ImpostorFrame impostor_frame(const Double3& direction) {
  const Double3 toward = normalized(direction, {0, 0, 1});
  const Double3 up = std::abs(toward.y) < 0.999 ? Double3{0, 1, 0} : Double3{0, 0, 1};
  const Double3 right = normalized(cross(up, toward));
  return {right, cross(toward, right)};
}

ImpostorBlend impostor_blend(ImpostorLayout layout, std::uint32_t views, const Double3& direction) {
  if (views == 0 || !is_finite(direction)) return {};
  ImpostorBlend out = layout == ImpostorLayout::billboard ? billboard_blend(views, direction)
                                                          : octahedral_blend(views, direction);
  // Where pictures are mixed evenly, foliage is a haze: the nearest one gets more than its share.
  double sum = 0;
  for (double& w : out.weight) sum += w = w * w;
  for (double& w : out.weight) w /= sum;
  return out;
}

Result<void> put_impostor(ContainerWriter& writer, const ImpostorAtlas& atlas) {
  for (const char* name : {"IMPO", "IMPA", "IMPN"}) writer.remove(name);
  if (atlas.empty()) return {};
  if (const std::string wrong = check_impostor(atlas); !wrong.empty())
    return fail(Fault::bug, "", fmt::format("an impostor that is not sound: {}", wrong), "report this");
  if (auto done = writer.put("IMPO", k_version, 1, header_of(atlas)); !done) return done;
  if (auto done = writer.put("IMPA", k_version, 1, atlas.albedo); !done) return done;
  return writer.put("IMPN", k_version, 1, atlas.normal);
}

Result<ImpostorAtlas> read_impostor(const TreeFile& file) {
  if (!file.has("IMPO")) return ImpostorAtlas{};
  const char* remedy = "restore the file, or bake its impostor again";
  const SectionInfo* info = file.container().find("IMPO");
  if (info->version != k_version)
    return file.container().refuse_section(
        *info, 0, fmt::format("version {} is unknown to this program", info->version));
  const auto header = file.section("IMPO");
  if (!header) return std::unexpected(header.error());
  if (header->size() != k_header)
    return refuse(file.container().name(),
                  fmt::format("section IMPO has {} bytes, not {}", header->size(), k_header), remedy);
  const std::span<const std::uint8_t> bytes = header->span();
  auto albedo = picture(file, "IMPA"), normal = picture(file, "IMPN");
  if (!albedo) return std::unexpected(albedo.error());
  if (!normal) return std::unexpected(normal.error());
  ImpostorAtlas out{.layout = static_cast<ImpostorLayout>(get<std::uint32_t>(bytes, 0)),
                    .views = get<std::uint32_t>(bytes, 4),
                    .size = get<std::uint32_t>(bytes, 8),
                    .centre = get<Float3>(bytes, 12),
                    .radius = get<float>(bytes, 24),
                    .distance = get<float>(bytes, 28),
                    .albedo = std::move(*albedo),
                    .normal = std::move(*normal)};
  if (const std::string wrong = check_impostor(out); !wrong.empty())
    return refuse(file.container().name(), wrong, remedy);
  return out;
}

std::string check_impostor(const ImpostorAtlas& a) {
  if (a.layout != ImpostorLayout::billboard && a.layout != ImpostorLayout::octahedral)
    return "section IMPO: the layout has no known value";
  if (a.views == 0 || a.views > k_max_impostor_views || a.size == 0 ||
      a.size > k_max_impostor_side / a.columns())
    return fmt::format("section IMPO: {} views of {} pixels a side make no atlas", a.views, a.size);
  if (!is_finite(a.centre) || !(a.radius >= 0) || !std::isfinite(a.radius))
    return "section IMPO: the sphere is not finite";
  if (!(a.distance >= 0) || !std::isfinite(a.distance)) return "section IMPO: the distance is no number";
  for (const auto& [name, png] : {std::pair{"IMPA", &a.albedo}, std::pair{"IMPN", &a.normal}}) {
    if (const std::string wrong = check_png(*png, a.columns() * a.size, a.rows() * a.size); !wrong.empty())
      return fmt::format("section {} {}", name, wrong);
  }
  return {};
}

}  // namespace copse
