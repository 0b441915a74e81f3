// From what a user writes to a terrain: a flat, a NURBS surface or a height map, sampled, then broken by
// random faults.
//
// Source: digest 000, section 2.5.
#pragma once

#include "lib/analysis/ecosystem/nurbs_surface.h"
#include "lib/analysis/ecosystem/random_faults.h"
#include "lib/analysis/ecosystem/value_map.h"
#include "lib/formats/ecosystem/ecosystem.h"
#include "lib/formats/result.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace copse {

struct TerrainPlan {
  Double3 origin{};                     // its corner of smallest x and z
  double width = 100, depth = 100;      // along x and z; of a free surface not used
  std::uint32_t columns = 2, rows = 2;  // vertices
  // Any of these, or none for a flat at y = 0:
  std::optional<NurbsSurface> surface{};  // free: x, y and z from the control points, relative to the origin
  std::optional<NurbsSurface> heights{};  // y alone: x and z are the grid's
  const ValueMap* height_map = nullptr;   // linear between pixels; 0 is `low`, 1 is `high`
  double low = 0, high = 1;
  FaultOptions faults{};
};

// Refused: more vertices than a file holds, numbers that are not finite or leave float32's range, and terrain
// that covers no ground seen from above (vertical), because nothing can be planted on it.
Result<Terrain> make_terrain(const TerrainPlan& plan, const Random& random);

}  // namespace copse
