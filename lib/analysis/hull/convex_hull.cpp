#include "lib/analysis/hull/convex_hull.h"

#include "lib/analysis/hull/exact_hull.h"
#include "lib/analysis/hull/farthest.h"
#include "lib/analysis/hull/frame.h"
#include "lib/analysis/hull/hull_candidates.h"
#include "lib/analysis/hull/hull_loss.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <span>

namespace copse {
namespace {

// Points of a tilted line or plane leave it by a few roundings of their coordinates, 2^-53 of the size each.
constexpr double k_flat = 0x1p-46;

using Points = std::span<const Double3>;

// Dimension and axes: the longest of a few distances, what is farthest from that line, from that plane.
void find_dimension(Points points, ConvexHull& hull) {
  const Double3 first = points.front();
  const Double3 p = points[farthest(points, [&](const Double3& q) { return dot(q - first, q - first); })];
  const Double3 r = points[farthest(points, [&](const Double3& q) { return dot(q - p, q - p); })];
  const Double3 along = r - p;
  const double size = length(along);
  if (!(size > 0)) return;
  const Double3 u = along / size;
  const auto off_line = [&](const Double3& q) {
    const Double3 d = q - p, away = d - u * dot(d, u);
    return dot(away, away);
  };
  const Double3 s = points[farthest(points, off_line)] - p;
  const Double3 away = s - u * dot(s, u);
  hull.dimension = 1;
  hull.axes[0] = u, hull.axes[1] = any_normal(u), hull.axes[2] = cross(u, hull.axes[1]);
  if (length(away) <= k_flat * size) return;
  const Double3 w = normalized(cross(u, away));
  hull.dimension = 2;
  hull.axes[1] = cross(w, u), hull.axes[2] = w;
  const auto off_plane = [&](const Double3& q) { return std::abs(dot(q - p, w)); };
  if (off_plane(points[farthest(points, off_plane)]) > k_flat * size) hull.dimension = 3;
}

void hull_of_line(Points points, ConvexHull& hull) {
  const auto along = [&](const Double3& a, const Double3& b) { return dot(a - b, hull.axes[0]) < 0; };
  const auto [low, high] = std::minmax_element(points.begin(), points.end(), along);
  hull.vertices = {*low, *high};
  std::sort(hull.vertices.begin(), hull.vertices.end(), lexicographically_less);
}

// Andrew's monotone chain in the plane's coordinates; near-collinear points are a rounding matter and may go.
void hull_of_plane(Points points, ConvexHull& hull) {
  struct Flat {
    double u, v;
    std::uint32_t point;
  };
  std::vector<Flat> flat;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const Double3 d = points[i] - points[0];
    flat.push_back({dot(d, hull.axes[0]), dot(d, hull.axes[1]), i});
  }
  std::sort(flat.begin(), flat.end(), [](const Flat& a, const Flat& b) {
    return a.u != b.u ? a.u < b.u : a.v != b.v ? a.v < b.v : a.point < b.point;
  });
  std::vector<Flat> chain;
  const auto add = [&](const Flat& f, std::size_t floor) {
    const auto turns_right = [&] {
      const Flat &a = chain[chain.size() - 2], &b = chain.back();
      return (b.u - a.u) * (f.v - a.v) - (b.v - a.v) * (f.u - a.u) <= 0;
    };
    while (chain.size() >= floor + 2 && turns_right()) chain.pop_back();
    chain.push_back(f);
  };
  for (const Flat& f : flat) add(f, 0);
  const std::size_t floor = chain.size() - 1;
  for (std::size_t i = flat.size() - 1; i-- > 0;) add(flat[i], floor);
  chain.pop_back();  // the first again
  std::vector<std::uint32_t> sorted;
  for (const Flat& f : chain) sorted.push_back(f.point);
  std::sort(sorted.begin(), sorted.end());
  const auto place = [&](std::uint32_t point) {
    return static_cast<std::uint32_t>(std::lower_bound(sorted.begin(), sorted.end(), point) - sorted.begin());
  };
  for (const std::uint32_t i : sorted) hull.vertices.push_back(points[i]);
  for (std::size_t i = 0; i < chain.size(); ++i) {
    const std::uint32_t a = place(chain[i].point), b = place(chain[(i + 1) % chain.size()].point);
    hull.edges.push_back({std::min(a, b), std::max(a, b), 0, 0});
  }
  const auto before = [](const HullEdge& e, const HullEdge& f) { return e.a != f.a ? e.a < f.a : e.b < f.b; };
  std::sort(hull.edges.begin(), hull.edges.end(), before);
}

void find_edges(ConvexHull& hull) {
  for (std::uint32_t f = 0; f < hull.faces.size(); ++f) {
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t a = hull.faces[f][i], b = hull.faces[f][(i + 1) % 3];
      hull.edges.push_back(a < b ? HullEdge{a, b, f, f} : HullEdge{b, a, f, f});
    }
  }
  std::sort(hull.edges.begin(), hull.edges.end(), [](const HullEdge& e, const HullEdge& f) {
    return e.a != f.a ? e.a < f.a : e.b != f.b ? e.b < f.b : e.left < f.left;
  });
  // Each edge is there twice, once a side.
  for (std::size_t i = 0; i < hull.edges.size() / 2; ++i) {
    hull.edges[i] = hull.edges[2 * i];
    hull.edges[i].right = hull.edges[2 * i + 1].left;
    const auto& face = hull.faces[hull.edges[i].left];
    // The face on the left runs from a to b.
    const bool forward = (face[0] == hull.edges[i].a && face[1] == hull.edges[i].b) ||
                         (face[1] == hull.edges[i].a && face[2] == hull.edges[i].b) ||
                         (face[2] == hull.edges[i].a && face[0] == hull.edges[i].b);
    if (!forward) std::swap(hull.edges[i].left, hull.edges[i].right);
  }
  hull.edges.resize(hull.edges.size() / 2);
}

void measure(ConvexHull& hull) {
  constexpr double k_of_faces = 16 * 0x1p-53, k_of_points = 0x1p-52;
  const Double3& apex = hull.vertices.front();
  double sizes = 0;
  for (const auto& f : hull.faces) {
    const Double3 a = hull.vertices[f[0]] - apex, b = hull.vertices[f[1]] - apex,
                  c = hull.vertices[f[2]] - apex;
    const Double3 normal = cross(b - a, c - a);
    hull.area += length(normal) / 2;
    hull.volume += dot(normal, a) / 6;
    sizes += length(b - a) * length(c - a) * length(a);
  }
  hull.least_volume = std::max(0.0, hull.volume * (1 - 1e-12) - k_of_faces * sizes - k_of_points * hull.area);
}

// Where the hull is cut short what is outside it is told.
void hull_of_space(Points points, const HullOptions& options, ConvexHull& hull) {
  const ExactHull exact = exact_hull(points, {options.max_corners, k_least_corners, options.deadline});
  for (const std::uint32_t i : exact.vertices) hull.vertices.push_back(points[i]);
  hull.faces = exact.faces;
  find_edges(hull);
  measure(hull);
  if (exact.outside.empty()) return;
  for (const std::uint32_t i : exact.outside) hull.boundary.push_back(points[i]);
  hull.loss = options.deadline.has_passed() ? std::numeric_limits<double>::infinity()
                                            : std::max(hull_loss(hull, hull.boundary),
                                                       0x1p-52);  // they are outside, if only by a rounding
  hull.boundary.insert(hull.boundary.end(), hull.vertices.begin(), hull.vertices.end());
  std::sort(hull.boundary.begin(), hull.boundary.end(), lexicographically_less);
}

// The first of the caller's points at each vertex. Most points are sorted out by one bit of a table.
void find_indices(Points all, ConvexHull& hull) {
  constexpr auto k_none = static_cast<std::uint32_t>(-1);
  const std::size_t size = std::bit_ceil(hull.vertices.size() * 16), mask = size - 1;
  const auto slot = [&](const Double3& p) {
    return (std::bit_cast<std::uint64_t>(p.x) * 0x9e3779b97f4a7c15u + std::bit_cast<std::uint64_t>(p.y)) *
                   0xbf58476d1ce4e5b9u >>
               32 &
           mask;
  };
  std::vector<char> met(size, 0);
  for (const Double3& v : hull.vertices) met[slot(v)] = 1;
  hull.indices.assign(hull.vertices.size(), k_none);
  for (std::uint32_t i = 0; i < all.size(); ++i) {
    if (!met[slot(all[i])]) continue;
    const auto at =
        std::lower_bound(hull.vertices.begin(), hull.vertices.end(), all[i], lexicographically_less);
    if (at == hull.vertices.end() || *at != all[i]) continue;
    std::uint32_t& index = hull.indices[at - hull.vertices.begin()];
    if (index == k_none) index = i;
  }
}

}  // namespace

ConvexHull convex_hull(const PointCloud& cloud, const HullOptions& options) {
  ConvexHull hull;
  hull.frame = cloud.frame;
  hull.box = cloud.box;
  const std::vector<Double3> candidates = hull_candidates(cloud.points);
  find_dimension(candidates, hull);
  if (hull.dimension == 0) hull.vertices = {candidates.front()};
  if (hull.dimension == 1) hull_of_line(candidates, hull);
  if (hull.dimension == 2) hull_of_plane(candidates, hull);
  if (hull.dimension == 3) hull_of_space(candidates, options, hull);
  if (hull.boundary.empty()) hull.boundary = hull.vertices;
  find_indices(cloud.points, hull);
  return hull;
}

double inner_radius(const ConvexHull& hull) {
  if (hull.dimension < 3) return 0;
  Double3 middle;
  for (const Double3& v : hull.vertices) middle += v;
  middle = middle / static_cast<double>(hull.vertices.size());
  double least = std::numeric_limits<double>::infinity();
  for (const auto& f : hull.faces) {
    const Double3 &a = hull.vertices[f[0]], u = hull.vertices[f[1]] - a, v = hull.vertices[f[2]] - a;
    const Double3 normal = cross(u, v), w = a - middle;
    // What the differences, the products and their sums can lose.
    const double lost = 64 * 0x1p-53 * length(u) * length(v);
    least = std::min(least, (dot(normal, w) - lost * length(w)) / (length(normal) + lost));
  }
  return std::max(0.0, least * (1 - 1e-12));
}

}  // namespace copse
