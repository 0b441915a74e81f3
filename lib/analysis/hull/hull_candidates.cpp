#include "lib/analysis/hull/hull_candidates.h"

#include "lib/analysis/boxes/kdop.h"
#include "lib/analysis/hull/exact_hull.h"
#include "lib/analysis/hull/point_cloud.h"
#include "lib/analysis/hull/principal_axes.h"
#include "lib/formats/random.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace copse {
namespace {

constexpr std::size_t k_few = 4000;     // points for which the hull itself is quicker
constexpr std::size_t k_sample = 1024;  // points, about
constexpr int k_directions = 96;        // along which the sample's extremes are taken
constexpr int k_cells = 16;             // along a side of the map: 6 * 16^2 cells
constexpr std::size_t k_worth = 2000;   // survivors for which a second pass pays
constexpr double k_thin = 1e-10;        // of the size: thinner clouds are not filtered
constexpr double k_margin = 1e-9;       // of the gauge, and more for thin clouds: rounding

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
      if (height <= 1e-3 * l) return;
      facets_.push_back(normal / height);
    }
    for (int side = 0; side < 6; ++side) list_facets(side);
    first_.push_back(static_cast<std::uint32_t>(lists_.size()));
    valid_ = true;
  }

  bool valid() const { return valid_; }

  // Below 1 inside. `cell` is the place of x in a map of k_cells, `fine` in one of `fine_cells`.
  double at(const Double3& x, int fine_cells, int& fine) const {
    const Double3 d = x - centre_;
    if (d == Double3{}) return 0;
    const Place place = place_of(d);
    fine = place.cell(fine_cells);
    const int cell = place.cell(k_cells);
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
  explicit Farthest(int cells) : gauge(6 * cells * cells, -1), point(gauge.size()) {}
  std::vector<double> gauge;
  Points point;
  void offer(int cell, double g, const Double3& p) {
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
                Farthest& far, int cells) {
  Points kept;
  for (const Double3& p : points) {
    int cell = 0;
    const double g = gauge.at(fat.in(p), cells, cell);
    if (g < 1 - margin) continue;
    kept.push_back(p);
    far.offer(cell, g, p);
  }
  return kept;
}

Points in_fat(const Points& points, const Fattening& fat) {
  Points out;
  for (const Double3& p : points) out.push_back(fat.in(p));
  return out;
}

}  // namespace

HullCandidates hull_candidates(std::span<const Double3> points, std::size_t limit) {
  const auto unfiltered = [&] {
    HullCandidates c{distinct_points(points), {}};
    c.chosen = c.all;
    return c;
  };
  if (points.size() <= std::min(k_few, limit)) return unfiltered();
  const Points sample = sample_of(points);
  if (sample.size() < 64) return unfiltered();
  const Fattening fat = fattening_of(sample);
  const double thin = std::min({fat.half.x, fat.half.y, fat.half.z});
  if (!(thin > k_thin)) return unfiltered();
  const double margin = k_margin + 1e-14 / thin;

  const Points inner = extremes_of(in_fat(sample, fat));
  const Gauge first(inner);
  if (!first.valid()) return unfiltered();
  Farthest outer(k_cells / 2);
  Points kept = filtered(points, fat, first, margin, outer, k_cells / 2);
  const int fine = std::max(1, static_cast<int>(std::sqrt(static_cast<double>(limit) / 6)));
  Farthest finest(fine);
  if (kept.size() > std::min(k_worth, limit)) {
    Points wider = in_fat(outer.points(), fat);
    wider.insert(wider.end(), inner.begin(), inner.end());
    const Gauge second(wider);
    if (second.valid()) kept = filtered(kept, fat, second, margin, finest, fine);
  }
  HullCandidates found{distinct_points(kept), {}};
  const bool many = found.all.size() > limit && finest.points().size() > 3;
  found.chosen = many ? distinct_points(finest.points()) : found.all;
  return found;
}

}  // namespace copse
