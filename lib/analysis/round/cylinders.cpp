#include "lib/analysis/round/cylinders.h"

#include "lib/analysis/hull/frame.h"
#include "lib/analysis/hull/grid_axis.h"
#include "lib/analysis/hull/principal_axes.h"
#include "lib/analysis/round/smallest_circle.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <queue>
#include <vector>

namespace copse {
namespace {

constexpr int k_directions = 48;   // of the fixed set of starts
constexpr std::size_t k_kept = 3;  // of them are descended from
// A small hull has few, deep creases: along its edges and across its faces more starts, and more are kept.
constexpr std::size_t k_small_hull = 60, k_kept_small = 16;
constexpr std::size_t k_polished = 1, k_polished_small = 4;  // ends that are descended to the last digit
constexpr int k_rounds = 100;                                // of a descent; some 40 do
constexpr double k_rounding = 1e-12;
constexpr int k_double_bits = 53;
constexpr double k_least_length =
    0x1p-28;  // of the radius: shorter axes lose their direction when they are placed
constexpr double k_least_reach = 0x1p-52;  // so that a segment or a point has ends that tell its axis

double volume_of(double radius, double height) {
  return std::numbers::pi * radius * radius * height;
}

// What a direction leads to: the circle round the points projected across it, and the extent along it.
struct Tube {
  Double3 direction;
  Double3 centre;  // of the circle, across the direction
  double radius = 0, low = 0, high = 0;
  double lower_radius = 0;  // of the circle round what holds it
  Double3 first, last;      // points at the ends
  SmallestCircle circle;    // of the points projected
  std::span<const std::uint32_t> holders() const {
    return {circle.support.data(), static_cast<std::size_t>(circle.supports)};
  }
  double support_extent = 0;  // along the direction, of the points that hold the circle
  double volume() const { return volume_of(radius, high - low); }
};

// `near`: of the same points along a direction like this one.
Tube tube_along(std::span<const Double3> points, const Double3& direction, const Tube* near = nullptr) {
  Tube t;
  t.direction = direction;
  const Double3 u = any_normal(direction), v = cross(direction, u);
  t.low = std::numeric_limits<double>::infinity(), t.high = -t.low;
  std::vector<Vec2<double>> flat;
  flat.reserve(points.size());
  for (const Double3& p : points) {
    const double h = dot(p, direction);
    if (h < t.low) t.low = h, t.first = p;
    if (h > t.high) t.high = h, t.last = p;
    flat.push_back({dot(p, u), dot(p, v)});
  }
  t.circle = near != nullptr ? smallest_circle(flat, near->holders()) : smallest_circle(flat);
  t.radius = t.circle.radius, t.lower_radius = t.circle.lower_radius;
  t.centre = u * t.circle.centre.x + v * t.circle.centre.y;
  double low = t.high, high = t.low;
  for (const std::uint32_t i : t.holders()) {
    const double h = dot(points[i], direction);
    low = std::min(low, h), high = std::max(high, h);
  }
  t.support_extent = std::max(0.0, high - low);
  return t;
}

// What no tube along another direction is below: that of the few points that hold this one.
double volume_of_holders(std::span<const Double3> points, const Tube& t, const Double3& direction) {
  const std::span<const std::uint32_t> holders = t.holders();
  const auto apart = [&](std::size_t i, std::size_t j) {
    const Double3 d = points[holders[i]] - points[holders[j]];
    const double along = dot(d, direction);
    return std::max(0.0, dot(d, d) - along * along);
  };
  double square = 0;  // of the circle's diameter
  if (holders.size() == 2) square = apart(0, 1);
  if (holders.size() == 3) {
    const double a = apart(0, 1), b = apart(1, 2), c = apart(2, 0);
    square = std::max({a, b, c});
    // Of an acute triangle the circle through its corners: 2 r = abc / (2 area), 16 area^2 by Heron.
    const double heron = 2 * (a * b + b * c + c * a) - (a * a + b * b + c * c);
    if (a + b + c > 2 * square && heron > 0) square = 4 * a * b * c / heron;
  }
  return std::numbers::pi / 4 * square * std::abs(dot(t.last - t.first, direction));
}

// Its ends tell the direction of the axis as well as doubles can, and are moved out by what that leaves.
Cylinder<double> cylinder_of(const Tube& t) {
  const double reach = std::max(t.radius, k_least_reach);
  const double length = std::max(t.high - t.low, k_least_length * reach);
  const Double3 low = t.centre + t.direction * ((t.high + t.low - length) / 2);
  const GridAxis ends = grid_axis({low, t.direction, length, t.radius, reach}, k_double_bits);
  return {ends.a, ends.b, t.radius};
}

// --- the search -------------------------------------------------------------------------------------------

std::vector<Double3> starts_for(const ConvexHull& hull) {
  std::vector<Double3> starts(k_world_axes.begin(), k_world_axes.end());
  for (const Axes& axes :
       {hull.axes, principal_axes(hull.vertices).axes, principal_axes(hull.vertices, hull.faces).axes}) {
    starts.insert(starts.end(), axes.begin(), axes.end());
  }
  const double golden = std::numbers::pi * (3 - std::sqrt(5.0));
  const Axes base = principal_axes(hull.vertices).axes;
  for (int i = 0; i < k_directions; ++i) {  // they turn with the points
    const double z = (i + 0.5) / k_directions, r = std::sqrt(1 - z * z);
    starts.push_back(base[0] * (r * std::cos(golden * i)) + base[1] * (r * std::sin(golden * i)) +
                     base[2] * z);
  }
  if (hull.vertices.size() >= k_small_hull) return starts;
  const auto add = [&](const Double3& d) {
    if (length(d) > 0) starts.push_back(normalized(d));
  };
  const std::vector<Double3>& v = hull.vertices;
  for (const HullEdge& e : hull.edges) add(v[e.b] - v[e.a]);
  for (const auto& [a, b, c] : hull.faces) add(cross(v[b] - v[a], v[c] - v[a]));
  return starts;
}

// Steps in the tangent plane, halved when none of them gains (pattern search): the volume has creases, along
// which the directions of the last gain are tried first.
// Given up when it is about to end far above what is known.
Tube descend(std::span<const Double3> points, Tube best, double step, double smallest,
             double known = std::numeric_limits<double>::infinity()) {
  constexpr double k_hopeless = 1.15, k_late = 0.04;
  constexpr double k_sure = 1 + 1e-9;  // of the holders' volume, which cancels
  const double late = k_late * step;
  Double3 last;
  for (int round = 0; round < k_rounds && step > smallest; ++round) {
    if (step < late && best.volume() > k_hopeless * known) break;
    const Double3 u = any_normal(best.direction), v = cross(best.direction, u);
    const Double3 before = best.direction;
    const Double3 along = last - best.direction * dot(last, best.direction);
    const double diagonal = std::numbers::sqrt2 / 2;
    for (const Double3& d : {length(along) > 0 ? normalized(along) : u, u, v, -u, -v, (u + v) * diagonal,
                             (u - v) * diagonal, (v - u) * diagonal, -(u + v) * diagonal}) {
      const Double3 direction = normalized(best.direction + d * step);
      if (volume_of_holders(points, best, direction) > best.volume() * k_sure) continue;
      const Tube t = tube_along(points, direction, &best);
      if (t.volume() < best.volume() * (1 - k_rounding)) {
        last = t.direction - before;
        best = t;
        break;
      }
    }
    step = best.direction == before ? step / 2 : step * 1.5;
  }
  return best;
}

// A turn by the angle about doubles the volume at most.
double first_step(const Tube& t) {
  const double r = 2 * t.radius, h = t.high - t.low;
  return std::clamp(0.3 * std::min(r, h) / std::max({r, h, 1e-300}), 1e-13, 0.1);
}

// The least on a circle of directions about this one: a crease that a few fixed directions would miss crosses
// every small circle.
Tube least_around(std::span<const Double3> points, const Tube& middle, double step) {
  constexpr int k_angles = 12, k_sections = 12, k_valleys = 2;
  constexpr double k_golden = 0.6180339887498949, k_apart = 2 * std::numbers::pi / k_angles;
  const Double3& direction = middle.direction;
  const Double3 u = any_normal(direction), v = cross(direction, u);
  const auto at = [&](double angle) {
    return tube_along(points, normalized(direction + (u * std::cos(angle) + v * std::sin(angle)) * step),
                      &middle);
  };
  std::array<double, k_angles> volume;
  Tube best;
  for (int k = 0; k < k_angles; ++k) {
    const Tube t = at(k * k_apart);
    volume[k] = t.volume();
    if (k == 0 || volume[k] < best.volume()) best = t;
  }
  std::vector<int> valleys;
  for (int k = 0; k < k_angles; ++k) {
    if (volume[k] <= volume[(k + 1) % k_angles] && volume[k] <= volume[(k + k_angles - 1) % k_angles])
      valleys.push_back(k);
  }
  std::stable_sort(valleys.begin(), valleys.end(), [&](int a, int b) { return volume[a] < volume[b]; });
  for (std::size_t i = 0; i < valleys.size() && i < k_valleys; ++i) {
    double low = (valleys[i] - 1) * k_apart, high = (valleys[i] + 1) * k_apart;
    double a = high - (high - low) * k_golden, b = low + (high - low) * k_golden;
    Tube left = at(a), right = at(b);
    for (int k = 0; k < k_sections; ++k) {
      const bool to_left = left.volume() < right.volume();
      if ((to_left ? left : right).volume() < best.volume()) best = to_left ? left : right;
      if (to_left) {
        high = b, b = a, right = left;
        left = at(a = high - (high - low) * k_golden);
      } else {
        low = a, a = b, left = right;
        right = at(b = low + (high - low) * k_golden);
      }
    }
  }
  return best;
}

Tube polish(std::span<const Double3> points, Tube best, double step, double smallest) {
  for (int round = 0; round < k_rounds && step > smallest; ++round) {
    const Tube t = least_around(points, best, step);
    const bool gains = t.volume() < best.volume() * (1 - k_rounding);
    if (gains) best = t;
    step *= gains ? 1.5 : 0.5;
  }
  return best;
}

// The least of the first ends when they are descended to the last digit; what is far above is given up early.
Tube best_polished(std::span<const Double3> points, const std::vector<Tube>& ends, std::size_t count,
                   const Deadline& deadline) {
  constexpr double k_first = 1.05, k_rough = 1.001;  // times the best volume
  Tube best = ends[0];
  std::vector<Double3> done;
  for (std::size_t i = 0; i < ends.size() && done.size() < count && !deadline.has_passed(); ++i) {
    if (ends[i].volume() > k_first * best.volume()) break;
    const double step = first_step(ends[i]);
    const auto near = [&](const Double3& d) { return length(cross(d, ends[i].direction)) < 1e-2 * step; };
    if (std::any_of(done.begin(), done.end(), near)) continue;
    const Tube rough = polish(points, ends[i], step * 0.1, 1e-3 * step);
    done.push_back(rough.direction);
    if (rough.volume() > k_rough * best.volume()) continue;
    const Tube end = polish(points, rough, step * 1e-3, 1e-7 * step);
    if (end.volume() < best.volume()) best = end;
  }
  return best;
}

Tube search(const ConvexHull& hull, const Deadline& deadline) {
  constexpr std::size_t k_least = 6;  // the world's axes and the hull's
  std::vector<Tube> tubes;
  for (const Double3& d : starts_for(hull)) {
    if (tubes.size() >= k_least && deadline.has_passed()) break;
    tubes.push_back(tube_along(hull.vertices, d));
  }
  const auto smaller = [](const Tube& a, const Tube& b) { return a.volume() < b.volume(); };
  std::stable_sort(tubes.begin(), tubes.end(), smaller);
  const bool small = hull.vertices.size() < k_small_hull;
  std::vector<Double3> starts;
  std::vector<Tube> ends{tubes[0]};
  double known = tubes[0].volume();
  for (std::size_t i = 0; i < tubes.size() && starts.size() < (small ? k_kept_small : k_kept); ++i) {
    const auto near = [&](const Double3& e) { return std::abs(dot(e, tubes[i].direction)) > 0.98; };
    if (std::any_of(starts.begin(), starts.end(), near)) continue;
    if (deadline.has_passed()) break;
    starts.push_back(tubes[i].direction);
    const double step = first_step(tubes[i]);
    ends.push_back(descend(hull.vertices, tubes[i], step, 1e-3 * step, known));
    known = std::min(known, ends.back().volume());
  }
  std::stable_sort(ends.begin(), ends.end(), smaller);
  return best_polished(hull.vertices, ends, small ? k_polished_small : k_polished, deadline);
}

// --- the bound --------------------------------------------------------------------------------------------

// A rectangle of the gnomonic map about one of three axes: its direction is axes[0] + x axes[1] + y axes[2].
struct Cell {
  int side = 0;
  double x = 0, y = 0, half_x = 1, half_y = 1;
  double bound = 0;
  std::uint64_t order = 0;
};
struct Later {
  bool operator()(const Cell& a, const Cell& b) const {
    return a.bound != b.bound ? a.bound > b.bound : a.order > b.order;
  }
};

class CylinderBounder {
 public:
  CylinderBounder(const ConvexHull& hull, const Tube& best, const MinimalCylinderOptions& options)
      : points_(hull.vertices),
        all_(hull.boundary),
        best_(best),
        whole_(tube_along(all_, best.direction)),
        options_(options),
        inner_(inner_radius(hull)) {
    const Axes base =
        rotated(axes_along(best.direction, any_normal(best.direction)), Double3{0, 0.0137, -0.0231});
    for (int i = 0; i < 3; ++i) sides_[i] = {base[i], base[(i + 1) % 3], base[(i + 2) % 3]};
  }

  double run() {
    for (int side = 0; side < 3; ++side) make({side, 0, 0, 1, 1, 0, 0}, 0);
    while (!open_.empty() && open_.top().bound < target() && made_ < options_.max_cells) {
      if (options_.deadline.has_passed()) break;
      const Cell cell = open_.top();
      open_.pop();
      const bool wide = cell.half_x >= cell.half_y;
      for (const int sign : {-1, 1}) {
        Cell half = cell;
        (wide ? half.half_x : half.half_y) /= 2;
        (wide ? half.x : half.y) += sign * (wide ? half.half_x : half.half_y);
        make(half, cell.bound);
      }
    }
    const double open = open_.empty() ? closed_ : std::min(closed_, open_.top().bound);
    return std::min(open, best_.volume());
  }
  const Tube& best() const { return best_; }
  const Tube& whole() const { return whole_; }

 private:
  // What a kernel gives away counts as a part of the gap.
  double target() const {
    return best_.volume() / (1 + reachable_gap(options_.gap, whole_.volume() / best_.volume()));
  }

  Double3 direction(const Cell& c, double x, double y) const {
    const Axes& s = sides_[c.side];
    return normalized(s[0] + s[1] * x + s[2] * y);
  }

  void make(Cell cell, double above) {
    const Double3 middle = direction(cell, cell.x, cell.y);
    double sine = 0;
    for (int k = 0; k < 4; ++k) {
      const double x = cell.x + (k & 1 ? cell.half_x : -cell.half_x),
                   y = cell.y + (k & 2 ? cell.half_y : -cell.half_y);
      sine = std::max(sine, length(cross(middle, direction(cell, x, y))));
    }
    sine = sine * (1 + 1e-12) + 1e-15;
    const Tube t = tube_along(points_, middle);
    if (t.volume() < best_.volume() * (1 - k_rounding)) {
      const Tube low = descend(points_, t, first_step(t) * 0.1, 1e-6 * first_step(t));
      if (low.volume() < best_.volume()) improve(low);
    }
    cell.order = made_++;
    cell.bound = std::max(above, bound_of(t, sine));
    if (cell.bound >= target()) {
      closed_ = std::min(closed_, cell.bound);
    } else {
      open_.push(cell);
    }
  }

  // What is less round a kernel need not be so round all points.
  void improve(const Tube& t) {
    best_ = t;
    const Tube whole = tube_along(all_, t.direction);
    if (whole.volume() < whole_.volume()) whole_ = whole;
  }

  // No cylinder is thinner, or lower, than a ball in the hull: across a needle nothing else would tell.
  double bound_of(const Tube& t, double sine) const {
    if (sine >= 1) return volume_of(inner_, 2 * inner_);
    constexpr double k_absolute = 1e-14;
    const double cosine = std::sqrt(1 - sine * sine);
    const Double3 e = t.last - t.first;
    const double height = cosine * (t.high - t.low) - sine * length(cross(e, t.direction)) - k_absolute;
    const double radius = cosine * t.lower_radius - sine * t.support_extent / 2 - k_absolute;
    return volume_of(std::max(inner_, radius), std::max(2 * inner_, height)) * (1 - k_rounding);
  }

  std::span<const Double3> points_, all_;
  Tube best_;   // round points_
  Tube whole_;  // the least known round all_
  const MinimalCylinderOptions& options_;
  double inner_;
  std::array<Axes, 3> sides_;
  std::priority_queue<Cell, std::vector<Cell>, Later> open_;
  double closed_ = std::numeric_limits<double>::infinity();
  std::uint64_t made_ = 0;
};

// A flat cloud fits a cylinder of no volume: a disc across its plane, or a segment.
Cylinder<double> flat_cylinder(const ConvexHull& hull) {
  return cylinder_along(hull.boundary, hull.dimension == 2 ? hull.axes[2] : hull.axes[0]);
}

}  // namespace

Cylinder<double> cylinder_along(std::span<const Double3> points, const Double3& direction) {
  return cylinder_of(tube_along(points, direction));
}

Cylinder<double> line_fit_cylinder(const PointCloud& cloud) {
  const PrincipalAxes spread = principal_axes(cloud.points);
  const Double3& u = spread.axes[0];
  Tube t;
  t.direction = u, t.centre = spread.mean;
  t.low = std::numeric_limits<double>::infinity(), t.high = -t.low;
  for (const Double3& p : cloud.points) {
    const Double3 d = p - spread.mean;
    const double h = dot(d, u);
    const Double3 away = d - u * h;
    t.low = std::min(t.low, h), t.high = std::max(t.high, h);
    t.radius = std::max(t.radius, dot(away, away));
  }
  t.radius = std::sqrt(t.radius);
  return cylinder_of(t);
}

Cylinder<double> recentred_cylinder(const PointCloud& cloud) {
  return cylinder_along(cloud.points, principal_axes(cloud.points).axes[0]);
}

BoundedFit<Cylinder<double>> minimal_cylinder(const ConvexHull& hull, const MinimalCylinderOptions& options) {
  if (hull.dimension < 3) return {flat_cylinder(hull), 0};
  const Tube best = search(hull, options.deadline);
  if (!std::isfinite(options.gap)) {
    const double bound = hull.least_volume;
    return {cylinder_along(hull.boundary, best.direction), std::min(bound, best.volume())};
  }
  CylinderBounder bounder(hull, best, options);
  const double bound = std::max(hull.least_volume, bounder.run());
  return {cylinder_of(bounder.whole()), std::min(bound, bounder.best().volume())};
}

}  // namespace copse
