#include "lib/analysis/volumes/exact_hull.h"
#include "lib/analysis/volumes/point_cloud.h"

#include <algorithm>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

namespace copse {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Polyhedron = CGAL::Surface_mesh<Kernel::Point_3>;

std::uint32_t index_of(const Kernel::Point_3& p, std::span<const Double3> points) {
  const Double3 q{p.x(), p.y(), p.z()};
  const auto at = std::lower_bound(points.begin(), points.end(), q, lexicographically_less);
  return static_cast<std::uint32_t>(at - points.begin());
}

}  // namespace

ExactHull exact_hull(std::span<const Double3> points) {
  std::vector<Kernel::Point_3> copies;
  copies.reserve(points.size());
  for (const Double3& p : points) copies.emplace_back(p.x, p.y, p.z);
  Polyhedron polyhedron;
  CGAL::convex_hull_3(copies.begin(), copies.end(), polyhedron);
  ExactHull hull;
  if (polyhedron.number_of_faces() < 4) return hull;
  std::vector<std::uint32_t> of_point(points.size(), 0), point_of(polyhedron.number_of_vertices());
  for (const auto v : polyhedron.vertices()) {
    point_of[v] = index_of(polyhedron.point(v), points);
    hull.vertices.push_back(point_of[v]);
  }
  std::sort(hull.vertices.begin(), hull.vertices.end());
  for (std::uint32_t i = 0; i < hull.vertices.size(); ++i) of_point[hull.vertices[i]] = i;
  for (const auto f : polyhedron.faces()) {
    std::array<std::uint32_t, 3> face{};
    int n = 0;
    for (const auto v : CGAL::vertices_around_face(polyhedron.halfedge(f), polyhedron)) {
      if (n < 3) face[n++] = of_point[point_of[v]];
    }
    std::rotate(face.begin(), std::min_element(face.begin(), face.end()), face.end());
    hull.faces.push_back(face);
  }
  std::sort(hull.faces.begin(), hull.faces.end());
  return hull;
}

}  // namespace copse
