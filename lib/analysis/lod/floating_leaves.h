// Leaves that hang in the air at a level: what bore them is gone, and they do not reach what is left.
#pragma once

#include "lib/formats/spectrum.h"
#include "lib/formats/tree.h"

#include <cstdint>
#include <vector>

namespace copse {

// A leaf whose bearer is gone passes to the nearest ancestor that is still there. It floats when it is
// farther from that part of the trunk (the axis between the radius, its parent and its children, less the
// thickness) than the leaves of its bearer are from their bearer at full detail, and than one percent of the
// tree's height. A leaf without a known bearer, and a tree that never had a trunk, float nowhere.
class FloatingLeaves {
 public:
  FloatingLeaves(const Tree& tree, const LodSpectra& spectra);

  // O(elements of both spectra + radii).
  std::uint64_t count(const LodLevel& level) const;

 private:
  // Between an element's triangles and the axis from a radius to its parent, less half the diameter.
  double gap(std::size_t element, std::uint32_t radius) const;
  std::vector<std::uint8_t> alive_radii(std::uint32_t steps) const;

  const LodSpectra& spectra_;
  std::vector<Double3> centres_;
  std::vector<std::uint32_t> parent_;
  std::vector<double> half_;     // of the diameter
  std::vector<double> allowed_;  // of every radius: how far its leaves are from it
  double tolerance_ = 0;
};

}  // namespace copse
