// Points, vectors and boxes as they are stored (float) and computed (double).
//
// Coordinates are metres in a right-handed frame, +Y up, once a mesh has been brought into copse's frame.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace copse {

template <class T>
struct Vec2 {
  T x{}, y{};
  friend constexpr bool operator==(const Vec2&, const Vec2&) = default;
};

template <class T>
struct Vec3 {
  T x{}, y{}, z{};

  friend constexpr bool operator==(const Vec3&, const Vec3&) = default;
  constexpr T operator[](int i) const { return i == 0 ? x : i == 1 ? y : z; }
  constexpr T& operator[](int i) { return i == 0 ? x : i == 1 ? y : z; }

  constexpr Vec3& operator+=(const Vec3& b) { return x += b.x, y += b.y, z += b.z, *this; }
  constexpr Vec3& operator-=(const Vec3& b) { return x -= b.x, y -= b.y, z -= b.z, *this; }
  constexpr Vec3& operator*=(T s) { return x *= s, y *= s, z *= s, *this; }
  friend constexpr Vec3 operator+(Vec3 a, const Vec3& b) { return a += b; }
  friend constexpr Vec3 operator-(Vec3 a, const Vec3& b) { return a -= b; }
  friend constexpr Vec3 operator-(const Vec3& a) { return {-a.x, -a.y, -a.z}; }
  friend constexpr Vec3 operator*(Vec3 a, T s) { return a *= s; }
  friend constexpr Vec3 operator*(T s, Vec3 a) { return a *= s; }
  friend constexpr Vec3 operator/(Vec3 a, T s) { return {a.x / s, a.y / s, a.z / s}; }
};

using Float2 = Vec2<float>;
using Float3 = Vec3<float>;
using Double3 = Vec3<double>;

template <class T>
constexpr T dot(const Vec3<T>& a, const Vec3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class T>
constexpr Vec3<T> cross(const Vec3<T>& a, const Vec3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
// Safe from overflow and underflow at any scale (three-argument hypot).
inline double length(const Double3& a) {
  return std::hypot(a.x, a.y, a.z);
}
inline double distance(const Double3& a, const Double3& b) {
  return length(a - b);
}
// The unit vector along `a`, or `fallback` when `a` has no direction.
inline Double3 normalized(const Double3& a, const Double3& fallback = {0, 1, 0}) {
  const double l = length(a);
  return l > 0 && std::isfinite(l) ? a / l : fallback;
}

constexpr Double3 to_double(const Float3& a) {
  return {a.x, a.y, a.z};
}
constexpr Float3 to_float(const Double3& a) {
  return {static_cast<float>(a.x), static_cast<float>(a.y), static_cast<float>(a.z)};
}
template <class T>
bool is_finite(const Vec3<T>& a) {
  return std::isfinite(a.x) && std::isfinite(a.y) && std::isfinite(a.z);
}

// An axis-aligned box. Default-constructed it is empty: min > max, and it contains nothing.
template <class T>
struct Box {
  Vec3<T> min{std::numeric_limits<T>::infinity(), std::numeric_limits<T>::infinity(),
              std::numeric_limits<T>::infinity()};
  Vec3<T> max{-std::numeric_limits<T>::infinity(), -std::numeric_limits<T>::infinity(),
              -std::numeric_limits<T>::infinity()};

  friend constexpr bool operator==(const Box&, const Box&) = default;
  constexpr bool empty() const { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
  constexpr void grow(const Vec3<T>& p) {
    min = {std::min(min.x, p.x), std::min(min.y, p.y), std::min(min.z, p.z)};
    max = {std::max(max.x, p.x), std::max(max.y, p.y), std::max(max.z, p.z)};
  }
  constexpr void grow(const Box& b) {
    if (!b.empty()) grow(b.min), grow(b.max);
  }
  constexpr Vec3<T> centre() const { return (min + max) * T(0.5); }
  constexpr Vec3<T> extent() const { return empty() ? Vec3<T>{} : max - min; }
};

using FloatBox = Box<float>;
using DoubleBox = Box<double>;

// The nearest float32 that is not above / not below `v`: what contains must be rounded outward.
inline float round_down(double v) {
  const float f = static_cast<float>(v);
  return f > v ? std::nextafter(f, -std::numeric_limits<float>::infinity()) : f;
}
inline float round_up(double v) {
  const float f = static_cast<float>(v);
  return f < v ? std::nextafter(f, std::numeric_limits<float>::infinity()) : f;
}
inline FloatBox round_outward(const DoubleBox& b) {
  if (b.empty()) return {};
  return {{round_down(b.min.x), round_down(b.min.y), round_down(b.min.z)},
          {round_up(b.max.x), round_up(b.max.y), round_up(b.max.z)}};
}

}  // namespace copse
