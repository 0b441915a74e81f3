// The camera: where it stands, what it sees, and where it must stand to see all of something.
//
// Positions are absolute, in double; what a GPU gets is relative to the eye, so a tree 1e7 m from the origin
// is drawn as exactly as one at the origin: upload its vertices once, relative to their own origin, and give
// each draw `offset_from_eye(origin)`.
#pragma once

#include "lib/formats/vec.h"
#include "lib/runtime/matrix.h"

#include <array>
#include <optional>
#include <span>

namespace copse {

struct Camera {
  Double3 eye{0, 0, 1};
  Double3 target;
  Double3 up{0, 1, 0};  // a wish; when it is parallel to the line of sight another is taken
  double fov = 0.6;     // vertical angle of view, radians, in (0, pi)
  friend bool operator==(const Camera&, const Camera&) = default;
};

// True when the camera has a line of sight: finite, eye and target apart, fov inside (0, pi).
bool is_valid(const Camera& camera);

// The camera's orthonormal frame.
struct CameraFrame {
  Double3 right{1, 0, 0}, up{0, 1, 0}, back{0, 0, 1};
};
CameraFrame frame_of(const Camera& camera);

// What a draw needs. All of it is relative to the eye: there is no translation in `rotation`.
struct View {
  Double3 eye;
  CameraFrame frame;
  Mat4 rotation;    // (world - eye) -> camera
  Mat4 projection;  // camera -> clip
  double tan_half_x = 0, tan_half_y = 0;
  double near_plane = 0, far_plane = 0;

  Float3 offset_from_eye(const Double3& origin) const { return to_float(origin - eye); }
};

// `aspect` is width / height; 0 < near_plane < far_plane.
View make_view(const Camera& camera, double aspect, double near_plane, double far_plane);

// A plane keeps what has dot(normal, p) + offset >= 0; p relative to the eye.
struct Plane {
  Double3 normal;
  double offset = 0;
};

// Left, right, bottom, top, near, far; normals of length 1 that point inward.
using Frustum = std::array<Plane, 6>;
Frustum frustum_of(const View& view);

enum class Visibility { outside, crossing, inside };

// Whether the box (absolute coordinates; inclusive) is seen. Conservative: a box that is outside no single
// plane counts as crossing. `plane_tests`, when given, is increased by the planes that were tried.
Visibility classify(const Frustum& frustum, const Double3& eye, const DoubleBox& box,
                    std::uint64_t* plane_tests = nullptr);

// The same of one plane; of the box its middle, relative to the eye, and half its sides.
Visibility classify(const Plane& plane, const Double3& centre, const Double3& half);

// The nearest camera that looks along -`back` (from `back` towards the points) with the given field of view
// and sees every point: exact, not by a bounding sphere. `margin` widens the picture on each side: 0.05
// leaves 5 % of its half-width and half-height free. Points are relative to `origin`. None: no finite point.
std::optional<Camera> fit(std::span<const Float3> points, const Double3& origin, const Double3& back,
                          double fov, double aspect, double margin);

}  // namespace copse
