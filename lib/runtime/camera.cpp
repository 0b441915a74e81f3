#include "lib/runtime/camera.h"

#include <algorithm>
#include <numbers>

namespace copse {

bool is_valid(const Camera& camera) {
  const double d = distance(camera.eye, camera.target);
  return is_finite(camera.eye) && is_finite(camera.target) && is_finite(camera.up) && std::isfinite(d) &&
         d > 0 && camera.fov > 0 && camera.fov < std::numbers::pi;
}

CameraFrame frame_of(const Camera& camera) {
  CameraFrame f;
  f.back = normalized(camera.eye - camera.target, {0, 0, 1});
  Double3 right = cross(normalized(camera.up), f.back);
  // Looking along the wished-for up: the axis that is most perpendicular to the line of sight takes its
  // place.
  if (length(right) < 1e-9)
    right = cross(std::abs(f.back.z) < 0.9 ? Double3{0, 0, -1} : Double3{0, 1, 0}, f.back);
  f.right = normalized(right, {1, 0, 0});
  f.up = cross(f.back, f.right);
  return f;
}

View make_view(const Camera& camera, double aspect, double near_plane, double far_plane) {
  View v;
  v.eye = camera.eye;
  v.frame = frame_of(camera);
  v.rotation = rotation_into(v.frame.right, v.frame.up, v.frame.back);
  v.tan_half_y = std::tan(camera.fov / 2);
  v.tan_half_x = v.tan_half_y * aspect;
  v.near_plane = near_plane;
  v.far_plane = far_plane;
  v.projection = perspective(-v.tan_half_x, v.tan_half_x, -v.tan_half_y, v.tan_half_y, near_plane, far_plane);
  return v;
}

Frustum frustum_of(const View& view) {
  const CameraFrame& f = view.frame;
  const auto side = [&](const Double3& axis, double tan_half) {
    return Plane{normalized(axis - f.back * tan_half), 0};
  };
  return {side(f.right, view.tan_half_x), side(-f.right, view.tan_half_x),  side(f.up, view.tan_half_y),
          side(-f.up, view.tan_half_y),   Plane{-f.back, -view.near_plane}, Plane{f.back, view.far_plane}};
}

Visibility classify(const Plane& p, const Double3& centre, const Double3& half) {
  const double reach =
      std::abs(p.normal.x) * half.x + std::abs(p.normal.y) * half.y + std::abs(p.normal.z) * half.z;
  const double d = dot(p.normal, centre) + p.offset;
  return d < -reach ? Visibility::outside : d < reach ? Visibility::crossing : Visibility::inside;
}

Visibility classify(const Frustum& frustum, const Double3& eye, const DoubleBox& box,
                    std::uint64_t* plane_tests) {
  if (box.empty()) return Visibility::outside;
  const Double3 centre = box.centre() - eye;
  const Double3 half = box.extent() * 0.5;
  Visibility answer = Visibility::inside;
  for (const Plane& p : frustum) {
    if (plane_tests) ++*plane_tests;
    const Visibility seen = classify(p, centre, half);
    if (seen == Visibility::outside) return seen;
    if (seen == Visibility::crossing) answer = seen;
  }
  return answer;
}

namespace {

// The extremes of the points against the two planes of one axis of the picture: with s = p . axis and
// d = p . back, a point is inside when |s - c| <= t (D - d), so what matters is max(s + t d) and
// max(-s + t d); the eye then stands at c with distance D along `back`.
struct AxisFit {
  double plus = -std::numeric_limits<double>::infinity();
  double minus = -std::numeric_limits<double>::infinity();
  void add(double s, double t_d) {
    plus = std::max(plus, s + t_d);
    minus = std::max(minus, -s + t_d);
  }
  double centre() const { return (plus - minus) / 2; }
  double distance(double t) const { return (plus + minus) / (2 * t); }
};

}  // namespace

std::optional<Camera> fit(std::span<const Float3> points, const Double3& origin, const Double3& back,
                          double fov, double aspect, double margin) {
  Camera camera;
  camera.fov = fov;
  camera.eye = normalized(back, {0, 0, 1});
  const CameraFrame f = frame_of(camera);
  const double t_y = std::tan(fov / 2) / (1 + margin);
  const double t_x = t_y * aspect;
  AxisFit x, y;
  double front = -std::numeric_limits<double>::infinity(), rear = -front, size = 0;
  for (const Float3& point : points) {
    if (!is_finite(point)) continue;
    const Double3 p = to_double(point);
    const double d = dot(p, f.back);
    x.add(dot(p, f.right), t_x * d);
    y.add(dot(p, f.up), t_y * d);
    front = std::max(front, d);
    rear = std::min(rear, d);
    size = std::max(size, length(p - to_double(points.front())));
  }
  if (!(front >= rear)) return std::nullopt;
  // The eye stands in front of the nearest point even when there is only one point, or a line of sight of
  // them.
  const double clearance = std::max(size * 1e-3, 1e-3 * std::max(1e-30, std::abs(front)));
  const double at = std::max({x.distance(t_x), y.distance(t_y), front + clearance});
  const Double3 across = origin + f.right * x.centre() + f.up * y.centre();
  camera.eye = across + f.back * at;
  camera.target = across + f.back * ((front + rear) / 2);
  return camera;
}

}  // namespace copse
