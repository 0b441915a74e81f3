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
  Culler(const Ecosystem& eco, const Frustum& frustum, const Double3& eye, std::vector<SeenBlock>& visible)
      : eco_(eco), frustum_(frustum), eye_(eye), visible_(visible) {}

  void by_boxes() {
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
      const Visibility seen = see(node.bounds);
      if (seen == Visibility::outside) continue;
      if (seen == Visibility::inside || at.level == eco_.depth) {
        take(node.first_block, node.block_count, seen == Visibility::crossing);
        continue;
      }
      for (std::uint32_t c = 4; c-- > 0;) stack[top++] = {at.level + 1, 4 * at.index + c};
    }
  }

  // Each entry with the planes that its box may still be outside of.
  void coherently(CullMemory& memory) {
    struct Entry {
      std::uint32_t level, index, planes;
    };
    memory.nodes.resize(eco_.boxes.size(), CullMemory::k_no_plane);
    memory.blocks.resize(eco_.blocks.size(), CullMemory::k_no_plane);
    std::array<Entry, 3 * k_max_quad_depth + 4> stack{};
    std::size_t top = 0;
    if (!eco_.boxes.empty()) stack[top++] = {0, 0, (1u << frustum_.size()) - 1};
    while (top > 0) {
      Entry at = stack[--top];
      const std::size_t number = first_quad_node(at.level) + at.index;
      const QuadNode& node = eco_.boxes[number];
      if (node.bounds.empty()) continue;
      ++counts_.nodes_visited;
      if (!see(node.bounds, at.planes, memory.nodes[number])) continue;
      if (at.planes == 0) {
        take(node.first_block, node.block_count, false);
      } else if (at.level == eco_.depth) {
        for (std::uint32_t b = node.first_block; b < node.first_block + node.block_count; ++b) {
          std::uint32_t planes = at.planes;
          if (eco_.blocks[b].bounds.empty() || !in_range(eco_.blocks[b])) continue;
          ++counts_.blocks_tested;
          if (see(eco_.blocks[b].bounds, planes, memory.blocks[b])) visible_.push_back({b, planes == 0});
        }
      } else {
        for (std::uint32_t c = 4; c-- > 0;) stack[top++] = {at.level + 1, 4 * at.index + c, at.planes};
      }
    }
  }

  // Depth first with skips: one walk through the array, without a stack.
  void by_tree(const Array<BlockNode>& nodes) {
    std::size_t inside_until = 0;
    for (std::size_t i = 0; i < nodes.size();) {
      const BlockNode& node = nodes[i];
      if (i >= inside_until) {
        ++counts_.nodes_visited;
        const Visibility seen = see(node.bounds);
        if (seen == Visibility::inside) inside_until = node.skip;
        if (seen == Visibility::outside) {
          i = node.skip;
          continue;
        }
      }
      if (node.block != k_none && in_range(eco_.blocks[node.block]))
        visible_.push_back({node.block, i < inside_until});
      ++i;
    }
  }

  void take(std::uint32_t first, std::uint32_t count, bool test) {
    for (std::uint32_t b = first; b < first + count; ++b) {
      const InstanceBlock& block = eco_.blocks[b];
      if (block.bounds.empty() || !in_range(block)) continue;
      counts_.blocks_tested += test;
      const Visibility seen = test ? see(block.bounds) : Visibility::inside;
      if (seen != Visibility::outside) visible_.push_back({b, seen == Visibility::inside});
    }
  }

  const CullCounts& counts() const { return counts_; }

 private:
  Visibility see(const FloatBox& box) {
    return classify(frustum_, eye_, absolute(box, eco_.origin), &counts_.plane_tests);
  }
  // Whether a box is outside none of `planes`; then they are those that it crosses. `last`: tried first.
  bool see(const FloatBox& box, std::uint32_t& planes, std::uint8_t& last) {
    const DoubleBox at = absolute(box, eco_.origin);
    const Double3 centre = at.centre() - eye_, half = at.extent() * 0.5;
    const std::uint32_t first = last;
    std::uint32_t crossed = 0;
    for (std::uint32_t k = 0; k < frustum_.size(); ++k) {
      // `first` and plane 0 change places.
      const std::uint32_t p = first >= frustum_.size() ? k : k == 0 ? first : k == first ? 0 : k;
      if (!(planes >> p & 1)) continue;
      ++counts_.plane_tests;
      const Visibility seen = classify(frustum_[p], centre, half);
      if (seen == Visibility::outside) {
        last = static_cast<std::uint8_t>(p);
        return false;
      }
      if (seen == Visibility::crossing) crossed |= 1u << p;
    }
    planes = crossed;
    return true;
  }
  bool in_range(const InstanceBlock& block) const {
    const double range = eco_.types[block.type].view_range;
    return !(range > 0) || distance_to(eye_, absolute(block.bounds, eco_.origin)) <= range;
  }

  const Ecosystem& eco_;
  const Frustum& frustum_;
  const Double3& eye_;
  std::vector<SeenBlock>& visible_;
  CullCounts counts_;
};

}  // namespace

double distance_to(const Double3& point, const DoubleBox& box) {
  Double3 gap;
  for (int a = 0; a < 3; ++a) gap[a] = std::max({0.0, box.min[a] - point[a], point[a] - box.max[a]});
  return length(gap);
}

bool has_hierarchy(const Ecosystem& eco, BlockHierarchy by) {
  const auto bounded = [](const InstanceBlock& b) { return !b.bounds.empty(); };
  if (by == BlockHierarchy::kd_tree || by == BlockHierarchy::rtree) {
    const bool there = !(by == BlockHierarchy::kd_tree ? eco.kd_tree : eco.rtree).empty();
    return there || std::none_of(eco.blocks.begin(), eco.blocks.end(), bounded);
  }
  return true;
}

void visible_blocks(const Ecosystem& eco, BlockHierarchy by, const Frustum& frustum, const Double3& eye,
                    std::vector<SeenBlock>& visible, CullCounts* counts, CullMemory* memory) {
  visible.clear();
  CullMemory nothing;
  Culler culler(eco, frustum, eye, visible);
  const auto all = static_cast<std::uint32_t>(eco.blocks.size());
  if (by == BlockHierarchy::none) culler.take(0, all, false);
  if (by == BlockHierarchy::flat) culler.take(0, all, true);
  if (by == BlockHierarchy::boxes) culler.by_boxes();
  if (by == BlockHierarchy::kd_tree) culler.by_tree(eco.kd_tree);
  if (by == BlockHierarchy::rtree) culler.by_tree(eco.rtree);
  if (by == BlockHierarchy::coherent) culler.coherently(memory ? *memory : nothing);
  if (counts) *counts = culler.counts();
}

}  // namespace copse
