#include "lib/analysis/volumes/certify.h"
#include "lib/analysis/volumes/double_double.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <type_traits>

#include <CGAL/Gmpq.h>

namespace copse {
namespace {

// --- numbers ---------------------------------------------------------------------------------------------

using Exact = CGAL::Gmpq;

// A double and a bound of how far it is from the exact value. Bounds are computed in rounded arithmetic too:
// k_slack covers that, k_unit is twice the unit roundoff, k_tiny what underflow can lose.
struct Bounded {
  double value = 0, error = 0;
};
constexpr double k_unit = 0x1p-52, k_slack = 1 + 0x1p-48, k_tiny = 0x1p-1060;

Bounded rounded(double value, double error) {
  return {value, error * k_slack + std::abs(value) * k_unit};
}
Bounded operator+(const Bounded& a, const Bounded& b) {
  return rounded(a.value + b.value, a.error + b.error);
}
Bounded operator-(const Bounded& a, const Bounded& b) {
  return rounded(a.value - b.value, a.error + b.error);
}
bool is_zero(const Bounded& a) {
  return a.value == 0 && a.error == 0;
}
Bounded operator*(const Bounded& a, const Bounded& b) {
  if (is_zero(a) || is_zero(b)) return {};
  const double error = std::abs(a.value) * b.error + std::abs(b.value) * a.error + a.error * b.error;
  return rounded(a.value * b.value, error + k_tiny);
}
Bounded operator/(const Bounded& a, const Bounded& b) {
  const double least = std::abs(b.value) * (1 - k_unit) - b.error;
  if (!(least > 0)) return {0, std::numeric_limits<double>::infinity()};
  const double value = a.value / b.value;
  return rounded(value, (a.error + std::abs(value) * b.error) / least + k_tiny);
}
// Clamping brings no two numbers farther apart, so the bound stays.
Bounded clamped(const Bounded& a) {
  return {std::clamp(a.value, 0.0, 1.0), a.error};
}
// What is certainly beyond an end is that end, without an error.
DoubleDouble clamped(const DoubleDouble& a) {
  const CertainSign above_0 = sign_of(a), above_1 = sign_of(a - DoubleDouble{1});
  if (above_0.is_certain && above_0.sign <= 0) return {0};
  if (above_1.is_certain && above_1.sign >= 0) return {1};
  return a;
}
Exact clamped(const Exact& a) {
  return a < 0 ? Exact(0) : a > 1 ? Exact(1) : a;
}

enum class Side { inside, outside, unsure };

// Whether a <= b.
Side at_most(const Bounded& a, const Bounded& b) {
  const Bounded d = a - b;
  if (d.value + d.error <= 0) return Side::inside;
  return d.value - d.error > 0 ? Side::outside : Side::unsure;
}
Side at_most(const DoubleDouble& a, const DoubleDouble& b) {
  const CertainSign s = sign_of(a - b);
  return !s.is_certain ? Side::unsure : s.sign <= 0 ? Side::inside : Side::outside;
}
Side at_most(const Exact& a, const Exact& b) {
  return a <= b ? Side::inside : Side::outside;
}
Side both(Side a, Side b) {
  return std::max(a, b, [](Side x, Side y) {
    const auto rank = [](Side s) { return s == Side::outside ? 2 : s == Side::unsure ? 1 : 0; };
    return rank(x) < rank(y);
  });
}

// --- the inequalities, for any kind of number --------------------------------------------------------------

template <class N>
N number(double v) {
  if constexpr (std::is_same_v<N, Bounded> || std::is_same_v<N, DoubleDouble>) {
    return {v, 0};
  } else {
    return N(v);
  }
}

template <class N>
struct Vector {
  N x, y, z;
};
template <class N>
Vector<N> vector(const Double3& a) {
  return {number<N>(a.x), number<N>(a.y), number<N>(a.z)};
}
template <class N>
Vector<N> operator-(const Vector<N>& a, const Vector<N>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class N>
Vector<N> operator*(const Vector<N>& a, const N& s) {
  return {a.x * s, a.y * s, a.z * s};
}
template <class N>
N product(const Vector<N>& a, const Vector<N>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class N>
Vector<N> vector_product(const Vector<N>& a, const Vector<N>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class N>
N squared(const N& a) {
  return a * a;
}
template <class N>
Side between(const N& low, const N& x, const N& high) {
  return both(at_most(low, x), at_most(x, high));
}
// Where along d the foot of q lies, 0 to 1.
template <class N>
N foot(const Vector<N>& q, const Vector<N>& d, bool vanishes) {
  return vanishes ? number<N>(0) : clamped(product(q, d) / product(d, d));
}
bool vanishes(const Double3& d) {
  return d == Double3{};
}

template <class N>
Side side(const DoubleBox& v, const Double3& p) {
  const bool inside = v.min.x <= p.x && p.x <= v.max.x && v.min.y <= p.y && p.y <= v.max.y &&
                      v.min.z <= p.z && p.z <= v.max.z;
  return inside ? Side::inside : Side::outside;
}
template <class N>
Side side(const BoundingSphere<double>& v, const Double3& p) {
  const Vector<N> d = vector<N>(p) - vector<N>(v.centre);
  return at_most(product(d, d), squared(number<N>(v.radius)));
}
template <class N>
Side side(const OrientedBox<double>& v, const Double3& p) {
  const Vector<N> d = vector<N>(p) - vector<N>(v.centre);
  Side s = Side::inside;
  for (int i = 0; i < 3; ++i) {
    const N x = product(vector<N>(v.axes[i]), d);
    s = both(s, between(number<N>(-v.half_extents[i]), x, number<N>(v.half_extents[i])));
  }
  return s;
}
template <class N>
Side side(const Capsule<double>& v, const Double3& p) {
  // d = b - a is a number of the inequality, not of the file: it is not rounded
  const Vector<N> q = vector<N>(p) - vector<N>(v.a), d = vector<N>(v.b) - vector<N>(v.a);
  const Vector<N> rest = q - d * foot(q, d, v.a == v.b);
  return at_most(product(rest, rest), squared(number<N>(v.radius)));
}
template <class N>
Side side(const Cylinder<double>& v, const Double3& p) {
  const Vector<N> q = vector<N>(p) - vector<N>(v.a), d = vector<N>(v.b) - vector<N>(v.a);
  const N along = product(q, d), dd = product(d, d);
  const Side ends = between(number<N>(0), along, dd);
  const Vector<N> across = vector_product(q, d);
  return both(ends, at_most(product(across, across), squared(number<N>(v.radius)) * dd));
}
template <class N>
Side side(const Lozenge<double>& v, const Double3& p) {
  const Vector<N> q = vector<N>(p) - vector<N>(v.origin);
  const Vector<N> e0 = vector<N>(v.edge0), e1 = vector<N>(v.edge1);
  const Vector<N> rest = q - e0 * foot(q, e0, vanishes(v.edge0)) - e1 * foot(q, e1, vanishes(v.edge1));
  return at_most(product(rest, rest), squared(number<N>(v.radius)));
}
template <class N>
Side side(const Ellipsoid<double>& v, const Double3& p) {
  const Vector<N> d = vector<N>(p) - vector<N>(v.centre);
  N sum = number<N>(0);
  Side flat = Side::inside;
  for (int i = 0; i < 3; ++i) {
    const N x = product(vector<N>(v.axes[i]), d);
    if (v.semi_axes[i] == 0) {
      flat = both(flat, between(number<N>(0), x, number<N>(0)));
    } else {
      sum = sum + squared(x / number<N>(v.semi_axes[i]));
    }
  }
  return both(flat, at_most(sum, number<N>(1)));
}
template <class N>
Side side(const Kdop<double>& v, const Double3& p) {
  const Vector<N> q = vector<N>(p);
  Side s = Side::inside;
  for (std::size_t i = 0; i < v.normals.size(); ++i) {
    s = both(s, between(number<N>(v.min[i]), product(vector<N>(v.normals[i]), q), number<N>(v.max[i])));
  }
  return s;
}

// --- whether the numbers make a volume ---------------------------------------------------------------------

bool sound(double v) {
  return std::isfinite(v) && v >= 0;
}
bool sound(const DoubleBox& v) {
  return is_finite(v.min) && is_finite(v.max);
}
bool sound(const BoundingSphere<double>& v) {
  return is_finite(v.centre) && sound(v.radius);
}
// Unit and orthogonal as far as float32 can say it (volume.h).
bool orthonormal(const std::array<Double3, 3>& axes) {
  constexpr double k_rounding = 1e-6;  // some ten units
  for (int i = 0; i < 3; ++i) {
    for (int j = i; j < 3; ++j) {
      if (!(std::abs(dot(axes[i], axes[j]) - (i == j ? 1 : 0)) <= k_rounding)) return false;
    }
  }
  return true;
}
template <class V>
bool framed(const V& v, const Double3& sizes) {
  return is_finite(v.centre) && orthonormal(v.axes) && sound(sizes.x) && sound(sizes.y) && sound(sizes.z);
}
bool sound(const OrientedBox<double>& v) {
  return framed(v, v.half_extents);
}
bool sound(const Capsule<double>& v) {
  return is_finite(v.a) && is_finite(v.b) && sound(v.radius);
}
bool sound(const Cylinder<double>& v) {
  return is_finite(v.a) && is_finite(v.b) && sound(v.radius) && v.a != v.b;
}
// At right angles as far as float32 can say it, down to where its numbers have few digits left.
bool orthogonal(const Double3& a, const Double3& b) {
  constexpr double k_rounding = 1e-6, k_denormal = std::numeric_limits<float>::denorm_min();
  const double la = length(a), lb = length(b);
  if (la == 0 || lb == 0) return true;
  return std::abs(dot(a / la, b / lb)) <= k_rounding + 2 * k_denormal / std::min(la, lb);
}
bool sound(const Lozenge<double>& v) {
  return is_finite(v.origin) && is_finite(v.edge0) && is_finite(v.edge1) && sound(v.radius) &&
         orthogonal(v.edge0, v.edge1);
}
bool sound(const Ellipsoid<double>& v) {
  return framed(v, v.semi_axes);
}
// Whether slabs with these normals, none 0, bound anything: three of them span space.
bool span_space(std::span<const Double3> normals) {
  constexpr double k_rounding = 1e-12;
  const auto unit = [&](std::size_t i) { return normals[i] / length(normals[i]); };
  Double3 plane;  // normal to the first and to what is farthest from it
  for (std::size_t i = 1; i < normals.size(); ++i) {
    const Double3 n = cross(unit(0), unit(i));
    if (dot(n, n) > dot(plane, plane)) plane = n;
  }
  const double l = length(plane);
  for (std::size_t i = 1; l > k_rounding && i < normals.size(); ++i) {
    if (std::abs(dot(plane / l, unit(i))) > k_rounding) return true;
  }
  return false;
}
bool sound(const Kdop<double>& v) {
  bool ok = v.normals.size() == v.min.size() && v.normals.size() == v.max.size() && !v.normals.empty();
  for (std::size_t i = 0; ok && i < v.normals.size(); ++i) {
    ok = is_finite(v.normals[i]) && v.normals[i] != Double3{} && std::isfinite(v.min[i]) &&
         std::isfinite(v.max[i]);
  }
  return ok && span_space(v.normals);
}

// --- how far out a point is, roughly: to find the worst
// -----------------------------------------------------

double outside_by(const DoubleBox& v, const Double3& p) {
  const Double3 d{std::max({0.0, v.min.x - p.x, p.x - v.max.x}),
                  std::max({0.0, v.min.y - p.y, p.y - v.max.y}),
                  std::max({0.0, v.min.z - p.z, p.z - v.max.z})};
  return length(d);
}
double outside_by(const BoundingSphere<double>& v, const Double3& p) {
  return distance(p, v.centre) - v.radius;
}
double outside_by(const OrientedBox<double>& v, const Double3& p) {
  Double3 d;
  for (int i = 0; i < 3; ++i)
    d[i] = std::max(0.0, std::abs(dot(v.axes[i], p - v.centre)) - v.half_extents[i]);
  return length(d);
}
double near_foot(const Double3& q, const Double3& d) {
  const double l = length(d);
  return l > 0 ? std::clamp(dot(q / l, d / l), 0.0, 1.0) : 0;
}
double outside_by(const Capsule<double>& v, const Double3& p) {
  const Double3 q = p - v.a, d = v.b - v.a;
  return length(q - d * near_foot(q, d)) - v.radius;
}
double outside_by(const Cylinder<double>& v, const Double3& p) {
  const Double3 q = p - v.a, d = v.b - v.a;
  const double l = length(d), along = dot(q, d / l);
  const double beyond = std::max({0.0, -along, along - l});
  return std::hypot(beyond, std::max(0.0, length(q - d / l * along) - v.radius));
}
double outside_by(const Lozenge<double>& v, const Double3& p) {
  const Double3 q = p - v.origin;
  return length(q - v.edge0 * near_foot(q, v.edge0) - v.edge1 * near_foot(q, v.edge1)) - v.radius;
}
double outside_by(const Ellipsoid<double>& v, const Double3& p) {  // along the ray from the centre
  Double3 scaled;
  double beyond = 0;
  for (int i = 0; i < 3; ++i) {
    const double x = dot(v.axes[i], p - v.centre);
    if (v.semi_axes[i] > 0) {
      scaled[i] = x / v.semi_axes[i];
    } else {
      beyond = std::max(beyond, std::abs(x));
    }
  }
  const double s = length(scaled);
  return std::max(beyond, s > 1 ? distance(p, v.centre) * (1 - 1 / s) : 0.0);
}
double outside_by(const Kdop<double>& v, const Double3& p) {
  double most = 0;
  for (std::size_t i = 0; i < v.normals.size(); ++i) {
    const double x = dot(v.normals[i], p);
    most = std::max(most, std::max(v.min[i] - x, x - v.max[i]) / length(v.normals[i]));
  }
  return most;
}

template <class V>
Certificate certify_one(const V& v, std::span<const Double3> points) {
  Certificate c;
  c.points = points.size();
  if (!sound(v)) {
    c.outside = points.size();
    c.excess = points.empty() ? 0 : std::numeric_limits<double>::infinity();
    return c;
  }
  double most = -1;
  for (std::size_t i = 0; i < points.size(); ++i) {
    Side s = side<Bounded>(v, points[i]);
    if (s == Side::unsure) {
      ++c.near;
      s = side<DoubleDouble>(v, points[i]);
    }
    if (s == Side::unsure) {
      ++c.exact;
      s = side<Exact>(v, points[i]);
    }
    if (s == Side::inside) continue;
    ++c.outside;
    const double excess = outside_by(v, points[i]);
    if (excess > most || c.outside == 1) c.worst = i, most = excess;
  }
  c.excess = std::max(most, 0.0);
  return c;
}

Double3 wide(const Float3& a) {
  return to_double(a);
}

}  // namespace

Volume<double> to_double(const Volume<float>& volume) {
  struct Widen {
    Volume<double> operator()(const FloatBox& v) const { return DoubleBox{wide(v.min), wide(v.max)}; }
    Volume<double> operator()(const BoundingSphere<float>& v) const {
      return BoundingSphere<double>{wide(v.centre), v.radius};
    }
    Volume<double> operator()(const OrientedBox<float>& v) const {
      return OrientedBox<double>{
          wide(v.centre), {wide(v.axes[0]), wide(v.axes[1]), wide(v.axes[2])}, wide(v.half_extents)};
    }
    Volume<double> operator()(const Capsule<float>& v) const {
      return Capsule<double>{wide(v.a), wide(v.b), v.radius};
    }
    Volume<double> operator()(const Cylinder<float>& v) const {
      return Cylinder<double>{wide(v.a), wide(v.b), v.radius};
    }
    Volume<double> operator()(const Lozenge<float>& v) const {
      return Lozenge<double>{wide(v.origin), wide(v.edge0), wide(v.edge1), v.radius};
    }
    Volume<double> operator()(const Ellipsoid<float>& v) const {
      return Ellipsoid<double>{
          wide(v.centre), {wide(v.axes[0]), wide(v.axes[1]), wide(v.axes[2])}, wide(v.semi_axes)};
    }
    Volume<double> operator()(const Kdop<float>& v) const {
      Kdop<double> out;
      for (const Float3& n : v.normals) out.normals.push_back(wide(n));
      out.min.assign(v.min.begin(), v.min.end());
      out.max.assign(v.max.begin(), v.max.end());
      return out;
    }
  };
  return std::visit(Widen{}, volume);
}

Certificate certify(const Volume<double>& volume, std::span<const Double3> points) {
  return std::visit([&](const auto& v) { return certify_one(v, points); }, volume);
}

Certificate certify(const Volume<float>& volume, std::span<const Double3> points) {
  return certify(to_double(volume), points);
}

}  // namespace copse
