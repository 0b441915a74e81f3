// 4 x 4 matrices as OpenGL takes them: column-major float32, column vectors, clip depth in [-1, 1].
#pragma once

#include "lib/formats/vec.h"

#include <array>

namespace copse {

struct Mat4 {
  std::array<float, 16> m{1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};  // m[4 * column + row]
  friend bool operator==(const Mat4&, const Mat4&) = default;
};

struct Float4 {
  float x = 0, y = 0, z = 0, w = 0;
  friend bool operator==(const Float4&, const Float4&) = default;
};

Mat4 multiply(const Mat4& a, const Mat4& b);
Float4 transform(const Mat4& a, const Float4& v);

// Rotates the world into the frame (right, up, back), which must be orthonormal: the rows of the matrix.
Mat4 rotation_into(const Double3& right, const Double3& up, const Double3& back);

// A perspective whose image plane at distance 1 spans [left, right] x [bottom, top]; looks along -Z.
Mat4 perspective(double left, double right, double bottom, double top, double near_plane, double far_plane);

// A parallel projection of the box onto [-1, 1]^3; looks along -Z: near_plane and far_plane are distances.
Mat4 orthographic(double left, double right, double bottom, double top, double near_plane, double far_plane);

// Narrows a projection of the whole image to the part [x0, x1] x [y0, y1] of it (0 to 1, from the lower
// left): for images that are drawn tile by tile.
Mat4 narrow(const Mat4& projection, double x0, double x1, double y0, double y1);

}  // namespace copse
