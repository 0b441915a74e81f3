// Which blocks of an ecosystem a camera sees: by the box hierarchy of the thesis, by the kd-tree or the
// R-tree that the file may have, or by testing every block.
//
// Source: digest 000, section 3.3 (three states: outside, crossing, inside) and hazard H32: invalid nodes are
// skipped before any arithmetic, and what is in doubt counts as seen. Below a node that lies inside nothing
// is tested any more. All ways see the same blocks: a box inside a box is outside a plane whenever that is.
// The stack is on the stack; `visible` grows to its largest size once.
#pragma once

#include "lib/formats/ecosystem/ecosystem.h"
#include "lib/runtime/camera.h"

#include <cstdint>
#include <vector>

namespace copse {

struct CullCounts {
  std::uint64_t nodes_visited = 0;  // of a hierarchy; its bottom nodes are blocks in the kd-tree and R-tree
  std::uint64_t blocks_tested = 0;  // one by one, beside the nodes
  std::uint64_t plane_tests = 0;    // of both
};

// none: nothing is tested, every block counts as seen; flat: every block is tested; coherent: the box
// hierarchy, with what is known of the frame before and of the node above.
enum class BlockHierarchy : std::uint8_t { none, flat, boxes, kd_tree, rtree, coherent };

// Of one camera, from frame to frame: the plane that each node and block was outside of when it was last
// looked at; k_no_plane: of none.
struct CullMemory {
  static constexpr std::uint8_t k_no_plane = 6;
  std::vector<std::uint8_t> nodes, blocks;
};

// Whether the file has it. Of an ecosystem without blocks every hierarchy is empty, and there.
bool has_hierarchy(const Ecosystem& eco, BlockHierarchy by);

struct SeenBlock {
  std::uint32_t block = 0;
  bool whole = false;  // its box lies inside: nothing of it need be tested
  friend bool operator==(const SeenBlock&, const SeenBlock&) = default;
};

// In the order of the file, by a kd-tree or R-tree in the order of that. Left out are blocks without a box,
// those outside a plane, and those whose type has a view range that ends before their box begins.
// Precondition: has_hierarchy. `memory`: of `coherent`, which tries that plane first (plane coherence:
// Assarsson and Moeller, 2000; digest 004, section 2.7), and below a node none of the planes that it lies
// inside of. What is seen does not depend on it.
void visible_blocks(const Ecosystem& eco, BlockHierarchy by, const Frustum& frustum, const Double3& eye,
                    std::vector<SeenBlock>& visible, CullCounts* counts = nullptr,
                    CullMemory* memory = nullptr);

// The distance from a point to a box; 0 inside.
double distance_to(const Double3& point, const DoubleBox& box);

}  // namespace copse
