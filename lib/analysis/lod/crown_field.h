// crown_field: how much of a place inside a crown is seen from outside, and how far any place is from the
// foliage; on a grid.
//
// Foliage is taken as a cloudy medium: of what stands behind leaves of area A in a cross-section S, exp(-A /
// 2S) is seen (a leaf of any direction hides half of its area on average; Beer and Lambert's law). Leaves
// that no one sees can be merged without anyone seeing it, and a place that has no leaf near it must not get
// one.
#pragma once

#include "lib/analysis/lod/crown_hull.h"
#include "lib/formats/mesh.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace copse {

struct FoliageTriangle {
  std::array<Double3, 3> corners;
  double opacity = 1;  // share of its area that the alpha test lets through
};

class CrownField {
 public:
  // `cells`: along the longest side of the box, 1 to 256. `reach`: the hull's. Linear in triangles (those
  // larger than a cell count by the cells that they cross) and in cells.
  CrownField(std::span<const FoliageTriangle> triangles, int cells, double reach = 0);

  // The share of the directions of the sphere from which the middle of the cell at `p` is seen, (0, 1]; mean
  // over 26 directions. 1 outside of the grid.
  double exposure(const Double3& p) const;
  // What is known of the cell at a place.
  struct Place {
    // The share of the lines through it that meet no foliage anywhere: how much of what is put there covers
    // ground that nothing covered. 1 outside of the grid.
    float openness = 1;
    // How far it is from the nearest cell with foliage: 0 inside one, else the distance of the cells'
    // middles; grows on outside of the grid. Metres.
    float emptiness = 0;
  };
  Place at(const Double3& p) const;
  // The foliage's convex hull.
  const CrownHull& hull() const { return hull_; }
  // The mean over the three axes of the area of the crown's silhouette, to a cell.
  double cross_section() const { return cross_section_; }
  double cell() const { return cell_; }

 private:
  std::size_t index(int x, int y, int z) const {
    return (static_cast<std::size_t>(z) * size_[1] + y) * size_[0] + x;
  }
  std::array<int, 3> cell_of(const Double3& p, double& outside) const;
  void deposit(const FoliageTriangle& triangle);
  void see();
  void sweep(std::array<int, 3> step, std::vector<float>& depth) const;
  void measure_distances();
  void measure_cross_section();
  void find_outer_cells();
  void measure_hull(std::span<const FoliageTriangle> triangles, double reach);

  Double3 low_{};
  double cell_ = 1, per_cell_ = 1, cross_section_ = 0;
  std::array<int, 3> size_{1, 1, 1};
  std::vector<float>
      area_;  // of foliage in the cell, opaque part, in cell sides squared: of any size of tree
  std::vector<std::uint8_t> full_, outer_;
  std::vector<float> exposure_;
  std::vector<Place> places_;
  CrownHull hull_;
};

}  // namespace copse
