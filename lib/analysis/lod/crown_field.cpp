#include "lib/analysis/lod/crown_field.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace copse {
namespace {

// A triangle is sampled about once a half cell, but never more often than this along a side.
constexpr int k_most_samples = 64;

// One pass of the exact distance transform along a line (Felzenszwalb, Huttenlocher 2012): the lower envelope
// of parabolas.
void transform_line(std::vector<float>& f, std::vector<float>& out, std::vector<int>& v,
                    std::vector<double>& z) {
  const int n = static_cast<int>(f.size());
  int k = -1;
  for (int q = 0; q < n; ++q) {
    if (!std::isfinite(f[q])) continue;
    double s = 0;
    for (; k >= 0; --k) {
      const int p = v[k];
      s = ((double(f[q]) + double(q) * q) - (double(f[p]) + double(p) * p)) / (2.0 * (q - p));
      if (s > z[k]) break;
    }
    v[++k] = q, z[k] = k == 0 ? -std::numeric_limits<double>::infinity() : s;
  }
  if (k < 0) return;
  for (int q = 0, j = 0; q < n; ++q) {
    while (j < k && z[j + 1] < q) ++j;
    out[q] = f[v[j]] + static_cast<float>((q - v[j]) * (q - v[j]));
  }
}

}  // namespace

CrownField::CrownField(std::span<const FoliageTriangle> triangles, int cells, double reach) {
  DoubleBox box;
  for (const FoliageTriangle& t : triangles)
    for (const Double3& p : t.corners) box.grow(p);
  if (!box.empty()) {
    const Double3 e = box.extent();
    const double longest = std::max({e.x, e.y, e.z});
    low_ = box.min;
    if (longest > 0) cell_ = longest / cells;
    per_cell_ = 1 / cell_;
    for (int a = 0; a < 3; ++a) size_[a] = std::clamp(static_cast<int>(std::ceil(e[a] / cell_)), 1, cells);
  }
  const std::size_t n = static_cast<std::size_t>(size_[0]) * size_[1] * size_[2];
  area_.assign(n, 0), full_.assign(n, 0);
  for (const FoliageTriangle& t : triangles) deposit(t);
  see();
  measure_distances();
  measure_cross_section();
  measure_hull(triangles, reach);
}

std::array<int, 3> CrownField::cell_of(const Double3& p, double& outside) const {
  std::array<int, 3> at{};
  double square = 0;
  for (int a = 0; a < 3; ++a) {
    const double c = (p[a] - low_[a]) * per_cell_;
    const double inside = std::clamp(c, 0.0, double(size_[a]));
    square += (c - inside) * (c - inside);
    at[a] = std::min(static_cast<int>(inside), size_[a] - 1);
  }
  outside = square > 0 ? cell_ * std::sqrt(square) : 0;
  return at;
}

void CrownField::deposit(const FoliageTriangle& t) {
  const Double3 e = t.corners[1] - t.corners[0], f = t.corners[2] - t.corners[0];
  const double area = 0.5 * length(cross(e, f)), side = std::max(length(e), length(f));
  const int n = std::clamp(static_cast<int>(std::ceil(2 * side / cell_)), 1, k_most_samples);
  const auto share = static_cast<float>(area / (cell_ * cell_) * t.opacity / (double(n) * n));
  const Double3 at = (t.corners[0] - low_) * per_cell_, u_way = e * per_cell_, v_way = f * per_cell_;
  const auto put = [&](double u, double v) {
    const Double3 p = at + u_way * u + v_way * v;
    const auto cell = [&](int a) { return std::clamp(static_cast<int>(p[a]), 0, size_[a] - 1); };
    const std::size_t i = index(cell(0), cell(1), cell(2));
    area_[i] += share, full_[i] = 1;
  };
  // The middles of the n^2 triangles into which it is cut.
  for (int i = 0; i < n; ++i)
    for (int j = 0; i + j < n; ++j) {
      put((i + 1 / 3.0) / n, (j + 1 / 3.0) / n);
      if (i + j + 1 < n) put((i + 2 / 3.0) / n, (j + 2 / 3.0) / n);
    }
}

// The optical depth in front of every cell, seen along `step`.
void CrownField::sweep(std::array<int, 3> step, std::vector<float>& depth) const {
  const double steps = std::sqrt(double(step[0] * step[0] + step[1] * step[1] + step[2] * step[2]));
  // A leaf of area A in the cell hides A / 2 of cell^2; a slanted ray is longer in the cell and meets more of
  // it.
  const auto scale = static_cast<float>(0.5 * steps);
  const auto range = [&](int axis) {
    return step[axis] < 0 ? std::array{size_[axis] - 1, -1, -1} : std::array{0, size_[axis], 1};
  };
  const auto [x0, x1, dx] = range(0);
  const auto [y0, y1, dy] = range(1);
  const auto [z0, z1, dz] = range(2);
  for (int z = z0; z != z1; z += dz) {
    for (int y = y0; y != y1; y += dy) {
      for (int x = x0; x != x1; x += dx) {
        const int px = x - step[0], py = y - step[1], pz = z - step[2];
        const bool in = px >= 0 && px < size_[0] && py >= 0 && py < size_[1] && pz >= 0 && pz < size_[2];
        const std::size_t before = in ? index(px, py, pz) : 0;
        depth[index(x, y, z)] = in ? depth[before] + scale * area_[before] : 0;
      }
    }
  }
}

void CrownField::see() {
  exposure_.assign(area_.size(), 0), places_.assign(area_.size(), {0, 0});
  std::vector<float> front(area_.size()), back(area_.size());
  for (int i = 14; i < 27; ++i) {  // one of each two opposite directions
    const std::array step{i % 3 - 1, i / 3 % 3 - 1, i / 9 - 1};
    sweep(step, front), sweep({-step[0], -step[1], -step[2]}, back);
    const double steps = std::sqrt(double(step[0] * step[0] + step[1] * step[1] + step[2] * step[2]));
    const auto scale = static_cast<float>(0.5 * steps);
    for (std::size_t c = 0; c < area_.size(); ++c) {
      const float f = std::exp(-front[c]), b = std::exp(-back[c]), half = std::exp(-0.5f * scale * area_[c]);
      exposure_[c] += (f + b) * half / 26;
      places_[c].openness += f * b * half * half / 13;
    }
  }
}

void CrownField::measure_distances() {
  for (std::size_t i = 0; i < full_.size(); ++i)
    places_[i].emptiness = full_[i] ? 0 : std::numeric_limits<float>::infinity();
  const auto pass = [&](int axis, int b, int c) {
    const int n = size_[axis];
    std::vector<float> line(n), out(n);
    std::vector<int> v(n);
    std::vector<double> z(n);
    std::array<int, 3> at{};
    for (at[b] = 0; at[b] < size_[b]; ++at[b])
      for (at[c] = 0; at[c] < size_[c]; ++at[c]) {
        for (at[axis] = 0; at[axis] < n; ++at[axis])
          line[at[axis]] = places_[index(at[0], at[1], at[2])].emptiness;
        out = line;
        transform_line(line, out, v, z);
        for (at[axis] = 0; at[axis] < n; ++at[axis])
          places_[index(at[0], at[1], at[2])].emptiness = out[at[axis]];
      }
  };
  pass(0, 1, 2), pass(1, 0, 2), pass(2, 0, 1);
  for (Place& p : places_) p.emptiness = static_cast<float>(cell_ * std::sqrt(p.emptiness));
}

void CrownField::measure_cross_section() {
  for (int axis = 0; axis < 3; ++axis) {
    const int b = (axis + 1) % 3, c = (axis + 2) % 3;
    std::array<int, 3> at{};
    for (at[b] = 0; at[b] < size_[b]; ++at[b])
      for (at[c] = 0; at[c] < size_[c]; ++at[c]) {
        bool any = false;
        for (at[axis] = 0; at[axis] < size_[axis]; ++at[axis]) any = any || full_[index(at[0], at[1], at[2])];
        cross_section_ += any ? cell_ * cell_ / 3 : 0;
      }
  }
}

// Which cells are the first or the last full one of a row along some axis: the hull is theirs.
void CrownField::find_outer_cells() {
  outer_.assign(full_.size(), 0);
  for (int axis = 0; axis < 3; ++axis) {
    const int b = (axis + 1) % 3, c = (axis + 2) % 3;
    std::array<int, 3> at{};
    const auto here = [&] { return index(at[0], at[1], at[2]); };
    for (at[b] = 0; at[b] < size_[b]; ++at[b]) {
      for (at[c] = 0; at[c] < size_[c]; ++at[c]) {
        for (at[axis] = 0; at[axis] < size_[axis] && !full_[here()];) ++at[axis];
        if (at[axis] == size_[axis]) continue;
        outer_[here()] = 1;
        for (at[axis] = size_[axis] - 1; !full_[here()];) --at[axis];
        outer_[here()] = 1;
      }
    }
  }
}

void CrownField::measure_hull(std::span<const FoliageTriangle> triangles, double reach) {
  find_outer_cells();
  std::vector<Double3> points;
  for (const FoliageTriangle& t : triangles) {
    for (const Double3& p : t.corners) {
      double outside = 0;
      const auto [x, y, z] = cell_of(p, outside);
      if (outer_[index(x, y, z)] != 0) points.push_back(p);
    }
  }
  hull_ = CrownHull(points, reach);
}

double CrownField::exposure(const Double3& p) const {
  double outside = 0;
  const auto [x, y, z] = cell_of(p, outside);
  return outside > 0 ? 1 : exposure_[index(x, y, z)];
}

CrownField::Place CrownField::at(const Double3& p) const {
  double outside = 0;
  const auto [x, y, z] = cell_of(p, outside);
  Place place = places_[index(x, y, z)];
  if (outside > 0) place = {1, static_cast<float>(place.emptiness + outside)};
  return place;
}

}  // namespace copse
