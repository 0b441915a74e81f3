#include "lib/formats/import/polygon.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace copse {
namespace {

// A diagonal must be shorter by this share to be preferred over the one through the first corner: below it
// the difference is the rounding of a text format, and a row of equal quads should be cut alike.
constexpr double k_diagonal_margin = 0.01;

constexpr std::uint32_t k_convex = 0xffffffffu;
constexpr std::uint32_t k_nobody = 0xffffffffu;

// Brings corners to about [-1, 1], so that products of lengths neither overflow nor vanish.
struct Normalizer {
  Double3 middle;
  double half = 0;
  double shrink = 1;  // 0.5 where the extent of the box itself would overflow

  explicit Normalizer(std::span<const Double3> corners) {
    DoubleBox box;
    for (const Double3& p : corners) box.grow(p);
    const Double3 finite_extent = box.max * 0.25 - box.min * 0.25;
    if (std::max({finite_extent.x, finite_extent.y, finite_extent.z}) > 1e300) shrink = 0.25;
    middle = box.min * (0.5 * shrink) + box.max * (0.5 * shrink);
    const Double3 extent = (box.max * shrink - box.min * shrink) * 0.5;
    half = std::max({extent.x, extent.y, extent.z});
  }
  Double3 operator()(const Double3& p) const { return (p * shrink - middle) / half; }
};

std::uint32_t spread_bits(std::uint32_t v) {
  v = (v | (v << 8)) & 0x00ff00ffu;
  v = (v | (v << 4)) & 0x0f0f0f0fu;
  v = (v | (v << 2)) & 0x33333333u;
  return (v | (v << 1)) & 0x55555555u;
}

}  // namespace

std::span<const PolygonCutter::Cut> PolygonCutter::cut(std::span<const Double3> corners) {
  cuts_.clear();
  gave_up_ = false;
  work_ = 0;
  if (corners.size() == 3) {
    cuts_.push_back({0, 1, 2});
  } else if (corners.size() == 4) {
    cut_quad(corners);
  } else if (corners.size() > 4) {
    const auto n = static_cast<std::uint32_t>(corners.size());
    next_.resize(n);
    previous_.resize(n);
    for (std::uint32_t i = 0; i < n; ++i) {
      next_[i] = i + 1 == n ? 0 : i + 1;
      previous_[i] = i == 0 ? n - 1 : i - 1;
    }
    if (project(corners)) {
      clip_ears();
    } else {
      fan(0);
    }
  }
  return cuts_;
}

void PolygonCutter::cut_quad(std::span<const Double3> corners) {
  const Normalizer normalize(corners);
  bool other = false;
  if (normalize.half > 0) {
    const Double3 a = normalize(corners[0]), b = normalize(corners[1]);
    const Double3 c = normalize(corners[2]), d = normalize(corners[3]);
    const Double3 normal = cross(c - a, d - b);
    const auto faces = [&](const Double3& p, const Double3& q, const Double3& r) {
      return dot(cross(q - p, r - p), normal) > 0;
    };
    const bool first_fits = faces(a, b, c) && faces(a, c, d);
    const bool other_fits = faces(b, c, d) && faces(b, d, a);
    const bool shorter = length(d - b) < length(c - a) * (1 - k_diagonal_margin);
    other = other_fits && (!first_fits || shorter);
  }
  if (other) {
    cuts_.push_back({1, 2, 3});
    cuts_.push_back({1, 3, 0});
  } else {
    cuts_.push_back({0, 1, 2});
    cuts_.push_back({0, 2, 3});
  }
}

// Drops the axis that the polygon's normal is nearest to, so that it runs counter-clockwise. False: no area.
bool PolygonCutter::project(std::span<const Double3> corners) {
  const Normalizer normalize(corners);
  if (!(normalize.half > 0)) return false;
  Double3 normal;
  Double3 before = normalize(corners.back());
  for (const Double3& corner : corners) {
    const Double3 p = normalize(corner);
    normal += {(before.y - p.y) * (before.z + p.z), (before.z - p.z) * (before.x + p.x),
               (before.x - p.x) * (before.y + p.y)};
    before = p;
  }
  const Double3 size{std::abs(normal.x), std::abs(normal.y), std::abs(normal.z)};
  const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
  if (!(size[axis] > 0)) return false;
  const int u = (axis + 1) % 3;
  const int v = (axis + 2) % 3;
  points_.clear();
  for (const Double3& corner : corners) {
    const Double3 p = normalize(corner);
    points_.push_back(normal[axis] > 0 ? Point{p[u], p[v]} : Point{p[v], p[u]});
  }
  return true;
}

// Twice the signed area of corner i's triangle with its neighbours: positive where the polygon is convex.
double PolygonCutter::turn(std::uint32_t i) const {
  const Point &a = points_[previous_[i]], &b = points_[i], &c = points_[next_[i]];
  return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

std::uint32_t PolygonCutter::morton(const Point& p) const {
  const auto quantize = [](double t) {
    return static_cast<std::uint32_t>(std::clamp((t + 1) * 32767.5, 0.0, 65535.0));
  };
  return spread_bits(quantize(p.x)) | (spread_bits(quantize(p.y)) << 1);
}

// Sorts the reflex corners along a Morton curve and puts boxes round neighbours.
void PolygonCutter::index_reflex() {
  sorted_.clear();
  boxes_.clear();
  rank_.assign(points_.size(), k_convex);
  std::vector<std::uint32_t> code(points_.size());
  for (std::uint32_t i = 0; i < points_.size(); ++i) {
    if (turn(i) > 0) continue;
    code[i] = morton(points_[i]);
    sorted_.push_back(i);
  }
  std::sort(sorted_.begin(), sorted_.end(),
            [&](std::uint32_t a, std::uint32_t b) { return code[a] != code[b] ? code[a] < code[b] : a < b; });
  std::vector<Box2> level;
  for (std::uint32_t i = 0; i < sorted_.size(); ++i) {
    rank_[sorted_[i]] = i;
    level.push_back({points_[sorted_[i]], points_[sorted_[i]], 1});
  }
  while (!level.empty() && (boxes_.empty() || boxes_.back().size() > 1)) {
    std::vector<Box2> above;
    for (std::size_t i = 0; i < level.size(); ++i) {
      if (i % k_fan_out == 0) above.push_back({level[i].low, level[i].high, 0});
      Box2& box = above.back();
      box.low = {std::min(box.low.x, level[i].low.x), std::min(box.low.y, level[i].low.y)};
      box.high = {std::max(box.high.x, level[i].high.x), std::max(box.high.y, level[i].high.y)};
      box.reflex += level[i].reflex;
    }
    boxes_.push_back(above);
    level = std::move(above);
  }
}

void PolygonCutter::forget_reflex(std::uint32_t i) {
  if (rank_[i] == k_convex) return;
  std::uint32_t at = rank_[i];
  rank_[i] = k_convex;
  for (std::vector<Box2>& level : boxes_) --level[at /= k_fan_out].reflex;
  for (std::uint32_t w = first_waiting_[i]; w != k_nobody; w = waiting_[w].next) enqueue(waiting_[w].corner);
  first_waiting_[i] = k_nobody;
}

void PolygonCutter::enqueue(std::uint32_t i) {
  if (queued_[i]) return;
  queued_[i] = true;
  queue_.push_back(i);
}

// Whether `corner` lies in the triangle of `ear` or on its border.
bool PolygonCutter::blocks(std::uint32_t corner, std::uint32_t ear) const {
  const std::uint32_t ia = previous_[ear], ic = next_[ear];
  if (rank_[corner] == k_convex || corner == ia || corner == ear || corner == ic) return false;
  const Point &a = points_[ia], &b = points_[ear], &c = points_[ic], &p = points_[corner];
  const auto same = [&](const Point& q) { return q.x == p.x && q.y == p.y; };
  if (same(a) || same(b) || same(c)) return false;  // where a keyhole joins a hole to the outline
  const auto side = [&p](const Point& q, const Point& r) {
    return (r.x - q.x) * (p.y - q.y) - (r.y - q.y) * (p.x - q.x);
  };
  return side(a, b) >= 0 && side(b, c) >= 0 && side(c, a) >= 0;
}

// Whether a box lies wholly outside one edge of the triangle of `ear`. Rounding is monotone, so this is never
// true of a box with a point that blocks() would find.
bool PolygonCutter::misses(const Box2& box, std::uint32_t ear) const {
  const Point &a = points_[previous_[ear]], &b = points_[ear], &c = points_[next_[ear]];
  const auto outside = [&box](const Point& q, const Point& r) {
    const double ex = r.x - q.x, ey = r.y - q.y;
    const double x = ey > 0 ? box.low.x : box.high.x;
    const double y = ex > 0 ? box.high.y : box.low.y;
    return ex * (y - q.y) - ey * (x - q.x) < 0;
  };
  const auto beyond = [](double low, double high, double p, double q, double r) {
    return high < std::min({p, q, r}) || low > std::max({p, q, r});
  };
  return beyond(box.low.x, box.high.x, a.x, b.x, c.x) || beyond(box.low.y, box.high.y, a.y, b.y, c.y) ||
         outside(a, b) || outside(b, c) || outside(c, a);
}

// A reflex corner in the triangle of corner i, or k_nobody.
std::uint32_t PolygonCutter::find_blocker(std::uint32_t i) {
  if (boxes_.empty()) return k_nobody;
  stack_.assign(1, {static_cast<std::uint32_t>(boxes_.size() - 1), 0});
  while (!stack_.empty()) {
    const auto [level, index] = stack_.back();
    stack_.pop_back();
    const Box2& box = boxes_[level][index];
    ++work_;
    if (box.reflex == 0 || misses(box, i)) continue;
    const std::uint32_t first = index * k_fan_out;
    const auto below = static_cast<std::uint32_t>(level > 0 ? boxes_[level - 1].size() : sorted_.size());
    const std::uint32_t last = std::min(first + k_fan_out, below);
    for (std::uint32_t k = first; k < last; ++k) {
      if (level > 0) {
        stack_.push_back({level - 1, k});
      } else if (++work_, blocks(sorted_[k], i)) {
        return sorted_[k];
      }
    }
  }
  return k_nobody;
}

bool PolygonCutter::is_ear(std::uint32_t i) {
  ++work_;
  if (next_[i] == k_nobody || turn(i) <= 0) return false;
  const std::uint32_t blocker = find_blocker(i);
  if (blocker == k_nobody) return true;
  waiting_.push_back({i, first_waiting_[blocker]});
  first_waiting_[blocker] = static_cast<std::uint32_t>(waiting_.size() - 1);
  return false;
}

// Cuts corner i off and returns the one after it.
std::uint32_t PolygonCutter::clip(std::uint32_t i) {
  const std::uint32_t before = previous_[i], after = next_[i];
  cuts_.push_back({before, i, after});
  next_[before] = after;
  previous_[after] = before;
  next_[i] = k_nobody;
  forget_reflex(i);
  if (turn(before) > 0) forget_reflex(before);
  if (turn(after) > 0) forget_reflex(after);
  enqueue(before);
  enqueue(after);
  return after;
}

// The next corner to cut off. When no ear is left the polygon crosses itself or is flat there: then it is the
// next convex corner after `from`, or any.
std::uint32_t PolygonCutter::choose(std::uint32_t& from) {
  while (queue_front_ < queue_.size()) {
    const std::uint32_t i = queue_[queue_front_++];
    queued_[i] = false;
    if (is_ear(i)) return i;
  }
  while (next_[from] == k_nobody) ++from;  // the first that is left; never beyond the last
  std::uint32_t i = from;
  do {
    ++work_;
    if (turn(i) > 0) return i;
    i = next_[i];
  } while (i != from);
  return from;
}

void PolygonCutter::clip_ears() {
  const std::uint64_t n = points_.size();
  const std::uint64_t budget = k_cut_budget * n * std::bit_width(n);
  queue_.clear();
  queue_front_ = 0;
  queued_.assign(n, false);
  first_waiting_.assign(n, k_nobody);
  waiting_.clear();
  index_reflex();
  for (std::uint32_t i = 0; i < n; ++i) enqueue(i);
  std::uint32_t from = 0, after = 0;
  for (std::size_t left = n; left > 3 && !gave_up_; --left) {
    after = clip(choose(from));
    gave_up_ = work_ > budget;
  }
  fan(after);
}

void PolygonCutter::fan(std::uint32_t first) {
  for (std::uint32_t i = next_[first]; next_[i] != first; i = next_[i]) cuts_.push_back({first, i, next_[i]});
}

}  // namespace copse
