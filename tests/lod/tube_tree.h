// Trees for the tests of this room: tubes whose every ring is known.
#pragma once

#include "lib/analysis/tree/trunk_arrays.h"
#include "tests/tree/tube_fixture.h"

namespace copse {

inline Tree tree_of(Tube& tube) {
  if (tube.trunk.positions.empty()) tube.finish();
  TrunkArrays arrays = make_trunk_arrays(tube.mesh, tube.trunk, tube.hierarchy, TreeKind::sensitive, {}, {});
  Tree tree;
  tree.header.kind = TreeKind::sensitive;
  tree.header.roots = arrays.roots;
  tree.header.ring_size = arrays.ring_size;
  tree.header.segment_factor = arrays.segment_factor;
  tree.header.bounds = tree.header.trunk_bounds = arrays.bounds;
  tree.trunk = std::move(arrays.trunk);
  tree.hierarchy = std::move(arrays.hierarchy);
  return tree;
}

// A straight stem of `rings` rings of `sides` vertices, radius 0.5, one metre apart; and `twigs` thin twigs
// of two rings that hang on its rings as free tubes (joints), three sides, radius 0.05, half a metre long.
inline Tree stem_with_twigs(int rings, int sides, int twigs) {
  Tube tube;
  std::vector<std::uint32_t> stem;
  for (int i = 0; i < rings; ++i)
    stem.push_back(tube.add_ring({0, static_cast<double>(i), 0}, 0.5, sides, i == 0 ? k_none : stem.back()));
  for (int i = 0; i < twigs; ++i) {
    const auto from = stem[static_cast<std::size_t>(1 + i % (rings - 1))];
    const Double3 at = tube.hierarchy.radii[from].centre + Double3{0.4, 0.1 * (i / rings), 0};
    const auto base = tube.add_ring(at, 0.05, 3, from, true);
    tube.add_ring(at + Double3{0, 0.5, 0}, 0.05, 3, base);
  }
  return tree_of(tube);
}

}  // namespace copse
