#include "lib/analysis/swept/swept_descent.h"

#include <algorithm>

namespace copse {
namespace {

constexpr double k_room = 0.05;        // by which a start is larger than it must be
constexpr std::size_t k_added = 6;     // points a round
constexpr double k_first_gap = 1e-3;   // no exact optimum over points that are not yet the right ones
constexpr double k_sticks_out = 1e-9;  // of the radius: less is left to the final growth

// The points that stick out most, none near another in the list of offsets: the worst of each octant of the
// offset, worst first.
void add_worst(std::span<const Double3> points, const SweptFit& fit, std::vector<std::uint32_t>& working,
               double limit) {
  std::array<std::pair<double, std::uint32_t>, 16> worst;
  worst.fill({limit * limit, 0});
  std::array<bool, 16> found{};
  const SweptRectangle& s = fit.rectangle;
  const double mid_a = (s.a0 + s.a1) / 2, mid_b = (s.b0 + s.b1) / 2;
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    const Double3 q = into(fit.frame, points[i]), e = offset_from(s, q);
    const double square = dot(e, e);
    if (square <= limit * limit) continue;
    const int key = (q.x > mid_a) | (q.y > mid_b) << 1 | (e.z > 0) << 2 | (e.x != 0) << 3;
    if (square > worst[key].first) worst[key] = {square, i}, found[key] = true;
  }
  std::vector<std::pair<double, std::uint32_t>> order;
  for (int k = 0; k < 16; ++k) {
    if (found[k]) order.push_back(worst[k]);
  }
  std::sort(order.begin(), order.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first > b.first : a.second < b.second;
  });
  for (std::size_t k = 0; k < order.size() && k < k_added; ++k) working.push_back(order[k].second);
}

std::vector<Double3> chosen(std::span<const Double3> points, const std::vector<std::uint32_t>& indices) {
  std::vector<Double3> out;
  for (const std::uint32_t i : indices) out.push_back(points[i]);
  return out;
}

}  // namespace

// Strictly round all points, and with lengths: what is on the boundary cannot be descended from.
void make_room(Swept kind, std::span<const Double3> points, double size, double room, SweptFit& fit) {
  SweptRectangle& s = fit.rectangle;
  s.r = std::max(reach_of(points, fit) * (1 + room), size * 1e-14);
  const double least = s.r * 0.05, a = (s.a0 + s.a1) / 2, b = (s.b0 + s.b1) / 2;
  if (s.a1 - s.a0 < least) s.a0 = a - least / 2, s.a1 = a + least / 2;
  if (kind == Swept::lozenge && s.b1 - s.b0 < least) s.b0 = b - least / 2, s.b1 = b + least / 2;
}

SweptRectangle roomy_rectangle(Swept kind, std::span<const Double3> points, const Axes& frame) {
  DoubleBox box;
  for (const Double3& p : points) box.grow(into(frame, p));
  SweptFit fit{frame, {}};
  SweptRectangle& s = fit.rectangle;
  const Double3 middle = box.centre();
  s = {box.min.x, box.max.x, box.min.y, box.max.y, middle.z, 0};
  if (kind != Swept::lozenge) s.b0 = s.b1 = middle.y;
  make_room(kind, points, std::max({box.extent().x, box.extent().y, box.extent().z}), k_room, fit);
  return s;
}

std::vector<std::uint32_t> extreme_points(std::span<const Double3> points, const Axes& frame) {
  constexpr int k_directions = 7;
  std::array<double, 2 * k_directions> most;
  most.fill(-std::numeric_limits<double>::infinity());
  std::array<std::uint32_t, 2 * k_directions> at{};
  DoubleBox box;
  for (const Double3& p : points) box.grow(into(frame, p));
  // Corners are sought in the box scaled to a cube.
  const Double3 x = box.extent();
  const Double3 scale{x.x > 0 ? 1 / x.x : 1, x.y > 0 ? 1 / x.y : 1, x.z > 0 ? 1 / x.z : 1};
  const Double3 middle = box.centre();
  for (std::uint32_t i = 0; i < points.size(); ++i) {
    Double3 q = into(frame, points[i]) - middle;
    q = {q.x * scale.x, q.y * scale.y, q.z * scale.z};
    const std::array<double, k_directions> along{
        q.x, q.y, q.z, q.x + q.y + q.z, q.x + q.y - q.z, q.x - q.y + q.z, q.x - q.y - q.z};
    for (int k = 0; k < k_directions; ++k) {
      if (along[k] > most[2 * k]) most[2 * k] = along[k], at[2 * k] = i;
      if (-along[k] > most[2 * k + 1]) most[2 * k + 1] = -along[k], at[2 * k + 1] = i;
    }
  }
  std::vector<std::uint32_t> out(at.begin(), at.end());
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

double reach_of(std::span<const Double3> points, const SweptFit& fit) {
  double square = 0;
  for (const Double3& p : points) {
    const Double3 e = offset_from(fit.rectangle, into(fit.frame, p));
    square = std::max(square, dot(e, e));
  }
  return std::sqrt(square);
}

double cost_of(Swept kind, const SweptFit& fit) {
  return kind == Swept::line ? fit.rectangle.r : fit.volume();
}

SweptDescent::SweptDescent(Swept kind, std::span<const Double3> points, const Axes& start)
    : kind_(kind), points_(points), fit_{orthonormal(start), {}} {
  working_ = extreme_points(points, fit_.frame);
  fit_.rectangle = roomy_rectangle(kind, points, fit_.frame);
}

SweptDescent::SweptDescent(Swept kind, std::span<const Double3> points, const SweptFit& start, double room)
    : kind_(kind), points_(points), fit_(start) {
  working_ = extreme_points(points, fit_.frame);
  DoubleBox box;
  for (const Double3& p : points) box.grow(p);
  make_room(kind, points, std::max({box.extent().x, box.extent().y, box.extent().z}), room, fit_);
}

bool SweptDescent::is_done(const DescentOptions& options) const {
  return reach_ > 0 && reach_ <= fit_.rectangle.r * (1 + k_sticks_out) && gaps_.last <= options.gap;
}

// Room for a next round, with the points that have stuck out.
void SweptDescent::add_points(const DescentOptions& options) {
  const double r = fit_.rectangle.r, excess = std::max(0.0, reach_ / r - 1);
  if (excess > k_sticks_out) add_worst(points_, fit_, working_, r);
  // Once nothing sticks out by much it pays to be exact.
  gaps_.first = std::min(0.3, std::max(excess, 10 * gaps_.last));
  gaps_.last = std::max(options.gap, std::min(gaps_.last, excess * 0.01));
  fit_.rectangle.r = reach_ + std::max(0.5 * (reach_ - r), 0.3 * gaps_.first * r);
}

void SweptDescent::run(const DescentOptions& options) {
  for (int round = 0; round < options.rounds && !is_done(options); ++round) {
    if (reach_ > 0) {
      add_points(options);
    } else {
      gaps_ = {options.first_gap, std::max(options.gap, k_first_gap)};
    }
    descend(kind_, chosen(points_, working_), fit_, gaps_);
    reach_ = reach_of(points_, fit_);
    if (least_cost() > options.hopeless) return;
  }
}

SweptFit SweptDescent::fit() const {
  SweptFit whole = fit_;
  whole.rectangle.r = reach_;
  return whole;
}

double SweptDescent::least_cost() const {
  constexpr double k_gaps = 2;  // what is beyond the theory of convex problems
  return cost_of(kind_, fit_) * (1 - k_gaps * gaps_.last);
}

SweptFit descend_around(Swept kind, std::span<const Double3> points, const Axes& start,
                        const DescentOptions& options) {
  SweptDescent descent(kind, points, start);
  descent.run(options);
  return descent.fit();
}

}  // namespace copse
