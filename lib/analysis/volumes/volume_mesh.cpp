#include "lib/analysis/volumes/volume_mesh.h"

#include "lib/analysis/hull/convex_hull.h"

#include <array>
#include <cmath>
#include <numbers>

namespace copse {
namespace {

// A box whose edges and corners are rounded: with some half extents 0 it is a lozenge, a capsule or a ball,
// with radius 0 a box.
struct RoundedBox {
  Double3 centre;
  std::array<Double3, 3> axes;  // right-handed
  Double3 half;
  Double3 radii;  // along the axes: unequal ones make an ellipsoid
};

void add_triangle(VolumeMesh& mesh, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
  const Double3 &p = mesh.positions[a], &q = mesh.positions[b], &r = mesh.positions[c];
  if (p == q || q == r || r == p) return;
  mesh.triangles.push_back({a, b, c});
}

// Rows of latitude from the top down and columns round axis 1, where every quadrant and either half has its
// own seam: what lies between two seams is stretched flat by the half extents.
VolumeMesh mesh_of(const RoundedBox& box, int steps) {
  VolumeMesh mesh;
  const int columns = 4 * (steps + 1), rows = 2 * (steps + 1);
  constexpr std::array<int, 4> k_sign0{1, -1, -1, 1}, k_sign2{1, 1, -1, -1};
  constexpr double k_quarter = std::numbers::pi / 2;
  for (int row = 0; row < rows; ++row) {
    const int half = row / (steps + 1), step = row % (steps + 1);
    const double latitude = half == 0 ? k_quarter * (1 - double(step) / steps) : -k_quarter * step / steps;
    for (int column = 0; column < columns; ++column) {
      const auto quadrant = static_cast<std::size_t>(column / (steps + 1));
      const double longitude = k_quarter * (double(quadrant) + double(column % (steps + 1)) / steps);
      const Double3 n{std::cos(latitude) * std::cos(longitude), std::sin(latitude),
                      std::cos(latitude) * std::sin(longitude)};
      const Double3 corner{k_sign0[quadrant] * box.half.x, (half == 0 ? 1 : -1) * box.half.y,
                           k_sign2[quadrant] * box.half.z};
      Double3 p = box.centre;
      for (int i = 0; i < 3; ++i)
        p += box.axes[static_cast<std::size_t>(i)] * (corner[i] + n[i] * box.radii[i]);
      mesh.positions.push_back(p);
    }
  }
  const auto at = [&](int row, int column) {
    return static_cast<std::uint32_t>(row * columns + column % columns);
  };
  for (int row = 0; row + 1 < rows; ++row) {
    for (int column = 0; column < columns; ++column) {
      add_triangle(mesh, at(row, column), at(row, column + 1), at(row + 1, column));
      add_triangle(mesh, at(row, column + 1), at(row + 1, column + 1), at(row + 1, column));
    }
  }
  const int quadrant = steps + 1;
  for (const int row : {0, rows - 1}) {  // the flat top and bottom
    const std::uint32_t a = at(row, 0), b = at(row, quadrant), c = at(row, 2 * quadrant),
                        d = at(row, 3 * quadrant);
    if (row == 0) {
      add_triangle(mesh, a, c, b), add_triangle(mesh, a, d, c);
    } else {
      add_triangle(mesh, a, b, c), add_triangle(mesh, a, c, d);
    }
  }
  return mesh;
}

std::array<Double3, 3> frame_along(const Double3& u) {
  const Double3 axis = normalized(u, {1, 0, 0});
  const Double3 side = std::abs(axis.x) < 0.6 ? Double3{1, 0, 0} : Double3{0, 0, 1};
  const Double3 v = normalized(cross(axis, side));
  return {axis, v, cross(axis, v)};
}

struct Mesher {
  int steps;
  VolumeMesh operator()(const DoubleBox& v) const {
    const Double3 half = v.extent() * 0.5;
    return mesh_of({v.centre(), {Double3{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, half, {}}, 1);
  }
  VolumeMesh operator()(const BoundingSphere<double>& v) const {
    return mesh_of({v.centre, frame_along({1, 0, 0}), {}, {v.radius, v.radius, v.radius}}, steps);
  }
  VolumeMesh operator()(const OrientedBox<double>& v) const {
    std::array<Double3, 3> axes = v.axes;
    if (dot(cross(axes[0], axes[1]), axes[2]) < 0) axes[2] = -axes[2];
    return mesh_of({v.centre, axes, v.half_extents, {}}, 1);
  }
  VolumeMesh operator()(const Capsule<double>& v) const {
    const Double3 d = v.b - v.a;
    return mesh_of({(v.a + v.b) * 0.5, frame_along(d), {length(d) / 2, 0, 0}, {v.radius, v.radius, v.radius}},
                   steps);
  }
  VolumeMesh operator()(const Lozenge<double>& v) const {
    const Double3 u = length(v.edge0) > 0 ? normalized(v.edge0) : frame_along(v.edge1)[1];
    const Double3 w = length(v.edge1) > 0 ? normalized(v.edge1 - u * dot(u, v.edge1), frame_along(u)[2])
                                          : frame_along(u)[2];
    return mesh_of({v.origin + (v.edge0 + v.edge1) * 0.5,
                    {u, cross(w, u), w},
                    {length(v.edge0) / 2, 0, length(v.edge1) / 2},
                    {v.radius, v.radius, v.radius}},
                   steps);
  }
  VolumeMesh operator()(const Ellipsoid<double>& v) const {
    std::array<Double3, 3> axes = v.axes;
    if (dot(cross(axes[0], axes[1]), axes[2]) < 0) axes[2] = -axes[2];
    return mesh_of({v.centre, axes, {}, v.semi_axes}, steps);
  }
  VolumeMesh operator()(const Cylinder<double>& v) const {
    VolumeMesh mesh;
    const std::array<Double3, 3> axes = frame_along(v.b - v.a);
    const int sides = 4 * steps;
    for (const Double3& end : {v.a, v.b}) {
      for (int i = 0; i < sides; ++i) {
        const double t = 2 * std::numbers::pi * i / sides;
        mesh.positions.push_back(end + axes[1] * (v.radius * std::cos(t)) +
                                 axes[2] * (v.radius * std::sin(t)));
      }
    }
    const auto n = static_cast<std::uint32_t>(sides);
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t j = (i + 1) % n;
      add_triangle(mesh, i, j, n + i), add_triangle(mesh, j, n + j, n + i);
      if (i > 0 && j > 0) add_triangle(mesh, 0, j, i), add_triangle(mesh, n, n + i, n + j);
    }
    return mesh;
  }
  // The corners are where three planes meet inside all others; few planes, so all triples are tried.
  VolumeMesh operator()(const Kdop<double>& v) const {
    struct Plane {
      Double3 normal;
      double offset;
    };
    std::vector<Plane> planes;
    double size = 0;
    for (std::size_t i = 0; i < v.normals.size(); ++i) {
      const double l = length(v.normals[i]);
      planes.push_back({v.normals[i] / l, v.max[i] / l});
      planes.push_back({-v.normals[i] / l, -v.min[i] / l});
      size = std::max({size, std::abs(v.min[i] / l), std::abs(v.max[i] / l)});
    }
    std::vector<Double3> corners;
    for (std::size_t i = 0; i < planes.size(); ++i) {
      for (std::size_t j = i + 1; j < planes.size(); ++j) {
        for (std::size_t k = j + 1; k < planes.size(); ++k) {
          const Double3 &a = planes[i].normal, &b = planes[j].normal, &c = planes[k].normal;
          const double det = dot(a, cross(b, c));
          if (std::abs(det) < 1e-9) continue;
          const Double3 p = (cross(b, c) * planes[i].offset + cross(c, a) * planes[j].offset +
                             cross(a, b) * planes[k].offset) /
                            det;
          bool inside = true;
          for (const Plane& q : planes) inside &= dot(q.normal, p) <= q.offset + 1e-9 * size;
          if (inside) corners.push_back(p);
        }
      }
    }
    const auto cloud = make_point_cloud(corners);
    if (!cloud) return {};
    const ConvexHull hull = convex_hull(*cloud);
    VolumeMesh mesh;
    for (const Double3& p : hull.vertices) mesh.positions.push_back(hull.frame.out(p));
    for (const auto& f : hull.faces) mesh.triangles.push_back(f);
    return mesh;
  }
};

}  // namespace

VolumeMesh volume_mesh(const Volume<double>& volume, int steps) {
  return std::visit(Mesher{steps}, volume);
}

}  // namespace copse
