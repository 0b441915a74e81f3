#include "bench/volumes_peers.h"
#include "lib/analysis/boxes/oriented_boxes.h"

#include <cmath>
#include <vector>

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Min_sphere_of_points_d_traits_3.h>
#include <CGAL/Min_sphere_of_spheres_d.h>
#include <CGAL/linear_least_squares_fitting_3.h>
#include <CGAL/optimal_bounding_box.h>

namespace copse {
namespace {
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
}  // namespace

struct CgalPeer::Points {
  std::vector<Kernel::Point_3> all;
  std::vector<Double3> ours;
};

CgalPeer::CgalPeer(std::span<const Double3> points) : points_(std::make_unique<Points>()) {
  for (const Double3& p : points) points_->all.emplace_back(p.x, p.y, p.z);
  points_->ours.assign(points.begin(), points.end());
}

CgalPeer::~CgalPeer() = default;

double CgalPeer::box_volume() const {
  std::array<Kernel::Point_3, 8> c;
  CGAL::oriented_bounding_box(points_->all, c);
  const auto l = [&](int i) { return std::sqrt(CGAL::to_double(CGAL::squared_distance(c[0], c[i]))); };
  return l(1) * l(3) * l(5);
}

BoundingSphere<double> CgalPeer::sphere() const {
  using Traits = CGAL::Min_sphere_of_points_d_traits_3<Kernel, double>;
  CGAL::Min_sphere_of_spheres_d<Traits> ball(points_->all.begin(), points_->all.end());
  const auto c = ball.center_cartesian_begin();
  return {{c[0], c[1], c[2]}, ball.radius()};
}

OrientedBox<double> CgalPeer::principal_box() const {
  const auto& points = points_->all;
  Kernel::Line_3 line;
  Kernel::Plane_3 plane;
  CGAL::linear_least_squares_fitting_3(points.begin(), points.end(), line, CGAL::Dimension_tag<0>());
  CGAL::linear_least_squares_fitting_3(points.begin(), points.end(), plane, CGAL::Dimension_tag<0>());
  const auto u = line.to_vector();
  const auto n = plane.orthogonal_vector();
  const Double3 along{u.x(), u.y(), u.z()}, across{n.x(), n.y(), n.z()};
  return box_in_axes(points_->ours, axes_along(along, cross(across, along)));
}

}  // namespace copse
