// segment_tree: which generalized cylinders a point lies in or near.
#pragma once

#include "lib/formats/vec.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

// A cone frustum with an axis from a to b, radii there, and the limb that it is part of.
struct Segment {
  Double3 a, b;
  double radius_a = 0, radius_b = 0;
  std::uint32_t limb = 0;
};

// Whether it lies more than it stands.
bool is_level(const Segment& segment);

// Where a point stands to a segment.
struct Nearness {
  std::uint32_t segment = 0;
  double t = 0;                                     // of the nearest point of the axis: 0 at a, 1 at b
  double distance = 0;                              // from the axis
  double radius = 0;                                // of the frustum there
  double gap() const { return distance - radius; }  // < 0 inside
};
Nearness nearness(std::span<const Segment> segments, std::uint32_t segment, const Double3& point);

// A bounding volume hierarchy over the axes. Building: O(n log n); a query: O(log n) and what it finds. Where
// axes lie across one another like straws in a heap, boxes over whole axes would tell nothing: there it is
// one over pieces of them.
class SegmentTree {
 public:
  explicit SegmentTree(std::vector<Segment> segments);

  std::span<const Segment> segments() const { return segments_; }
  void set_limb(std::uint32_t segment, std::uint32_t limb) { segments_[segment].limb = limb; }

  // The segments, at most one a limb, whose surface is not farther than `reach` from the point or that
  // contain it: by ascending distance from the axis in radii (never less than `least_radius`), ties by
  // descending radius, then by segment; no more than `count`. A distance that rounding may have made
  // (tolerances.h: k_rounding) is none. Segments of `except` do not count. `found` is overwritten. Returns at
  // how many pieces of axes it has looked.
  std::size_t near(const Double3& point, double reach, double least_radius, std::uint32_t except,
                   std::size_t count, std::vector<Nearness>& found) const;

  // The segment whose surface is nearest to the point, or contains it deepest, if its gap is at most `reach`;
  // false when there is none. Ties go to the lower segment.
  bool nearest(const Double3& point, double reach, std::uint32_t except, Nearness& found) const;

 private:
  struct Node {
    DoubleBox box;             // of the axes, or their pieces
    double radius = 0;         // the largest
    std::uint32_t lowest = 0;  // segment
    std::uint32_t first = 0;  // leaf: first of order_; inner: the right child (the left one follows the node)
    std::uint32_t count = 0;  // leaf: pieces; inner: 0
  };
  void build();
  void choose_pieces();
  DoubleBox box_of(std::uint32_t piece) const;
  Double3 middle_of(std::uint32_t piece) const;

  std::vector<Segment> segments_;
  double noise_ = 0;                  // of a distance
  std::uint32_t pieces_ = 1;          // of each axis, equally long
  std::vector<std::uint32_t> order_;  // pieces: piece p is of segment p / pieces_
  std::vector<Node> nodes_;
};

}  // namespace copse
