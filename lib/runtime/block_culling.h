// Which blocks of an ecosystem a camera sees: the box hierarchy of the thesis, tested from the root.
//
// Source: digest 000, section 3.3 (three states: outside, crossing, inside) and hazard H32: invalid nodes are
// skipped before any arithmetic, and what is in doubt counts as seen. Below a node that lies inside nothing
// is tested any more. Blocks come in the order of the file. The stack is on the stack; `visible` grows to its
// largest size once.
#pragma once

#include "lib/formats/ecosystem.h"
#include "lib/runtime/camera.h"

#include <cstdint>
#include <vector>

namespace copse {

struct CullCounts {
  std::uint64_t nodes_visited = 0, plane_tests = 0, blocks_tested = 0;
};

// Also left out: blocks whose type has a view range that ends before their box begins.
void visible_blocks(const Ecosystem& eco, const Frustum& frustum, const Double3& eye,
                    std::vector<std::uint32_t>& visible, CullCounts* counts = nullptr);

// The distance from a point to a box; 0 inside.
double distance_to(const Double3& point, const DoubleBox& box);

}  // namespace copse
