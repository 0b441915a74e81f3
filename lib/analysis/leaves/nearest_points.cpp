#include "lib/analysis/leaves/nearest_points.h"

#include "lib/formats/material.h"

#include <cmath>
#include <limits>

#include <nanoflann.hpp>

namespace copse {
namespace {

struct Cloud {
  std::span<const Double3> points;
  std::size_t kdtree_get_point_count() const { return points.size(); }
  double kdtree_get_pt(std::size_t i, std::size_t axis) const { return points[i][static_cast<int>(axis)]; }
  template <class Box>
  bool kdtree_get_bbox(Box&) const {
    return false;
  }
};

using Index =
    nanoflann::KDTreeSingleIndexAdaptor<nanoflann::L2_Simple_Adaptor<double, Cloud>, Cloud, 3, std::uint32_t>;

// Keeps the nearest point, of equals the lowest. Names are nanoflann's.
struct Best {
  std::span<const std::uint8_t> skip;
  std::uint32_t index = k_none;
  double distance = std::numeric_limits<double>::infinity();

  bool addPoint(double d, std::uint32_t i) {  // NOLINT(readability-identifier-naming)
    if (!skip.empty() && skip[i]) return true;
    if (d < distance || (d == distance && i < index)) distance = d, index = i;
    return true;
  }
  // The search offers only what is nearer than this: one step more, so that equals are offered.
  double worstDist() const {  // NOLINT(readability-identifier-naming)
    return std::nextafter(distance, std::numeric_limits<double>::infinity());
  }
  bool full() const { return index != k_none; }
};

// The distance to a cell is accumulated; a cell is skipped only when it is farther by more than its rounding.
constexpr float k_not_farther = -1e-6f;

}  // namespace

struct NearestPoints::Impl {
  explicit Impl(std::span<const Double3> points) : cloud{points}, index(3, cloud) { index.buildIndex(); }
  Cloud cloud;
  Index index;
};

NearestPoints::NearestPoints(std::span<const Double3> points)
    : impl_(points.empty() ? nullptr : std::make_unique<Impl>(points)) {}
NearestPoints::~NearestPoints() = default;
NearestPoints::NearestPoints(NearestPoints&&) noexcept = default;

std::uint32_t NearestPoints::nearest(const Double3& p, std::span<const std::uint8_t> skip) const {
  if (!impl_) return k_none;
  Best best{skip};
  const double query[3] = {p.x, p.y, p.z};
  impl_->index.findNeighbors(best, query, nanoflann::SearchParams(0, k_not_farther, false));
  return best.index;
}

}  // namespace copse
