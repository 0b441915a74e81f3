#include "lib/analysis/hull/hull_candidates.h"

#include "lib/analysis/boxes/kdop.h"
#include "lib/analysis/hull/exact_hull.h"
#include "lib/analysis/hull/point_cloud.h"
#include "lib/analysis/hull/principal_axes.h"
#include "lib/formats/random.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

namespace copse {
namespace {

constexpr std::size_t k_few = 4000;     // points for which the hull itself is quicker
constexpr std::size_t k_sample = 1024;  // points, about
constexpr std::size_t k_least_sample = 64;
constexpr int k_directions = 96;       // along which the sample's extremes are taken
constexpr int k_cells = 16;            // along a side of the map: 6 * 16^2 cells
constexpr int k_coarse = 8;            // of the map from which the second polytope is taken
constexpr std::size_t k_worth = 2000;  // survivors for which a second pass pays
constexpr double k_thin = 4e-14;       // of the size: thinner clouds are not filtered
constexpr double k_margin = 1e-9;      // of the gauge, and more for thin clouds: rounding

using Points = std::vector<Double3>;

// Brings the cloud to about a cube, so that no direction of the map is crowded.
struct Fattening {
  Double3 centre;
  Axes axes = k_world_axes;
  Double3 half{1, 1, 1};
  Double3 in(const Double3& p) const {
    const Double3 d = p - centre;
    return {dot(d, axes[0]) / half.x, dot(d, axes[1]) / half.y, dot(d, axes[2]) / half.z};
  }
};

// The same points are chosen in any order.
Points sample_of(std::span<const Double3> points) {
  const std::uint64_t below = std::numeric_limits<std::uint64_t>::max() / points.size() * k_sample;
  Points sample;
  for (const Double3& p : points) {
    const std::uint64_t h = std::bit_cast<std::uint64_t>(p.x) ^
                            std::rotl(std::bit_cast<std::uint64_t>(p.y), 21) ^
                            std::rotl(std::bit_cast<std::uint64_t>(p.z), 42);
    if (Random::mix(h) < below) sample.push_back(p);
  }
  return distinct_points(sample);
}

Fattening fattening_of(const Points& sample) {
  Fattening f;
  f.axes = principal_axes(sample).axes;
  DoubleBox box;
  for (const Double3& p : sample) box.grow(Double3{dot(p, f.axes[0]), dot(p, f.axes[1]), dot(p, f.axes[2])});
  const Double3 middle = box.centre();
  f.centre = f.axes[0] * middle.x + f.axes[1] * middle.y + f.axes[2] * middle.z;
  f.half = box.extent() * 0.5;
  return f;
}

double thickness(const Fattening& fat) {
  return std::min({fat.half.x, fat.half.y, fat.half.z});
}

// The first and the last of all points along each axis; of equals the first in lexicographic order.
void add_extremes(std::span<const Double3> points, const Axes& axes, Points& sample) {
  std::array<Double3, 6> extremes;
  extremes.fill(points.front());
  std::array<double, 6> most;
  most.fill(-std::numeric_limits<double>::infinity());
  for (const Double3& p : points) {
    for (std::size_t k = 0; k < 3; ++k) {
      const double along = dot(p, axes[k]);
      for (std::size_t side = 2 * k; side < 2 * k + 2; ++side) {
        const double t = side % 2 == 0 ? along : -along;
        if (t > most[side] || (t == most[side] && lexicographically_less(p, extremes[side])))
          most[side] = t, extremes[side] = p;
      }
    }
  }
  sample.insert(sample.end(), extremes.begin(), extremes.end());
  sample = distinct_points(sample);
}

// What the sample has missed may be all that makes the cloud thick: a mast on flat ground, a point far from a
// line. What lies farthest out of the sample's frame joins it, and once more out of what that makes of it.
Fattening fatten(std::span<const Double3> points, Points& sample) {
  constexpr int k_most = 3;
  Fattening fat = fattening_of(sample);
  for (int round = 0; round < k_most; ++round) {
    add_extremes(points, fat.axes, sample);
    fat = fattening_of(sample);
    if (thickness(fat) > k_thin) break;
  }
  return fat;
}

// A direction's place in the map: the side of a cube that it meets, and where.
struct Place {
  int side = 0;
  double x = 0, y = 0;  // in [-1, 1]
  int cell(int cells) const {
    const auto column = [&](double t) {
      return std::clamp(static_cast<int>((t + 1) / 2 * cells), 0, cells - 1);
    };
    return (side * cells + column(y)) * cells + column(x);
  }
};
Place place_of(const Double3& d) {
  const double ax = std::abs(d.x), ay = std::abs(d.y), az = std::abs(d.z);
  if (ax >= ay && ax >= az) return {d.x < 0 ? 1 : 0, d.y / ax, d.z / ax};
  if (ay >= az) return {d.y < 0 ? 3 : 2, d.z / ay, d.x / ay};
  return {d.z < 0 ? 5 : 4, d.x / az, d.y / az};
}
Double3 direction_of(const Place& p) {
  const double s = p.side % 2 == 0 ? 1 : -1;
  return p.side < 2 ? Double3{s, p.x, p.y} : p.side < 4 ? Double3{p.y, s, p.x} : Double3{p.x, p.y, s};
}

// The gauge of a polytope about a point inside it.
class Gauge {
 public:
  // Of the hull of the points; not valid() when that is too thin.
  explicit Gauge(Points points) {
    points = distinct_points(points);
    const ExactHull hull = exact_hull(points);
    if (hull.faces.empty()) return;
    for (const std::uint32_t v : hull.vertices) centre_ += points[v];
    centre_ = centre_ / static_cast<double>(hull.vertices.size());
    for (const auto& f : hull.faces) {
      const Double3 a = points[hull.vertices[f[0]]] - centre_, b = points[hull.vertices[f[1]]] - centre_,
                    c = points[hull.vertices[f[2]]] - centre_;
      const Double3 normal = cross(b - a, c - a);
      const double l = length(normal), height = dot(normal, a);
      if (l == 0) continue;
      if (height <= 1e-5 * l) return;
      facets_.push_back(normal / height);
    }
    for (int side = 0; side < 6; ++side) list_facets(side);
    first_.push_back(static_cast<std::uint32_t>(lists_.size()));
    valid_ = true;
  }

  bool valid() const { return valid_; }

  const Double3& centre() const { return centre_; }

  // Of a direction from the centre: below 1 inside.
  double at(const Double3& d) const {
    if (d == Double3{}) return 0;
    const int cell = place_of(d).cell(k_cells);
    double most = 0;
    for (std::uint32_t i = first_[cell]; i < first_[cell + 1]; ++i)
      most = std::max(most, dot(facets_[lists_[i]], d));
    return most;
  }

 private:
  // For each cell of a side the facets that are largest somewhere in it: a . x is linear over the cell, so
  // one that is nowhere as large as another's least corner is left out.
  void list_facets(int side) {
    constexpr int k_nodes = k_cells + 1;
    const std::size_t n = facets_.size();
    std::vector<double> at(n * k_nodes * k_nodes);
    for (std::size_t f = 0; f < n; ++f) {
      for (int j = 0; j < k_nodes; ++j) {
        for (int i = 0; i < k_nodes; ++i) {
          at[(f * k_nodes + j) * k_nodes + i] =
              dot(facets_[f], direction_of({side, 2. * i / k_cells - 1, 2. * j / k_cells - 1}));
        }
      }
    }
    for (int j = 0; j < k_cells; ++j) {
      for (int i = 0; i < k_cells; ++i) {
        const auto corners = [&](std::size_t f) {
          const double* c = &at[(f * k_nodes + j) * k_nodes + i];
          return std::minmax({c[0], c[1], c[k_nodes], c[k_nodes + 1]});
        };
        double least = -std::numeric_limits<double>::infinity();
        for (std::size_t f = 0; f < n; ++f) least = std::max(least, corners(f).first);
        first_.push_back(static_cast<std::uint32_t>(lists_.size()));
        for (std::size_t f = 0; f < n; ++f) {
          if (corners(f).second >= least) lists_.push_back(static_cast<std::uint32_t>(f));
        }
      }
    }
  }

  Double3 centre_;
  Points facets_;
  std::vector<std::uint32_t> first_, lists_;
  bool valid_ = false;
};

Points extremes_of(const Points& points) {
  static const std::vector<Double3> k_normals = kdop_normals(k_directions);
  Points extremes;
  for (const Double3& n : k_normals) {
    const auto along = [&](const Double3& a, const Double3& b) { return dot(a, n) < dot(b, n); };
    const auto [low, high] = std::minmax_element(points.begin(), points.end(), along);
    extremes.push_back(*low), extremes.push_back(*high);
  }
  return extremes;
}

// The farthest point of each cell of a map by its gauge; of equals the first in lexicographic order.
struct Farthest {
  std::vector<double> gauge = std::vector<double>(6 * k_coarse * k_coarse, -1);
  Points point = Points(gauge.size());
  void offer(const Double3& direction, double g, const Double3& p) {
    const int cell = place_of(direction).cell(k_coarse);
    if (g > gauge[cell] || (g == gauge[cell] && lexicographically_less(p, point[cell])))
      gauge[cell] = g, point[cell] = p;
  }
  Points points() const {
    Points out;
    for (std::size_t i = 0; i < gauge.size(); ++i) {
      if (gauge[i] >= 0) out.push_back(point[i]);
    }
    return out;
  }
};

// What is not inside, and the farthest of it in each direction.
Points filtered(std::span<const Double3> points, const Fattening& fat, const Gauge& gauge, double margin,
                Farthest& far) {
  Points kept;
  for (const Double3& p : points) {
    const Double3 direction = fat.in(p)-gauge.centre();
    const double g = gauge.at(direction);
    if (g < 1 - margin) continue;
    kept.push_back(p);
    far.offer(direction, g, p);
  }
  return kept;
}

Points in_fat(const Points& points, const Fattening& fat) {
  Points out;
  for (const Double3& p : points) out.push_back(fat.in(p));
  return out;
}

}  // namespace

std::vector<Double3> hull_candidates(std::span<const Double3> points) {
  if (points.size() <= k_few) return distinct_points(points);
  Points sample = sample_of(points);
  if (sample.size() < k_least_sample) {  // most points are others again
    const Points distinct = distinct_points(points);
    if (distinct.size() < points.size() / 2) return hull_candidates(distinct);
  }
  const Fattening fat = fatten(points, sample);
  const double thin = thickness(fat);
  if (!(thin > k_thin)) return distinct_points(points);
  const Points inner = extremes_of(in_fat(sample, fat));
  const Gauge first(inner);
  if (!first.valid()) return distinct_points(points);
  const double margin = k_margin + 1e-14 / thin;
  Farthest outer, ignored;
  Points kept = filtered(points, fat, first, margin, outer);
  if (kept.size() > k_worth) {
    Points wider = in_fat(outer.points(), fat);
    wider.insert(wider.end(), inner.begin(), inner.end());
    const Gauge second(wider);
    if (second.valid()) kept = filtered(kept, fat, second, margin, ignored);
  }
  return distinct_points(kept);
}

}  // namespace copse
