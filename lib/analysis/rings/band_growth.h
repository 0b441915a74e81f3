// band_growth: reads bands one after the other, from the ends of a surface inward.
//
// A front is a border of the part that is not yet read. The triangles that touch it form its next band
// exactly when they make a closed strip whose far side is again a simple cycle. On a tube of rings that is
// always so, however its quads are cut and however they are twisted; at a fork it is not, so a front waits
// there until the fronts of the other limbs have arrived: what is then left of their borders is the ring that
// the limbs grow from. (The thesis, digest 000 section 1.3, walks up from the root, where a fork whose rings
// share vertices cannot be told from one wide ring; walking down from the tips, it can.)
#pragma once

#include "lib/analysis/rings/limb_ends.h"
#include "lib/analysis/rings/patched_surface.h"
#include "lib/analysis/surface/bands.h"
#include "lib/analysis/surface/surface.h"

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <queue>
#include <span>
#include <utility>
#include <vector>

namespace copse {

class BandGrowth {
 public:
  // Both must outlive this; `bands.band_of` has one entry a triangle.
  BandGrowth(const Surface& surface, Bands& bands);

  // Fronts: the borders of the surface, and the rings round pointed ends (cones steeper than
  // k_point_angle, and blunter ones behind which two more rings of the same size follow).
  void start_at_borders();
  // A sharp vertex may be a bend of a thin limb: those that rings follow first. One ring behind it does for a
  // blunt vertex only where that is asked for.
  enum class Points : std::uint8_t { followed_by_rings, all, followed_by_a_ring };
  void start_at_points(Points which);
  // Fronts: the rims of lids (lids.h, with its `smooth`) behind which so many rings of the same size follow;
  // of any shape, or those that are about as round as a regular polygon.
  using Lids = LimbEnds::Lids;
  void start_at_lids(double smooth, int rings, Lids which);
  // Lids that limbs grow out of the band behind: closes the limbs' holes as read_past_limbs() does, and takes
  // the patch for a lid only where the band is then one.
  void start_at_lids_beside_limbs(double smooth);
  // Takes for lids, flat or not, the discs without inner vertices that one ring of a band encloses.
  void close_rings();
  // Reads fans round a vertex of which half or more is bordered by one band: blunt points, and caps.
  void close_fans();
  // Fronts: the rings of bands first .. count() - 1, which another method has found.
  void start_at_bands(std::uint32_t first);

  // Reads every band that keeps the number of vertices from ring to ring; then, if `change` says so, also
  // those that change it, or start from a front that is longer than the rings that led to it, on a cone of at
  // most 45 degrees: those that change it least first.
  void run(bool change);

  // Where limbs were cut into the strip beyond a ring: closes their holes with triangles that stand for the
  // missing surface wherever the strip is then a band that keeps the number of vertices, and reads on.
  // Topology alone decides: what does not fit stays as it was.
  void read_past_limbs();

  // Closes the holes that are left where limbs were cut into others, the least open and small ones first,
  // and reads on from there. Fits or not, by shape.
  void fill_collars();

 private:
  // An edge a -> b of a triangle that is not read; its other side is read or a border. `limit`: a front that
  // is longer is not walked to its end. It grows with the ring that led here, which keeps the whole linear.
  struct Edge {
    std::uint32_t triangle = 0, a = 0, b = 0;
    std::size_t limit = 0;
  };
  // The front through an edge, and what touches it.
  struct Step {
    std::vector<std::uint32_t> ring, next, triangles;
    std::vector<Edge> near;  // the edges of `ring` with their triangles
    std::vector<Edge> far;   // the edges of `next` with their triangles, far[i] from next[i] on
    bool corner = false;     // a triangle lies in a corner of the front: no strip
  };
  struct Parked {
    double change = 0;
    std::uint32_t serial = 0;
    Edge edge;
    bool operator>(const Parked& o) const {
      return change != o.change ? change > o.change : serial > o.serial;
    }
  };
  struct Fan {
    std::vector<std::uint32_t> link, triangles;
    double angle = 0;
  };

  bool unread(std::uint32_t t) const { return t != k_none && claimed_[t] == 0; }
  const Triangle& triangle(std::uint32_t t) const { return patched_.triangle(t); }
  std::uint32_t beyond(std::uint32_t t, std::uint32_t a, std::uint32_t b) const {
    return patched_.beyond(t, a, b);
  }
  void push(std::uint32_t read_triangle, std::uint32_t a, std::uint32_t b, std::size_t limit);
  bool walk(const Edge& start);
  bool is_strip();
  bool is_simple(std::span<const std::uint32_t> ring);
  bool is_expected() const;
  bool is_gentle() const;
  void claim(std::span<const std::uint32_t> ring, std::span<const std::uint32_t> next,
             std::span<const std::uint32_t> triangles);
  void commit();
  void read_regular();
  bool collect_fan(std::uint32_t v, std::uint32_t t, Fan& fan);
  bool is_point(std::uint32_t v, const Fan& fan, Points which);
  void read_fan(std::uint32_t v, const Fan& fan);
  bool is_unread(const Lid& lid) const;
  std::uint32_t close_with_lid(const Lid& lid);
  void open_again();
  void push_rim(const Lid& lid);
  std::vector<std::uint32_t> first_unread() const;
  bool continues_behind(const Fan& fan, int rings);
  // A side of a ring: inside, its band.
  using Side = PatchedSurface::Side;
  // Bands and lids are numbered together, and so are their rings: 2b and 2b + 1, of a lid only 2b.
  static constexpr std::uint32_t k_first_lid = 1u << 30;
  static constexpr bool is_band(std::uint32_t number) { return number < k_first_lid; }
  std::span<const std::uint32_t> polygon_of(std::uint32_t ring) const;
  std::vector<std::uint32_t> triangles_of(std::uint32_t band) const;
  std::vector<Side> sides_of(std::uint32_t ring) const;
  double open_share(std::uint32_t ring);
  void stand_in(std::span<const Side> hole, std::span<const Triangle> triangles);
  void take_back(std::span<const Side> hole);
  void fill(std::uint32_t ring);
  bool borders_unread(std::uint32_t band) const;
  std::vector<std::uint32_t> limbs_beyond(std::span<const Side> sides) const;
  bool close_strip(std::uint32_t ring, std::uint32_t band);
  bool close_strip_at_border(std::span<const Side> sides, std::uint32_t ring);
  bool read_from_border(const Side& border, std::uint32_t first_stand_in, std::size_t k);
  bool read_past_limb_at_border(std::uint32_t ring, std::span<const Side> sides);
  void read_past_limbs_at_borders();
  bool runs_along(std::uint32_t band) const;
  bool read_past_limbs(std::uint32_t ring, std::size_t most);
  void read_past_limbs_from(std::uint32_t first);
  void read_past_limbs_of(std::size_t most, std::uint32_t first);

  const Surface& surface_;
  Bands& bands_;
  PatchedSurface patched_;
  LimbEnds ends_;
  std::vector<Lid> closing_;  // what was taken for lids
  // One a triangle of the patched surface: its band or lid, k_none for what is not read and for lids that
  // another growth has found.
  std::vector<std::uint32_t> band_of_;
  std::map<std::uint32_t, std::vector<std::uint32_t>> stand_ins_of_;  // of bands that have some
  std::vector<std::uint8_t> claimed_;
  std::vector<std::uint32_t> seen_;    // one an edge of each triangle: the walk that last passed it
  std::vector<std::uint32_t> mark_;    // one a vertex
  std::vector<std::uint32_t> degree_;  // one a vertex: triangles that meet there
  std::uint32_t walks_ = 0, committed_at_ = 0, stamp_ = 0, serial_ = 0;
  std::deque<Edge> queue_;
  std::priority_queue<Parked, std::vector<Parked>, std::greater<>> parked_;
  Step step_;
};

}  // namespace copse
