// How far a place is from the marked pixels of a map: exactly, from the point itself to the nearest point of
// their area, 0 on them.
//
// A distance transform from middle to middle of pixels (the lower envelope of parabolas) brackets every
// answer within a pixel's diagonal, which decides most of the questions whether a distance is within limits;
// the rest goes by the rows of pixels that may be nearer. Source: Felzenszwalb and Huttenlocher, "Distance
// transforms of sampled functions" (Theory of Computing, 2012). O(pixels) once, 8 bytes a pixel; a question
// O(1), or O(rows up to that distance).
#pragma once

#include "lib/analysis/ecosystem/value_map.h"

#include <cstdint>
#include <vector>

namespace copse {

class PixelDistance {
 public:
  PixelDistance() = default;  // of no map: infinite everywhere
  // Marked are pixels of at least 1/2.
  PixelDistance(const ValueMap& map, const PlantedArea& area);

  // In metres; +infinity when nothing is marked. A place outside of the area counts as on its border. Off by
  // rounding alone, some 1e-15 of the area's size.
  double at(double x, double z) const;
  // Whether least <= at(x, z) <= most.
  bool is_within(double x, double z, double least, double most) const;

 private:
  struct Place;
  Place place_of(double x, double z) const;
  double exact(const Place& p) const;
  PlantedArea area_;
  std::uint32_t width_ = 0, height_ = 0;
  double side_x_ = 1, side_z_ = 1;
  std::vector<float> middles_;  // m, from middle to middle
  // Of every pixel the marked one nearest to it in its row: twice the pixels between, plus 1 when it is on
  // the right; k_free: its row has none, k_here: it is marked itself.
  std::vector<std::uint32_t> in_row_;
};

}  // namespace copse
