#include "lib/analysis/rings/fork_rings.h"

#include "lib/analysis/rings/band_growth.h"
#include "lib/analysis/rings/ring_graph.h"
#include "lib/analysis/rings/ring_walk.h"
#include "lib/analysis/surface/quads.h"
#include "lib/analysis/surface/tolerances.h"
#include "lib/analysis/surface/welded_tolerances.h"

#include <array>
#include <cstdint>
#include <span>
#include <utility>

namespace copse {

namespace {

bool is_complete(const Surface& surface, const Bands& bands) {
  return bands.explained() == surface.triangles.size();
}

// Which ends of limbs growth starts from.
enum class Ends : std::uint8_t {
  pointed,  // borders, points, and the middles of caps with rings behind them
  lidded,   // lids, too
  any,      // and caps and lids with one ring behind them or, where a limb grows out of the last band, none
};

// Where a welded tube is sheared by more, its end is no lid here.
constexpr auto k_lid_angles = std::to_array({k_lid_smooth_cosines[0], k_lid_smooth_cosines[1]});

// A lid comes to light when the limb beside it is read, and a limb when the lid at its end is.
void start_at_lids_beside_limbs(const Surface& surface, BandGrowth& growth, const Bands& bands) {
  std::size_t before = bands.count();
  do {
    before = bands.count();
    for (const double smooth : k_lid_angles) {
      if (is_complete(surface, bands)) return;
      growth.start_at_lids_beside_limbs(smooth);
      growth.read_past_limbs();
    }
  } while (bands.count() > before);
}

// From the ends inward, by counting alone.
void grow_from_ends(const Surface& surface, Ends ends, Bands& bands) {
  using Points = BandGrowth::Points;
  using Lids = BandGrowth::Lids;
  BandGrowth growth(surface, bands);
  const auto start_at_points = [&](Points which) {
    growth.start_at_points(which);
    growth.run(false);
  };
  const auto start_at_lids = [&](std::span<const double> angles, int rings, Lids which) {
    for (const double smooth : angles) {
      if (is_complete(surface, bands)) return;
      growth.start_at_lids(smooth, rings, which);
      growth.run(false);
    }
  };
  growth.start_at_borders();
  growth.run(false);
  if (ends != Ends::pointed) {
    start_at_lids(k_lid_angles, 2, Lids::round);
    start_at_lids(k_lid_angles, 2, Lids::any);
  }
  start_at_points(Points::followed_by_rings);
  if (ends == Ends::any) {
    growth.read_past_limbs();
    start_at_lids(k_lid_angles, 1, Lids::round);
    start_at_lids(k_lid_angles, 1, Lids::any);
    start_at_points(Points::followed_by_a_ring);
    growth.read_past_limbs();
    start_at_lids_beside_limbs(surface, growth, bands);
    growth.close_rings();
  }
  // The corners of lids are as sharp as points.
  start_at_points(Points::all);
  growth.read_past_limbs();
}

// What lies in no band and is no lid.
std::vector<std::uint32_t> taken(const Bands& bands) {
  std::vector<std::uint32_t> taken = bands.band_of;
  for (const std::uint32_t t : bands.lids) taken[t] = 0;
  return taken;
}

Bands read_bands(const Surface& surface, Ends ends, QuadOrder order) {
  Bands bands;
  bands.band_of.assign(surface.triangles.size(), k_none);
  grow_from_ends(surface, ends, bands);
  if (!is_complete(surface, bands)) {
    add_quad_bands(surface, pair_quads(surface, taken(bands), order), bands);
    BandGrowth growth(surface, bands);
    growth.start_at_bands(0);
    growth.run(false);
    growth.read_past_limbs();
    growth.close_fans();
    growth.run(false);
    growth.fill_collars();
    growth.start_at_borders();
    growth.run(true);
  }
  return bands;
}

// A limb's point has the limb behind it, or at a fork the limb below and the other one's point. A fan with
// less than half of its border on other bands is the corner of something else.
bool is_corner(const Surface& surface, const Bands& bands, std::uint32_t band) {
  if (bands.ring(2 * band + 1).size() > 1) return false;
  std::size_t bordered = 0;
  for (const std::uint32_t t : bands.triangles_of(band)) {
    for (const std::uint32_t n : surface.across[t]) {
      bordered += n != k_none && bands.band_of[n] != k_none && bands.band_of[n] != band;
    }
  }
  return 2 * bordered < bands.ring(2 * band).size();
}

// What takes no corner for a point, and no open ring for a hole, can go on where one was.
void grow_on(const Surface& surface, Bands& bands) {
  if (is_complete(surface, bands)) return;
  BandGrowth growth(surface, bands);
  growth.start_at_bands(0);
  growth.run(true);
}

Bands without_corners(const Surface& surface, const Bands& all) {
  Bands kept;
  kept.band_of.assign(surface.triangles.size(), k_none);
  kept.lids = all.lids;
  for (std::uint32_t b = 0; b < all.count(); ++b) {
    if (!is_corner(surface, all, b)) kept.add(all.ring(2 * b), all.ring(2 * b + 1), all.triangles_of(b));
  }
  return kept;
}

}  // namespace

Bands read_bands(const Surface& surface) {
  // Where counting explains every triangle there is nothing to choose. Flat ends are easily mistaken for
  // something else, so those of short twigs count only where all is then explained.
  for (const Ends ends : {Ends::pointed, Ends::any}) {
    Bands counted;
    counted.band_of.assign(surface.triangles.size(), k_none);
    grow_from_ends(surface, ends, counted);
    if (is_complete(surface, counted)) return counted;
  }
  Bands bands = read_bands(surface, Ends::pointed, QuadOrder::file);
  const auto enough = k_enough_bands * static_cast<double>(surface.triangles.size());
  for (const Ends ends : {Ends::pointed, Ends::lidded}) {
    if (static_cast<double>(bands.explained()) >= enough) break;
    Bands by_shape = read_bands(surface, ends, QuadOrder::shape);
    if (by_shape.explained() > bands.explained()) bands = std::move(by_shape);
  }
  bands = without_corners(surface, bands);
  grow_on(surface, bands);
  return bands;
}

RingReading read_fork_rings(const Surface& surface) {
  if (surface.triangles.empty()) return {};
  Bands bands = read_bands(surface);
  Hierarchy hierarchy = walk_rings(surface, bands, make_ring_graph(surface, bands));
  const double share = static_cast<double>(bands.explained()) / static_cast<double>(surface.triangles.size());
  return {std::move(hierarchy), share, std::move(bands)};
}

}  // namespace copse
