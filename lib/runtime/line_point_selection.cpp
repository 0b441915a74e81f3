#include "lib/runtime/line_point_selection.h"

#include <algorithm>
#include <cmath>

namespace copse {
namespace {

constexpr double k_facing = 1.8;  // equation 4.4: a little more than half of the leaves' area shows

}  // namespace

TrunkSelection select_trunk(std::span<const float> diameters, double depth, const PrimitiveView& view,
                            const PrimitiveSizes& sizes) {
  TrunkSelection out;
  if (!(depth > 0) || !(view.pixel > 0)) return out;
  const double factor = view.scale / depth;
  // The first segment that is not thinner than so many pixels.
  const auto thinner_than = [&](double pixels) {
    return static_cast<std::uint32_t>(
        std::partition_point(diameters.begin(), diameters.end(),
                             [&](float d) { return d * factor < pixels * view.pixel; }) -
        diameters.begin());
  };
  const int least = std::clamp(sizes.least_width, 1, k_widest_line),
            largest = std::clamp(sizes.largest_width, least, k_widest_line);
  out.discarded = thinner_than(least - 0.5);
  for (int w = 0; w < least; ++w) out.end[static_cast<std::size_t>(w)] = out.discarded;
  for (int w = least; w <= largest; ++w) out.end[static_cast<std::size_t>(w)] = thinner_than(w + 0.5);
  out.triangles = out.end[static_cast<std::size_t>(largest)];
  for (std::size_t w = static_cast<std::size_t>(largest) + 1; w < out.end.size(); ++w)
    out.end[w] = out.triangles;
  return out;
}

GroupSelection select_group(const LeafGroup& group, double depth, const PrimitiveView& view,
                            const PrimitiveSizes& sizes) {
  const double n = group.count, side = sizes.point_size * view.pixel;
  const GroupSelection triangles{.first_point = 0, .end_point = 0, .first_leaf = 0, .end_leaf = group.count};
  if (!(depth > 0) || !(side > 0) || !std::isfinite(group.mean_area)) return triangles;
  const double area = n * group.mean_area * view.scale * view.scale / (k_facing * depth * depth);
  const double points = area / (side * side);
  if (!(points < 2 * n)) return triangles;
  if (points < n) {
    const auto count = static_cast<std::uint32_t>(std::min(std::ceil(points), n));
    return {group.count - count, group.count, group.count, group.count};
  }
  const auto count = static_cast<std::uint32_t>(std::floor(2 * n - points));
  return {0, count, count, group.count};
}

}  // namespace copse
