// A map over the planted area: an image whose pixels say something of the ground below them. Row 0 lies along
// the smallest z, column 0 along the smallest x: the map as it is drawn, seen from above with +X to the right
// and +Z down.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace copse {

struct ValueMap {
  std::uint32_t width = 0, height = 0;
  std::vector<float> values;  // rows from the smallest z; finite
};

// The rectangle that maps lie over.
struct PlantedArea {
  double x0 = 0, z0 = 0, x1 = 0, z1 = 0;
  double width() const { return x1 - x0; }
  double depth() const { return z1 - z0; }
};

// The value of the pixel that holds (x, z); points outside count as on the border. 0 of an empty map.
double pixel_at(const ValueMap& map, const PlantedArea& area, double x, double z);

// Linear between the centres of pixels.
double smooth_at(const ValueMap& map, const PlantedArea& area, double x, double z);

// At most what smooth_at is anywhere from (x0, z0) to (x1, z1): the least of the pixels that have a part in
// it.
double least_in(const ValueMap& map, const PlantedArea& area, double x0, double z0, double x1, double z1);

// One map for each size among `maps`, in the order in which sizes come first: the sum of those of that size,
// what is below 0 counted as 0, over the number of all `maps`, so that it stays a float; above 0 wherever one
// of them is. O(pixels).
std::vector<ValueMap> means_by_size(std::span<const ValueMap* const> maps);

}  // namespace copse
