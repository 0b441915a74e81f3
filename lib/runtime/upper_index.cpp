#include "lib/runtime/upper_index.h"

#include <algorithm>

namespace copse {
namespace {

constexpr double k_loose = 1.5;       // how much all boxes may grow before the order is made anew
constexpr double k_loose_mean = 2.5;  // and on the mean of the inner boxes, none counted more than
constexpr double k_most = 8;
constexpr int k_bits = 16;

std::uint64_t spread(std::uint64_t v) {  // its bits three apart
  std::uint64_t out = 0;
  for (int b = 0; b < k_bits; ++b) out |= (v >> b & 1) << (3 * b);
  return out;
}

double half_surface(const FloatBox& box) {
  const Double3 e = to_double(box.max) - to_double(box.min);
  return e.x * e.y + e.y * e.z + e.z * e.x;
}

}  // namespace

UpperIndex::UpperIndex(std::uint32_t things) : boxes_(things), order_(things) {
  nodes_.reserve(things == 0 ? 0 : 2 * std::size_t{things} - 1);
}

// Z-order of the centres in one cube round all of them; ties by index.
void UpperIndex::make_order() {
  DoubleBox all;
  for (const FloatBox& b : boxes_) all.grow((to_double(b.min) + to_double(b.max)) * 0.5);
  const Double3 e = all.extent();
  const double side = std::max({e.x, e.y, e.z});
  for (std::uint32_t i = 0; i < order_.size(); ++i) {
    const Double3 c = (to_double(boxes_[i].min) + to_double(boxes_[i].max)) * 0.5 - all.min;
    const auto cell = [&](double x) {
      return static_cast<std::uint64_t>(side > 0 ? std::min(x / side, 1.0) * ((1 << k_bits) - 1) : 0.0);
    };
    order_[i] = {spread(cell(c.x)) << 2 | spread(cell(c.y)) << 1 | spread(cell(c.z)), i};
  }
  std::sort(order_.begin(), order_.end());
}

// Halves, depth first. The stack holds one range a level.
void UpperIndex::build() {
  nodes_.clear();
  struct Range {
    std::uint32_t begin, end;
    int level;
  };
  Range open[40];
  int top = 0;
  if (!order_.empty()) open[top++] = {0, static_cast<std::uint32_t>(order_.size()), 0};
  while (top > 0) {
    const Range r = open[--top];
    const std::uint32_t count = r.end - r.begin;
    nodes_.push_back({{},
                      static_cast<std::uint32_t>(nodes_.size()) + 2 * count - 1,
                      count == 1 ? order_[r.begin].second : k_none,
                      r.level,
                      0});
    if (count == 1) continue;
    const std::uint32_t middle = r.begin + count / 2;
    open[top++] = {middle, r.end, r.level + 1};
    open[top++] = {r.begin, middle, r.level + 1};
  }
}

UpperIndex::Growth UpperIndex::refit() {
  Growth growth;
  double ratios = 0, inner = 0;
  for (std::size_t i = nodes_.size(); i-- > 0;) {
    Node& n = nodes_[i];
    if (n.thing != k_none) {
      n.box = boxes_[n.thing];
    } else {
      n.box = nodes_[i + 1].box;
      n.box.grow(nodes_[nodes_[i + 1].skip].box);
    }
    const double surface = half_surface(n.box);
    growth.sum += surface;
    if (n.thing != k_none) continue;
    ++inner;
    ratios += surface <= n.tight ? 1 : std::min(surface / n.tight, k_most);
  }
  if (inner > 0) growth.mean = ratios / inner;
  return growth;
}

bool UpperIndex::update() {
  if (tight_ >= 0) {
    const Growth growth = refit();
    if (growth.sum <= tight_ * k_loose && growth.mean <= k_loose_mean) return false;
  }
  make_order();
  build();
  tight_ = refit().sum;
  for (Node& n : nodes_) n.tight = half_surface(n.box);
  return true;
}

}  // namespace copse
