// radius_ancestors: which radius bears two others.
#pragma once

#include "lib/formats/tree/tree.h"

#include <cstdint>
#include <vector>

namespace copse {

class RadiusAncestors {
 public:
  explicit RadiusAncestors(const Tree& tree);
  // The lowest radius that both hang on (one of them, when the other hangs on it). k_none when one of them is
  // k_none or no radius of the tree, or when they hang on different roots. Cost: the levels between.
  std::uint32_t common(std::uint32_t a, std::uint32_t b) const;
  // The radius that each leaf group hangs on: its terminal radius; k_none for a group without one.
  const std::vector<std::uint32_t>& of_group() const { return of_group_; }

 private:
  std::vector<std::uint32_t> parent_, depth_, of_group_;
};

}  // namespace copse
