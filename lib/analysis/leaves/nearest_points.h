// nearest_points: the nearest of a set of points, exactly, ties to the lowest index.
#pragma once

#include "lib/formats/vec.h"

#include <cstdint>
#include <memory>
#include <span>

namespace copse {

// A k-d tree (nanoflann) over points that outlive it. Distances are compared as squares in double.
class NearestPoints {
 public:
  explicit NearestPoints(std::span<const Double3> points);
  ~NearestPoints();
  NearestPoints(NearestPoints&&) noexcept;

  // The index of the point nearest to `p`, of those at the same distance the lowest. Points i with skip[i]
  // are passed over; `skip` is empty or one a point. k_none when nothing is left.
  std::uint32_t nearest(const Double3& p, std::span<const std::uint8_t> skip = {}) const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace copse
