#include "lib/analysis/ecosystem/density_field.h"

#include "lib/analysis/ecosystem/degrees.h"

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

// The lower envelope of parabolas (x - i)^2 step^2 + f[i]: min over i, for every x.
void transform_line(std::vector<double>& f, double step, std::vector<double>& out,
                    std::vector<std::size_t>& at, std::vector<double>& border) {
  const std::size_t n = f.size();
  out.assign(n, k_infinite);
  at.assign(n, 0);
  border.assign(n + 1, 0);
  std::size_t k = 0;
  bool any = false;
  const double s2 = step * step;
  for (std::size_t q = 0; q < n; ++q) {
    if (f[q] == k_infinite) continue;
    if (!any) {
      any = true;
      at[0] = q;
      border[0] = -k_infinite;
      border[1] = k_infinite;
      continue;
    }
    double cut = 0;
    while (true) {
      const auto p = static_cast<double>(at[k]), x = static_cast<double>(q);
      cut = ((f[q] - f[at[k]]) / s2 + x * x - p * p) / (2 * (x - p));
      if (cut > border[k] || k == 0) break;
      --k;
    }
    if (cut <= border[k]) {
      at[k] = q;
      border[k + 1] = k_infinite;
      continue;
    }
    ++k;
    at[k] = q;
    border[k] = cut;
    border[k + 1] = k_infinite;
  }
  if (!any) return;
  std::size_t j = 0;
  for (std::size_t q = 0; q < n; ++q) {
    while (border[j + 1] < static_cast<double>(q)) ++j;
    const double d = (static_cast<double>(q) - static_cast<double>(at[j])) * step;
    out[q] = d * d + f[at[j]];
  }
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
  std::vector<double> kernel(f.weights.size(), most);
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, f.rows), [&](const auto& range) {
    for (std::uint32_t r = range.begin(); r < range.end(); ++r) {
      double* row = kernel.data() + std::size_t{r} * f.columns;
      const double z = f.area.z0 + (r + 0.5) / f.rows * f.area.depth();
      for (const Double3& c : centres) {
        const double dz = z - c.z, left = most - dz * dz;
        if (!(left > 0)) continue;
        const double reach = std::sqrt(left) / w, at = (c.x - f.area.x0) / w;
        const auto first = static_cast<std::uint32_t>(std::max(at - reach - 1, 0.0));
        const auto end = static_cast<std::uint32_t>(std::min(at + reach + 1, 1.0 * f.columns));
        for (std::uint32_t k = first; k < end; ++k) {
          const double dx = f.area.x0 + (k + 0.5) / f.columns * f.area.width() - c.x;
          row[k] = std::min(row[k], dx * dx + dz * dz);
        }
      }
      for (std::uint32_t k = 0; k < f.columns; ++k) row[k] = (1 - row[k] / most) * (1 - row[k] / most);
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

ValueMap distance_map(const ValueMap& map, const PlantedArea& area) {
  const double sx = area.width() / map.width, sz = area.depth() / map.height;
  std::vector<double> squares(map.values.size());
  for (std::size_t i = 0; i < squares.size(); ++i) squares[i] = map.values[i] >= 0.5f ? 0 : k_infinite;
  std::vector<double> line, out, border;
  std::vector<std::size_t> at;
  for (std::uint32_t c = 0; c < map.width; ++c) {
    line.resize(map.height);
    for (std::uint32_t r = 0; r < map.height; ++r) line[r] = squares[std::size_t{r} * map.width + c];
    transform_line(line, sz, out, at, border);
    for (std::uint32_t r = 0; r < map.height; ++r) squares[std::size_t{r} * map.width + c] = out[r];
  }
  ValueMap result{map.width, map.height, std::vector<float>(map.values.size())};
  for (std::uint32_t r = 0; r < map.height; ++r) {
    const auto row = squares.begin() + static_cast<std::ptrdiff_t>(std::size_t{r} * map.width);
    line.assign(row, row + map.width);
    transform_line(line, sx, out, at, border);
    for (std::uint32_t c = 0; c < map.width; ++c)
      result.values[std::size_t{r} * map.width + c] = static_cast<float>(std::sqrt(out[c]));
  }
  return result;
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
  if (rules.distance_to) distance_ = distance_map(*rules.distance_to, area);
}

bool PlacementTest::allows(double x, double z) const {
  if (rules_.forbidden && pixel_at(*rules_.forbidden, area_, x, z) >= 0.5) return false;
  if (rules_.distance_to && !rules_.distance.holds(pixel_at(distance_, area_, x, z))) return false;
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
