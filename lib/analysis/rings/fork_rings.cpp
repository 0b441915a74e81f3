#include "lib/analysis/rings/fork_rings.h"

#include "lib/analysis/rings/band_growth.h"
#include "lib/analysis/rings/ring_graph.h"
#include "lib/analysis/rings/ring_walk.h"
#include "lib/analysis/surface/quads.h"
#include "lib/analysis/surface/welded_tolerances.h"

#include <utility>

namespace copse {

namespace {

bool is_complete(const Surface& surface, const Bands& bands) {
  return bands.triangles.size() == surface.triangles.size();
}

// From every end inward, by counting alone. With `caps`, an end with one ring behind it will do.
void grow_from_ends(const Surface& surface, bool caps, Bands& bands) {
  BandGrowth growth(surface, bands);
  growth.start_at_borders();
  growth.run(false);
  growth.start_at_points(BandGrowth::Points::followed_by_rings);
  growth.run(false);
  growth.start_at_points(BandGrowth::Points::all);
  growth.run(false);
  growth.read_past_limbs();
  if (!caps || is_complete(surface, bands)) return;
  growth.start_at_points(BandGrowth::Points::followed_by_a_ring);
  growth.run(false);
  growth.read_past_limbs();
}

Bands read_bands(const Surface& surface, bool in_order) {
  Bands bands;
  bands.band_of.assign(surface.triangles.size(), k_none);
  grow_from_ends(surface, false, bands);
  if (!is_complete(surface, bands)) {
    add_quad_bands(surface, pair_quads(surface, bands.band_of, in_order), bands);
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

// What takes no corner for a point can go on where one was.
void grow_on(const Surface& surface, Bands& bands) {
  if (bands.triangles.size() == surface.triangles.size()) return;
  BandGrowth growth(surface, bands);
  growth.start_at_bands(0);
  growth.run(false);
}

Bands without_corners(const Surface& surface, const Bands& all) {
  Bands kept;
  kept.band_of.assign(surface.triangles.size(), k_none);
  for (std::uint32_t b = 0; b < all.count(); ++b) {
    if (!is_corner(surface, all, b)) kept.add(all.ring(2 * b), all.ring(2 * b + 1), all.triangles_of(b));
  }
  return kept;
}

}  // namespace

Bands read_bands(const Surface& surface) {
  // Where counting explains every triangle there is nothing to choose. The flat end of a short twig is easily
  // taken for something else, so it counts as an end only where all is then explained.
  Bands counted;
  counted.band_of.assign(surface.triangles.size(), k_none);
  grow_from_ends(surface, true, counted);
  if (is_complete(surface, counted)) return counted;
  Bands bands = read_bands(surface, true);
  const auto enough = k_enough_bands * static_cast<double>(surface.triangles.size());
  if (static_cast<double>(bands.triangles.size()) < enough) {
    Bands by_shape = read_bands(surface, false);
    if (by_shape.triangles.size() > bands.triangles.size()) bands = std::move(by_shape);
  }
  const std::size_t before = bands.triangles.size();
  bands = without_corners(surface, bands);
  if (bands.triangles.size() < before) grow_on(surface, bands);
  return bands;
}

RingReading read_fork_rings(const Surface& surface) {
  if (surface.triangles.empty()) return {};
  const Bands bands = read_bands(surface);
  return {walk_rings(surface, bands, make_ring_graph(surface, bands)),
          static_cast<double>(bands.triangles.size()) / static_cast<double>(surface.triangles.size())};
}

}  // namespace copse
