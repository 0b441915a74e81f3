#include "lib/formats/import/polygon.h"

#include <algorithm>
#include <bit>
#include <cmath>

namespace copse {
namespace {

// A diagonal must be shorter by this share to be preferred over the one through the first corner: below it
// the difference is the rounding of a text format, and a row of equal quads should be cut alike.
constexpr double k_diagonal_margin = 0.01;

// Fewer reflex corners than this are tested one by one.
constexpr std::size_t k_few = 32;

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

void PolygonCutter::index_reflex() {
  keys_.clear();
  reflex_.assign(points_.size(), 0);
  for (std::uint32_t i = 0; i < points_.size(); ++i) {
    if (turn(i) > 0) continue;
    reflex_[i] = 1;
    keys_.push_back({morton(points_[i]), i});
  }
  std::sort(keys_.begin(), keys_.end(), [](const Key& a, const Key& b) {
    return a.code != b.code ? a.code < b.code : a.corner < b.corner;
  });
  reflex_count_ = keys_.size();
}

void PolygonCutter::update_reflex(std::uint32_t i) {
  if (reflex_[i] == 0 || turn(i) <= 0) return;
  reflex_[i] = 0;
  --reflex_count_;
}

// Whether `corner` lies in the triangle of `ear` or on its border.
bool PolygonCutter::blocks(std::uint32_t corner, std::uint32_t ear) const {
  const std::uint32_t ia = previous_[ear], ic = next_[ear];
  if (reflex_[corner] == 0 || corner == ia || corner == ear || corner == ic) return false;
  const Point &a = points_[ia], &b = points_[ear], &c = points_[ic], &p = points_[corner];
  const auto same = [&](const Point& q) { return q.x == p.x && q.y == p.y; };
  if (same(a) || same(b) || same(c)) return false;  // where a keyhole joins a hole to the outline
  const auto side = [&p](const Point& q, const Point& r) {
    return (r.x - q.x) * (p.y - q.y) - (r.y - q.y) * (p.x - q.x);
  };
  return side(a, b) >= 0 && side(b, c) >= 0 && side(c, a) >= 0;
}

bool PolygonCutter::is_ear(std::uint32_t i) {
  ++work_;
  if (turn(i) <= 0) return false;
  if (reflex_count_ == 0) return true;
  auto first = keys_.begin();
  std::uint32_t last_code = 0xffffffffu;
  if (keys_.size() > k_few) {
    const Point &a = points_[previous_[i]], &b = points_[i], &c = points_[next_[i]];
    const auto [low_x, high_x] = std::minmax({a.x, b.x, c.x});
    const auto [low_y, high_y] = std::minmax({a.y, b.y, c.y});
    last_code = morton({high_x, high_y});
    first = std::lower_bound(first, keys_.end(), morton({low_x, low_y}),
                             [](const Key& key, std::uint32_t code) { return key.code < code; });
  }
  for (; first != keys_.end() && first->code <= last_code; ++first) {
    ++work_;
    if (blocks(first->corner, i)) return false;
  }
  return true;
}

// Cuts corner i off and returns the one after it.
std::uint32_t PolygonCutter::clip(std::uint32_t i) {
  const std::uint32_t before = previous_[i], after = next_[i];
  cuts_.push_back({before, i, after});
  next_[before] = after;
  previous_[after] = before;
  if (reflex_[i] != 0) {
    reflex_[i] = 0;
    --reflex_count_;
  }
  update_reflex(before);
  update_reflex(after);
  if (keys_.size() > k_few && keys_.size() > 2 * reflex_count_) {
    work_ += keys_.size();
    std::erase_if(keys_, [this](const Key& key) { return reflex_[key.corner] == 0; });
  }
  return after;
}

void PolygonCutter::clip_ears() {
  index_reflex();
  const std::uint64_t n = points_.size();
  const std::uint64_t budget = k_cut_budget * n * std::bit_width(n);
  work_ = 0;
  std::uint32_t i = 0;
  std::size_t left = n;
  std::size_t passed = 0;  // corners in a row that were no ears
  while (left > 3) {
    if (work_ > budget) {
      gave_up_ = true;
      break;
    }
    // When no ear is left the polygon crosses itself or is flat there: cut anyway, a convex corner if there
    // is one.
    const bool desperate = passed >= left;
    if (is_ear(i) || (desperate && turn(i) > 0) || passed >= 2 * left) {
      i = next_[clip(i)];  // skipping one: slender fans are avoided
      --left;
      passed = 0;
    } else {
      i = next_[i];
      ++passed;
    }
  }
  fan(i);
}

void PolygonCutter::fan(std::uint32_t first) {
  for (std::uint32_t i = next_[first]; next_[i] != first; i = next_[i]) cuts_.push_back({first, i, next_[i]});
}

}  // namespace copse
