#include "lib/analysis/ecosystem/density_field.h"

#include "lib/analysis/ecosystem/degrees.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <utility>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace copse {
namespace {

constexpr double k_infinite = std::numeric_limits<double>::infinity();

bool is_limit(const ValueRange& r) {
  return r.min > -k_infinite || r.max < k_infinite;
}

}  // namespace

bool PlacementRules::limits_anything() const {
  return density || forbidden || share_of || distance_to || is_limit(slope) || is_limit(altitude) ||
         clusters.count > 0;
}

double DensityField::total() const {
  double sum = 0;
  for (std::uint32_t r = 0; r < rows; ++r) {
    double row = 0;
    for (std::uint32_t c = 0; c < columns; ++c) row += weights[std::size_t{r} * columns + c];
    sum += row;
  }
  return sum;
}

std::uint32_t field_side(std::uint32_t largest_map, std::uint64_t instances, const Clusters& clusters,
                         const PlantedArea& area) {
  double wanted = std::max(2.0 * largest_map, std::sqrt(static_cast<double>(instances)));
  if (clusters.count > 0)
    wanted = std::max(wanted, 4 * std::max(area.width(), area.depth()) / clusters.radius);
  const auto side = static_cast<std::uint32_t>(
      std::clamp(std::ceil(wanted), 64.0, static_cast<double>(k_most_field_cells)));
  if (largest_map == 0) return side;
  if (largest_map <= k_most_field_cells)
    return std::min((side + largest_map - 1) / largest_map, k_most_field_cells / largest_map) * largest_map;
  const std::uint32_t part = (largest_map + k_most_field_cells - 1) / k_most_field_cells;
  for (std::uint32_t k = part; k <= 2 * part; ++k)
    if (largest_map % k == 0) return largest_map / k;
  return side;
}

// Where the pixels of every map can have whole squares of samples they get them.
std::uint32_t field_samples(const PlacementRules& rules, const TerrainGround& ground, std::uint32_t columns,
                            std::uint32_t rows) {
  constexpr std::uint32_t k_along_a_side = 1024;  // for the rules of the ground, which know no pixels
  constexpr std::uint32_t k_most = 16, k_cut = 2;
  std::uint32_t whole = 1, least = 1;
  if (is_limit(rules.slope) || is_limit(rules.altitude) || !ground.covers_all())
    whole = std::clamp(std::bit_ceil(k_along_a_side / std::max(std::min(columns, rows), 1u)), 2u, k_most);
  const auto count = [&](std::uint32_t pixels, std::uint32_t cells) {
    const std::uint32_t need = std::lcm(whole, pixels / std::gcd(pixels, cells));
    if (need <= k_most)
      whole = need;
    else
      least = std::max(least, k_cut * ((pixels + cells - 1) / cells));
  };
  std::vector<const ValueMap*> maps = rules.share_total;
  for (const ValueMap* m : {rules.density, rules.forbidden, rules.share_of, rules.distance_to})
    if (m) maps.push_back(m);
  for (const ValueMap* m : maps)
    if (m->width > 0 && m->height > 0) count(m->width, columns), count(m->height, rows);
  return (least + whole - 1) / whole * whole;
}

PlacementTest::PlacementTest(const PlacementRules& rules, const PlantedArea& area,
                             const TerrainGround& ground, std::shared_ptr<const PixelDistance> distance)
    : rules_(rules),
      area_(area),
      ground_(ground),
      by_slope_(is_limit(rules.slope)),
      by_ground_(by_slope_ || is_limit(rules.altitude) || !ground.covers_all()),
      distance_(std::move(distance)) {
  if (by_slope_) {
    // A slope of 0 to 90 degrees falls as the normal's y rises from 0 to 1.
    least_up_ = sin_cos_degrees(std::clamp(rules.slope.max, 0.0, 90.0)).cos;
    most_up_ = sin_cos_degrees(std::clamp(rules.slope.min, 0.0, 90.0)).cos;
    if (rules.slope.max < 0 || rules.slope.min > 90) least_up_ = 2;  // never
  }
  if (rules.distance_to && !distance_)
    distance_ = std::make_shared<const PixelDistance>(*rules.distance_to, area);
}

bool PlacementTest::allows(AskedPlace& place) const {
  if (rules_.forbidden && pixel_at(*rules_.forbidden, area_, place.x, place.z) >= 0.5) return false;
  if (rules_.distance_to && !distance_->is_within(place.x, place.z, rules_.distance.min, rules_.distance.max))
    return false;
  if (!by_ground_) return true;
  const auto& here = place.ground();
  if (!here) return false;
  if (by_slope_ && !(here->normal.y >= least_up_ && here->normal.y <= most_up_)) return false;
  return rules_.altitude.holds(here->height);
}

double PlacementTest::unshared(double x, double z) const {
  const double w = rules_.density ? std::max(pixel_at(*rules_.density, area_, x, z), 0.0) : 1;
  if (!(w > 0) || !rules_.share_of) return w;
  double sum = 0;
  for (const ValueMap* share : rules_.share_total) sum += std::max(pixel_at(*share, area_, x, z), 0.0);
  return sum > 0 ? w / sum : 0;
}

double PlacementTest::share(double x, double z) const {
  return rules_.share_of ? std::max(pixel_at(*rules_.share_of, area_, x, z), 0.0) : 1;
}

double PlacementTest::weight(double x, double z) const {
  double w = unshared(x, z);
  if (w > 0) w *= share(x, z);
  AskedPlace place(ground_, x, z);
  return w > 0 && allows(place) ? w : 0;
}

ClusterKernel::ClusterKernel(const Clusters& clusters, const PlantedArea& area, std::uint32_t columns,
                             std::uint32_t rows, const Random& random) {
  if (clusters.count == 0) return;
  const double w = area.width() / columns, d = area.depth() / rows;
  const double radius = std::max(clusters.radius, 0.51 * std::sqrt(w * w + d * d));
  most_ = radius * radius;
  for (std::uint32_t i = 0; i < clusters.count; ++i) {
    Random stream = random.fork(i);
    const double x = stream.uniform(area.x0, area.x1), z = stream.uniform(area.z0, area.z1);
    centres_.push_back({x, 0, z});
  }
  nearest_.emplace(centres_);
}

double ClusterKernel::at(const GroundPlace& middle) const {
  if (!nearest_) return 1;
  const Double3& c = centres_[nearest_->nearest({middle.x, 0, middle.z})];
  const double dx = middle.x - c.x, dz = middle.z - c.z, near = std::min(dx * dx + dz * dz, most_);
  return (1 - near / most_) * (1 - near / most_);
}

GroundPlace DensityField::point(std::uint32_t cell, double u, double v) const {
  const std::uint32_t column = cell % columns, row = cell / columns;
  return {area.x0 + (column + u) / columns * area.width(), area.z0 + (row + v) / rows * area.depth()};
}

GroundPlace sample_in_cell(std::uint32_t i, std::uint32_t j, std::uint32_t samples) {
  const double n = samples;
  return {(i + (j + 0.5) / n) / n, (j + (i + 0.5) / n) / n};
}

DensityField make_field(const PlacementTest& test, std::uint32_t columns, std::uint32_t rows,
                        const Random& random) {
  DensityField field{test.area(),
                     columns,
                     rows,
                     std::vector<double>(std::size_t{columns} * rows),
                     std::vector<float>(std::size_t{columns} * rows),
                     field_samples(test.rules(), test.ground(), columns, rows)};
  const ClusterKernel kernel(test.rules().clusters, test.area(), columns, rows, random);
  const std::uint32_t n = field.samples;
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, rows), [&](const auto& range) {
    for (std::uint32_t cell = range.begin() * columns; cell < range.end() * columns; ++cell) {
      const double near = kernel.at(field.point(cell, 0.5, 0.5));
      if (!(near > 0)) continue;
      double sum = 0, peak = 0;
      for (std::uint32_t j = 0; j < n; ++j)
        for (std::uint32_t i = 0; i < n; ++i) {
          const GroundPlace in = sample_in_cell(i, j, n), at = field.point(cell, in.x, in.z);
          const double w = test.weight(at.x, at.z);
          sum += w;
          peak = std::max(peak, w);
        }
      field.weights[cell] = near * (sum / (n * n));
      field.peaks[cell] = static_cast<float>(peak);
    }
  });
  return field;
}

}  // namespace copse
