// Vertices as arrays of coordinates, and how wide they are along the axes of a frame: the inner loop of every
// search over rotations.
#pragma once

#include "lib/analysis/hull/frame.h"

#include <span>
#include <vector>

namespace copse {

class VertexWidths {
 public:
  explicit VertexWidths(std::span<const Double3> vertices);
  std::size_t size() const { return count_; }
  double along(const Double3& axis) const;
  // The product of the three widths.
  double volume(const Axes& axes) const { return along(axes[0]) * along(axes[1]) * along(axes[2]); }

 private:
  std::size_t count_;
  std::vector<double> x_, y_, z_;  // padded with the first vertex to whole vectors
};

}  // namespace copse
