#include "lib/runtime/sky_light.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace copse {

namespace {

constexpr std::size_t k_directions = 48;  // over the upper hemisphere; more is not visible
constexpr double k_sample_budget =
    4000000;  // points at which the area of large triangles is counted, at most

struct Grid {
  std::array<std::size_t, 3> size{};
  Double3 corner;
  double cell = 1;
  std::vector<double> area;  // projected, averaged over all directions

  std::size_t count() const { return size[0] * size[1] * size[2]; }
  std::size_t stride(std::size_t axis) const {
    return axis == 0 ? 1 : axis == 1 ? size[0] : size[0] * size[1];
  }
  std::size_t cell_of(const Double3& p) const {
    std::size_t index = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const int a = static_cast<int>(axis);
      const double at = (p[a] - corner[a]) / cell;
      index +=
          stride(axis) * static_cast<std::size_t>(std::clamp(at, 0.0, static_cast<double>(size[axis] - 1)));
    }
    return index;
  }
};

Grid make_grid(const FloatBox& bounds, std::size_t resolution) {
  Grid grid;
  const Double3 low = to_double(bounds.min), extent = to_double(bounds.max) - low;
  const double margin = 0.5 * std::max({extent.x, extent.y, extent.z, 1e-30});
  const double longest = std::max({extent.x, extent.y, extent.z}) + 2 * margin;
  grid.cell = longest / static_cast<double>(resolution);
  grid.corner = low - Double3{margin, margin, margin};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double cells = std::ceil((extent[static_cast<int>(axis)] + 2 * margin) / grid.cell);
    grid.size[axis] = std::clamp<std::size_t>(static_cast<std::size_t>(cells), 1, resolution);
  }
  grid.area.resize(grid.count());
  return grid;
}

// Two cells beside the bounds and one above.
Grid make_low_grid(const FloatBox& bounds, std::size_t resolution) {
  Grid grid;
  const Double3 low = to_double(bounds.min), extent = to_double(bounds.max) - low;
  grid.cell = std::max({extent.x, extent.y, extent.z, 1e-30}) / static_cast<double>(resolution - 4);
  grid.corner = low - Double3{2 * grid.cell, 0, 2 * grid.cell};
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double cells = std::ceil(extent[static_cast<int>(axis)] / grid.cell) + (axis == 1 ? 1 : 4);
    grid.size[axis] = std::clamp<std::size_t>(static_cast<std::size_t>(cells), 1, resolution + 1);
  }
  grid.area.resize(grid.count());
  return grid;
}

struct Corners {
  Double3 a, b, c;
  double area() const { return length(cross(b - a, c - a)) / 2; }
};

Corners corners(const TreeGeometry& g, std::size_t first_index) {
  const auto at = [&](std::size_t i) { return to_double(g.vertices[g.indices[first_index + i]].position); };
  return {at(0), at(1), at(2)};
}

// Spreads the area of a triangle over the cells that it crosses: at the centroids of n * n equal parts.
void spread(Grid& grid, const Corners& t, double weight, double spacing) {
  const double area = t.area();
  if (!(area > 0) || !std::isfinite(area)) return;
  const int n = std::max(1, static_cast<int>(std::ceil(std::sqrt(area) / spacing)));
  const double share = weight * area / (static_cast<double>(n) * n);
  const auto add = [&](double u, double v) {
    grid.area[grid.cell_of(t.a + (t.b - t.a) * (u / n) + (t.c - t.a) * (v / n))] += share;
  };
  for (int i = 0; i < n; ++i) {
    for (int j = 0; i + j < n; ++j) {
      add(i + 1 / 3.0, j + 1 / 3.0);
      if (i + j + 1 < n) add(i + 2 / 3.0, j + 2 / 3.0);
    }
  }
}

void deposit(Grid& grid, const TreeGeometry& g, std::span<const float> opacity) {
  double total = 0;
  for (std::size_t i = 0; i + 2 < g.indices.size(); i += 3) total += corners(g, i).area();
  const double spacing = std::max(grid.cell / 2, std::sqrt(total / k_sample_budget));
  for (std::size_t r = 0; r < g.ranges.size(); ++r) {
    // The mean projection of a flat card is half its area; of a closed surface a quarter (Cauchy).
    const double weight = opacity[r] * (g.ranges[r].part == DrawPart::leaves ? 0.5 : 0.25);
    const std::size_t end = g.ranges[r].first_index + g.ranges[r].index_count;
    for (std::size_t i = g.ranges[r].first_index; i < end; i += 3) {
      spread(grid, corners(g, i), weight, spacing);
    }
  }
}

Double3 direction(std::size_t i) {
  const double y = (static_cast<double>(i) + 0.5) / k_directions;
  const double r = std::sqrt(1 - y * y);
  const double turn = static_cast<double>(i) * (3 - std::sqrt(5.0)) * std::numbers::pi;
  return {r * std::cos(turn), y, r * std::sin(turn)};
}

// Carries the light of one direction through the grid against that direction, slab after slab of the axis
// that it follows most. `light` is what reaches a cell's centre.
class Sweep {
 public:
  Sweep(const Grid& grid, const Double3& towards_sky) : grid_(grid), towards_(towards_sky) {
    const Double3 a{std::abs(towards_.x), std::abs(towards_.y), std::abs(towards_.z)};
    axis_ = a.x > a.y && a.x > a.z ? 0 : a.y >= a.z ? 1 : 2;
    u_ = (axis_ + 1) % 3;
    v_ = (axis_ + 2) % 3;
    const double along = a[static_cast<int>(axis_)];
    shift_u_ = towards_[static_cast<int>(u_)] / along;
    shift_v_ = towards_[static_cast<int>(v_)] / along;
    path_ = 1 / (along * grid.cell * grid.cell);  // length through a slab over the volume of a cell
    through_.resize(grid.count(), 1.0);
    light_.resize(grid.count(), 1.0);
  }

  const std::vector<double>& run() {
    const bool up = towards_[static_cast<int>(axis_)] > 0;
    const std::size_t n = grid_.size[axis_];
    for (std::size_t step = 0; step < n; ++step) slab(up ? n - 1 - step : step, step > 0, up);
    return light_;
  }

 private:
  void slab(std::size_t k, bool has_source, bool up) {
    const std::size_t source = (up ? k + 1 : k - 1) * grid_.stride(axis_);
    for (std::size_t j = 0; j < grid_.size[v_]; ++j) {
      for (std::size_t i = 0; i < grid_.size[u_]; ++i) {
        const std::size_t at = k * grid_.stride(axis_) + i * grid_.stride(u_) + j * grid_.stride(v_);
        const double arrives =
            has_source ? sample(source, static_cast<double>(i) + shift_u_, static_cast<double>(j) + shift_v_)
                       : 1;
        const double half = std::exp(-0.5 * grid_.area[at] * path_);
        light_[at] = arrives * half;
        through_[at] = arrives * half * half;
      }
    }
  }

  // Bilinear; outside the grid is open sky.
  double sample(std::size_t slab, double u, double v) const {
    const double fu = std::floor(u), fv = std::floor(v);
    const auto at = [&](double i, double j) {
      if (i < 0 || j < 0 || i >= static_cast<double>(grid_.size[u_]) ||
          j >= static_cast<double>(grid_.size[v_])) {
        return 1.0;
      }
      return through_[slab + static_cast<std::size_t>(i) * grid_.stride(u_) +
                      static_cast<std::size_t>(j) * grid_.stride(v_)];
    };
    const double su = u - fu, sv = v - fv;
    return (at(fu, fv) * (1 - su) + at(fu + 1, fv) * su) * (1 - sv) +
           (at(fu, fv + 1) * (1 - su) + at(fu + 1, fv + 1) * su) * sv;
  }

  const Grid& grid_;
  Double3 towards_;
  std::size_t axis_ = 1, u_ = 2, v_ = 0;
  double shift_u_ = 0, shift_v_ = 0, path_ = 0;
  std::vector<double> through_, light_;
};

}  // namespace

namespace {

SkyLight swept(const Grid& grid) {
  std::vector<double> constant(grid.count(), 0);
  std::vector<Double3> linear(grid.count());
  for (std::size_t d = 0; d < k_directions; ++d) {
    const Double3 towards = direction(d);
    Sweep sweep(grid, towards);
    const std::vector<double>& light = sweep.run();
    for (std::size_t i = 0; i < grid.count(); ++i) {
      constant[i] += light[i];
      linear[i] += towards * light[i];
    }
  }
  // Irradiance over pi of radiance L = sum of a hemisphere of solid angle 2 pi: with the cosine lobe's bands
  // pi and 2 pi / 3, the constant band gives mean(L) / 2 and the linear one mean(L direction) (Ramamoorthi).
  SkyLight sky;
  sky.size = grid.size;
  sky.corner = to_float(grid.corner);
  sky.cell = static_cast<float>(grid.cell);
  sky.cells.resize(grid.count());
  for (std::size_t i = 0; i < grid.count(); ++i) {
    const Float3 l = to_float(linear[i] / k_directions);
    sky.cells[i] = {l.x, l.y, l.z, static_cast<float>(constant[i] / (2 * k_directions))};
  }
  return sky;
}

}  // namespace

SkyLight make_sky_light(const TreeGeometry& geometry, std::span<const float> opacity,
                        std::size_t resolution) {
  if (geometry.bounds.empty()) return {};
  Grid grid = make_grid(geometry.bounds, std::max<std::size_t>(resolution, 1));
  deposit(grid, geometry, opacity);
  return swept(grid);
}

SkyLight make_sky_light(std::span<const SkyOccluder> occluders, const FloatBox& bounds,
                        std::size_t resolution) {
  if (bounds.empty() || occluders.empty()) return {};
  Grid grid = make_low_grid(bounds, std::max<std::size_t>(resolution, 8));
  for (const SkyOccluder& o : occluders)
    if (is_finite(to_double(o.position)) && std::isfinite(o.area))
      grid.area[grid.cell_of(to_double(o.position))] += std::max(0.0, double{o.area});
  SkyLight sky = swept(grid);
  // Beside the bounds it opens over the two cells there; above them everything is open.
  const auto opens = [&](std::size_t axis) { return 1 - 4 / static_cast<float>(grid.size[axis]); };
  sky.opens = {opens(0), 1.1f, opens(2)};
  return sky;
}

}  // namespace copse
