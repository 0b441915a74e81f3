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
  // Keeps a reference to `spectra`. O(n log n) in the trunk's triangles. floats_by blames the trunk's steps
  // after `from` alone: what floats after so many has its excuse.
  FloatingLeaves(const Tree& tree, const LodSpectra& spectra, std::uint32_t from = 0);
  ~FloatingLeaves();
  FloatingLeaves(const FloatingLeaves&) = delete;
  FloatingLeaves& operator=(const FloatingLeaves&) = delete;

  // Of the leaves that are drawn. O(log n) a leaf.
  std::uint64_t count(const LodLevel& level) const;

  // Whether an element of the leaves would float after so many of the trunk's steps or after fewer, if more
  // than `from`; never at full detail. What is found out is kept: asked again, or with fewer steps, it costs
  // nothing. O(log n) for each form that the trunk near it takes in between. Elements may be asked about in
  // parallel, each of them by one thread at a time.
  bool floats_by(std::uint32_t element, std::uint32_t trunk_steps);

 private:
  class DrawnTrunk;
  // What is known of an element.
  struct Known {
    double allowed = -1;      // how far it may be from the trunk; below 0: not yet known
    std::uint32_t until = 0;  // it is held before so many steps,
    bool last = false;        // and floats then
  };

  const LodSpectra& spectra_;
  std::unique_ptr<const DrawnTrunk> full_, drawn_;  // of full detail; of all steps
  std::vector<Known> known_;
  std::uint32_t from_ = 0;
  double tolerance_ = 0;
};

}  // namespace copse
