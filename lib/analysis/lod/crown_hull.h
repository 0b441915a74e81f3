// crown_hull: the convex hull of a crown as its supports in 642 directions, to tell what reaches out of it
// and to bring that back.
//
// Asked of every leaf that grows, most of which are well inside: what is inside is known for straight rows
// through the hull, and as it is convex, for all that lies between four of them.
#pragma once

#include "lib/formats/vec.h"

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace copse {

class CrownHull {
 public:
  CrownHull() = default;  // of nothing: nothing is out of it
  // `reach`: how far out of it is always allowed, as a share of its width. Linear in the points.
  explicit CrownHull(std::span<const Double3> points, double reach = 0);

  // The largest over those directions; < 0: there is nothing.
  double width() const { return width_; }
  // Whether the points reach no farther out than `out`, a share of the width, not below the constructor's
  // `reach`; quick for those that do not reach farther than that.
  bool fits(std::span<const Double3> points, double out) const;
  // The move, none for most that are inside, after which the points fit: to within `target` of the hull, a
  // share of its width, as in way_back(). Nothing where none is found or, as the points are too far apart,
  // none can be.
  std::optional<Double3> move_in(std::span<const Double3> points, double out, double target) const;
  // How far the points reach out, metres; 0 inside.
  double excess(std::span<const Double3> points) const;
  // The shortest move, found direction by direction, that brings the points back to within `margin`, metres,
  // as far as 642 directions know it. Zero when they are there.
  Double3 way_back(std::span<const Double3> points, double margin) const;

 private:
  // Two directions along each of these; four axes side by side, the last ones empty.
  static constexpr std::size_t k_axes = 321, k_fours = (k_axes + 3) / 4;
  using Four [[gnu::vector_size(16)]] = float;
  using Fours = std::array<Four, k_fours>;
  // How far out the farthest of some points are, in widths: along an axis, and against it.
  struct Reach {
    Fours along, against;
    float most = 0;
    std::size_t axis = 0;
    float sign = 1;  // of the direction of the most
  };
  // From where to where in X a row is inside, widths from low_.
  struct Row {
    float first = 1, last = 0;
  };
  Row row_at(float y, float z) const;
  void reach_of(std::span<const Double3> points, Reach& reach) const;
  static void find_most(Reach& reach);
  Double3 moved_back(Reach& reach, double margin) const;
  bool within_rows(std::span<const Double3> points) const;
  double per_width() const { return width_ > 0 ? 1 / width_ : 1; }
  void measure(std::span<const Double3> points);
  void measure_rows();

  double width_ = -1, reach_ = 0;
  Double3 low_{};
  std::array<Fours, 3> axes_{};          // coordinates
  Fours highest_{}, lowest_{};           // along each axis, widths from low_
  int rows_a_side_ = 0;                  // along Y and Z
  float per_row_y_ = 0, per_row_z_ = 0;  // rows a width
  // Of the rows between which y and z are: where all of them are inside.
  std::vector<Row> rows_;
};

}  // namespace copse
