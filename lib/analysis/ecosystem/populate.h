// Plants every type: where, how large, how turned and leaned, of which colour.
//
// Types that nothing limits share the jittered cells of the thesis (jittered_cells.h); those with maps or
// rules are spread over a density field (spread.h); those with spacing are kept apart from all others with
// spacing (spread_apart.h), the largest first, and from the feet of those that they are to avoid. Counts are
// kept, or the run is refused.
//
// Every instance has random streams of its own, so the result is the same for any number of threads. Source:
// digest 000, sections 2.2 to 2.4 and 8, errata E3 to E6.
#pragma once

#include "lib/analysis/ecosystem/density_field.h"
#include "lib/analysis/ecosystem/density_shares.h"
#include "lib/analysis/ecosystem/ground.h"
#include "lib/formats/ecosystem/ecosystem.h"
#include "lib/formats/random.h"
#include "lib/formats/result.h"

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

namespace copse {

struct TintMap {
  std::uint32_t width = 0, height = 0;
  std::vector<std::array<std::uint8_t, 3>> colours;  // sRGB; rows as of ValueMap
};

struct TypePlan {
  std::string name{};       // for messages: "types[2] (oak)"
  std::uint64_t count = 0;  // of random instances
  ValueRange head{0, 360};  // degrees
  bool tilt_to_ground = false;
  ValueRange pitch{0, 0}, roll{0, 0};   // degrees; of a tilt that is not the ground's
  ValueRange scale{1, 1};               // > 0
  const ValueMap* scale_map = nullptr;  // 0 is scale.min, 1 is scale.max; otherwise random
  const TintMap* tint_map = nullptr;
  std::uint32_t trunk_material = k_none, leaf_material = k_none, motion = 0;
  PlacementRules rules{};
  std::uint32_t field_cells = 0;  // a side of its density field; 0: as its maps, count and clusters need
  double footprint = 0;  // m at scale 1: in cells this far from the border of the cell, where it fits
  double spacing = 0;    // m at scale 1: radius of a disc that overlaps no other; 0: not kept apart
  // Types without spacing whose feet, those by hand included, its discs keep off.
  std::vector<std::size_t> avoid{};
  bool fewer = false;              // when they do not all fit: fewer, instead of none
  std::vector<Instance> manual{};  // by hand, added to the random ones
};

struct TypeCounts {
  std::uint64_t placed = 0;       // random ones
  std::uint64_t crowded = 0;      // reach out of their cell: no promise that they do not touch
  std::uint64_t overlapping = 0;  // by hand, with spacing: discs that overlap one by hand before them
  std::uint64_t missing = 0;      // did not fit, with `fewer`
  std::uint64_t hindered = 0;     // of a type with spacing: where it would have stood was no room
  std::uint64_t moved = 0;        // of these: stand in other parts of their density (density_shares.h)
  std::vector<DensityShare> by_density{};  // of a type with spacing
};

struct Population {
  std::vector<Instance> instances;  // type after type, the random ones first
  std::vector<TypeCounts> types;
  std::uint64_t cells = 0, displaced = 0, in_random_cells = 0;  // of the jittered cells
};

// What the clusters of type number `type` are drawn with; `random` as given to populate().
Random cluster_random(const Random& random, std::size_t type);

// Refused: no ground that the rules allow for a type that is to be planted; spacing that leaves no room for
// all. `progress` hears from 0 to 1 how far types with spacing are, now and then, from the thread of the
// call.
Result<Population> populate(std::span<const TypePlan> types, const TerrainGround& ground,
                            const PlantedArea& area, const Random& random,
                            const std::function<void(double)>& progress = {});

}  // namespace copse
