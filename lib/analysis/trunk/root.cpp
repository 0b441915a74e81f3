#include "lib/analysis/trunk/root.h"

#include "lib/analysis/rings/taper.h"
#include "lib/analysis/surface/lists.h"
#include "lib/analysis/surface/tolerances.h"

#include <algorithm>
#include <functional>
#include <limits>
#include <tuple>

namespace copse {
namespace {

// How deep an end lies in another limb, in radii of that limb from its axis; infinite in the open. Where it
// meets an end at which the other limb may begin, both could begin there: that says nothing.
class Contact {
 public:
  // `possible`: of each ring whether it is an end at which its limb may begin (taper.h).
  Contact(const Limbs& limbs, const LimbSegments& segments, std::span<const std::uint32_t> ends,
          std::span<const std::uint8_t> possible)
      : limbs_(limbs),
        segments_(segments),
        is_end_(limbs.rings(), 0),
        is_possible_(possible.begin(), possible.end()) {
    for (const std::uint32_t e : ends) is_end_[e] = 1;
  }

  double operator()(std::uint32_t end) {
    const double radius = limbs_.diameter[end] / 2;
    segments_.tree.near(limbs_.centre[end], k_contact_reach * radius, radius / 2, limbs_.limb[end],
                        k_candidates, found_);
    for (const Nearness& near : found_) {
      if (!meets_base(near, end)) return near.distance / std::max(near.radius, radius / 2);
    }
    return std::numeric_limits<double>::infinity();
  }

  // Whether an end lies in a limb that lies itself, and not at an end of that.
  bool lies_in_log(std::uint32_t end) {
    segments_.tree.near(limbs_.centre[end], 0, 0, limbs_.limb[end], k_candidates, found_);
    return std::ranges::any_of(found_, [&](const Nearness& near) {
      return is_level(segments_.tree.segments()[near.segment]) && near.gap() < 0 && !meets_end(near, end);
    });
  }

  // Whether something holds a limb by this end: what it lies in or against, or what it floats a little above.
  // It is not much thinner: a branch that begins at the top of a trunk does not hold the trunk. In its middle
  // or at its tip it may be thinner, as it does not begin there.
  bool holds(std::uint32_t end, double reach) {
    const double radius = limbs_.diameter[end] / 2;
    const auto is_holder = [&](const Nearness& near) {
      const std::uint32_t ring = limbs_.alive(segments_.rings[near.segment][0]);
      const double thinner = meets_base(near, end) ? k_thicker_child : k_thinner_holder;
      return !limbs_.plate(limbs_.limb[ring]) && near.radius * thinner >= radius;
    };
    segments_.tree.near(limbs_.centre[end], k_contact_reach * radius, radius / 2, limbs_.limb[end],
                        k_candidates, found_);
    if (!found_.empty()) return std::ranges::any_of(found_, is_holder);
    Nearness near;
    return segments_.tree.nearest(limbs_.centre[end], k_float_gap * reach, limbs_.limb[end], near) &&
           is_holder(near);
  }

 private:
  // Whether what an end is near to is an end, too.
  bool meets_end(const Nearness& near, std::uint32_t end) const {
    const std::uint32_t ring = limbs_.alive(segments_.rings[near.segment][near.t < 0.5 ? 0 : 1]);
    const double radius = std::max(limbs_.diameter[end], limbs_.diameter[ring]) / 2;
    return is_end_[ring] && distance(limbs_.centre[ring], limbs_.centre[end]) <= radius;
  }

  // The same of an end at which that limb may begin.
  bool meets_base(const Nearness& near, std::uint32_t end) const {
    return is_possible_[limbs_.alive(segments_.rings[near.segment][near.t < 0.5 ? 0 : 1])] &&
           meets_end(near, end);
  }

  const Limbs& limbs_;
  const LimbSegments& segments_;
  std::vector<std::uint8_t> is_end_, is_possible_;
  std::vector<Nearness> found_;
};

}  // namespace

Ground::Ground(const Limbs& limbs, const LimbSegments& segments, std::span<const Double3> positions)
    : below_(limbs.rings(), 0), floor_(limbs.rings(), 0) {
  DoubleBox box;
  for (const std::uint32_t v : limbs.vertices) box.grow(positions[v]);
  const double height = box.extent().y;
  bool any_below = false;
  if (!box.empty() && -box.min.y <= k_ground_depth * height) {
    for (std::uint32_t r = 0; r < limbs.rings(); ++r) {
      below_[r] = !limbs.ring(r).empty() &&
                  std::ranges::all_of(limbs.ring(r), [&](std::uint32_t v) { return positions[v].y < 0; });
      any_below |= below_[r] != 0;
    }
  }
  overhead_ = !box.empty() && box.max.y <= k_ground_depth * height && box.min.y < -k_ground_depth * height;
  if (!any_below) find_floor(limbs, segments, height);
}

void Ground::find_floor(const Limbs& limbs, const LimbSegments& segments, double height) {
  double lowest = std::numeric_limits<double>::infinity();
  for (const Double3& c : limbs.centre) lowest = std::min(lowest, c.y);
  std::vector<std::uint32_t> standing;
  const std::vector<std::uint32_t> ends = end_rings(limbs);
  for (const std::uint32_t e : ends) {
    const double level = std::min(k_same_level * height, k_ground_level * limbs.diameter[e] / 2);
    if (limbs.centre[e].y - lowest <= level) standing.push_back(e);
  }
  Contact contact(limbs, segments, ends, possible_bases(limbs, ends));
  std::erase_if(standing, [&](std::uint32_t e) { return contact.lies_in_log(e); });
  const bool several = std::ranges::any_of(
      standing, [&](std::uint32_t e) { return limbs.limb[e] != limbs.limb[standing.front()]; });
  if (!several) return;
  for (const std::uint32_t e : standing) floor_[e] = 1;
}

namespace {

// Chooses among the ends of one limb.
class BaseChooser {
 public:
  BaseChooser(const Limbs& limbs, const LimbSegments& segments, const Ground& ground)
      : limbs_(limbs),
        ground_(ground),
        ends_(end_rings(limbs)),
        possible_(possible_bases(limbs, ends_)),
        thickness_(end_thickness(limbs, ends_)),
        contact_(limbs, segments, ends_, possible_) {}

  std::vector<std::uint32_t> run() {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> of_limb;
    for (const std::uint32_t e : ends_) of_limb.emplace_back(limbs_.limb[e], e);
    const Lists lists = make_lists(of_limb, limbs_.size);
    std::vector<std::uint32_t> base(limbs_.size, k_none);
    for (std::uint32_t l = 0; l < limbs_.size; ++l) {
      if (lists[l].size() > 1 && !ground_.is_overhead() && !is_held(lists[l]))
        base[l] = standing_end(lists[l]);
      if (base[l] == k_none) base[l] = held_end(lists[l]);
    }
    return base;
  }

 private:
  bool is_grounded(std::uint32_t end) const { return ground_.is_below(end) || ground_.is_floor(end); }

  bool is_held(std::span<const std::uint32_t> ends) {
    DoubleBox box;
    for (const std::uint32_t e : ends) box.grow(limbs_.centre[e]);
    const double reach = length(box.extent());
    return std::ranges::any_of(
        ends, [&](std::uint32_t e) { return possible_[e] && !is_grounded(e) && contact_.holds(e, reach); });
  }

  std::uint32_t held_end(std::span<const std::uint32_t> ends) {
    const auto choices = std::ranges::count_if(ends, [&](std::uint32_t e) { return possible_[e] != 0; });
    using Rank = std::tuple<bool, double, double, double, double>;  // lower is better
    Rank best;
    std::uint32_t base = k_none;
    for (const std::uint32_t e : ends) {
      if (!possible_[e]) continue;
      const Double3& c = limbs_.centre[e];
      Rank rank;
      if (choices > 1) rank = {!is_grounded(e), contact_(e), c.y, c.x, c.z};
      if (base == k_none || rank < best) best = rank, base = e;
    }
    return base;
  }

  // Whether a limb may stand on an end.
  bool may_stand(std::uint32_t end, std::size_t ends, double thickest) const {
    if (ends == 2 && ground_.is_below(end)) return true;
    return thickness_[end] > 0 && (ends == 2 || thickness_[end] * k_thinner_base >= thickest);
  }

  std::uint32_t standing_end(std::span<const std::uint32_t> ends) const {
    double thickest = 0;
    for (const std::uint32_t e : ends) thickest = std::max(thickest, thickness_[e]);
    std::vector<std::uint32_t> may;
    for (const std::uint32_t e : ends) {
      if (may_stand(e, ends.size(), thickest)) may.push_back(e);
    }
    const auto is_down = [&](std::uint32_t e) { return is_grounded(e); };
    if (std::ranges::any_of(may, is_down)) std::erase_if(may, std::not_fn(is_down));
    if (may.empty()) return k_none;
    const auto height = [&](std::uint32_t e) { return limbs_.centre[e].y; };
    const std::uint32_t lowest = std::ranges::min(may, {}, height);
    const double level = height(lowest) + k_ground_level * thickness_[lowest] / 2;
    std::erase_if(may, [&](std::uint32_t e) { return height(e) > level; });
    return std::ranges::min(may, {}, [&](std::uint32_t e) {
      const Double3& c = limbs_.centre[e];
      return std::tuple(-thickness_[e], c.y, c.x, c.z);
    });
  }

  const Limbs& limbs_;
  const Ground& ground_;
  std::vector<std::uint32_t> ends_;
  std::vector<std::uint8_t> possible_;
  std::vector<double> thickness_;
  Contact contact_;
};

}  // namespace

std::vector<std::uint32_t> choose_bases(const Limbs& limbs, const LimbSegments& segments,
                                        const Ground& ground) {
  return BaseChooser(limbs, segments, ground).run();
}

std::vector<std::uint32_t> nearest_ends(const Limbs& limbs, std::span<const Double3> points) {
  const std::vector<std::uint32_t> ends = end_rings(limbs);
  std::vector<std::uint32_t> nearest;
  for (const Double3& p : points) {
    std::uint32_t best = k_none;
    for (const std::uint32_t e : ends) {
      if (limbs.plate(limbs.limb[e])) continue;
      if (best == k_none || distance(limbs.centre[e], p) < distance(limbs.centre[best], p)) best = e;
    }
    nearest.push_back(best);
  }
  return nearest;
}

}  // namespace copse
