// point_cloud: points brought near the origin and to a size of about 1, so that nothing that is fitted to
// them can overflow, underflow or cancel, whatever their place and scale.
//
// The shift is a number of few bits where the points allow it (then differences of float32 coordinates are
// exact), the scale a power of two (then scaling is exact): what is lost is at most one rounding of each
// coordinate, 2^-53 of the size.
#pragma once

#include "lib/formats/result.h"
#include "lib/formats/vec.h"
#include "lib/formats/volumes/volume.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

// Cloud coordinates = (caller's coordinates - origin) / scale.
struct PointFrame {
  Double3 origin;
  double scale = 1;  // a power of two: the caller's length of 1 in the cloud

  Double3 in(const Double3& p) const {  // + 0: -0 and 0 are one coordinate, and must be one pattern of bits
    const double inverse = 1 / scale;
    return {(p.x - origin.x) * inverse + 0.0, (p.y - origin.y) * inverse + 0.0,
            (p.z - origin.z) * inverse + 0.0};
  }
  Double3 out(const Double3& q) const { return q * scale + origin; }
  double volume_out(double v) const { return v * scale * scale * scale; }
  friend bool operator==(const PointFrame&, const PointFrame&) = default;
};

struct PointCloud {
  PointFrame frame;
  std::vector<Double3>
      points;     // the caller's, in their order; coordinates within 1.1 (2 near the largest double)
  DoubleBox box;  // of `points`
};

// Refuses an empty span and coordinates that are not finite, naming the first such point. A cloud smaller
// than 1e-300 is scaled by 2^1000 only. O(n), two passes.
Result<PointCloud> make_point_cloud(std::span<const Double3> points);

// The points without repetition, in an order that does not depend on the order given (lexicographic).
// O(n log n).
std::vector<Double3> distinct_points(std::span<const Double3> points);

inline bool lexicographically_less(const Double3& a, const Double3& b) {
  return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

// A volume fitted in cloud coordinates, in the caller's. Rounds to nearest: what must contain is certified
// afterwards, as it is written.
DoubleBox placed(const DoubleBox& v, const PointFrame& frame);
BoundingSphere<double> placed(const BoundingSphere<double>& v, const PointFrame& frame);
OrientedBox<double> placed(const OrientedBox<double>& v, const PointFrame& frame);
Capsule<double> placed(const Capsule<double>& v, const PointFrame& frame);
Cylinder<double> placed(const Cylinder<double>& v, const PointFrame& frame);
Lozenge<double> placed(const Lozenge<double>& v, const PointFrame& frame);
Ellipsoid<double> placed(const Ellipsoid<double>& v, const PointFrame& frame);
Kdop<double> placed(const Kdop<double>& v, const PointFrame& frame);
Volume<double> placed(const Volume<double>& v, const PointFrame& frame);

}  // namespace copse
