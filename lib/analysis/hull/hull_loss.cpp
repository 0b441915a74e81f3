#include "lib/analysis/hull/hull_loss.h"

#include "lib/analysis/surface/components.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <tuple>

namespace copse {
namespace {

constexpr double k_rounding = 1e-9;   // of the gauge
constexpr std::uint32_t k_many = 16;  // sides of a facet

// The facets of a hull: what lies in one plane is one, however many triangles it was cut into. Triangles of
// one plane have the same gauge, and a walk that stands amid them would see nothing better beside it.
struct Facets {
  struct Side {
    std::uint32_t from, to;  // facets
    double turn;  // of a facet of many sides: the angle at which the side begins, seen from its middle
  };
  struct Plane {
    Double3 middle, x, y;  // of a facet of many sides
  };
  std::vector<Double3> gauge;        // a with a . (p - middle) = 1 on the facet
  std::vector<std::uint32_t> first;  // sides of facet f: sides[first[f]] to sides[first[f + 1]]
  std::vector<Side> sides;           // of many: ascending by turn
  std::vector<Plane> planes;

  std::uint32_t count(std::uint32_t f) const { return first[f + 1] - first[f]; }
  bool has_many(std::uint32_t f) const { return count(f) > k_many; }

  // The side that the ray along d leaves the facet by lies at about this place among them.
  std::uint32_t side_towards(std::uint32_t f, const Double3& d, double gauge_of_d) const {
    const Double3 p = d / gauge_of_d - planes[f].middle;
    const double turn = std::atan2(dot(p, planes[f].y), dot(p, planes[f].x));
    const auto begin = sides.begin() + first[f], end = sides.begin() + first[f + 1];
    const auto after = std::upper_bound(begin, end, turn, [](double v, const Side& s) { return v < s.turn; });
    return static_cast<std::uint32_t>(after - begin) + count(f) - 1;
  }

  // The neighbour with the largest gauge, if it is larger: all neighbours are asked, or of many those next to
  // where the ray leaves the facet's plane; across that side lies what is larger, if anything is.
  std::uint32_t next(std::uint32_t at, const Double3& d, double& largest) const {
    std::uint32_t best = at, from = 0, asked = count(at);
    if (has_many(at) && largest > 0) from = side_towards(at, d, largest) - 1, asked = 3;
    for (std::uint32_t i = from; i < from + asked; ++i) {
      const std::uint32_t f = sides[first[at] + i % count(at)].to;
      if (dot(gauge[f], d) > largest) largest = dot(gauge[f], d), best = f;
    }
    return best;
  }
};

std::vector<std::uint32_t> facet_of_faces(const ConvexHull& hull, const std::vector<Double3>& gauge) {
  UnionFind planes(gauge.size());
  for (const HullEdge& e : hull.edges) {
    if (length(gauge[e.left] - gauge[e.right]) <= k_rounding * length(gauge[e.left]))
      planes.unite(e.left, e.right);
  }
  std::vector<std::uint32_t> facet(gauge.size());
  std::uint32_t facets = 0;
  for (std::uint32_t f = 0; f < gauge.size(); ++f)
    facet[f] = planes.find(f) == f ? facets++ : facet[planes.find(f)];
  return facet;
}

// Middles and axes of the facets that have many sides.
void find_planes(const ConvexHull& hull, const Double3& middle, const std::vector<std::uint32_t>& facet,
                 Facets& facets) {
  facets.planes.resize(facets.gauge.size());
  for (const HullEdge& e : hull.edges) {
    if (facet[e.left] == facet[e.right]) continue;
    const Double3 ends = hull.vertices[e.a] + hull.vertices[e.b] - middle * 2;
    for (const std::uint32_t f : {facet[e.left], facet[e.right]}) facets.planes[f].middle += ends;
  }
  for (std::uint32_t f = 0; f < facets.planes.size(); ++f) {
    if (!facets.has_many(f)) continue;
    Facets::Plane& plane = facets.planes[f];
    plane.middle = plane.middle / (2.0 * facets.count(f));
    const Double3 n = normalized(facets.gauge[f]);
    plane.x = normalized(cross(n, std::abs(n.x) < 0.6 ? Double3{1, 0, 0} : Double3{0, 1, 0}));
    plane.y = cross(n, plane.x);
  }
}

// The angle at which the side from a to b begins, going round with the angle.
double start_of(const Facets::Plane& plane, const Double3& a, const Double3& b) {
  const auto turn = [&](const Double3& p) {
    return std::atan2(dot(p - plane.middle, plane.y), dot(p - plane.middle, plane.x));
  };
  const double from = turn(a), to = turn(b);
  return (to > from) == (std::abs(to - from) < std::numbers::pi) ? from : to;
}

Facets facets_of(const ConvexHull& hull, const Double3& middle) {
  std::vector<Double3> gauge;
  for (const auto& f : hull.faces) {
    const Double3 a = hull.vertices[f[0]], normal = cross(hull.vertices[f[1]] - a, hull.vertices[f[2]] - a);
    gauge.push_back(normal / std::max(dot(normal, a - middle), 1e-300));
  }
  const std::vector<std::uint32_t> facet = facet_of_faces(hull, gauge);
  Facets facets;
  for (std::uint32_t f = 0; f < gauge.size(); ++f) {
    if (facet[f] == facets.gauge.size()) facets.gauge.push_back(gauge[f]);
  }
  facets.first.assign(facets.gauge.size() + 1, 0);
  for (const HullEdge& e : hull.edges) {
    if (facet[e.left] == facet[e.right]) continue;
    ++facets.first[facet[e.left] + 1], ++facets.first[facet[e.right] + 1];
  }
  std::partial_sum(facets.first.begin(), facets.first.end(), facets.first.begin());
  find_planes(hull, middle, facet, facets);
  for (const HullEdge& e : hull.edges) {
    const std::uint32_t l = facet[e.left], r = facet[e.right];
    if (l == r) continue;
    const Double3 a = hull.vertices[e.a] - middle, b = hull.vertices[e.b] - middle;
    facets.sides.push_back({l, r, facets.has_many(l) ? start_of(facets.planes[l], a, b) : 0});
    facets.sides.push_back({r, l, facets.has_many(r) ? start_of(facets.planes[r], a, b) : 0});
  }
  std::ranges::sort(facets.sides, [](const Facets::Side& a, const Facets::Side& b) {
    return std::tie(a.from, a.turn, a.to) < std::tie(b.from, b.turn, b.to);
  });
  return facets;
}

}  // namespace

double hull_loss(const ConvexHull& hull, std::span<const Double3> points) {
  Double3 middle;
  for (const Double3& v : hull.vertices) middle += v;
  middle = middle / static_cast<double>(hull.vertices.size());
  const Facets facets = facets_of(hull, middle);
  double loss = 0;
  std::uint32_t at = 0;
  for (const Double3& p : points) {
    const Double3 d = p - middle;
    double gauge = dot(facets.gauge[at], d);
    for (std::size_t step = 0; step < facets.gauge.size(); ++step) {
      const std::uint32_t next = facets.next(at, d, gauge);
      if (next == at) break;
      at = next;
    }
    if (gauge > 1) loss = std::max(loss, (1 - 1 / gauge) * length(d));  // p / gauge is in the hull
  }
  return loss;
}

}  // namespace copse
