#include "lib/analysis/ecosystem/value_map.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace copse {
namespace {

// Where `at` lies among `count` pixels, in pixels from the border.
double pixels(double at, double low, double high, std::uint32_t count) {
  return high > low ? std::clamp((at - low) / (high - low), 0.0, 1.0) * count : 0;
}

}  // namespace

double pixel_at(const ValueMap& map, const PlantedArea& area, double x, double z) {
  if (map.values.empty()) return 0;
  const auto c = std::min(static_cast<std::uint32_t>(pixels(x, area.x0, area.x1, map.width)), map.width - 1);
  const auto r =
      std::min(static_cast<std::uint32_t>(pixels(z, area.z0, area.z1, map.height)), map.height - 1);
  return static_cast<double>(map.values[std::size_t{r} * map.width + c]);
}

double smooth_at(const ValueMap& map, const PlantedArea& area, double x, double z) {
  if (map.values.empty()) return 0;
  const double u = std::clamp(pixels(x, area.x0, area.x1, map.width) - 0.5, 0.0, map.width - 1.0);
  const double v = std::clamp(pixels(z, area.z0, area.z1, map.height) - 0.5, 0.0, map.height - 1.0);
  const auto c = static_cast<std::uint32_t>(u), r = static_cast<std::uint32_t>(v);
  const std::uint32_t c1 = std::min(c + 1, map.width - 1), r1 = std::min(r + 1, map.height - 1);
  const auto value = [&](std::uint32_t col, std::uint32_t row) {
    return static_cast<double>(map.values[std::size_t{row} * map.width + col]);
  };
  const double fu = u - c, fv = v - r;
  const double near = value(c, r) + fu * (value(c1, r) - value(c, r));
  const double far = value(c, r1) + fu * (value(c1, r1) - value(c, r1));
  return near + fv * (far - near);
}

double least_in(const ValueMap& map, const PlantedArea& area, double x0, double z0, double x1, double z1) {
  if (map.values.empty()) return 0;
  // Between the same four middles it is bilinear: least at a corner.
  const auto middle = [](double at, double low, double high, std::uint32_t count) {
    return std::floor(pixels(at, low, high, count) - 0.5);
  };
  if (middle(x0, area.x0, area.x1, map.width) == middle(x1, area.x0, area.x1, map.width) &&
      middle(z0, area.z0, area.z1, map.height) == middle(z1, area.z0, area.z1, map.height))
    return std::min({smooth_at(map, area, x0, z0), smooth_at(map, area, x1, z0), smooth_at(map, area, x0, z1),
                     smooth_at(map, area, x1, z1)});
  const auto pixel = [](double at, double low, double high, std::uint32_t count, double side) {
    return static_cast<std::uint32_t>(std::clamp(pixels(at, low, high, count) + side, 0.0, count - 1.0));
  };
  // As smooth_at: half a pixel before the middle is that of the one before.
  const std::uint32_t c0 = pixel(x0, area.x0, area.x1, map.width, -0.5),
                      c1 = pixel(x1, area.x0, area.x1, map.width, 0.5),
                      r0 = pixel(z0, area.z0, area.z1, map.height, -0.5),
                      r1 = pixel(z1, area.z0, area.z1, map.height, 0.5);
  float least = map.values[std::size_t{r0} * map.width + c0];
  for (std::uint32_t r = r0; r <= r1; ++r)
    for (std::uint32_t c = c0; c <= c1; ++c)
      least = std::min(least, map.values[std::size_t{r} * map.width + c]);
  return static_cast<double>(least);
}

std::vector<ValueMap> means_by_size(std::span<const ValueMap* const> maps) {
  const auto same_size = [](const ValueMap& a, const ValueMap& b) {
    return a.width == b.width && a.height == b.height;
  };
  std::vector<ValueMap> out;
  for (std::size_t first = 0; first < maps.size(); ++first) {
    const ValueMap& like = *maps[first];
    if (std::any_of(out.begin(), out.end(), [&](const ValueMap& m) { return same_size(m, like); })) continue;
    std::vector<double> sums(like.values.size());
    for (const ValueMap* map : maps.subspan(first))
      for (std::size_t i = 0; same_size(*map, like) && i < sums.size(); ++i)
        sums[i] += std::max(static_cast<double>(map->values[i]), 0.0);
    ValueMap mean{like.width, like.height, {}};
    mean.values.reserve(sums.size());
    for (const double sum : sums)
      mean.values.push_back(sum > 0 ? std::max(static_cast<float>(sum / static_cast<double>(maps.size())),
                                               std::numeric_limits<float>::denorm_min())
                                    : 0.0f);
    out.push_back(std::move(mean));
  }
  return out;
}

}  // namespace copse
