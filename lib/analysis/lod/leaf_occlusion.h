// leaf_occlusion: which leaves no one misses, in the order in which they can leave.
//
// A crown is drawn from all round with all of its layers (as in depth peeling, Everitt 2001, but each pixel
// keeps a list), once. What a leaf's going changes is then counted, and stays counted while others go: ground
// that it alone covers is lost, and where it was seen another leaf is. So leaves go greedily, each time the
// one that changes least for each triangle, and no picture is drawn again.
#pragma once

#include "lib/analysis/lod/leaf_views.h"

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

namespace copse {

struct OcclusionOptions {
  int views = 12;         // of half of the sphere
  double samples = 36;    // points of a leaf of mean size, of all views together
  double other = 0.04;    // what a pixel counts that shows another leaf, beside one that is lost
  double coverage = 1;    // ends before less than this share of the pixels is covered
  float few = 0;          // pixels: a triangle of fewer is drawn as points; quicker, not as sure
  std::size_t least = 0;  // ends before fewer triangles are left
  // What is known of each leaf beside, pixels that its going costs; empty: nothing. Ties are broken by it.
  std::span<const float> prior = {};
};

struct Occlusion {
  // What leaf collapse makes of it: of the triangles so many stay at least, of the coverage so much; and when
  // of those that stay so many are left, merged leaves take their place.
  static constexpr double k_least = 0.24, k_coverage = 0.98, k_shown = 0.8;
  // They leave in so many steps at most: what leaves together is stored in the order of the tree, in a third
  // of the bytes.
  static constexpr std::size_t k_steps = 256;
  std::vector<std::uint32_t> gone;  // leaves, in this order
  std::size_t step(std::size_t i) const { return i * std::min(k_steps, gone.size()) / gone.size(); }
  // Of how many pixels all leaves cover, how many are seen in front of others: the mean of both sides.
  double covered = 0, seen = 0;
};

// The leaves of a crown in the ball. Deterministic; pictures are drawn in parallel. O(samples x leaves), some
// dozens of nanoseconds and eight bytes a sample; of leaves that are as large as the crown no more than 2^24
// samples, or four a view.
Occlusion leaves_by_occlusion(std::span<const ViewedLeaf> leaves, const Double3& centre, double radius,
                              const DoubleBox& box, const OcclusionOptions& options);

}  // namespace copse
