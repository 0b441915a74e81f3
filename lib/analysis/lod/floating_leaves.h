// Leaves that hang in the air at a level: what bore them is gone, and they do not reach what is left.
#pragma once

#include "lib/formats/levels/spectrum.h"
#include "lib/formats/tree/tree.h"

#include <cstdint>
#include <memory>
#include <vector>

namespace copse {

// A leaf, single or merged, floats when it is farther from the trunk that is drawn than 1.25 times what its
// own triangles are from the trunk at full detail and one percent of the tree's height. Distances are
// those between triangles as they are drawn. Without a trunk at full detail nothing floats; where nothing is
// left of one, all leaves do.
class FloatingLeaves {
 public:
  // Keeps a reference to `spectra`. O(n log n) in the trunk's triangles.
  FloatingLeaves(const Tree& tree, const LodSpectra& spectra);
  ~FloatingLeaves();
  FloatingLeaves(const FloatingLeaves&) = delete;
  FloatingLeaves& operator=(const FloatingLeaves&) = delete;

  // Of the leaves that are drawn. O(log n) a leaf.
  std::uint64_t count(const LodLevel& level) const;

  // Of every element of the leaves the first number of trunk steps after which it would float, at least 1;
  // k_none when it never does. Empty without a trunk. O(log n) an element and form that the trunk near it
  // takes.
  std::vector<std::uint32_t> held_until() const;

 private:
  class DrawnTrunk;

  const LodSpectra& spectra_;
  std::unique_ptr<const DrawnTrunk> full_, drawn_;  // of full detail; of all steps
  double tolerance_ = 0;
};

}  // namespace copse
