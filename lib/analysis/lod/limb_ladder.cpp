#include "lib/analysis/lod/limb_ladder.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>

namespace copse {
namespace {

constexpr double k_rung_ratio = 0.88;  // of the triangles of the rung before: closer rungs are left out
constexpr double k_ribbon = 0.45, k_spike = 0.7;  // rms distance from a tube of radius 1

// How far a regular k-gon lies from the circle of its perimeter, rms, as a share of the radius.
double roughness(std::uint32_t sides) {
  return sides == 2 ? k_ribbon : sides == 1 ? k_spike : 1.7 / (static_cast<double>(sides) * sides);
}

// The inner rings in the order in which they go: each time the one that costs least.
struct Removal {
  double cost = 0;
  std::uint32_t ring = 0, version = 0;
  bool operator<(const Removal& b) const { return cost != b.cost ? cost > b.cost : ring > b.ring; }
};

// The angle by which a path turns, radians.
double bend(const Double3& from, const Double3& to) {
  return std::atan2(length(cross(from, to)), dot(from, to));
}

// The mean of it in the pictures of level views all round.
double projected_bend(const Double3& from, const Double3& to) {
  constexpr int k_views = 8;  // half a turn: the other half shows the mirror images
  double sum = 0;
  for (int i = 0; i < k_views; ++i) {
    const double a = std::numbers::pi * i / k_views;
    const Double3 right{std::cos(a), 0, std::sin(a)};
    sum += bend({dot(from, right), from.y, 0}, {dot(to, right), to.y, 0});
  }
  return sum / k_views;
}

class RingOrder {
 public:
  RingOrder(const LimbShape& shape, const std::vector<std::uint8_t>& forks, RemovalOrder by)
      : shape_(shape), forks_(forks), by_(by) {
    const auto n = static_cast<std::uint32_t>(shape.ring_count());
    for (std::uint32_t i = 0; i < n; ++i) before_.push_back(i - 1), after_.push_back(i + 1);
    version_.assign(n, 0), interval_.assign(n, 0);
    std::priority_queue<Removal> queue;
    for (std::uint32_t i = 1; i + 1 < n; ++i) queue.push({cost(i), i, 0});
    costs.push_back(0), bounds.push_back(0);
    while (!queue.empty()) {
      const Removal next = queue.top();
      queue.pop();
      if (next.version != version_[next.ring]) continue;
      remove(next.ring, queue, n);
    }
  }

  std::vector<std::uint32_t> order;   // rings as they go
  std::vector<double> costs, bounds;  // after so many have gone

 private:
  double cost(std::uint32_t i) const {
    const Double3 &a = shape_.ring(before_[i]).centre, &b = shape_.ring(i).centre,
                  &c = shape_.ring(after_[i]).centre;
    const double weight = forks_[i] ? 2 : 1;
    if (by_ == RemovalOrder::angle) return weight * bend(b - a, c - b);
    if (by_ == RemovalOrder::projected_angle) return weight * projected_bend(b - a, c - b);
    if (by_ == RemovalOrder::diameter) return weight * shape_.ring(i).radius;
    const double extra = shape_.area_error(before_[i], after_[i]) - interval_[before_[i]] - interval_[i];
    return std::max(extra, 0.0) * weight;
  }
  void remove(std::uint32_t i, std::priority_queue<Removal>& queue, std::uint32_t n) {
    const std::uint32_t a = before_[i], b = after_[i];
    const double joined = shape_.area_error(a, b);
    costs.push_back(std::max(costs.back(), total_ += joined - interval_[a] - interval_[i]));
    bounds.push_back(std::max(bounds.back(), shape_.largest_error(a, b)));
    interval_[a] = joined;
    order.push_back(i);
    after_[a] = b, before_[b] = a;
    ++version_[i];
    for (const std::uint32_t neighbour : {a, b}) {
      if (neighbour > 0 && neighbour + 1 < n) queue.push({cost(neighbour), neighbour, ++version_[neighbour]});
    }
  }

  const LimbShape& shape_;
  const std::vector<std::uint8_t>& forks_;
  RemovalOrder by_;
  std::vector<std::uint32_t> before_, after_, version_;
  std::vector<double> interval_;  // error of the interval that begins at a ring
  double total_ = 0;
};

std::vector<std::uint32_t> side_counts(std::uint32_t most) {
  std::vector<std::uint32_t> counts;
  for (std::uint32_t k = most; k > 3; k = k > 8 ? k * 3 / 4 : k - 1) counts.push_back(k);
  counts.push_back(3), counts.push_back(2);
  return counts;
}

// Walks down in rings and sides, each time the way that costs less a triangle.
class Walk {
 public:
  Walk(const LimbShape& shape, const RingOrder& rings)
      : shape_(shape), rings_(rings), sides_(side_counts(shape.sides())) {
    for (std::size_t i = 0; i + 1 < shape.ring_count(); ++i) {
      const double l = shape.length_between(i, i + 1);
      girth_ += l * 0.5 * (shape.ring(i).radius + shape.ring(i + 1).radius);
      rough_ += l * 0.5 * (shape.ring(i).residual + shape.ring(i + 1).residual);
    }
    for (std::size_t i = 0; i < shape.ring_count(); ++i)
      thickest_ = std::max(thickest_, shape.ring(i).radius);
    for (std::size_t i = 0; i < shape.ring_count(); ++i)
      residual_ = std::max(residual_, shape.ring(i).residual);
  }

  double girth() const { return girth_; }
  double thickest() const { return thickest_; }

  std::vector<LimbRung> rungs() {
    std::vector<LimbRung> out;
    std::size_t gone = 0, k = 0;
    for (;;) {
      out.push_back(rung(gone, k));
      const bool fewer_rings = gone < rings_.order.size(), fewer_sides = k + 1 < sides_.size();
      if (!fewer_rings && !fewer_sides) return out;
      if (!fewer_sides ||
          (fewer_rings && slope(out.back(), state(gone + 1, k)) <= slope(out.back(), state(gone, k + 1)))) {
        ++gone;
      } else {
        ++k;
      }
    }
  }

 private:
  LimbRung state(std::size_t gone, std::size_t k) const {
    LimbRung r;
    r.sides = sides_[k];
    r.triangles = shape_.triangles(shape_.ring_count() - gone, r.sides);
    const double rough = std::max(0.0, roughness(r.sides) - roughness(sides_.front()));
    r.cost = rings_.costs[gone] + girth_ * rough + rough_;
    r.bound = rings_.bounds[gone] + 2 * rough * thickest_ + 3 * residual_;
    return r;
  }
  LimbRung rung(std::size_t gone, std::size_t k) const {
    LimbRung r = state(gone, k);
    std::vector<std::uint8_t> is_gone(shape_.ring_count(), 0);
    for (std::size_t i = 0; i < gone; ++i) is_gone[rings_.order[i]] = 1;
    for (std::uint32_t i = 0; i < is_gone.size(); ++i)
      if (!is_gone[i]) r.kept.push_back(i);
    return r;
  }
  static double slope(const LimbRung& from, const LimbRung& to) {
    return (to.cost - from.cost) / std::max(1.0, static_cast<double>(from.triangles) - to.triangles);
  }

  const LimbShape& shape_;
  const RingOrder& rings_;
  std::vector<std::uint32_t> sides_;
  double girth_ = 0, rough_ = 0, thickest_ = 0, residual_ = 0;
};

// Keeps what is on the lower convex hull of cost over triangles, from (full, 0) on.
std::vector<LimbRung> convex(std::vector<LimbRung> rungs, std::uint32_t full) {
  std::vector<LimbRung> hull;
  const auto slope = [&](const LimbRung* a, const LimbRung& b) {
    const double from = a ? a->cost : 0, triangles = a ? a->triangles : full;
    return (b.cost - from) / (triangles - b.triangles);
  };
  for (LimbRung& r : rungs) {
    if (r.triangles >= (hull.empty() ? full : hull.back().triangles)) {
      continue;
    }
    while (!hull.empty()) {
      const LimbRung* before = hull.size() > 1 ? &hull[hull.size() - 2] : nullptr;
      if (slope(before, hull.back()) < slope(&hull.back(), r)) break;
      hull.pop_back();
    }
    hull.push_back(std::move(r));
  }
  return hull;
}

}  // namespace

std::vector<LimbRung> limb_ladder(const LimbShape& shape, const std::vector<std::uint8_t>& forks,
                                  std::uint32_t full, double vanish, RemovalOrder order) {
  const RingOrder rings(shape, forks, order);
  Walk walk(shape, rings);
  std::vector<LimbRung> all = walk.rungs();
  const double length = shape.length_between(0, shape.ring_count() - 1);
  if (!shape.pointed()) {
    LimbRung spike = all.back();
    spike.sides = 1, spike.triangles = 1;
    spike.cost += walk.girth() * (k_spike - k_ribbon);
    all.push_back(spike);
  }
  all.push_back({.kept = {},
                 .sides = 0,
                 .triangles = 0,
                 .cost = walk.girth() * vanish + all.back().cost * 1e-9,
                 .bound = length + walk.thickest()});
  all.back().cost = std::max(all.back().cost, all[all.size() - 2].cost * 1.001);
  std::vector<LimbRung> hull = convex(std::move(all), full);
  std::vector<LimbRung> out;
  double last = full;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    if (i + 1 < hull.size() && hull[i].triangles > k_rung_ratio * last) continue;
    last = hull[i].triangles;
    out.push_back(std::move(hull[i]));
  }
  return out;
}

}  // namespace copse
