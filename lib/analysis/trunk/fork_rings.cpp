#include "lib/analysis/trunk/fork_rings.h"

#include "lib/analysis/trunk/band_growth.h"
#include "lib/analysis/trunk/quads.h"
#include "lib/analysis/trunk/ring_graph.h"
#include "lib/analysis/trunk/ring_walk.h"
#include "lib/analysis/trunk/welded_tolerances.h"

#include <utility>

namespace copse {

namespace {

Bands read_bands(const Surface& surface, bool in_order) {
  Bands bands;
  bands.band_of.assign(surface.triangles.size(), k_none);
  {
    BandGrowth growth(surface, bands);
    growth.start_at_borders();
    growth.start_at_points();
    growth.run(false);
  }
  if (bands.triangles.size() < surface.triangles.size()) {
    add_quad_bands(surface, pair_quads(surface, bands.band_of, in_order), bands);
    BandGrowth growth(surface, bands);
    growth.start_at_bands(0);
    growth.run(false);
    growth.fill_collars();
    growth.close_fans();
    growth.start_at_borders();
    growth.run(true);
  }
  return bands;
}

}  // namespace

Bands read_bands(const Surface& surface) {
  Bands bands = read_bands(surface, true);
  const auto enough = k_enough_bands * static_cast<double>(surface.triangles.size());
  if (static_cast<double>(bands.triangles.size()) < enough) {
    Bands by_shape = read_bands(surface, false);
    if (by_shape.triangles.size() > bands.triangles.size()) bands = std::move(by_shape);
  }
  return bands;
}

RingReading read_fork_rings(const Surface& surface) {
  if (surface.triangles.empty()) return {};
  const Bands bands = read_bands(surface);
  return {walk_rings(surface, bands, make_ring_graph(surface, bands)),
          static_cast<double>(bands.triangles.size()) / static_cast<double>(surface.triangles.size())};
}

}  // namespace copse
