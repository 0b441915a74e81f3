// Gives points that are equal bit by bit one index, in order of their first occurrence.
#pragma once

#include "lib/formats/vec.h"

#include <cstdint>
#include <vector>

namespace copse {

class ExactWeld {
 public:
  // Points are appended to `points`, which is empty at first and changed by nobody else.
  explicit ExactWeld(std::vector<Double3>& points);
  std::uint32_t index_of(Double3 point);

 private:
  std::uint64_t hash(const Double3& point) const;
  void grow();

  std::vector<Double3>& points_;
  std::vector<std::uint32_t> slots_;  // open addressing; at most half full
  std::uint64_t seed_;                // a file cannot aim at collisions; the result does not depend on it
};

}  // namespace copse
