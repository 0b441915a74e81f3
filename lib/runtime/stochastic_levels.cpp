#include "lib/runtime/stochastic_levels.h"

#include "lib/formats/random.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace copse {
namespace {

using Corners = std::array<DrawVertex, 3>;

Corners corners_of(const TreeGeometry& g, std::size_t first_index) {
  return {g.vertices[g.indices[first_index]], g.vertices[g.indices[first_index + 1]],
          g.vertices[g.indices[first_index + 2]]};
}

double area_of(const Corners& c) {
  const Double3 a = to_double(c[0].position), b = to_double(c[1].position), d = to_double(c[2].position);
  const double area = length(cross(b - a, d - a)) / 2;
  return std::isfinite(area) ? area : 0;
}

double area_of(const TreeGeometry& g, const DrawRange& range) {
  double sum = 0;
  for (std::size_t i = 0; i + 2 < range.index_count; i += 3)
    sum += area_of(corners_of(g, range.first_index + i));
  return sum;
}

// How many times as large a triangle may be round its middle, and stay in the box.
double most_in(const FloatBox& box, const Corners& c, const Double3& centre) {
  double most = 1e30;
  for (const DrawVertex& v : c)
    for (int a = 0; a < 3; ++a) {
      const double reach = double{v.position[a]} - centre[a];
      const double room = double{reach > 0 ? box.max[a] : box.min[a]} - centre[a];
      if (reach != 0) most = std::min(most, room / reach);
    }
  return std::max(most, 1.0);
}

class LevelMaker {
 public:
  LevelMaker(TreeGeometry& geometry, std::span<const DrawRange> ranges) : g_(geometry) {
    for (const DrawRange& r : ranges)
      for (std::size_t i = 0; i < r.index_count; ++i)
        box_.grow(g_.vertices[g_.indices[r.first_index + i]].position);
  }

  // `count` triangles, each for the same share of the range's area: that in whose part of the sum a point at
  // random of every step falls.
  DrawRange add(const DrawRange& range, double area, std::uint32_t count, Random random) {
    DrawRange out{range.part, range.material, static_cast<std::uint32_t>(g_.indices.size()), 3 * count};
    const double step = area / count;
    double sum = 0;
    std::uint32_t taken = 0;
    double next = step * random.uniform();
    Corners last{};
    double last_area = 0;
    for (std::size_t i = 0; i + 2 < range.index_count && taken < count; i += 3) {
      const Corners c = corners_of(g_, range.first_index + i);
      const double own = area_of(c);
      if (own > 0) last = c, last_area = own;
      sum += own;
      for (; taken < count && next < sum; next = step * (++taken + random.uniform())) append(c, step / own);
    }
    // The sum may end a rounding early.
    for (; taken < count; ++taken) append(last, step / last_area);
    return out;
  }

 private:
  void append(const Corners& c, double larger) {
    Double3 centre;
    for (const DrawVertex& v : c) centre += to_double(v.position) / 3.0;
    const double scale = std::min(std::sqrt(larger), most_in(box_, c, centre));
    for (DrawVertex v : c) {
      v.position = to_float(centre + (to_double(v.position) - centre) * scale);
      for (int a = 0; a < 3; ++a) v.position[a] = std::clamp(v.position[a], box_.min[a], box_.max[a]);
      g_.indices.push_back(static_cast<std::uint32_t>(g_.vertices.size()));
      g_.vertices.push_back(v);
    }
  }

  TreeGeometry& g_;
  FloatBox box_;
};

}  // namespace

std::vector<DrawRange> add_stochastic_level(TreeGeometry& geometry, std::span<const DrawRange> ranges,
                                            std::uint32_t wanted) {
  std::uint64_t triangles = 0;
  for (const DrawRange& r : ranges) triangles += r.index_count / 3;
  if (triangles <= wanted) return {ranges.begin(), ranges.end()};
  std::vector<double> areas;
  double all = 0;
  for (const DrawRange& r : ranges) all += areas.emplace_back(area_of(geometry, r));
  LevelMaker maker(geometry, ranges);
  std::vector<DrawRange> out;
  for (std::size_t r = 0; r < ranges.size(); ++r) {
    if (!(areas[r] > 0)) continue;
    const double share = std::floor(wanted * (areas[r] / all));
    const auto count = static_cast<std::uint32_t>(std::clamp(share, 1.0, ranges[r].index_count / 3.0));
    out.push_back(maker.add(ranges[r], areas[r], count, Random(wanted).fork(r)));
  }
  return out;
}

std::uint32_t triangles_of_pixels(double pixels) {
  return static_cast<std::uint32_t>(std::clamp(std::ceil(pixels * pixels), 1.0, 1e9));
}

}  // namespace copse
