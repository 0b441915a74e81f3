#include "lib/analysis/trunk/join.h"

#include "lib/analysis/rings/taper.h"
#include "lib/analysis/surface/components.h"
#include "lib/analysis/surface/tolerances.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace copse {
namespace {

// A limb amid which others begin is so many times as thick as they are, and they so near to its axis, radii;
// the lesser where they go on from one another in one line, as pieces of a tube do.
constexpr double k_amid_thicker = 1.25, k_amid_axis = 0.25, k_amid_axis_straight = 0.01;

std::vector<std::array<std::uint32_t, 2>> segment_rings(const Limbs& limbs) {
  std::vector<std::array<std::uint32_t, 2>> rings;
  std::vector<std::uint8_t> has_child(limbs.rings(), 0);
  for (std::uint32_t r = 0; r < limbs.rings(); ++r) {
    if (limbs.parent[r] != k_none) has_child[limbs.parent[r]] = 1;
  }
  for (std::uint32_t r = 0; r < limbs.rings(); ++r) {
    if (limbs.parent[r] != k_none) {
      rings.push_back({limbs.parent[r], r});
    } else if (!has_child[r]) {
      rings.push_back({r, r});
    }
  }
  return rings;
}

SegmentTree make_tree(const Limbs& limbs, std::span<const std::array<std::uint32_t, 2>> rings) {
  std::vector<Segment> segments;
  segments.reserve(rings.size());
  for (const auto& [a, b] : rings) {
    segments.push_back(
        {limbs.centre[a], limbs.centre[b], limbs.diameter[a] / 2, limbs.diameter[b] / 2, limbs.limb[a]});
  }
  return SegmentTree(std::move(segments));
}

// How far apart rings of a radius may be that go on from one another, where the rings of all limbs take up
// `size`: what was computed twice, or rounded, is apart by a share of the whole, however thin the twig, but
// never by much of an edge.
double seam_reach(double radius, double size) {
  return std::max(k_join_tolerance * radius, std::min(k_weld_of_edge * radius, 2 * k_rounding * size));
}

bool coincide(const Limbs& limbs, std::uint32_t a, std::uint32_t b, double apart, double reach) {
  return distance(limbs.centre[a], limbs.centre[b]) <= apart &&
         std::abs(limbs.diameter[a] - limbs.diameter[b]) <= 2 * reach;
}

// The ring next to an end.
std::vector<std::uint32_t> next_rings(const Limbs& limbs) {
  std::vector<std::uint32_t> next(limbs.rings(), k_none);
  for (std::uint32_t r = 0; r < limbs.rings(); ++r) {
    if (limbs.parent[r] == k_none) continue;
    next[r] = limbs.parent[r];
    next[limbs.parent[r]] = r;
  }
  return next;
}

// Whether two rings lie in one plane, as far as their planes are known.
bool lie_alike(const Limbs& limbs, std::uint32_t a, std::uint32_t b) {
  const double cosine = std::abs(dot(limbs.normal[a], limbs.normal[b]));
  return cosine >= k_one_plane || length(limbs.normal[a]) == 0 || length(limbs.normal[b]) == 0;
}

// Whether a tube that ends in ring `a` may go on from ring `b`, as tubes laid end to end do: where that is an
// end, too, they lead away from their plane to its two sides (limbs that begin beside one another both lead
// to one); where a branch begins there, the rings are of one make.
bool go_on(const Limbs& limbs, std::span<const std::uint32_t> next, std::uint32_t a, std::uint32_t b,
           bool is_end) {
  if (!lie_alike(limbs, a, b) || length(limbs.normal[a]) == 0) return false;
  if (!is_end) return limbs.ring(a).size() == limbs.ring(b).size();
  if (next[a] == k_none || next[b] == k_none) return false;
  const double on_a = dot(limbs.normal[a], limbs.centre[next[a]] - limbs.centre[a]);
  const double on_b = dot(limbs.normal[a], limbs.centre[next[b]] - limbs.centre[b]);
  return on_a * on_b < 0;
}

// Whether two limbs that end in one place would be one that turns back: then they begin there side by side.
bool fold(const Limbs& limbs, std::span<const std::uint32_t> next, std::uint32_t a, std::uint32_t b) {
  if (next[a] == k_none || next[b] == k_none) return false;
  return dot(limbs.centre[next[a]] - limbs.centre[a], limbs.centre[next[b]] - limbs.centre[b]) > 0;
}

// Whether limbs that end in one place begin amid a third one, about its axis, as opposite twigs of a bough
// do. `found`: what is near to that place.
bool begin_amid(const LimbSegments& segments, std::span<const Nearness> found, double radius,
                std::uint32_t limb, std::span<const std::uint8_t> is_end, bool straight) {
  const double from_axis = straight ? k_amid_axis_straight : k_amid_axis;
  return std::any_of(found.begin(), found.end(), [&](const Nearness& near) {
    if (segments.tree.segments()[near.segment].limb == limb) return false;
    const auto& [a, b] = segments.rings[near.segment];
    if ((near.t <= 0 && is_end[a] != 0) || (near.t >= 1 && is_end[b] != 0)) return false;
    return near.radius > k_amid_thicker * radius && near.distance <= from_axis * near.radius;
  });
}

// The ends at which their limbs clearly begin: no other end may be the base.
std::vector<std::uint8_t> clear_starts(const Limbs& limbs, std::span<const std::uint32_t> ends) {
  std::vector<std::uint8_t> is_start = possible_bases(limbs, ends);
  std::vector<std::uint32_t> possible(limbs.size, 0);
  for (const std::uint32_t e : ends) possible[limbs.limb[e]] += is_start[e];
  for (const std::uint32_t e : ends) {
    if (possible[limbs.limb[e]] > 1) is_start[e] = 0;
  }
  return is_start;
}

// Limbs as they grow together: which are one, and how large they are.
class Joints {
 public:
  explicit Joints(Limbs& limbs) : limbs_(limbs), sets_(limbs.size), rings_(limbs.size, 0) {
    for (const std::uint32_t l : limbs.limb) ++rings_[l];
  }

  std::uint32_t find(std::uint32_t limb) { return sets_.find(limb); }

  // The smaller limb is the one that is turned round: O(n log n) in all.
  void merge(std::uint32_t a, std::uint32_t b) {
    a = limbs_.alive(a), b = limbs_.alive(b);
    const std::uint32_t limb_a = find(limbs_.limb[a]), limb_b = find(limbs_.limb[b]);
    if (limb_a == limb_b) return;
    if (rings_[limb_a] > rings_[limb_b] || (rings_[limb_a] == rings_[limb_b] && a < b)) std::swap(a, b);
    take_lesser(a, b);
    merge_rings(limbs_, a, b);
    sets_.unite(limb_a, limb_b);
    rings_[find(limb_a)] = rings_[limb_a] + rings_[limb_b];
  }

 private:
  // The two differ by rounding, or as polygons of one circle do. Which of them stays must not depend on the
  // order of the file: the lesser by position.
  void take_lesser(std::uint32_t from, std::uint32_t ring) {
    const auto key = [&](std::uint32_t r) {
      const Double3& c = limbs_.centre[r];
      return std::tuple(c.x, c.y, c.z, limbs_.diameter[r]);
    };
    if (key(ring) <= key(from)) return;
    limbs_.centre[ring] = limbs_.centre[from];
    limbs_.diameter[ring] = limbs_.diameter[from];
  }

  Limbs& limbs_;
  UnionFind sets_;
  std::vector<std::uint32_t> rings_;
};

}  // namespace

LimbSegments::LimbSegments(const Limbs& limbs) : rings(segment_rings(limbs)), tree(make_tree(limbs, rings)) {}

void join(Limbs& limbs, LimbSegments& segments) {
  Joints joints(limbs);
  DoubleBox box;
  for (const Double3& c : limbs.centre) box.grow(c);
  const double size = length(box.extent());
  const std::vector<std::uint32_t> next = next_rings(limbs);
  std::vector<Nearness> found;
  const std::vector<std::uint32_t> ends = end_rings(limbs);
  const std::vector<std::uint8_t> is_start = clear_starts(limbs, ends);
  std::vector<std::uint8_t> is_end(limbs.rings(), 0);
  for (const std::uint32_t end : ends) is_end[end] = 1;
  for (const std::uint32_t end : ends) {
    const double radius = limbs.diameter[end] / 2;
    if (radius <= 0) continue;
    const double seam = seam_reach(radius, size), facing = std::max(seam, k_join_facing * radius);
    segments.tree.near(limbs.centre[end], facing, radius, limbs.limb[end], k_candidates, found);
    for (const Nearness& near : found) {
      for (const std::uint32_t ring : segments.rings[near.segment]) {
        // A limb that begins amid another one, at an angle, is a branch of it, however thick.
        if (!is_end[ring] && !lie_alike(limbs, end, ring)) continue;
        // Two limbs that begin in one place are siblings, and grow side by side from something else.
        if (is_start[end] && is_start[ring]) continue;
        const bool wide = go_on(limbs, next, end, ring, is_end[ring] != 0);
        if (is_end[ring] && (fold(limbs, next, end, ring) ||
                             begin_amid(segments, found, radius, limbs.limb[ring], is_end, wide)))
          continue;
        const double thick = std::max(limbs.diameter[end], limbs.diameter[ring]) / 2;
        const double reach = wide ? seam : k_join_tolerance * thick;
        const double apart = wide && is_end[ring] ? facing : reach;
        if (coincide(limbs, end, ring, apart, reach)) joints.merge(end, ring);
      }
    }
  }
  for (std::uint32_t& limb : limbs.limb) limb = joints.find(limb);
  for (std::uint32_t s = 0; s < segments.rings.size(); ++s) {
    segments.tree.set_limb(s, limbs.limb[segments.rings[s][0]]);
  }
}

}  // namespace copse
