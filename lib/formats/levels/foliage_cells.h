// Foliage pruning as a file holds it: cells, the order of their leaves, and how much of each cell is seen
// from where (digest 001, sections 3, 4, 5). What a runtime makes of it says section 6: a cell shows the
// first m of its leaves, enlarged.
#pragma once

#include "lib/formats/array.h"
#include "lib/formats/container/container.h"
#include "lib/formats/result.h"
#include "lib/formats/tree_file/tree_file.h"
#include "lib/formats/volumes/volume.h"

#include <array>
#include <cstdint>

namespace copse {

struct FoliageCell {
  OrientedBox<float> box;   // every vertex of its leaves is inside, relative to the tree's origin
  std::uint32_t first = 0;  // its leaves are order[first .. first + count): the first ones stay the longest
  std::uint32_t count = 0;
  friend bool operator==(const FoliageCell&, const FoliageCell&) = default;
};
static_assert(sizeof(FoliageCell) == 68);

// Pixels of a cell from one view: how sure the share visible / total is grows with total. total = 0: nothing
// of it can be seen from there, and the share counts as 0.
struct CellVisibility {
  std::uint32_t visible = 0, total = 0;
  double share() const { return total > 0 ? double(visible) / total : 0; }
  friend bool operator==(const CellVisibility&, const CellVisibility&) = default;
};

// Everything that a runtime needs beside the cells, so that it does what the baker meant (erratum P19).
struct FoliageParameters {
  enum class Distance : std::uint32_t { cell = 0, tree = 1 };           // erratum P10
  enum class Compensation : std::uint32_t { distance = 0, total = 1 };  // erratum P5
  enum class Anchor : std::uint32_t { centre = 0 };  // about which leaves grow: a card tells no petiole
  // How much is left at a distance: `linear`: full up to near, `least` from far on, straight between (what
  // the paper built); `power`: equation 1, distance^(-log_h 2) with distances in units of near (erratum P2).
  enum class Ramp : std::uint32_t { linear = 0, power = 1 };
  float near = 0, far = 0;  // full detail up to near, least from far on; metres, near <= far
  float least = 0.05f;      // fraction of the leaves beyond far, 0 to 1
  float half_distance = 2;  // h of equation 1, > 1: the multiple of `near` at which half of the leaves remain
  float largest_enlargement = 16;  // of a leaf's area, >= 1
  Distance distance = Distance::cell;
  Compensation compensation = Compensation::distance;
  Anchor anchor = Anchor::centre;
  std::uint32_t resolution = 0;  // pixels of a view's side at which visibility was counted
  Ramp ramp = Ramp::linear;
  std::uint64_t seed = 0;
  std::uint64_t leaves = 0;  // hash of the leaf vertices that this was made from (hazard N21)
  friend bool operator==(const FoliageParameters&, const FoliageParameters&) = default;
};
static_assert(sizeof(FoliageParameters) == 56);

struct FoliageCells {
  Array<FoliageCell> cells;
  Array<std::uint32_t> order;                          // a permutation of the leaves, cell after cell
  Array<Float3> views;                                 // unit, toward the viewer
  Array<std::array<std::uint32_t, 3>> view_triangles;  // of views, covering the sphere
  Array<CellVisibility> visibility;                    // cells x views, cell after cell
  FoliageParameters parameters;

  CellVisibility at(std::size_t cell, std::size_t view) const {
    return visibility[cell * views.size() + view];
  }
};

// A leaf set's hash: what FoliageParameters::leaves must be for the tree that the cells are used with.
std::uint64_t hash_leaves(const Tree& tree);

// Sections FCEL, FORD, FVWS, FVTR, FVIS, FPAR (docs/formats.md).
Result<void> put_foliage_cells(ContainerWriter& writer, const FoliageCells& foliage);
// Checked: sizes, that cells tile the order, that the order is a permutation, that views are unit vectors,
// counts and parameters are in range. `leaves`: of the tree. Nothing when the file has no such sections.
Result<FoliageCells> read_foliage_cells(const TreeFile& file);
// What is wrong with it; empty when it is sound.
std::string check_foliage_cells(const FoliageCells& foliage, std::uint64_t leaves);

}  // namespace copse
