#include "lib/analysis/ecosystem/block_trees.h"

#include "lib/analysis/bvh/hilbert_rtree.h"
#include "lib/analysis/bvh/kd_tree.h"

namespace copse {
namespace {

constexpr std::uint32_t k_children = 4;

template <class Build>
std::vector<BlockNode> nodes_of(const Ecosystem& eco, Build&& build) {
  std::vector<DoubleBox> boxes;
  std::vector<std::uint32_t> blocks;
  for (std::uint32_t b = 0; b < eco.blocks.size(); ++b) {
    const FloatBox& box = eco.blocks[b].bounds;
    if (box.empty()) continue;
    boxes.push_back({to_double(box.min), to_double(box.max)});
    blocks.push_back(b);
  }
  if (boxes.empty()) return {};
  const BoxTree tree = build(boxes, k_children);
  const std::vector<DoubleBox> bounds = node_boxes(tree, boxes);
  std::vector<BlockNode> nodes(tree.nodes.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const std::uint32_t item = tree.nodes[i].item;
    nodes[i] = {round_outward(bounds[i]), tree.nodes[i].skip, item == k_none ? k_none : blocks[item]};
  }
  return nodes;
}

}  // namespace

std::vector<BlockNode> block_kd_tree(const Ecosystem& eco) {
  return nodes_of(eco, [](const auto& boxes, std::uint32_t k) { return kd_tree(boxes, k); });
}

std::vector<BlockNode> block_rtree(const Ecosystem& eco) {
  return nodes_of(eco, [](const auto& boxes, std::uint32_t k) { return hilbert_rtree(boxes, k); });
}

}  // namespace copse
