#include "lib/runtime/matrix.h"

namespace copse {

namespace {

float to_f(double v) {
  return static_cast<float>(v);
}

}  // namespace

Mat4 multiply(const Mat4& a, const Mat4& b) {
  Mat4 c;
  for (std::size_t column = 0; column < 4; ++column) {
    for (std::size_t row = 0; row < 4; ++row) {
      double sum = 0;
      for (std::size_t k = 0; k < 4; ++k) sum += double{a.m[4 * k + row]} * double{b.m[4 * column + k]};
      c.m[4 * column + row] = to_f(sum);
    }
  }
  return c;
}

Float4 transform(const Mat4& a, const Float4& v) {
  const auto row = [&](std::size_t r) {
    return to_f(double{a.m[r]} * v.x + double{a.m[4 + r]} * v.y + double{a.m[8 + r]} * v.z +
                double{a.m[12 + r]} * v.w);
  };
  return {row(0), row(1), row(2), row(3)};
}

Mat4 rotation_into(const Double3& right, const Double3& up, const Double3& back) {
  Mat4 r;
  for (int column = 0; column < 3; ++column) {
    const auto at = static_cast<std::size_t>(4 * column);
    r.m[at + 0] = to_f(right[column]);
    r.m[at + 1] = to_f(up[column]);
    r.m[at + 2] = to_f(back[column]);
  }
  return r;
}

Mat4 perspective(double left, double right, double bottom, double top, double near_plane, double far_plane) {
  Mat4 p;
  p.m = {to_f(2 / (right - left)),
         0,
         0,
         0,
         0,
         to_f(2 / (top - bottom)),
         0,
         0,
         to_f((right + left) / (right - left)),
         to_f((top + bottom) / (top - bottom)),
         to_f(-(far_plane + near_plane) / (far_plane - near_plane)),
         -1,
         0,
         0,
         to_f(-2 * far_plane * near_plane / (far_plane - near_plane)),
         0};
  return p;
}

Mat4 orthographic(double left, double right, double bottom, double top, double near_plane, double far_plane) {
  Mat4 p;
  p.m[0] = to_f(2 / (right - left));
  p.m[5] = to_f(2 / (top - bottom));
  p.m[10] = to_f(-2 / (far_plane - near_plane));
  p.m[12] = to_f(-(right + left) / (right - left));
  p.m[13] = to_f(-(top + bottom) / (top - bottom));
  p.m[14] = to_f(-(far_plane + near_plane) / (far_plane - near_plane));
  return p;
}

Mat4 narrow(const Mat4& projection, double x0, double x1, double y0, double y1) {
  Mat4 window;
  window.m[0] = to_f(1 / (x1 - x0));
  window.m[5] = to_f(1 / (y1 - y0));
  window.m[12] = to_f((1 - x0 - x1) / (x1 - x0));
  window.m[13] = to_f((1 - y0 - y1) / (y1 - y0));
  return multiply(window, projection);
}

}  // namespace copse
