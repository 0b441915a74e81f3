#include "lib/analysis/trunk/segment_tree.h"

#include "lib/analysis/surface/tolerances.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace copse {
namespace {

constexpr std::uint32_t k_leaf_size = 4;
// As many boxes may lie over one another, in the mean, before axes are cut; into so many pieces at most.
constexpr double k_overlap = 4;
constexpr std::uint32_t k_most_pieces = 32;
constexpr double k_most_pieces_in_all = 4e6;

double distance_to(const DoubleBox& box, const Double3& p) {
  const auto outside = [](double low, double high, double x) { return std::max({low - x, x - high, 0.0}); };
  return length(Double3{outside(box.min.x, box.max.x, p.x), outside(box.min.y, box.max.y, p.y),
                        outside(box.min.z, box.max.z, p.z)});
}

// Lower bounds of distances from one point, by squares: several times as fast as what is safe at any scale,
// since everything is measured in units in which nothing overflows.
class Bounds {
 public:
  Bounds(const DoubleBox& all, const Double3& point) : point_(point) {
    const Double3 e = all.extent();
    size_ = std::max({e.x, e.y, e.z, distance_to(all, point)});
    if (!(size_ > 0)) size_ = 1;
    unit_ = 1 / size_;
    if (!std::isfinite(unit_)) size_ = unit_ = 0;  // no bound but 0
  }
  double from(const DoubleBox& box) const {
    const auto outside = [](double low, double high, double x) { return std::max({low - x, x - high, 0.0}); };
    return below(Double3{outside(box.min.x, box.max.x, point_.x), outside(box.min.y, box.max.y, point_.y),
                         outside(box.min.z, box.max.z, point_.z)} *
                 unit_);
  }
  double from_axis(const Segment& s) const {
    const Double3 axis = (s.b - s.a) * unit_, to = (point_ - s.a) * unit_;
    const double square = dot(axis, axis);
    const double t = square > 0 ? std::clamp(dot(axis, to) / square, 0.0, 1.0) : 0;
    return below(to - axis * t);
  }

 private:
  // Rounding is far below the margin: a vector's components are at most 2 units.
  double below(const Double3& units) const {
    return size_ * std::max(0.0, std::sqrt(dot(units, units)) - 1e-12);
  }
  Double3 point_;
  double size_ = 0, unit_ = 0;
};

int longest_axis(const DoubleBox& box) {
  const Double3 e = box.extent();
  return e.x >= e.y && e.x >= e.z ? 0 : e.y >= e.z ? 1 : 2;
}

}  // namespace

bool is_level(const Segment& segment) {
  const Double3 way = segment.b - segment.a;
  return std::abs(way.y) < std::hypot(way.x, way.z);
}

Nearness nearness(std::span<const Segment> segments, std::uint32_t segment, const Double3& point) {
  const Segment& s = segments[segment];
  const Double3 axis = s.b - s.a;
  const double axis_length = length(axis);
  Nearness near{segment, 0, 0, 0};
  if (axis_length > 0) {
    near.t = std::clamp(dot(axis / axis_length, (point - s.a) / axis_length), 0.0, 1.0);
  }
  near.distance = distance(point, s.a + axis * near.t);
  near.radius = s.radius_a + (s.radius_b - s.radius_a) * near.t;
  return near;
}

SegmentTree::SegmentTree(std::vector<Segment> segments) : segments_(std::move(segments)) {
  build();
}

// How often the boxes of the axes cover the box of all, cut into p pieces each, goes down with p squared.
void SegmentTree::choose_pieces() {
  DoubleBox all;
  for (const Segment& s : segments_) all.grow(s.a), all.grow(s.b);
  const Double3 size = all.extent();
  if (!(std::min({size.x, size.y, size.z}) > 0)) return;  // straws in a plane: pieces lie as thick
  double overlap = 0;
  for (const Segment& s : segments_) {
    const Double3 e = s.b - s.a;
    overlap += std::abs(e.x / size.x) * std::abs(e.y / size.y) * std::abs(e.z / size.z);
  }
  if (!(overlap > k_overlap)) return;  // a share is no number where the box is too large for one
  const double most = std::min<double>(
      k_most_pieces, std::floor(k_most_pieces_in_all / static_cast<double>(segments_.size())));
  pieces_ =
      static_cast<std::uint32_t>(std::max(1.0, std::min(most, std::ceil(std::sqrt(overlap / k_overlap)))));
}

DoubleBox SegmentTree::box_of(std::uint32_t piece) const {
  const Segment& s = segments_[piece / pieces_];
  const double from = static_cast<double>(piece % pieces_) / pieces_,
               to = static_cast<double>(piece % pieces_ + 1) / pieces_;
  DoubleBox box;
  box.grow(s.a * (1 - from) + s.b * from);
  box.grow(s.a * (1 - to) + s.b * to);
  return box;
}

Double3 SegmentTree::middle_of(std::uint32_t piece) const {
  const Segment& s = segments_[piece / pieces_];
  const double t = (piece % pieces_ + 0.5) / pieces_;
  return s.a * (1 - t) + s.b * t;
}

void SegmentTree::build() {
  choose_pieces();
  order_.resize(segments_.size() * pieces_);
  for (std::uint32_t i = 0; i < order_.size(); ++i) order_[i] = i;
  if (order_.empty()) return;
  struct Range {
    std::uint32_t begin, end, parent;  // parent: whose right child this is, or itself for none
  };
  std::vector<Range> todo{{0, static_cast<std::uint32_t>(order_.size()), 0}};
  while (!todo.empty()) {
    const Range range = todo.back();
    todo.pop_back();
    const auto id = static_cast<std::uint32_t>(nodes_.size());
    Node& node = nodes_.emplace_back();
    if (range.parent != id) nodes_[range.parent].first = id;
    node.lowest = order_[range.begin] / pieces_;
    DoubleBox middles;
    for (std::uint32_t i = range.begin; i < range.end; ++i) {
      const Segment& s = segments_[order_[i] / pieces_];
      node.box.grow(box_of(order_[i]));
      node.radius = std::max({node.radius, s.radius_a, s.radius_b});
      node.lowest = std::min(node.lowest, order_[i] / pieces_);
      middles.grow(middle_of(order_[i]));
    }
    if (range.end - range.begin <= k_leaf_size) {
      node.first = range.begin;
      node.count = range.end - range.begin;
      continue;
    }
    const int axis = longest_axis(middles);
    const std::uint32_t middle = range.begin + (range.end - range.begin) / 2;
    const auto at = [&](std::uint32_t piece) { return std::pair(middle_of(piece)[axis], piece); };
    std::nth_element(order_.begin() + range.begin, order_.begin() + middle, order_.begin() + range.end,
                     [&](std::uint32_t x, std::uint32_t y) { return at(x) < at(y); });
    todo.push_back({middle, range.end, id});
    todo.push_back({range.begin, middle, id + 1});  // becomes node id + 1: the left child
  }
  const double noise = k_rounding * length(nodes_[0].box.extent());
  if (std::isfinite(noise)) noise_ = noise;
}

std::size_t SegmentTree::near(const Double3& point, double reach, double least_radius, std::uint32_t except,
                              std::size_t count, std::vector<Nearness>& found) const {
  found.clear();
  if (nodes_.empty() || count == 0) return 0;
  std::size_t looked_at = 0;
  const auto beyond_noise = [&](double d) { return std::max(0.0, d - noise_); };
  const auto key = [&](const Nearness& n) {
    const double radius = std::max(n.radius, least_radius), d = beyond_noise(n.distance);
    return std::tuple(radius > 0 ? d / radius
                      : d > 0    ? std::numeric_limits<double>::infinity()
                                 : 0.0,
                      -n.radius, n.segment);
  };
  const auto insert = [&](const Nearness& n) {
    for (std::size_t i = 0; i < found.size(); ++i) {
      if (segments_[found[i].segment].limb != segments_[n.segment].limb) continue;
      if (key(n) >= key(found[i])) return;
      found.erase(found.begin() + static_cast<std::ptrdiff_t>(i));
      break;
    }
    const auto at = std::ranges::upper_bound(found, key(n), {}, key);
    found.insert(at, n);
    if (found.size() > count) found.pop_back();
  };
  // Whether nothing as far from the point, with no larger radius and no lower segment can be among what is
  // found. Of axes that all begin in one place only the thickest are looked at.
  const auto is_too_far = [&](double d, double radius, std::uint32_t lowest) {
    if (d > radius + reach) return true;
    if (found.size() < count) return false;
    const auto& [ratio, thinness, segment] = key(found.back());
    const double here = beyond_noise(d);
    if (ratio > 0 || here > 0) return here > ratio * std::max(radius, least_radius);
    return std::pair(-radius, lowest) >= std::pair(thinness, segment);
  };
  struct Step {
    std::uint32_t node;
    double distance;  // of the point from its box
  };
  const Bounds bounds(nodes_[0].box, point);
  const auto step_to = [&](std::uint32_t id) { return Step{id, bounds.from(nodes_[id].box)}; };
  std::vector<Step> todo{step_to(0)};
  while (!todo.empty()) {
    const auto [id, d] = todo.back();
    todo.pop_back();
    const Node& node = nodes_[id];
    if (is_too_far(d, node.radius, node.lowest)) continue;
    if (node.count == 0) {  // the nearer or thicker child first: what it holds spares most of the other
      Step near = step_to(id + 1), far = step_to(node.first);
      const auto rank = [&](const Step& s) {
        return std::tuple(beyond_noise(s.distance), -nodes_[s.node].radius, nodes_[s.node].lowest);
      };
      if (rank(far) < rank(near)) std::swap(near, far);
      todo.push_back(far);
      todo.push_back(near);
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const std::uint32_t segment = order_[i] / pieces_;
      const Segment& s = segments_[segment];
      ++looked_at;
      const double thickest = std::max(s.radius_a, s.radius_b);
      if (s.limb == except || is_too_far(bounds.from_axis(s), thickest, segment)) continue;
      const Nearness n = nearness(segments_, segment, point);
      if (n.gap() <= reach) insert(n);
    }
  }
  return looked_at;
}

bool SegmentTree::nearest(const Double3& point, double reach, std::uint32_t except, Nearness& found) const {
  bool any = false;
  if (nodes_.empty()) return false;
  const Bounds bounds(nodes_[0].box, point);
  std::vector<std::uint32_t> todo{0};
  while (!todo.empty()) {
    const std::uint32_t id = todo.back();
    todo.pop_back();
    const Node& node = nodes_[id];
    if (bounds.from(node.box) - node.radius > (any ? found.gap() : reach)) continue;
    if (node.count == 0) {
      std::uint32_t near = id + 1, far = node.first;
      if (bounds.from(nodes_[far].box) < bounds.from(nodes_[near].box)) std::swap(near, far);
      todo.push_back(far);
      todo.push_back(near);
      continue;
    }
    for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
      const std::uint32_t segment = order_[i] / pieces_;
      if (segments_[segment].limb == except) continue;
      const Nearness n = nearness(segments_, segment, point);
      if (n.gap() > reach) continue;
      if (!any || std::pair(n.gap(), n.segment) < std::pair(found.gap(), found.segment))
        found = n, any = true;
    }
  }
  return any;
}

}  // namespace copse
