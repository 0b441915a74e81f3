#include "lib/analysis/ecosystem/density_field.h"

#include "lib/analysis/ecosystem/degrees.h"
#include "lib/analysis/leaves/nearest_points.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace copse {
namespace {

constexpr double k_infinite = std::numeric_limits<double>::infinity();

bool is_limit(const ValueRange& r) {
  return r.min > -k_infinite || r.max < k_infinite;
}

// How much the clusters leave of every cell: 1 at a centre, smoothly 0 at the radius; where clusters meet the
// nearer one counts. A cluster smaller than a cell still has the cell that it is in.
std::vector<double> cluster_kernel(const Clusters& clusters, const DensityField& f, const Random& random) {
  const double w = f.area.width() / f.columns, d = f.area.depth() / f.rows;
  const double radius = std::max(clusters.radius, 0.51 * std::sqrt(w * w + d * d)), most = radius * radius;
  std::vector<Double3> centres;
  for (std::uint32_t i = 0; i < clusters.count; ++i) {
    Random stream = random.fork(i);
    centres.push_back({stream.uniform(f.area.x0, f.area.x1), 0, stream.uniform(f.area.z0, f.area.z1)});
  }
  const NearestPoints nearest(centres);
  std::vector<double> kernel(f.weights.size());
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, f.rows), [&](const auto& range) {
    for (std::uint32_t cell = range.begin() * f.columns; cell < range.end() * f.columns; ++cell) {
      const GroundPlace at = f.point(cell, 0.5, 0.5);
      const Double3& c = centres[nearest.nearest({at.x, 0, at.z})];
      const double dx = at.x - c.x, dz = at.z - c.z, near = std::min(dx * dx + dz * dz, most);
      kernel[cell] = (1 - near / most) * (1 - near / most);
    }
  });
  return kernel;
}

// Samples a side of a cell. Where the pixels of every map can have whole squares of samples they get them.
std::uint32_t samples_of(const PlacementRules& rules, const TerrainGround& ground, std::uint32_t columns,
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

PlacementTest::PlacementTest(const PlacementRules& rules, const PlantedArea& area,
                             const TerrainGround& ground)
    : rules_(rules), area_(area), ground_(ground) {
  if (is_limit(rules.slope)) {
    // A slope of 0 to 90 degrees falls as the normal's y rises from 0 to 1.
    least_up_ = sin_cos_degrees(std::clamp(rules.slope.max, 0.0, 90.0)).cos;
    most_up_ = sin_cos_degrees(std::clamp(rules.slope.min, 0.0, 90.0)).cos;
    if (rules.slope.max < 0 || rules.slope.min > 90) least_up_ = 2;  // never
  }
  if (rules.distance_to) distance_ = PixelDistance(*rules.distance_to, area);
}

bool PlacementTest::allows(double x, double z) const {
  if (rules_.forbidden && pixel_at(*rules_.forbidden, area_, x, z) >= 0.5) return false;
  if (rules_.distance_to && !distance_.is_within(x, z, rules_.distance.min, rules_.distance.max))
    return false;
  const auto here = ground_.at(x, z);
  if (!here) return false;
  if (is_limit(rules_.slope) && !(here->normal.y >= least_up_ && here->normal.y <= most_up_)) return false;
  return rules_.altitude.holds(here->height);
}

double PlacementTest::weight(double x, double z) const {
  double w = rules_.density ? std::max(pixel_at(*rules_.density, area_, x, z), 0.0) : 1;
  if (w > 0 && rules_.share_of) {
    double sum = 0;
    for (const ValueMap* share : rules_.share_total) sum += std::max(pixel_at(*share, area_, x, z), 0.0);
    w = sum > 0 ? w * std::max(pixel_at(*rules_.share_of, area_, x, z), 0.0) / sum : 0;
  }
  return w > 0 && allows(x, z) ? w : 0;
}

GroundPlace DensityField::point(std::uint32_t cell, double u, double v) const {
  return {area.x0 + (cell % columns + u) / columns * area.width(),
          area.z0 + (cell / columns + v) / rows * area.depth()};
}

GroundPlace sample_in_cell(std::uint32_t i, std::uint32_t j, std::uint32_t samples) {
  const double n = samples;
  return {(i + (j + 0.5) / n) / n, (j + (i + 0.5) / n) / n};
}

DensityField make_field(const PlacementRules& rules, const PlantedArea& area, const TerrainGround& ground,
                        std::uint32_t columns, std::uint32_t rows, const Random& random) {
  DensityField field{area,
                     columns,
                     rows,
                     std::vector<double>(std::size_t{columns} * rows),
                     std::vector<float>(std::size_t{columns} * rows),
                     samples_of(rules, ground, columns, rows)};
  const PlacementTest test(rules, area, ground);
  std::vector<double> clusters;
  if (rules.clusters.count > 0) clusters = cluster_kernel(rules.clusters, field, random);
  const std::uint32_t n = field.samples;
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, rows), [&](const auto& range) {
    for (std::uint32_t cell = range.begin() * columns; cell < range.end() * columns; ++cell) {
      const double near = clusters.empty() ? 1 : clusters[cell];
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
