#include "lib/analysis/lod/limb_ladder.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <queue>

namespace copse {
namespace {

constexpr double k_rung_ratio = 0.85;  // of the triangles of the rung before: closer rungs are left out
constexpr double k_ribbon = 0.45, k_spike = 0.7;  // rms distance from a tube of radius 1

// Of leaves whose twig went elsewhere, in square metres of silhouette a square metre of leaf.
constexpr double k_left_behind = 0.5;

double roughness(std::uint32_t sides) {
  return sides == 2 ? k_ribbon : sides == 1 ? k_spike : polygon_roughness(sides);
}

// From its edge a ribbon is not seen. Where many limbs are ribbons, as much is too wide in any view as is
// too thin; of the one that the trunk is made of, all goes at once. What that costs, in radii, when there is
// no other limb.
constexpr double k_alone = 2;

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
  RingOrder(const LimbShape& shape, const std::vector<std::uint8_t>& forks, RemovalOrder by,
            const HangingLeaves& leaves)
      : shape_(shape), forks_(forks), by_(by), leaves_(leaves) {
    const auto n = static_cast<std::uint32_t>(shape.ring_count());
    for (std::uint32_t i = 0; i < n; ++i) before_.push_back(i - 1), after_.push_back(i + 1);
    version_.assign(n, 0), interval_.assign(n, 0), turned_.assign(n, 0);
    std::priority_queue<Removal> queue;
    for (std::uint32_t i = 1; i + 1 < n; ++i) queue.push({cost(i), i, 0});
    costs.push_back(0), turns.push_back(0), bounds.push_back(0);
    while (!queue.empty()) {
      const Removal next = queue.top();
      queue.pop();
      if (next.version != version_[next.ring]) continue;
      remove(next.ring, queue, n);
    }
  }

  std::vector<std::uint32_t> order;   // rings as they go
  std::vector<double> costs, bounds;  // after so many have gone
  std::vector<double> turns;          // of costs that are the rings' own corners'

 private:
  double cost(std::uint32_t i) const {
    const Double3 &a = shape_.ring(before_[i]).centre, &b = shape_.ring(i).centre,
                  &c = shape_.ring(after_[i]).centre;
    const double weight = forks_[i] ? 2 : 1;
    if (by_ == RemovalOrder::angle) return weight * bend(b - a, c - b);
    if (by_ == RemovalOrder::projected_angle) return weight * projected_bend(b - a, c - b);
    if (by_ == RemovalOrder::diameter) return weight * shape_.ring(i).radius;
    const double extra = error(before_[i], after_[i]) + shape_.turned_error(before_[i], after_[i]) -
                         interval_[before_[i]] - interval_[i] - turned_[before_[i]] - turned_[i];
    return std::max(extra, 0.0) * weight;
  }
  double error(std::size_t a, std::size_t b) const {
    return shape_.area_error(a, b) + k_left_behind * shape_.left_behind(a, b, leaves_.area, leaves_.hold);
  }
  void remove(std::uint32_t i, std::priority_queue<Removal>& queue, std::uint32_t n) {
    const std::uint32_t a = before_[i], b = after_[i];
    const double joined = error(a, b);
    costs.push_back(std::max(costs.back(), total_ += joined - interval_[a] - interval_[i]));
    bounds.push_back(std::max(bounds.back(), shape_.largest_error(a, b)));
    const double turned = shape_.turned_error(a, b);
    turns.push_back(std::max(0.0, turns.back() + turned - turned_[a] - turned_[i]));
    interval_[a] = joined, turned_[a] = turned;
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
  HangingLeaves leaves_;
  std::vector<std::uint32_t> before_, after_, version_;
  std::vector<double> interval_, turned_;  // errors of the interval that begins at a ring
  double total_ = 0;
};

std::vector<std::uint32_t> side_counts(std::uint32_t most) {
  std::vector<std::uint32_t> counts;
  for (std::uint32_t k = most; k > 3; k = k > 8 ? k * 3 / 4 : k - 1) counts.push_back(k);
  if (most > 2) counts.push_back(3);
  counts.push_back(2);
  return counts;
}

// A rung before its rings are named.
struct Rung {
  std::size_t gone = 0;     // rings, in their order
  std::uint32_t sides = 0;  // 0: nothing is left
  std::uint32_t triangles = 0;
  double cost = 0, bound = 0;
};

// Walks down in rings and sides, each time the way that costs less a triangle.
class Walk {
 public:
  Walk(const LimbShape& shape, const RingOrder& rings, double share)
      : shape_(shape), rings_(rings), sides_(side_counts(shape.sides())), alone_(k_alone * share) {
    for (std::size_t i = 0; i + 1 < shape.ring_count(); ++i) {
      const double l = shape.length_between(i, i + 1);
      girth_ +=
          l * 0.5 * (shape.ring(i).radius * shape.weight(i) + shape.ring(i + 1).radius * shape.weight(i + 1));
      rough_ += l * 0.5 * (shape.ring(i).residual + shape.ring(i + 1).residual);
    }
    for (std::size_t i = 0; i < shape.ring_count(); ++i)
      thickest_ = std::max(thickest_, shape.ring(i).radius);
    for (std::size_t i = 0; i < shape.ring_count(); ++i)
      residual_ = std::max(residual_, shape.ring(i).residual);
  }

  double girth() const { return girth_; }
  double thickest() const { return thickest_; }

  std::vector<Rung> rungs() const {
    std::vector<Rung> out;
    std::size_t gone = 0, k = 0;
    for (;;) {
      out.push_back(rung(gone, k));
      const bool fewer_rings = gone < rings_.order.size(), fewer_sides = k + 1 < sides_.size();
      if (!fewer_rings && !fewer_sides) return out;
      if (!fewer_sides ||
          (fewer_rings && slope(out.back(), rung(gone + 1, k)) <= slope(out.back(), rung(gone, k + 1)))) {
        ++gone;
      } else {
        ++k;
      }
    }
  }

  LimbRung made(const Rung& r) const {
    LimbRung out{.kept = {}, .sides = r.sides, .triangles = r.triangles, .cost = r.cost, .bound = r.bound};
    if (r.sides == 0) return out;
    std::vector<std::uint8_t> is_gone(shape_.ring_count(), 0);
    for (std::size_t i = 0; i < r.gone; ++i) is_gone[rings_.order[i]] = 1;
    for (std::uint32_t i = 0; i < is_gone.size(); ++i)
      if (!is_gone[i]) out.kept.push_back(i);
    return out;
  }

 private:
  Rung rung(std::size_t gone, std::size_t k) const {
    Rung r{.gone = gone, .sides = sides_[k]};
    r.triangles = shape_.triangles(shape_.ring_count() - gone, r.sides);
    // The mesh's own polygon lies off the circle too, but elsewhere: a square becomes no triangle for free.
    const double rough = k == 0 ? 0 : std::hypot(roughness(r.sides), roughness(sides_.front()));
    r.cost = rings_.costs[gone] + (k == 0 ? rings_.turns[gone] : girth_ * rough) + rough_;
    if (r.sides == 2 && k > 0) r.cost += girth_ * alone_;
    r.bound = rings_.bounds[gone] + 2 * rough * thickest_ + 3 * residual_;
    return r;
  }
  static double slope(const Rung& from, const Rung& to) {
    return (to.cost - from.cost) / std::max(1.0, static_cast<double>(from.triangles) - to.triangles);
  }

  const LimbShape& shape_;
  const RingOrder& rings_;
  std::vector<std::uint32_t> sides_;
  double alone_ = 0, girth_ = 0, rough_ = 0, thickest_ = 0, residual_ = 0;
};

// Keeps what is on the lower convex hull of cost over triangles, from (full, 0) on.
std::vector<Rung> convex(const std::vector<Rung>& rungs, std::uint32_t full) {
  std::vector<Rung> hull;
  const auto slope = [&](const Rung* a, const Rung& b) {
    const double from = a ? a->cost : 0, triangles = a ? a->triangles : full;
    return (b.cost - from) / (triangles - b.triangles);
  };
  for (const Rung& r : rungs) {
    if (r.triangles >= (hull.empty() ? full : hull.back().triangles)) continue;
    while (!hull.empty()) {
      const Rung* before = hull.size() > 1 ? &hull[hull.size() - 2] : nullptr;
      if (slope(before, hull.back()) < slope(&hull.back(), r)) break;
      hull.pop_back();
    }
    hull.push_back(r);
  }
  return hull;
}

// One triangle as large as the ribbon: the less it tapers, the more it differs.
double spike_roughness(const LimbShape& shape) {
  const double first = shape.ring(0).radius, last = shape.ring(shape.ring_count() - 1).radius;
  return first + last > 0 ? 2 * last / (first + last) * (k_spike - k_ribbon) : 0;
}

}  // namespace

std::vector<LimbRung> limb_ladder(const LimbShape& shape, const std::vector<std::uint8_t>& forks,
                                  std::uint32_t full, double vanish, RemovalOrder order,
                                  const HangingLeaves& leaves, double share) {
  const RingOrder rings(shape, forks, order, leaves);
  const Walk walk(shape, rings, share);
  std::vector<Rung> all = walk.rungs();
  const double length = shape.length_between(0, shape.ring_count() - 1);
  if (!shape.pointed()) {
    Rung spike = all.back();
    spike.sides = 1, spike.triangles = 1;
    spike.cost += walk.girth() * spike_roughness(shape);
    all.push_back(spike);
  }
  all.push_back({.triangles = 0,
                 .cost = std::max(walk.girth() * vanish + all.back().cost * 1e-9, all.back().cost * 1.001),
                 .bound = length + walk.thickest()});
  const std::vector<Rung> hull = convex(all, full);
  std::vector<LimbRung> out;
  double last = full;
  for (std::size_t i = 0; i < hull.size(); ++i) {
    if (i + 1 < hull.size() && hull[i].triangles > k_rung_ratio * last) continue;
    last = hull[i].triangles;
    out.push_back(walk.made(hull[i]));
  }
  return out;
}

}  // namespace copse
