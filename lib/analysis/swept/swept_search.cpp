#include "lib/analysis/swept/swept_search.h"

#include "lib/analysis/hull/frame.h"
#include "lib/analysis/hull/principal_axes.h"

#include <algorithm>
#include <limits>
#include <numbers>
#include <vector>

namespace copse {
namespace {

constexpr double k_rough_gap = 0.005, k_narrow = 0.03, k_room = 0.05;
constexpr double k_narrowest = 1e-3, k_least_room = 1e-3;  // of starts that are in their valleys already
constexpr int k_rough_rounds = 2;
// Starts that are descended from. A small hull has few, deep valleys, and is quick.
constexpr std::size_t k_small_hull = 60;
constexpr std::size_t k_kept_small = 20, k_kept = 12, k_lozenge_kept_small = 32, k_lozenge_kept = 16;
// Of a rough descent and an end: it would come to the same one.
constexpr double k_same_end_frame = 0.9998;
constexpr double k_same_end = 1e-7;  // costs of descents that came to one end
// Times the least of the starts, which all hold the points: what is larger has not been seen to end as the
// least.
constexpr double k_off = 1.5, k_far_off = 2;   // of a valley that has a start, of another one
constexpr double k_alike = 0.985;              // of frames a sixth of a radian apart
constexpr double k_same_valley = 0.95;         // a third of a radian
constexpr std::size_t k_most_looked_at = 128;  // points, for the choice of the starts

Axes about(const Axes& base, const Double3& direction) {
  const Double3 u = normalized(direction);
  const Double3 side = std::abs(u.x) < 0.7 ? Double3{1, 0, 0} : Double3{0, 1, 0};
  const Axes local = orthonormal({u, side, {}});
  return {out_of(base, local[0]), out_of(base, local[1]), out_of(base, local[2])};
}

// The axes, the face diagonals and the body diagonals.
std::vector<Axes> directions(const Axes& base) {
  std::vector<Axes> out;
  for (int x = 1; x >= -1; --x) {
    for (int y = 1; y >= -1; --y) {
      for (int z = 1; z >= -1; --z) {
        const bool half = x > 0 || (x == 0 && (y > 0 || (y == 0 && z > 0)));
        if (half) out.push_back(about(base, {double(x), double(y), double(z)}));
      }
    }
  }
  return out;
}

// The frames modulo the eight rotations of a rectangle: each axis of the base across, turned to the corners
// of a cube in the space of rotations, and not turned.
std::vector<Axes> frames(const Axes& base) {
  constexpr double k_turn = 0.2071;  // half of tan(pi / 8), the cube's half side
  std::vector<Axes> out;
  for (int k = 0; k < 3; ++k) {
    const Axes across{base[(k + 1) % 3], base[(k + 2) % 3], base[k]};
    out.push_back(across);
    for (int corner = 0; corner < 8; ++corner) {
      const auto sign = [&](int bit) { return corner >> bit & 1 ? -k_turn : k_turn; };
      out.push_back(turned(across, {sign(0), sign(1), sign(2)}));
    }
  }
  return out;
}

// --- many frames are looked at, few descended from
// ----------------------------------------------------------

// About the radius of the smallest circle round the points across the first axis, and its centre (Badoiu and
// Clarkson's steps: towards the farthest, ever shorter).
double circle_across(std::span<const Double3> local, Double3& centre) {
  constexpr int k_steps = 12;
  double radius = std::numeric_limits<double>::infinity();
  Double3 c = centre;
  for (int step = 0; step < k_steps; ++step) {
    Double3 far;
    double most = -1;
    for (const Double3& q : local) {
      const Double3 d{0, q.y - c.y, q.z - c.z};
      if (dot(d, d) > most) most = dot(d, d), far = d;
    }
    if (most < radius * radius) radius = std::sqrt(most), centre = c;
    c += far / (step + 3);
  }
  return radius;
}

// The points as a frame has them, and rectangles about the line or plane in their middle.
class FrameLook {
 public:
  FrameLook(Swept kind, std::span<const Double3> points, const Axes& frame, std::vector<Double3>& local)
      : kind_(kind), local_(local) {
    local.resize(points.size());
    for (std::size_t i = 0; i < points.size(); ++i) box_.grow(local[i] = into(frame, points[i]));
    centre_ = box_.centre();
    thinnest_ = kind == Swept::lozenge ? box_.extent().z / 2 : circle_across(local, centre_);
    widest_ = thinnest_ * thinnest_;
    for (const Double3& q : local) widest_ = std::max(widest_, dot(q - centre_, q - centre_));
  }

  double thinnest() const { return thinnest_; }

  // With sides as short as a radius lets them be: `bulge` 0: the thinnest; 1: a ball's. Holds all points.
  SweptRectangle rectangle(double bulge) const {
    const double square = thinnest_ * thinnest_ + bulge * bulge * (widest_ - thinnest_ * thinnest_);
    const double r = std::sqrt(square);
    const bool flat = kind_ == Swept::lozenge;
    double a0 = box_.max.x + r, a1 = box_.min.x - r, b0 = box_.max.y + r, b1 = box_.min.y - r;
    for (const Double3& q : local_) {
      const double y = flat ? 0 : q.y - centre_.y, z = q.z - centre_.z;
      const double half = std::sqrt(std::max(0.0, square - y * y - z * z));
      a0 = std::min(a0, q.x + half), a1 = std::max(a1, q.x - half);
      b0 = std::min(b0, q.y + half), b1 = std::max(b1, q.y - half);
    }
    if (a0 > a1) a0 = a1 = (a0 + a1) / 2;
    if (!flat) b0 = b1 = centre_.y;
    if (b0 > b1) b0 = b1 = (b0 + b1) / 2;
    SweptFit fit{k_world_axes, {a0, a1, b0, b1, centre_.z, r}};
    fit.rectangle.r = reach_of(local_, fit);  // corners, and ends that have crossed, may leave points out
    return fit.rectangle;
  }

 private:
  Swept kind_;
  const std::vector<Double3>& local_;
  DoubleBox box_;
  Double3 centre_;
  double thinnest_ = 0, widest_ = 0;
};

// How small it is in this frame, unturned and without care. The thinnest is not the least: caps that bulge
// more shorten it, up to a ball's.
struct Start {
  double cost = std::numeric_limits<double>::infinity();
  SweptFit fit;
};
Start start_in_frame(Swept kind, std::span<const Double3> points, const Axes& frame,
                     std::vector<Double3>& local) {
  constexpr int k_bulges = 6;
  Start start{.fit = {orthonormal(frame), {}}};
  const FrameLook look(kind, points, start.fit.frame, local);
  if (kind == Swept::line) return {look.thinnest(), {start.fit.frame, look.rectangle(0)}};
  for (int k = 0; k < k_bulges; ++k) {
    const SweptRectangle s = look.rectangle(static_cast<double>(k) / k_bulges);
    if (const double volume = swept_volume(s.lengths()); volume < start.cost)
      start.cost = volume, start.fit.rectangle = s;
  }
  return start;
}

// How far one is turned from the other, of what tells them apart: the axis of a line or capsule, the axis
// across of a lozenge and the cross of its two others.
double likeness(Swept kind, const Axes& f, const Axes& g) {
  if (kind != Swept::lozenge) return std::abs(dot(f[0], g[0]));
  const double along = std::max(std::abs(dot(f[0], g[0])), std::abs(dot(f[0], g[1])));
  return std::min(std::abs(dot(f[2], g[2])), along);
}

// A Fibonacci lattice on half a sphere.
std::vector<Axes> even_directions(const Axes& base, int count) {
  std::vector<Axes> out;
  for (int i = 0; i < count; ++i) {
    const double z = (i + 0.5) / count, r = std::sqrt(1 - z * z), a = i * 2.399963229728653;
    out.push_back(about(base, {r * std::cos(a), r * std::sin(a), z}));
  }
  return out;
}

// Directions between all points of so few, and an even spread of directions; for a lozenge a grid of turns.
std::vector<Axes> many_frames(Swept kind, std::span<const Double3> points, const Axes& base) {
  constexpr std::size_t k_few = 16;
  constexpr int k_directions = 96, k_turns = 5;
  constexpr double k_half = 0.41421357;  // tan(pi / 8): the cube's half side
  std::vector<Axes> out = kind == Swept::lozenge ? frames(base) : directions(base);
  if (kind == Swept::lozenge) {
    const auto turn = [](int i) { return (2 * i - k_turns + 1) * (k_half / k_turns); };
    for (int i = 0; i < 3 * k_turns * k_turns * k_turns; ++i) {
      const int k = i % 3, x = i / 3 % k_turns, y = i / 3 / k_turns % k_turns, z = i / 3 / k_turns / k_turns;
      const Double3 g{turn(x), turn(y), turn(z)};
      if (std::abs(g.x) + std::abs(g.y) + std::abs(g.z) > 1) continue;
      out.push_back(turned({base[(k + 1) % 3], base[(k + 2) % 3], base[k]}, g));
    }
    return out;
  }
  for (const Axes& f : even_directions(base, k_directions)) out.push_back(f);
  for (std::size_t i = 0; points.size() <= k_few && i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      if (points[i] != points[j]) out.push_back(about(k_world_axes, points[j] - points[i]));
    }
  }
  return out;
}

// All points where they are few, else what is extreme along an even spread of directions.
std::vector<Double3> looked_at(std::span<const Double3> points, const Axes& base) {
  if (points.size() <= k_most_looked_at) return {points.begin(), points.end()};
  std::vector<std::uint32_t> chosen;
  for (const Axes& f : even_directions(base, k_most_looked_at / 2)) {
    std::uint32_t low = 0, high = 0;
    for (std::uint32_t i = 1; i < points.size(); ++i) {
      const double along = dot(f[0], points[i]);
      if (along < dot(f[0], points[low])) low = i;
      if (along > dot(f[0], points[high])) high = i;
    }
    chosen.push_back(low), chosen.push_back(high);
  }
  std::sort(chosen.begin(), chosen.end());
  chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
  std::vector<Double3> out;
  for (const std::uint32_t i : chosen) out.push_back(points[i]);
  return out;
}

// The most promising of many frames, none near another.
std::vector<SweptFit> promising_starts(Swept kind, std::span<const Double3> points, const Axes& base) {
  const bool small = points.size() < k_small_hull;
  const std::size_t wanted = kind == Swept::lozenge ? (small ? k_lozenge_kept_small : k_lozenge_kept)
                                                    : (small ? k_kept_small : k_kept);
  std::vector<Start> all;
  std::vector<Double3> local;
  for (const Axes& f : many_frames(kind, points, base)) all.push_back(start_in_frame(kind, points, f, local));
  std::stable_sort(all.begin(), all.end(), [](const Start& a, const Start& b) { return a.cost < b.cost; });
  std::vector<SweptFit> kept;
  const auto keep = [&](const SweptFit& f) {
    const bool near = std::any_of(kept.begin(), kept.end(), [&](const SweptFit& k) {
      return likeness(kind, k.frame, f.frame) > k_alike;
    });
    if (!near && kept.size() < wanted) kept.push_back(f);
  };
  // First one a valley: of what is regular, the many images of one would leave no place for another.
  for (auto f = all.begin(); f != all.end() && f->cost <= k_far_off * all.front().cost; ++f) {
    const bool lowest = std::none_of(all.begin(), f, [&](const Start& lower) {
      return likeness(kind, lower.fit.frame, f->fit.frame) > k_same_valley;
    });
    if (lowest) keep(f->fit);
  }
  for (const Start& f : all) {
    if (f.cost <= k_off * all.front().cost) keep(f.fit);
  }
  return kept;
}

// --- regular things
// ---------------------------------------------------------------------------------------------------------

// Lozenges across one axis, by turn about it and by radius.
class TurnsAcross {
 public:
  TurnsAcross(std::span<const Double3> points, const Axes& axes, int across) {
    std::vector<Double3> local;
    for (int t = 0; t < k_turns; ++t) {
      const double angle = std::numbers::pi / 2 * t / k_turns, c = std::cos(angle), s = std::sin(angle);
      const Double3 &u = axes[(across + 1) % 3], &v = axes[(across + 2) % 3];
      const Axes frame{u * c + v * s, v * c - u * s, axes[across]};
      const FrameLook look(Swept::lozenge, points, frame, local);
      for (int b = 0; b < k_bulges; ++b) fits_.push_back({frame, look.rectangle((b + 0.5) / k_bulges)});
    }
  }

  // Those that are smaller than their neighbours, the least first.
  std::vector<SweptFit> valleys(std::size_t most) const {
    std::vector<SweptFit> out;
    for (int t = 0; t < k_turns; ++t) {
      for (int b = 0; b < k_bulges; ++b) {
        const double v = volume(t, b);
        if (v <= volume(t - 1, b) && v <= volume(t + 1, b) && v <= volume(t, b - 1) && v <= volume(t, b + 1))
          out.push_back(fits_[index(t, b)]);
      }
    }
    std::stable_sort(out.begin(), out.end(),
                     [](const SweptFit& a, const SweptFit& b) { return a.volume() < b.volume(); });
    if (out.size() > most) out.resize(most);
    return out;
  }

 private:
  static constexpr int k_turns = 24, k_bulges = 12;
  static std::size_t index(int turn, int bulge) {
    return static_cast<std::size_t>((turn + k_turns) % k_turns * k_bulges + bulge);
  }
  double volume(int turn, int bulge) const {
    if (bulge < 0 || bulge >= k_bulges) return std::numeric_limits<double>::infinity();
    return fits_[index(turn, bulge)].volume();
  }
  std::vector<SweptFit> fits_;
};

// What is regular about an axis spreads equally across it, and may have its least lozenge across that axis,
// in one of many narrow valleys of turns about it and of radii.
std::vector<SweptFit> regular_starts(std::span<const Double3> points, const PrincipalAxes& spread) {
  constexpr double k_equal = 1e-3;
  constexpr std::size_t k_wanted = 8;  // an axis
  std::vector<SweptFit> out;
  for (int k = 0; k < 3; ++k) {
    const double u = spread.variances[(k + 1) % 3], v = spread.variances[(k + 2) % 3];
    if (std::abs(u - v) > k_equal * u) continue;
    const std::vector<SweptFit> valleys = TurnsAcross(points, spread.axes, k).valleys(k_wanted);
    out.insert(out.end(), valleys.begin(), valleys.end());
  }
  return out;
}

}  // namespace

SweptFit search_around(Swept kind, std::span<const Double3> points, const Deadline& deadline) {
  const PrincipalAxes spread = principal_axes(points);
  // What a scout finds round some of many points is no larger than what there is round all.
  const std::vector<Double3> some = looked_at(points, spread.axes);
  const bool all = some.size() == points.size();
  std::vector<SweptDescent> scouts;
  double least = std::numeric_limits<double>::infinity();
  const auto scout = [&](const std::vector<SweptFit>& starts, double gap, double room) {
    for (const SweptFit& start : starts) {
      if (!scouts.empty() && deadline.has_passed()) return;
      scouts.emplace_back(kind, some, start, room);
      scouts.back().run({k_rough_gap, k_rough_rounds, gap, least});
      least = std::min(least, scouts.back().cost());
    }
  };
  scout(promising_starts(kind, some, spread.axes), k_narrow, k_room);
  if (kind == Swept::lozenge && points.size() < k_small_hull && !deadline.has_passed())
    scout(regular_starts(some, spread), k_narrowest, k_least_room);
  std::stable_sort(scouts.begin(), scouts.end(),
                   [](const SweptDescent& a, const SweptDescent& b) { return a.cost() < b.cost(); });
  SweptFit best = scouts.front().fit();
  best.rectangle.r = reach_of(points, best);
  least = std::min(all ? least : std::numeric_limits<double>::infinity(), cost_of(kind, best));
  std::vector<double> ends;   // round some
  std::vector<Axes> valleys;  // whose ends are known
  for (SweptDescent& descent : scouts) {
    if (deadline.has_passed()) return best;
    if (descent.least_cost() > least) continue;
    const Axes& rough = descent.frame();
    const auto leads_there = [&](const Axes& end) { return likeness(kind, end, rough) > k_same_end_frame; };
    if (std::any_of(valleys.begin(), valleys.end(), leads_there)) continue;
    descent.run({.hopeless = least});
    valleys.push_back(descent.frame());
    if (!all) {
      const double end = descent.cost();
      const auto same = [&](double other) { return std::abs(end - other) <= k_same_end * other; };
      if (descent.least_cost() > least || std::any_of(ends.begin(), ends.end(), same)) continue;
      ends.push_back(end);
      descent = SweptDescent(kind, points, descent.fit(), k_least_room);
      descent.run({.first_gap = k_narrowest, .hopeless = least});
    }
    if (descent.cost() < least) least = descent.cost(), best = descent.fit();
  }
  if (deadline.has_passed()) return best;
  // A narrow descent may have ended early.
  const SweptFit again = descend_around(kind, points, best.frame);
  return cost_of(kind, again) < least ? again : best;
}

}  // namespace copse
