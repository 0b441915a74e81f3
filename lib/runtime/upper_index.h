// The upper level of a two-level index: things that move freely, each with a static hierarchy of its own.
//
// The lower level is what is below one thing (a tree, a platform): built offline, moved along as a whole. The
// upper level holds the boxes of the things as they are now: a balanced binary tree over them in the order of
// a space-filling curve. Every frame the boxes are refitted, O(n); when they have drifted so far that the
// tree has grown loose, all in all or on the mean of its boxes (one thing far away makes all the others'
// boxes nothing beside its own), the order is made anew, O(n log n). Nothing is allocated after construction.
//
// Source: digest 002, section 3.6 (two-level hierarchy), which leaves open how the upper level is kept.
#pragma once

#include "lib/formats/material.h"
#include "lib/formats/vec.h"
#include "lib/runtime/volume_tests.h"

#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace copse {

class UpperIndex {
 public:
  explicit UpperIndex(std::uint32_t things);

  // Where a thing is now: not empty, finite. All must be placed before the first update.
  void place(std::uint32_t thing, const FloatBox& box) { boxes_[thing] = box; }

  // After any number of placings. True when the order was made anew.
  bool update();

  // Calls visit(thing, mask) for every thing that no plane in `mask` keeps out, with the planes that are
  // still undecided for it (volume_tests.h); in the order of the tree.
  template <class Visit>
  void in_frustum(std::span<const FloatPlane> planes, std::uint32_t mask, Visit&& visit) const {
    std::uint32_t node = 0;
    // The masks of the nodes that are open: those of level l are good until its end.
    std::uint32_t masks[34] = {mask};
    int level = 0;
    while (node < nodes_.size()) {
      const Node& n = nodes_[node];
      level = n.level;
      std::uint32_t left = masks[level];
      if (copse::in_frustum(Volume<float>(n.box), planes, left) == Visibility::outside) {
        node = n.skip;
        continue;
      }
      masks[level + 1] = left;
      if (n.thing != k_none) visit(n.thing, left);
      ++node;
    }
  }

 private:
  struct Node {
    FloatBox box;
    std::uint32_t skip = 0, thing = k_none;
    int level = 0;
    double tight = 0;  // half its surface when the order was made
  };
  void make_order();
  void build();
  struct Growth {
    double sum = 0;  // of half the surfaces of all boxes
    double mean =
        1;  // by how much an inner box has grown since the order was made, none counted more than 8 times
  };
  Growth refit();

  std::vector<FloatBox> boxes_;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> order_;  // key, thing
  std::vector<Node> nodes_;
  double tight_ = -1;  // the sum when the order was made
};

}  // namespace copse
