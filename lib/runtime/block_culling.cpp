#include "lib/runtime/block_culling.h"

#include <algorithm>
#include <array>

namespace copse {
namespace {

DoubleBox absolute(const FloatBox& box, const Double3& origin) {
  return {origin + to_double(box.min), origin + to_double(box.max)};
}

class Culler {
 public:
  Culler(const Ecosystem& eco, const Frustum& frustum, const Double3& eye,
         std::vector<std::uint32_t>& visible)
      : eco_(eco), frustum_(frustum), eye_(eye), visible_(visible) {}

  CullCounts run() {
    struct Entry {
      std::uint32_t level, index;
    };
    // Three children wait on every level above the one that is looked at.
    std::array<Entry, 3 * k_max_quad_depth + 4> stack{};
    std::size_t top = 0;
    if (!eco_.boxes.empty()) stack[top++] = {0, 0};
    while (top > 0) {
      const Entry at = stack[--top];
      const QuadNode& node = eco_.boxes[first_quad_node(at.level) + at.index];
      if (node.bounds.empty()) continue;
      ++counts_.nodes_visited;
      const Visibility seen =
          classify(frustum_, eye_, absolute(node.bounds, eco_.origin), &counts_.plane_tests);
      if (seen == Visibility::outside) continue;
      if (seen == Visibility::inside || at.level == eco_.depth) {
        take(node, seen == Visibility::crossing);
        continue;
      }
      for (std::uint32_t c = 4; c-- > 0;) stack[top++] = {at.level + 1, 4 * at.index + c};
    }
    return counts_;
  }

 private:
  void take(const QuadNode& node, bool test) {
    for (std::uint32_t b = node.first_block; b < node.first_block + node.block_count; ++b) {
      const InstanceBlock& block = eco_.blocks[b];
      if (block.bounds.empty()) continue;
      const DoubleBox box = absolute(block.bounds, eco_.origin);
      const double range = eco_.types[block.type].view_range;
      if (range > 0 && distance_to(eye_, box) > range) continue;
      counts_.blocks_tested += test;
      if (test && classify(frustum_, eye_, box, &counts_.plane_tests) == Visibility::outside) continue;
      visible_.push_back(b);
    }
  }

  const Ecosystem& eco_;
  const Frustum& frustum_;
  const Double3& eye_;
  std::vector<std::uint32_t>& visible_;
  CullCounts counts_;
};

}  // namespace

double distance_to(const Double3& point, const DoubleBox& box) {
  Double3 gap;
  for (int a = 0; a < 3; ++a) gap[a] = std::max({0.0, box.min[a] - point[a], point[a] - box.max[a]});
  return length(gap);
}

void visible_blocks(const Ecosystem& eco, const Frustum& frustum, const Double3& eye,
                    std::vector<std::uint32_t>& visible, CullCounts* counts) {
  visible.clear();
  const CullCounts done = Culler(eco, frustum, eye, visible).run();
  if (counts) *counts = done;
}

}  // namespace copse
