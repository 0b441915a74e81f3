#include "lib/analysis/boxes/box_bound.h"

#include "lib/analysis/hull/principal_axes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <queue>
#include <vector>

namespace copse {
namespace {

constexpr double k_zone = 0.41421356237309515;  // tan(pi / 8), rounded up
constexpr double k_rounding = 1e-14;            // of a pair's length: the error of its products
constexpr int k_corners = 8;
constexpr double k_lean = 0.05;  // of the width: what terms of second order may take from it
constexpr auto k_mixed = static_cast<std::uint32_t>(-1);  // of a combination of pairs
constexpr int k_steps = 24;                               // of the search for a combination of pairs
// The zone's cell is a little larger than the zone and off its middle, so that the known minimum does not lie
// on the boundary of cells; but not turned: turns about a needle's axis must lie along one component.
constexpr Double3 k_aside{0.0137, -0.0231, 0.0179};

using Candidates = std::array<std::vector<std::uint32_t>, 3>;  // per axis: what can be first or last along it

struct Cell {
  Double3 middle, half;
  double bound = 0;
  int split = 0;  // the component to halve
  std::uint64_t order = 0;
  std::shared_ptr<const Candidates> candidates;
};

struct Later {
  bool operator()(const Cell& a, const Cell& b) const {
    return a.bound != b.bound ? a.bound > b.bound : a.order > b.order;
  }
};

// A bound of the width along one axis from one pair of vertices, or from a convex combination of some.
struct PairBound {
  std::uint32_t first = 0, last = 0;
  Double3 d;                           // from first to last, in the axes of the cell's middle
  double error = 0;                    // of its products
  std::array<double, k_corners> at{};  // the cell's corners
};

struct Ends {
  std::uint32_t first = 0, last = 0;
  double low = 0, high = 0;
};

double log_or_none(double x) {
  return x > 0 ? std::log(x) : -std::numeric_limits<double>::infinity();
}

class BoxBounder {
 public:
  BoxBounder(std::span<const Double3> vertices, const Axes& base, double volume,
             const BoxBoundOptions& options)
      : vertices_(vertices),
        length_(principal_axes(vertices).axes[0]),
        base_(base),
        volume_(volume),
        options_(options) {}

  BoxBound run() {
    push_root();
    while (!open_.empty() && open_.top().bound < target() && made_ < options_.max_cells) {
      if (options_.deadline.has_passed()) break;
      const Cell cell = open_.top();
      open_.pop();
      Double3 half = cell.half;
      half[cell.split] /= 2;
      for (const double side : {-1.0, 1.0}) {
        Double3 middle = cell.middle;
        middle[cell.split] += side * half[cell.split];
        make(middle, half, *cell.candidates, cell.bound);
      }
    }
    const double open = open_.empty() ? closed_ : std::min(closed_, open_.top().bound);
    return {std::min(open, volume_), made_};
  }

 private:
  double target() const { return volume_ / (1 + options_.gap); }

  void push_root() {
    Candidates all;
    for (auto& list : all) {
      for (std::uint32_t i = 0; i < vertices_.size(); ++i) list.push_back(i);
    }
    Double3 half;
    for (int i = 0; i < 3; ++i) half[i] = k_zone + std::abs(k_aside[i]);
    make(k_aside, half, all, 0);
  }

  Ends ends_along(const Double3& axis, const std::vector<std::uint32_t>& list) const {
    Ends e{list[0], list[0], dot(axis, vertices_[list[0]]), 0};
    e.high = e.low;
    for (const std::uint32_t i : list) {
      const double d = dot(axis, vertices_[i]);
      if (d < e.low) e.low = d, e.first = i;
      if (d > e.high) e.high = d, e.last = i;
    }
    return e;
  }

  // What can be first or last along an axis within the angle whose sine squared is given.
  std::vector<std::uint32_t> within(const Double3& axis, const Ends& e, double sine_squared,
                                    const std::vector<std::uint32_t>& list) const {
    std::vector<std::uint32_t> kept;
    const Double3 &first = vertices_[e.first], &last = vertices_[e.last];
    const auto can_pass = [&](double behind, const Double3& away) {
      return behind * behind <= sine_squared * dot(away, away) * (1 + 1e-9) + 1e-28;
    };
    for (const std::uint32_t i : list) {
      const Double3& p = vertices_[i];
      const double d = dot(axis, p);
      if (can_pass(d - e.low, p - first) || can_pass(e.high - d, p - last)) kept.push_back(i);
    }
    return kept;
  }

  void make(const Double3& middle, const Double3& half, const Candidates& above, double bound_above) {
    const Double3 nearest{std::max(0.0, std::abs(middle.x) - half.x),
                          std::max(0.0, std::abs(middle.y) - half.y),
                          std::max(0.0, std::abs(middle.z) - half.z)};
    if (nearest.x + nearest.y + nearest.z > 1 + 1e-9) return;  // outside the zone
    ++made_;
    find_corners(middle, half);
    const Axes axes = rotated(base_, middle);
    const double sine = std::min(1.0, 2 * std::sqrt(reach_) / (1 + reach_));
    const double sine_squared = reach_ < 1 ? sine * sine : 1;
    auto candidates = std::make_shared<Candidates>();
    for (auto& list : pairs_) list.clear();
    double here = 1;
    for (int i = 0; i < 3; ++i) {
      const Ends e = ends_along(axes[i], above[i]);
      here *= e.high - e.low;
      (*candidates)[i] = within(axes[i], e, sine_squared, above[i]);
      add_pair(axes, i, e);
    }
    if (here < volume_ * (1 - 1e-7) && options_.improve)
      volume_ = std::min(volume_, options_.improve(axes, here));
    double bound = std::max(bound_above, combined(0));
    if (bound < target()) {
      for (const Double3& corner : corners_) {
        const Axes turned = rotated(axes, corner);
        for (int i = 0; i < 3; ++i) add_pair(axes, i, ends_along(turned[i], (*candidates)[i]));
      }
      for (int i = 0; i < 3; ++i) add_level_pairs(axes, i, above[i]);
      bound = std::max(bound, combined(k_steps));
    }
    if (bound >= target()) {
      closed_ = std::min(closed_, bound);
      return;
    }
    open_.push({middle, half, bound, widest(half), made_, std::move(candidates)});
  }

  // The turns, relative to the middle frame, of the cell's corners.
  void find_corners(const Double3& c, const Double3& half) {
    reach_ = 0;
    most_ = {};
    for (int k = 0; k < k_corners; ++k) {
      const Double3 d{k & 1 ? half.x : -half.x, k & 2 ? half.y : -half.y, k & 4 ? half.z : -half.z};
      corners_[k] = (d - cross(c, d)) / (1 + dot(c, c) + dot(c, d));
      reach_ = std::max(reach_, dot(corners_[k], corners_[k]));
      for (int i = 0; i < 3; ++i) most_[i] = std::max(most_[i], std::abs(corners_[k][i]) * (1 + 1e-12));
    }
    reach_ *= 1 + 1e-12;
  }

  void add_pair(const Axes& axes, int i, const Ends& e) {
    for (const PairBound& p : pairs_[i]) {
      if (p.first == e.first && p.last == e.last) return;
    }
    const Double3 world = vertices_[e.last] - vertices_[e.first];
    PairBound p{e.first, e.last, {dot(world, axes[0]), dot(world, axes[1]), dot(world, axes[2])}, 0, {}};
    p.error = k_rounding * length(p.d);
    p.at = at_corners(i, p);
    pairs_[i].push_back(p);
  }

  // By each component of the turn.
  static Double3 slope(int i, const Double3& d) {
    Double3 unit;
    unit[i] = 1;
    return cross(unit, d) * 2;
  }

  std::array<double, k_corners> at_corners(int i, const PairBound& p) const {
    // The terms of second order are d_i (r_i^2 - r_j^2 - r_k^2) + 2 r_i (r_j d_j + r_k d_k).
    const int j = (i + 1) % 3, m = (i + 2) % 3;
    const double squares = p.d[i] > 0 ? most_[j] * most_[j] + most_[m] * most_[m] : most_[i] * most_[i];
    const double mixed = most_[j] * std::abs(p.d[j]) + most_[m] * std::abs(p.d[m]);
    const double least = p.d[i] - std::abs(p.d[i]) * squares - 2 * most_[i] * mixed - p.error;
    const Double3 along = slope(i, p.d);
    std::array<double, k_corners> at;
    for (int k = 0; k < k_corners; ++k) at[k] = least + dot(corners_[k], along);
    return at;
  }

  static PairBound mixed(const PairBound& a, const PairBound& b, double t) {
    return {k_mixed, k_mixed, a.d + (b.d - a.d) * t, (a.error + (b.error - a.error) * t) * (1 + 1e-12), {}};
  }

  // Of a needle across its length a pair's terms of second order outweigh its width, unless the pair lies
  // across. So what is extreme at right angles to the length is mixed with pairs that lean the other way
  // until it does.
  void add_level_pairs(const Axes& axes, int i, const std::vector<std::uint32_t>& list) {
    const int j = (i + 1) % 3, m = (i + 2) % 3;
    const PairBound& middle = pairs_[i][0];
    const double lost = 2 * most_[i] * (most_[j] * std::abs(middle.d[j]) + most_[m] * std::abs(middle.d[m]));
    if (lost < k_lean * middle.d[i]) return;
    const Double3 across = axes[i] - length_ * dot(length_, axes[i]);
    const std::size_t own = pairs_[i].size();
    add_pair(axes, i, ends_along(across, list));
    const std::size_t count = pairs_[i].size();
    const Double3 along{dot(length_, axes[0]), dot(length_, axes[1]), dot(length_, axes[2])};
    for (const std::size_t base : {std::size_t{0}, own}) {
      if (base == count) continue;
      const double from = dot(pairs_[i][base].d, along);
      for (std::size_t k = 0; k < count; ++k) {
        const double to = dot(pairs_[i][k].d, along);
        if (from * to >= 0) continue;
        PairBound level = mixed(pairs_[i][base], pairs_[i][k], from / (from - to));
        level.at = at_corners(i, level);
        pairs_[i].push_back(level);
      }
    }
  }

  // The one whose least bound is the largest; of equals the first.
  const PairBound& safest(int i) const {
    const auto least = [](const PairBound& p) { return *std::min_element(p.at.begin(), p.at.end()); };
    return *std::max_element(pairs_[i].begin(), pairs_[i].end(),
                             [&](const PairBound& a, const PairBound& b) { return least(a) < least(b); });
  }

  // The best bound met on the way from the safest pairs towards the best combination of all (Frank-Wolfe on a
  // smoothed minimum over the corners).
  double combined(int steps) const {
    std::array<PairBound, 3> mix{safest(0), safest(1), safest(2)};
    double best = product_of(mix);
    for (int step = 0; step < steps; ++step) {
      const std::array<double, k_corners> weight = weights_of(mix, 20.0 * (step + 1));
      const double towards = 2.0 / (step + 3);
      for (int i = 0; i < 3; ++i) {
        const PairBound* chosen = nullptr;
        double most = -std::numeric_limits<double>::infinity();
        const double floor = std::max(1e-9 * pairs_[i][0].d[i], 1e-300);
        for (const PairBound& p : pairs_[i]) {
          double gain = 0;
          for (int k = 0; k < k_corners; ++k) gain += weight[k] * p.at[k] / std::max(mix[i].at[k], floor);
          if (gain > most) most = gain, chosen = &p;
        }
        if (!chosen) continue;
        mix[i] = mixed(mix[i], *chosen, towards);
        mix[i].at = at_corners(i, mix[i]);
      }
      best = std::max(best, product_of(mix));
      if (best >= target()) break;
    }
    return best;
  }

  double product_of(const std::array<PairBound, 3>& mix) const {
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < k_corners; ++k) {
      least = std::min(
          least, std::max(0.0, mix[0].at[k]) * std::max(0.0, mix[1].at[k]) * std::max(0.0, mix[2].at[k]));
    }
    const double grown = 1 + reach_;
    return least / (grown * grown * grown) * (1 - 1e-14);
  }

  static std::array<double, k_corners> weights_of(const std::array<PairBound, 3>& mix, double sharpness) {
    std::array<double, k_corners> logs{}, weight{};
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < k_corners; ++k) {
      for (int i = 0; i < 3; ++i) logs[k] += std::max(-50.0, log_or_none(mix[i].at[k]));
      least = std::min(least, logs[k]);
    }
    for (int k = 0; k < k_corners; ++k) weight[k] = std::exp((least - logs[k]) * sharpness);
    return weight;
  }

  // The component that costs the bound most: what the widths change from the middle to the boundary, and the
  // terms of second order (of a turn about a needle's own axis there is nothing else).
  int widest(const Double3& half) const {
    Double3 cost{3 * half.x * half.x, 3 * half.y * half.y, 3 * half.z * half.z};  // of the divisor
    for (int i = 0; i < 3; ++i) {
      double width = 1e-300;
      Double3 slope;
      for (const PairBound& p : pairs_[i]) {
        for (const double w : p.at) width = std::max(width, w);
        const Double3 own = BoxBounder::slope(i, p.d);
        for (int k = 0; k < 3; ++k) slope[k] = std::max(slope[k], std::abs(own[k]));
      }
      const int j = (i + 1) % 3, m = (i + 2) % 3;
      for (int k = 0; k < 3; ++k) cost[k] = std::max(cost[k], slope[k] * half[k] / width);
      // slope = 2 u x d: what d is along j is half the slope of m.
      const double ij = most_[i] * most_[j] * slope[m] / width, im = most_[i] * most_[m] * slope[j] / width;
      cost[i] = std::max(cost[i], ij + im), cost[j] = std::max(cost[j], ij), cost[m] = std::max(cost[m], im);
    }
    return cost.x >= cost.y && cost.x >= cost.z ? 0 : cost.y >= cost.z ? 1 : 2;
  }

  std::span<const Double3> vertices_;
  Double3 length_;  // the direction in which they spread most
  Axes base_;
  double volume_;
  const BoxBoundOptions& options_;
  std::priority_queue<Cell, std::vector<Cell>, Later> open_;
  double closed_ = std::numeric_limits<double>::infinity();
  std::size_t made_ = 0;
  // Of the cell at hand:
  std::array<Double3, k_corners> corners_;
  double reach_ = 0;  // the largest squared turn
  Double3 most_;      // and its largest components
  std::array<std::vector<PairBound>, 3> pairs_;
};

}  // namespace

BoxBound box_bound(std::span<const Double3> vertices, const Axes& base, double volume,
                   const BoxBoundOptions& options) {
  if (vertices.empty() || !(volume > 0)) return {};
  return BoxBounder(vertices, base, volume, options).run();
}

}  // namespace copse
