#include "tools/treegrow/surface.h"

#include <cmath>

namespace copse::grow {
namespace {

// The multiple of `step` nearest to v. Divides by 1 / step, a whole number for the steps in use: the quotient
// is then the double nearest to the decimal number, and prints as short as that.
double rounded(double v, double step) {
  if (step <= 0) return v;
  if (step >= 1) return std::nearbyint(v / step) * step;
  const double per_unit = std::nearbyint(1 / step);
  return std::nearbyint(v * per_unit) / per_unit;
}

}  // namespace

Double3 Placement::apply(const Double3& p) const {
  const Double3 q = turn(p + offset) * scale;
  return {rounded(q.x, step), rounded(q.y, step), rounded(q.z, step)};
}

Double3 Placement::undo(const Double3& p) const {
  const Double3 q = p / scale;
  return (z_up ? Double3{q.x, q.z, -q.y} : q) - offset;
}

std::uint32_t Surface::vertex(const Double3& position, const Double3& normal) {
  mesh_.positions.push_back(placement_.apply(position));
  mesh_.normals.push_back(to_float(placement_.turn(normal)));
  return static_cast<std::uint32_t>(mesh_.positions.size() - 1);
}

std::uint32_t Surface::twin(std::uint32_t of, const Double3& apart) {
  const Double3 p = mesh_.positions[of];
  const Float3 n = mesh_.normals[of];
  const Double3 q = apart == Double3{} ? p : placement_.apply(placement_.undo(p) + apart);
  mesh_.positions.push_back(q);
  mesh_.normals.push_back(n);
  return static_cast<std::uint32_t>(mesh_.positions.size() - 1);
}

std::uint32_t Surface::texcoord(double u, double v) {
  mesh_.texcoords.push_back({static_cast<float>(u), static_cast<float>(v)});
  return static_cast<std::uint32_t>(mesh_.texcoords.size() - 1);
}

void Surface::push(const std::array<std::uint32_t, 3>& v, const std::array<std::uint32_t, 3>& t) {
  mesh_.triangles.push_back(v);
  mesh_.texcoord_triangles.push_back(t);
  mesh_.part_of.push_back(part_);
  mesh_.face_of.push_back(faces_);
}

void Surface::triangle(const std::array<std::uint32_t, 3>& v, const std::array<std::uint32_t, 3>& t) {
  push(v, t);
  ++faces_;
}

void Surface::quad(const std::array<std::uint32_t, 4>& v, const std::array<std::uint32_t, 4>& t) {
  push({v[0], v[1], v[2]}, {t[0], t[1], t[2]});
  if (!quads_) ++faces_;
  push({v[0], v[2], v[3]}, {t[0], t[2], t[3]});
  ++faces_;
}

void Surface::polygon(std::span<const std::uint32_t> v, std::span<const std::uint32_t> t) {
  for (std::size_t i = 1; i + 1 < v.size(); ++i) push({v[0], v[i], v[i + 1]}, {t[0], t[i], t[i + 1]});
  ++faces_;
}

void Surface::reserve(std::uint64_t triangles) {
  mesh_.triangles.reserve(triangles);
  mesh_.texcoord_triangles.reserve(triangles);
  mesh_.part_of.reserve(triangles);
  mesh_.face_of.reserve(triangles);
}

Mesh Surface::finish() {
  mesh_.normal_triangles = mesh_.triangles;
  return std::move(mesh_);
}

}  // namespace copse::grow
