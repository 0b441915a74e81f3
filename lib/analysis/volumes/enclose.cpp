#include "lib/analysis/volumes/enclose.h"

#include "lib/analysis/hull/grid_axis.h"
#include "lib/analysis/volumes/certify.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace copse {
namespace {

constexpr float k_infinity = std::numeric_limits<float>::infinity();
constexpr double k_denormal = std::numeric_limits<float>::denorm_min();
constexpr int k_float_bits = 24;
constexpr int k_growths = 40;  // pads double each time: more than enough to pass from one unit to anything

using Points = std::span<const Double3>;

// Points relative to something near, times a power of two that brings them to a size of about 1: squares
// neither overflow nor underflow.
class Near {
 public:
  Near(Points points, const Float3& origin) : origin_(to_double(origin)) {
    double reach = 0;
    for (const Double3& p : points) {
      const Double3 d = p * 0.5 - origin_ * 0.5;
      reach = std::max({reach, std::abs(d.x), std::abs(d.y), std::abs(d.z)});
    }
    if (reach > 0 && std::isfinite(reach))
      scale_ = std::ldexp(1.0, -std::clamp(std::ilogb(reach), -1000, 1000));
  }
  Double3 in(const Double3& p) const { return (p * 0.5 - origin_ * 0.5) * (2 * scale_); }
  double out(double size) const { return size / scale_; }
  Double3 direction(const Double3& d) const { return d * scale_; }

 private:
  Double3 origin_;
  double scale_ = 1;
};

// As float32 stores it; GCC 12 may drop the rounding of a mere pair of conversions (minimal_sphere.h).
Float3 narrow(const Double3& p) {
  volatile float x = static_cast<float>(p.x), y = static_cast<float>(p.y), z = static_cast<float>(p.z);
  return {x, y, z};
}

// A direction whose components that are nothing but rounding (2^-46 of the largest) are 0: then what is flat
// in a coordinate plane has no thickness.
Float3 narrow_direction(const Double3& d) {
  const double noise = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}) * 0x1p-46;
  const auto cleaned = [&](double x) { return std::abs(x) <= noise ? 0 : x; };
  return narrow({cleaned(d.x), cleaned(d.y), cleaned(d.z)});
}

float unit_of(float size) {
  return std::nextafter(size, k_infinity) - size;
}

// Nothing at first, then what double arithmetic may have lost, then 1, 2, 4, ... units in the last place of a
// size. So a set without thickness keeps its 0, and a thin one is not made thick for a rounding of doubles.
double pad_of(int growth, double size) {
  if (growth == 0) return 0;
  return growth == 1 ? size * 0x1p-48 : std::ldexp(unit_of(static_cast<float>(size)), growth - 2);
}

double clamped_foot(const Double3& q, const Double3& d) {
  const double dd = dot(d, d);
  return dd > 0 ? std::clamp(dot(q, d) / dd, 0.0, 1.0) : 0;
}

// --- each type: the stored volume at the n-th growth
// ---------------------------------------------------------

FloatBox store(const DoubleBox&, Points points, int) {
  DoubleBox box;
  for (const Double3& p : points) box.grow(p);
  return round_outward(box);
}

BoundingSphere<float> store(const BoundingSphere<double>& v, Points points, int growth) {
  BoundingSphere<float> s{narrow(v.centre), 0};
  const Near near(points, s.centre);
  double squared = 0;
  for (const Double3& p : points) {
    const Double3 d = near.in(p);
    squared = std::max(squared, dot(d, d));
  }
  const double radius = near.out(std::sqrt(squared));
  s.radius = round_up(radius + pad_of(growth, radius));
  return s;
}

OrientedBox<float> store(const OrientedBox<double>& v, Points points, int growth) {
  OrientedBox<float> box;
  for (int i = 0; i < 3; ++i) box.axes[i] = narrow_direction(v.axes[i]);
  // The middle of what the rounded axes span, from the fitted centre.
  const Near about_fit(points, narrow(v.centre));
  Double3 centre = to_double(narrow(v.centre));
  for (int i = 0; i < 3; ++i) {
    const Double3 axis = to_double(box.axes[i]);
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Double3& p : points) {
      const double x = dot(axis, about_fit.in(p));
      low = std::min(low, x), high = std::max(high, x);
    }
    centre += axis * about_fit.out((low + high) / 2);
  }
  box.centre = narrow(centre);
  const Near near(points, box.centre);
  Double3 half, most;
  for (const Double3& p : points) {
    const Double3 d = near.in(p);
    for (int i = 0; i < 3; ++i) half[i] = std::max(half[i], std::abs(dot(to_double(box.axes[i]), d)));
  }
  for (int i = 0; i < 3; ++i) most[i] = near.out(half[i]);
  const double size = std::max({most.x, most.y, most.z});
  for (int i = 0; i < 3; ++i) box.half_extents[i] = round_up(most[i] + pad_of(growth, size));
  return box;
}

Capsule<float> store(const Capsule<double>& v, Points points, int growth) {
  Capsule<float> c{narrow(v.a), narrow(v.b), 0};
  const Near near(points, c.a);
  const Double3 d = near.in(to_double(c.b));
  double squared = 0;
  for (const Double3& p : points) {
    const Double3 q = near.in(p);
    const Double3 rest = q - d * clamped_foot(q, d);
    squared = std::max(squared, dot(rest, rest));
  }
  const double radius = near.out(std::sqrt(squared));
  c.radius = round_up(radius + pad_of(growth, std::max(radius, near.out(length(d)))));
  return c;
}

Lozenge<float> store(const Lozenge<double>& v, Points points, int growth) {
  Lozenge<float> l{narrow(v.origin), narrow_direction(v.edge0), narrow_direction(v.edge1), 0};
  const Near near(points, l.origin);
  const Double3 e0 = near.direction(to_double(l.edge0)), e1 = near.direction(to_double(l.edge1));
  double squared = 0;
  for (const Double3& p : points) {
    const Double3 q = near.in(p);
    const Double3 rest = q - e0 * clamped_foot(q, e0) - e1 * clamped_foot(q, e1);
    squared = std::max(squared, dot(rest, rest));
  }
  const double radius = near.out(std::sqrt(squared));
  l.radius =
      round_up(radius + pad_of(growth, std::max({radius, near.out(length(e0)), near.out(length(e1))})));
  return l;
}

// Ends between whose planes the points lie, on a line that keeps the axis' direction; no radius yet.
Cylinder<float> with_ends(const Cylinder<double>& v, Points points, int growth) {
  const Near near(points, narrow(v.a));
  const Double3 axis = normalized(v.b - v.a), start = near.in(v.a);
  double low = std::numeric_limits<double>::infinity(), high = -low, squared = 0, size = 0;
  for (const Double3& p : points) {
    const Double3 q = near.in(p)-start;
    const double t = dot(axis, q);
    const Double3 away = q - axis * t;
    low = std::min(low, t), high = std::max(high, t);
    squared = std::max(squared, dot(away, away)), size = std::max(size, length(near.in(p)));
  }
  // Units of the coordinates too: ends that round to the same point are no cylinder.
  double pad = pad_of(growth, std::max(near.out(size), length(v.a)));
  if (growth > 1) pad = std::max(pad, std::ldexp(k_denormal, growth - 2));
  const double radius = near.out(std::sqrt(squared));
  const double reach = std::max(radius, near.out(size) * 0x1p-60);  // planes even where there is no radius
  const GridAxis ends =
      grid_axis({v.a + axis * (near.out(low) - pad), axis, near.out(high - low) + 2 * pad, radius, reach},
                k_float_bits);
  return {narrow(ends.a), narrow(ends.b), 0};
}

// What the points need between these ends.
struct TubeRadius {
  double radius = 0, height = 0;
};
TubeRadius radius_between(const Cylinder<float>& c, Points points) {
  const Near near(points, c.a);
  const Double3 d = near.in(to_double(c.b));
  const double dd = dot(d, d);
  double squared = 0;
  for (const Double3& p : points) {
    const Double3 across = cross(near.in(p), d);
    squared = std::max(squared, dot(across, across));
  }
  return {dd > 0 ? near.out(std::sqrt(squared / dd)) : 0, near.out(std::sqrt(dd))};
}

// The factor by which semi-axes must grow so that every point is inside.
double reach_of(const std::vector<Double3>& components, const Double3& semi) {
  double most = 0;
  for (const Double3& x : components) {
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
      const double t = semi[i] > 0 ? x[i] / semi[i] : 0;
      sum += t * t;
    }
    most = std::max(most, sum);
  }
  return std::sqrt(most);
}

Ellipsoid<float> store(const Ellipsoid<double>& v, Points points, int growth) {
  Ellipsoid<float> e;
  e.centre = narrow(v.centre);
  for (int i = 0; i < 3; ++i) e.axes[i] = narrow_direction(v.axes[i]);
  const Near near(points, e.centre);
  std::vector<Double3> components;
  components.reserve(points.size());
  Double3 widest;
  for (const Double3& p : points) {
    const Double3 d = near.in(p);
    components.push_back(
        {dot(to_double(e.axes[0]), d), dot(to_double(e.axes[1]), d), dot(to_double(e.axes[2]), d)});
    for (int i = 0; i < 3; ++i) widest[i] = std::max(widest[i], std::abs(components.back()[i]));
  }
  // A semi-axis that vanishes, or has lost its meaning to rounding, is set to some multiple of what is left
  // of the points along it; of a few multiples the one with the least volume.
  const Double3 fitted = near.direction(v.semi_axes);
  Double3 best;
  double least = std::numeric_limits<double>::infinity();
  for (const double multiple : {0.0, 1.0, 1.75, 4.0, 64.0}) {
    Double3 semi;
    bool holds = true;
    for (int i = 0; i < 3; ++i) {
      semi[i] = fitted[i] >= widest[i] ? fitted[i] : multiple == 0 ? fitted[i] : multiple * widest[i];
      holds &= semi[i] > 0 || widest[i] == 0;
    }
    if (!holds) continue;
    const double reach = reach_of(components, semi);
    double product = 1;
    for (int i = 0; i < 3; ++i) product *= semi[i] > 0 ? semi[i] * reach : 1;
    if (product < least) least = product, best = semi * std::max(reach, 1e-300);
  }
  for (int i = 0; i < 3; ++i) {
    const double semi = near.out(best[i]);
    // In proportion: units of the whole size would make a thin axis thick for nothing.
    e.semi_axes[i] = semi == 0 ? 0 : round_up(semi * (1 + pad_of(growth, 1)));
  }
  return e;
}

Kdop<float> store(const Kdop<double>& v, Points points, int growth) {
  Kdop<float> k;
  for (const Double3& normal : v.normals) {
    const Float3 n = narrow(normal);
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (const Double3& p : points) {
      const double x = dot(to_double(n), p);
      low = std::min(low, x), high = std::max(high, x);
    }
    const double pad = pad_of(growth, std::max(std::abs(low), std::abs(high)));
    k.normals.push_back(n);
    k.min.push_back(round_down(low - pad));
    k.max.push_back(round_up(high + pad));
  }
  return k;
}

// The first growth of `fitted` round `from` that holds `points`.
template <class V>
std::optional<Volume<float>> grown(const V& fitted, Points from, Points points, int growths) {
  for (int growth = 0; growth < growths; ++growth) {
    const Volume<float> v = store(fitted, from, growth);
    if (certify(v, points).holds()) return v;
  }
  return std::nullopt;
}

// The ends lie on the line, or as near to it as float32 can say, and their difference is a float32 too: so
// the capsule is a lozenge of one edge as well. What has no thickness may have ends whose difference is none.
std::optional<Volume<float>> grown(const Capsule<double>& fitted, Points from, Points points, int growths) {
  const auto on_ends = [&](const Capsule<double>& c) -> std::optional<Capsule<float>> {
    for (int growth = 0; growth < growths; ++growth) {
      const Capsule<float> stored = store(c, from, growth);
      if (certify(stored, points).holds()) return stored;
    }
    return std::nullopt;
  };
  constexpr float k_units = 8;  // of the ends: a radius below it is mostly their rounding
  constexpr double k_clearly = 0.5;
  const Double3 d = fitted.b - fitted.a;
  const GridAxis ends = grid_axis({fitted.a, normalized(d), length(d), fitted.radius, 0}, k_float_bits);
  const auto on_grid = on_ends({ends.a, ends.b, fitted.radius});
  if (!on_grid) return std::nullopt;
  const double reach = std::max(length(fitted.a), length(fitted.b));
  if (on_grid->radius > k_units * unit_of(static_cast<float>(reach))) return *on_grid;
  const auto nearest = on_ends(fitted);
  return nearest && nearest->radius < k_clearly * on_grid->radius ? *nearest : *on_grid;
}

// Of a needle a unit of the length is thick: the ends grow first, with a radius that holds anything, and the
// radius then for itself, by what double arithmetic has lost of the length, 2^-48, and more of it.
std::optional<Volume<float>> grown(const Cylinder<double>& fitted, Points from, Points points, int growths) {
  for (int ends = 0; ends < growths; ++ends) {
    Cylinder<float> c = with_ends(fitted, from, ends);
    const TubeRadius least = radius_between(c, from);
    const double size = std::max(least.radius, least.height);
    c.radius = round_up(std::min<double>(4 * size, std::numeric_limits<float>::max()));
    if (!certify(c, points).holds()) continue;
    for (int growth = 0; growth < growths; ++growth) {
      c.radius = round_up(least.radius + (growth == 0 ? 0 : std::ldexp(size, growth - 49)));
      if (certify(c, points).holds()) return c;
    }
  }
  return std::nullopt;
}

}  // namespace

std::optional<Enclosed> enclose(const Volume<double>& fitted, Points points, Points corners) {
  // From corners only where they are enough as they are: what pads them is more than the thinnest needs.
  constexpr int k_corner_growths = 1;
  for (const Points from : {corners, points}) {
    if (from.empty()) continue;
    const int growths = from.data() == points.data() ? k_growths : k_corner_growths;
    auto volume = std::visit([&](const auto& v) { return grown(v, from, points, growths); }, fitted);
    if (volume) return Enclosed{std::move(*volume), true};
  }
  return std::nullopt;
}

}  // namespace copse
