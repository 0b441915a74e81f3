// Instances to what a player loads: put in spatial order, cut into blocks, packed, bounded, and under the box
// hierarchy of the thesis.
//
// Source: digest 000, section 3.3 (a quadtree, erratum E40). The leaf that owns an instance is the one in
// whose portion it is planted; along the Hilbert curve every subtree is one run of blocks. Inside a leaf
// instances are sorted by type, then along the curve. Ties by the given order. O(n log n).
#pragma once

#include "lib/analysis/ecosystem/ground.h"
#include "lib/formats/ecosystem/ecosystem.h"
#include "lib/formats/result.h"

#include <array>
#include <cstdint>
#include <vector>

namespace copse {

inline constexpr std::uint32_t k_block_instances = 256;
// A foot is off the ground by at most this share of the instance's size.
inline constexpr double k_foot_error = 1e-5;

struct ArrangeOptions {
  bool exact = false;            // 48 bytes an instance
  std::uint32_t depth = k_none;  // of the box hierarchy; none: so that a leaf has about 1000 instances
  std::array<double, 4> area{};  // x0, z0, x1, z1
  // Where given, instances that are on the ground or along its normal are so again after their x and z were
  // rounded.
  const TerrainGround* ground = nullptr;
};

// The depth that `none` stands for.
std::uint32_t usual_depth(std::size_t instances);

// Fills blocks, packed or exact, boxes, area, depth, the errors, and of every type instances, scale_min and
// scale_max. `eco.types`, with their bounds, and `eco.origin` must be there. Types without instances keep
// their scales. Answers which of `instances` each of the stored ones is. Refused: 255 materials or more, or a
// motion above 255, unless exact.
Result<std::vector<std::uint32_t>> arrange(const std::vector<Instance>& instances,
                                           const ArrangeOptions& options, Ecosystem& eco);

}  // namespace copse
