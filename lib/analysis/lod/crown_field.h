// crown_field: how much of a place inside a crown is seen from outside, and how far any place is from the
// foliage; on a grid.
//
// Foliage is taken as a cloudy medium: of what stands behind leaves of area A in a cross-section S, exp(-A /
// 2S) is seen (a leaf of any direction hides half of its area on average; Beer and Lambert's law). Leaves
// that no one sees can be merged without anyone seeing it, and a place that has no leaf near it must not get
// one.
#pragma once

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
  // `cells`: along the longest side of the box, 1 to 256. Linear in triangles (those larger than a cell count
  // by the cells that they cross) and in cells.
  CrownField(std::span<const FoliageTriangle> triangles, int cells);

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
  // Whether it is in a cell with foliage that has others before and behind it along all axes: no such place
  // is out of the foliage's hull.
  bool surrounded(const Double3& p) const;
  // The shortest move, found direction by direction, that brings the points back to within `margin` of the
  // foliage's convex hull, as far as 642 directions know it. Zero when they are there.
  Double3 way_back(std::span<const Double3> points, double margin) const;
  // How far the points reach out of that hull, metres; 0 inside.
  double excess(std::span<const Double3> points) const;
  double width() const {
    return width_;
  }  // of the foliage, the largest over those directions; < 0: there is none
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
  // A hull is known along 642 directions: two along each of these.
  static constexpr std::size_t k_axes = 321;
  // How far out the farthest of some points are beyond the hull, in widths: along an axis, and against it.
  struct Reach {
    std::array<float, k_axes> along, against;
    float most = 0;
    std::size_t axis = 0;
    float sign = 1;  // of the direction of the most
  };
  void reach_of(std::span<const Double3> points, Reach& reach) const;
  static void find_most(Reach& reach);
  double per_width() const;  // 1 where it has none
  void measure_hull(std::span<const FoliageTriangle> triangles);

  Double3 low_{};
  double cell_ = 1, per_cell_ = 1, cross_section_ = 0, width_ = 0;
  std::array<int, 3> size_{1, 1, 1};
  std::vector<float>
      area_;  // of foliage in the cell, opaque part, in cell sides squared: of any size of tree
  std::vector<std::uint8_t> full_, outer_;
  std::vector<float> exposure_;
  std::vector<Place> places_;
  std::array<std::array<float, k_axes>, 3> axes_{};  // coordinates
  std::array<float, k_axes> highest_{}, lowest_{};   // of the foliage along each axis, widths from low_
};

}  // namespace copse
