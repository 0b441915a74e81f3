// Small terrains for tests.
#pragma once

#include "lib/formats/ecosystem/ecosystem.h"

#include <functional>
#include <vector>

namespace copse {

inline Terrain regular_terrain(std::uint32_t side, double size,
                               const std::function<double(double, double)>& height) {
  Terrain t;
  t.columns = t.rows = side;
  t.spacing_x = t.spacing_z = size / (side - 1);
  std::vector<float> heights;
  for (std::uint32_t r = 0; r < side; ++r)
    for (std::uint32_t c = 0; c < side; ++c)
      heights.push_back(static_cast<float>(height(c * t.spacing_x, r * t.spacing_z)));
  t.heights = std::move(heights);
  return t;
}

inline Terrain free_terrain(std::uint32_t columns, std::uint32_t rows, std::vector<Float3> points) {
  Terrain t;
  t.columns = columns;
  t.rows = rows;
  t.points = std::move(points);
  return t;
}

}  // namespace copse
