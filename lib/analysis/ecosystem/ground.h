// What is under a point of the XZ plane: the height and the normal of the terrain's triangle there.
//
// Source: digest 000, sections 2.3 to 2.5; hazards H28 and H29. Where a surface is folded the highest
// triangle counts. On a regular grid a look-up costs a few operations; otherwise triangles are found through
// a grid of buckets, O(1) on terrains whose triangles are of like size.
#pragma once

#include "lib/analysis/leaves/nearest_points.h"
#include "lib/formats/ecosystem/ecosystem.h"

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace copse {

struct GroundPoint {
  double height = 0;        // y
  Double3 normal{0, 1, 0};  // of the triangle, length 1, y > 0
};

class TerrainGround {
 public:
  // `terrain` must outlive it.
  explicit TerrainGround(const Terrain& terrain);

  // The rectangle that the terrain covers or surrounds; a side of 0 where it is vertical.
  double x0() const { return x0_; }
  double z0() const { return z0_; }
  double x1() const { return x1_; }
  double z1() const { return z1_; }
  // Whether every point of the rectangle has a triangle below it.
  bool covers_all() const { return terrain_.regular(); }
  // PlantedArea of the triangles seen from above, folds counted once more: 0 means that nothing can stand
  // here.
  double area() const;

  // None: no triangle there. On a regular grid points outside are moved to the border.
  std::optional<GroundPoint> at(double x, double z) const;
  // Whether a triangle lies there, with nothing moved. False of what is not finite.
  bool covers(double x, double z) const;

 private:
  GroundPoint at_regular(double x, double z) const;
  std::optional<GroundPoint> at_free(double x, double z) const;
  void choose_buckets(std::uint32_t triangles);
  // First column and row, and those behind the last; all 0 of what is upright.
  std::array<std::uint32_t, 4> buckets_of(const std::array<Double3, 3>& triangle) const;
  void fill_buckets();

  const Terrain& terrain_;
  double x0_ = 0, z0_ = 0, x1_ = 0, z1_ = 0;
  std::uint32_t across_ = 0, down_ = 0;  // buckets
  std::vector<std::uint32_t> first_, triangles_;
};

// The ground for what stands beside it too: there it is that of the terrain's vertex that is nearest as seen
// from above, of several the first. The vertices are sorted once, where there are points beside a free
// surface at all; then O(log vertices) a point.
class GroundBeside {
 public:
  // Both must outlive it.
  GroundBeside(const Terrain& terrain, const TerrainGround& ground) : terrain_(terrain), ground_(ground) {}
  GroundPoint at(double x, double z);

 private:
  const Terrain& terrain_;
  const TerrainGround& ground_;
  std::vector<Double3> vertices_;  // y = 0
  std::optional<NearestPoints> nearest_;
};

}  // namespace copse
