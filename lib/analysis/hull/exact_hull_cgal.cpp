#include "lib/analysis/hull/exact_hull.h"
#include "lib/analysis/hull/quickhull.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

namespace copse {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;

using Face = std::array<std::uint32_t, 3>;

// The facets of the hull: what of its triangles lies in one plane.
class Facets {
 public:
  Facets(const std::vector<Kernel::Point_3>& points, HullTriangles hull)
      : points_(points), faces_(std::move(hull.faces)), group_(faces_.size()) {
    std::iota(group_.begin(), group_.end(), 0u);
    for (std::uint32_t f = 0; f < faces_.size(); ++f) {
      for (const std::uint32_t g : hull.neighbours[f]) {
        if (f < g) join(f, g);
      }
    }
  }

  // The corners of every facet, counter-clockwise from outside, the least first: no more than they must be.
  std::vector<std::vector<std::uint32_t>> polygons() {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> members;
    for (std::uint32_t f = 0; f < faces_.size(); ++f) members.push_back({root(f), f});
    std::sort(members.begin(), members.end());
    std::vector<std::vector<std::uint32_t>> out;
    for (std::size_t i = 0; i < members.size();) {
      std::vector<std::uint32_t> faces;
      for (const std::uint32_t first = members[i].first; i < members.size() && members[i].first == first;
           ++i) {
        faces.push_back(members[i].second);
      }
      out.push_back(polygon(faces));
    }
    return out;
  }

 private:
  std::uint32_t root(std::uint32_t f) {
    while (group_[f] != f) f = group_[f] = group_[group_[f]];
    return f;
  }
  void join(std::uint32_t f, std::uint32_t g) {
    const Face &a = faces_[f], &b = faces_[g];
    for (const std::uint32_t v : b) {
      if (!CGAL::coplanar(points_[a[0]], points_[a[1]], points_[a[2]], points_[v])) return;
    }
    const std::uint32_t x = root(f), y = root(g);
    group_[std::max(x, y)] = std::min(x, y);
  }

  // Andrew's monotone chain in the plane of the two axes across which the facet is seen best. What is
  // strictly to the left stays, so that points on edges go.
  std::vector<std::uint32_t> polygon(const std::vector<std::uint32_t>& faces) const {
    std::vector<std::uint32_t> corners;
    for (const std::uint32_t f : faces) corners.insert(corners.end(), faces_[f].begin(), faces_[f].end());
    std::sort(corners.begin(), corners.end());
    corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
    if (corners.size() == 3)
      return {corners.front(), after(faces.front(), corners.front(), 1),
              after(faces.front(), corners.front(), 2)};
    const int drop = dropped_axis(faces.front());
    const CGAL::Orientation left = turn(faces_[faces.front()], drop);
    std::sort(corners.begin(), corners.end(),
              [&](std::uint32_t a, std::uint32_t b) { return flat_point(a, drop) < flat_point(b, drop); });
    std::vector<std::uint32_t> chain;
    const auto add = [&](std::uint32_t v, std::size_t least) {
      while (chain.size() >= least + 2 &&
             turn({chain[chain.size() - 2], chain.back(), v}, drop) != CGAL::LEFT_TURN) {
        chain.pop_back();
      }
      chain.push_back(v);
    };
    for (const std::uint32_t v : corners) add(v, 0);
    const std::size_t lower = chain.size() - 1;
    for (auto v = corners.rbegin() + 1; v != corners.rend(); ++v) add(*v, lower);
    chain.pop_back();
    if (left != CGAL::LEFT_TURN) std::reverse(chain.begin(), chain.end());
    std::rotate(chain.begin(), std::min_element(chain.begin(), chain.end()), chain.end());
    return chain;
  }

  std::uint32_t after(std::uint32_t f, std::uint32_t vertex, std::size_t steps) const {
    const Face& face = faces_[f];
    const auto at = static_cast<std::size_t>(std::find(face.begin(), face.end(), vertex) - face.begin());
    return face[(at + steps) % 3];
  }
  Kernel::Point_2 flat_point(std::uint32_t v, int drop) const {
    const Kernel::Point_3& p = points_[v];
    return {p[(drop + 1) % 3], p[(drop + 2) % 3]};
  }
  CGAL::Orientation turn(const Face& t, int drop) const {
    return CGAL::orientation(flat_point(t[0], drop), flat_point(t[1], drop), flat_point(t[2], drop));
  }
  // An axis along which the facet is not seen from its edge; exact, the first that does.
  int dropped_axis(std::uint32_t f) const {
    for (int axis = 0; axis < 2; ++axis) {
      if (turn(faces_[f], axis) != CGAL::COLLINEAR) return axis;
    }
    return 2;
  }

  const std::vector<Kernel::Point_3>& points_;
  std::vector<Face> faces_;
  std::vector<std::uint32_t> group_;
};

}  // namespace

ExactHull exact_hull(std::span<const Double3> points, const QuickhullLimits& limits) {
  std::vector<Kernel::Point_3> copies;
  copies.reserve(points.size());
  for (const Double3& p : points) copies.emplace_back(p.x, p.y, p.z);
  HullTriangles triangles = quickhull(points, limits);
  ExactHull hull;
  if (triangles.faces.empty()) return hull;
  hull.outside = std::move(triangles.outside);
  const auto polygons = Facets(copies, std::move(triangles)).polygons();
  for (const auto& polygon : polygons)
    hull.vertices.insert(hull.vertices.end(), polygon.begin(), polygon.end());
  std::sort(hull.vertices.begin(), hull.vertices.end());
  hull.vertices.erase(std::unique(hull.vertices.begin(), hull.vertices.end()), hull.vertices.end());
  std::vector<std::uint32_t> of_point(points.size(), 0);
  for (std::uint32_t i = 0; i < hull.vertices.size(); ++i) of_point[hull.vertices[i]] = i;
  for (const auto& polygon : polygons) {
    for (std::size_t i = 2; i < polygon.size(); ++i) {
      hull.faces.push_back({of_point[polygon[0]], of_point[polygon[i - 1]], of_point[polygon[i]]});
    }
  }
  std::sort(hull.faces.begin(), hull.faces.end());
  return hull;
}

}  // namespace copse
