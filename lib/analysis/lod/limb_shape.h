// A limb as a tube with any number of rings and sides: what a generalized cylinder looks like when rings
// along its axis are left out and those that stay get fewer sides.
#pragma once

#include "lib/analysis/lod/limb_chains.h"
#include "lib/analysis/lod/spectrum_builder.h"
#include "lib/formats/levels/part_triangles.h"
#include "lib/formats/tree/tree.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace copse {

// One side of a ring as the mesh has it: the angles of its ends and their texture coordinates in one segment,
// those of a texture that repeats without a jump from one side to the next.
struct RingSide {
  double from = 0, to = 0;  // radians in the ring's frame, from < to <= from + 2 pi
  Float2 at_from, at_to;
};

struct RingShape {
  Double3 centre, x, y, axis;  // right-handed frame; the ring lies across the axis
  double radius = 0;           // mean, across the axis
  double perimeter = 0;        // of the polygon as seen along the axis, or of the circle where there is none
  double first = 0;         // mean angle of the vertices of its polygon, less their places in a regular one
  bool seam = false;        // the texture does not go on there: every ring that is made begins at `first`
  double residual = 0;      // rms distance of the ring's vertices from its polygon or circle
  std::uint32_t sides = 0;  // of the polygon; 0: a circle stands for it
};

// A corner of a ring's polygon.
struct RingCorner {
  double angle = 0;
  Double3 place;
};

// How far a regular polygon lies from the circle of its perimeter, rms, as a share of the radius.
constexpr double polygon_roughness(std::uint32_t sides) {
  return 1.7 / (static_cast<double>(sides) * sides);
}

class LimbShape {
 public:
  // `centres`: absolute_centres(tree); `trunk`: trunk_triangles(tree). They must outlive this.
  LimbShape(const Tree& tree, const std::vector<Double3>& centres, const PartTriangles& trunk,
            const LimbChain& limb);

  std::size_t ring_count() const { return rings_.size(); }
  const RingShape& ring(std::size_t i) const { return rings_[i]; }
  // Whether surfaces of several limbs begin at ring i.
  bool is_fork(std::size_t i) const;
  double length_between(std::size_t a, std::size_t b) const { return along_[b] - along_[a]; }
  // Whether the triangles of interval i (between rings i and i + 1) are a plain band, with at most a lid.
  bool regular(std::size_t i) const { return regular_[i]; }
  bool regular() const;
  // The most of any ring, 3 at least; 2 of a strip (two vertices a ring): its ribbon lies in its own plane,
  // is as wide as it is, and it never is a tube.
  std::uint32_t sides() const;
  // Whether the last ring is (nearly) a point, so that the last interval ends in a cone.
  bool pointed() const { return pointed_; }
  bool capped() const { return capped_; }
  std::uint32_t material(std::size_t interval) const;

  // How much more than its silhouette a square metre of what is as thick as ring i counts: the more surface
  // lies behind it, the more the mean distance of the surface suffers.
  double weight(std::size_t i) const;
  // Mean distance, times length and weight, between the tube that goes straight from ring a to ring b and the
  // rings that it leaves out, saturating at two diameters: square metres of silhouette. Looks at no more than
  // 16 of them.
  double area_error(std::size_t a, std::size_t b) const;
  // The same of the corners of the rings, which lie elsewhere when the mesh turns along the limb otherwise
  // than the tube: only as long as that has the rings' own corners.
  double turned_error(std::size_t a, std::size_t b) const;
  // The largest distance of the axis and thickness.
  double largest_error(std::size_t a, std::size_t b) const;
  // Of what hangs on the rings that it leaves out (`hanging`, one entry a ring, or none at all), how much is
  // on rings farther than `hold` metres from it. Looks at no more than 16 of them.
  double left_behind(std::size_t a, std::size_t b, std::span<const double> hanging, double hold) const;

  // Triangles of the tube through the kept rings (ascending, first and last among them): `sides` >= 3 is a
  // closed tube, 2 a flat ribbon.
  std::uint32_t triangles(std::size_t kept, std::uint32_t sides) const;

  // Of what a ring measures, how much the tube has that begins or ends there in interval `interval` (i or i -
  // 1): less than 1 where limbs that are welded together share a ring.
  double width(std::size_t i, std::size_t interval) const;

  // How much wider a tube through the kept rings (ascending, two at least) has to be to have the area of the
  // one through all: a chord is shorter than what is bent, and between its ends a twig may be thicker than
  // both say. In steps of 1/20.
  double wider(std::span<const std::uint32_t> kept) const;

  // Meshes turn along a limb, by up to a side from ring to ring. How many sides later than by itself ring b
  // begins so that the band from ring a, which begins by itself, is not twisted: of the two triangles of a
  // side the first is (low j, low j + 1, high j), so high j lies between the angles of low j and low j + 1.
  int turn(std::size_t a, std::size_t b, std::uint32_t sides) const;

  // Appends the vertices of ring i with so many sides, two at least, as they are in interval `interval` (i or
  // i - 1): sides + 1, the last one where the first one is; two of a ribbon. It begins `turned` sides later
  // than by itself. `wider`: times as wide.
  void append_ring(std::size_t i, std::size_t interval, std::uint32_t sides, int turned, double ribbon_angle,
                   double wider, std::vector<SpectrumVertex>& out) const;
  // The texture coordinate of vertex j of the same.
  Float2 ring_texcoord(std::size_t i, std::size_t interval, std::uint32_t sides, int turned,
                       double ribbon_angle, std::size_t j) const;
  // The limb as one triangle, as large as the ribbon straight from its first to its last ring (smaller for a
  // strip), its tip at the last.
  std::array<SpectrumVertex, 3> spike(double ribbon_angle) const;

 private:
  std::span<const RingCorner> polygon(std::size_t i) const {
    return std::span(corners_).subspan(first_corner_[i], rings_[i].sides);
  }
  std::span<const RingSide> sides_of(std::size_t interval, std::size_t end) const {
    const std::size_t list = 2 * interval + end;
    return std::span(sides_).subspan(first_side_[list], first_side_[list + 1] - first_side_[list]);
  }
  void make_frames(const std::vector<Double3>& centres);
  void read_ring(std::size_t i);
  void read_sides(std::size_t interval, std::array<std::vector<RingSide>, 2>& scratch);
  void narrow(std::size_t interval, double area);
  void fit_width(std::size_t interval, std::size_t end,
                 const std::vector<std::array<std::uint32_t, 2>>& loop);
  bool goes_flat() const;
  void read_strip(std::size_t interval, const std::array<std::vector<std::array<std::uint32_t, 2>>, 2>& edges,
                  bool plain);
  void unfold();
  std::array<std::uint32_t, 2> tip_of(std::size_t interval) const;
  void thin_out_radii();
  double girth(std::size_t a, std::size_t b) const;
  double area_of(const std::array<std::uint32_t, 3>& corners) const;
  void unwind(std::size_t interval, std::size_t end);
  void choose_first_vertices();
  double first_angle(std::size_t i, std::uint32_t sides) const;
  double vertex_angle(std::size_t i, std::uint32_t sides, int turned, std::size_t j) const;
  double angle(std::size_t i, const Double3& from_centre) const;
  Double3 sample(std::size_t i, double angle) const;
  Float2 texcoord(std::size_t i, std::size_t interval, double angle, double towards) const;
  void errors(std::size_t a, std::size_t b, double& area, double& largest) const;
  double turned_off(std::size_t a, std::size_t b, std::size_t i, double w) const;
  double off_chord(std::size_t a, std::size_t b, std::size_t i) const;

  const Tree& tree_;
  const PartTriangles& trunk_;
  const LimbChain& limb_;
  std::vector<RingShape> rings_;
  std::vector<double> along_;
  std::vector<RingCorner> corners_;           // of all polygons, each by ascending angle
  std::vector<std::uint32_t> first_corner_;   // of each ring
  std::vector<double> angles_;                // of all vectors of the rings
  std::vector<std::uint32_t> first_angle_;    // of each ring, and the end
  std::vector<RingSide> sides_;               // of every interval at its two rings, each by ascending angle
  std::vector<std::uint32_t> first_side_{0};  // two an interval, and the end
  std::vector<Float2> winding_;               // by how much their texture coordinates grow once round
  std::vector<std::array<Float2, 2>> any_texcoord_;  // of every interval, at its two rings
  std::vector<std::uint8_t> regular_;
  std::vector<std::array<double, 2>> width_;  // of every interval, at its two rings
  // Of every interval of a strip, the vertices of its two edges at its two rings.
  std::vector<std::array<std::array<std::uint32_t, 2>, 2>> strips_;
  double size_ = 0;   // of the tree
  double first_ = 0;  // angle at which rings begin, about
  bool pointed_ = false, capped_ = false, flat_ = false;
};

}  // namespace copse
