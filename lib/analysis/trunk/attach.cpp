#include "lib/analysis/trunk/attach.h"

#include "lib/analysis/trunk/taper.h"
#include "lib/analysis/trunk/tolerances.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace copse {
namespace {

// A possible parent of a limb.
struct Candidate {
  std::uint32_t limb = 0, ring = 0;
  double offset = 0;    // of the base from the axis, in radii
  double too_thin = 0;  // ln of how much thinner the parent is than a parent may be; 0 if it is not
  double buried = 0;    // 1 at the centre of the parent's own buried base, 0 a radius away from it
  double gap = 0;
  double doubt = 0;  // cost of what is unusual about it
  double cost = 0;
};

// How the limbs of this file are set on their parents.
struct Habit {
  double offset = 0, spread = 1;
};

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

class Attacher {
 public:
  Attacher(const Limbs& limbs, const LimbSegments& segments, const Ground& ground,
           std::span<const std::uint32_t> bases)
      : limbs_(limbs),
        segments_(segments),
        ground_(ground),
        natural_bases_(bases),
        bases_(bases.begin(), bases.end()) {}

  std::vector<Attachment> run() {
    measure_limbs();
    find_candidates();
    mark_buried();
    rate(habit());
    choose();
    std::vector<Attachment> attachments(bases_.size());
    for (std::uint32_t l = 0; l < bases_.size(); ++l) {
      attachments[l].base = natural_bases_[l];
      if (chosen_[l] >= first_[l + 1]) continue;
      attachments[l] = {bases_[l], candidates_[chosen_[l]].ring, candidates_[chosen_[l]].gap};
    }
    return attachments;
  }

 private:
  void measure_limbs();
  void find_candidates();
  void find_candidates(std::uint32_t limb);
  bool find_turned(std::uint32_t limb);
  void mark_buried();
  Habit habit() const;
  void rate(const Habit& habit);
  void choose();
  void break_cycle(std::span<const std::uint32_t> cycle);
  Candidate candidate(const Nearness& near, double radius) const;
  bool stands_on_ground(std::uint32_t limb, double least_offset) const;
  std::uint32_t parent(std::uint32_t limb) const {
    return chosen_[limb] < first_[limb + 1] ? candidates_[chosen_[limb]].limb : k_none;
  }

  const Limbs& limbs_;
  const LimbSegments& segments_;
  const Ground& ground_;
  std::span<const std::uint32_t> natural_bases_;
  std::vector<std::uint32_t> bases_;                         // by which limbs are attached, if they are
  double lowest_ = std::numeric_limits<double>::infinity();  // y of the lowest base
  std::vector<double> reach_;                                // from a limb's base to its farthest ring
  std::vector<std::uint32_t> farthest_;                      // that ring
  std::vector<double> radius_, mean_radius_;                 // of a limb at its base, and of all its rings
  std::vector<std::uint32_t> other_end_;                     // of a limb with two; k_none
  std::vector<std::size_t> first_;                           // of each limb's candidates; limbs + 1
  std::vector<Nearness> found_;
  std::vector<Candidate> candidates_;  // by ascending cost, limb by limb
  std::vector<std::size_t> chosen_;    // candidate; first_[limb + 1] where none is left: a root
};

void Attacher::measure_limbs() {
  reach_.assign(bases_.size(), 0);
  radius_.assign(bases_.size(), 0);
  mean_radius_.assign(bases_.size(), 0);
  std::vector<std::uint32_t> rings(bases_.size(), 0);
  farthest_.assign(bases_.begin(), bases_.end());
  for (const std::uint32_t base : bases_) {
    if (base == k_none) continue;
    lowest_ = std::min(lowest_, limbs_.centre[base].y);
    radius_[limbs_.limb[base]] = limbs_.diameter[base] / 2;
  }
  for (std::uint32_t r = 0; r < limbs_.rings(); ++r) {
    const std::uint32_t limb = limbs_.limb[r];
    const double d = distance(limbs_.centre[r], limbs_.centre[bases_[limb]]);
    if (d > reach_[limb]) reach_[limb] = d, farthest_[limb] = r;
    // A limb that begins in a point is as thick as what the point opens into.
    const bool is_next = limbs_.parent_of(r) == bases_[limb] || limbs_.parent_of(bases_[limb]) == r;
    if (is_next && radius_[limb] == 0) radius_[limb] = limbs_.diameter[r] / 4;
    if (limbs_.merged_into[r] != k_none) continue;
    mean_radius_[limb] += limbs_.diameter[r] / 2;
    ++rings[limb];
  }
  for (std::size_t limb = 0; limb < bases_.size(); ++limb) {
    if (rings[limb] > 0) mean_radius_[limb] /= rings[limb];
  }
  std::vector<std::uint32_t> ends(bases_.size(), 0);
  other_end_.assign(bases_.size(), k_none);
  for (const std::uint32_t e : end_rings(limbs_)) {
    const std::uint32_t limb = limbs_.limb[e];
    ++ends[limb];
    if (e != bases_[limb]) other_end_[limb] = e;
  }
  for (std::size_t limb = 0; limb < bases_.size(); ++limb) {
    if (ends[limb] != 2) other_end_[limb] = k_none;
  }
}

Candidate Attacher::candidate(const Nearness& near, double radius) const {
  const auto& rings = segments_.rings[near.segment];
  std::uint32_t ring = rings[near.t < 0.5 ? 0 : 1];
  // Nothing grows from a point if there is a ring to grow from.
  if (limbs_.source[ring] == RadiusSource::point) ring = rings[near.t < 0.5 ? 1 : 0];
  Candidate c;
  c.ring = limbs_.alive(ring);
  c.limb = limbs_.limb[c.ring];
  const double wide = std::max(near.radius, radius / 2);
  c.offset = wide > 0 ? near.distance / wide : 0;
  c.too_thin = radius > k_thicker_child * near.radius ? std::log(radius / (k_thicker_child * wide)) : 0;
  c.gap = near.gap();
  return c;
}

// Whether a limb that nothing holds better than `least_offset` radii from an axis comes out of the ground.
bool Attacher::stands_on_ground(std::uint32_t limb, double least_offset) const {
  const std::uint32_t base = bases_[limb];
  const double rise = limbs_.centre[farthest_[limb]].y - limbs_.centre[base].y;
  if (ground_.is_below(base)) return rise > 0 && !ground_.is_below(farthest_[limb]);
  return rise > reach_[limb] / 2 && least_offset > k_ground_offset &&
         limbs_.centre[base].y - lowest_ <= k_ground_level * radius_[limb];
}

void Attacher::find_candidates() {
  first_.assign(1, 0);
  for (std::uint32_t limb = 0; limb < bases_.size(); ++limb) {
    if (bases_[limb] != k_none) find_candidates(limb);
    first_.push_back(candidates_.size());
  }
}

void Attacher::find_candidates(std::uint32_t limb) {
  const std::size_t begin = candidates_.size();
  const double radius = radius_[limb];
  const Double3& at = limbs_.centre[bases_[limb]];
  segments_.tree.near(at, k_contact_reach * radius, radius / 2, limb, k_candidates, found_);
  for (const Nearness& near : found_) candidates_.push_back(candidate(near, radius));
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t c = begin; c < candidates_.size(); ++c) least = std::min(least, candidates_[c].offset);
  if (stands_on_ground(limb, least)) candidates_.resize(begin);
  if (!found_.empty() || stands_on_ground(limb, least) || find_turned(limb)) return;
  Nearness near;
  if (segments_.tree.nearest(at, k_float_gap * reach_[limb], limb, near)) {
    candidates_.push_back(candidate(near, radius));
    candidates_.back().doubt = k_cost_float;
  }
}

// A tube that nothing holds by the end that it tapers from may hang on something by the other: a twig with a
// flared tip. What holds it must not be thinner than it is, lest a tree hang by its top from another one.
bool Attacher::find_turned(std::uint32_t limb) {
  const std::uint32_t end = other_end_[limb];
  if (end == k_none) return false;
  const double radius = limbs_.diameter[end] / 2;
  const std::size_t begin = candidates_.size();
  segments_.tree.near(limbs_.centre[end], k_contact_reach * radius, radius / 2, limb, k_candidates, found_);
  for (const Nearness& near : found_) {
    if (mean_radius_[limb] > k_thicker_child * near.radius) continue;
    candidates_.push_back(candidate(near, radius));
    candidates_.back().doubt = k_cost_float;
  }
  if (candidates_.size() == begin) return false;
  bases_[limb] = end;
  radius_[limb] = radius;
  return true;
}

void Attacher::mark_buried() {
  for (std::uint32_t limb = 0; limb < bases_.size(); ++limb) {
    for (std::size_t c = first_[limb]; c < first_[limb + 1]; ++c) {
      const std::uint32_t parent = candidates_[c].limb;
      if (first_[parent] == first_[parent + 1] || radius_[parent] <= 0) continue;
      const double d = distance(limbs_.centre[bases_[limb]], limbs_.centre[bases_[parent]]);
      candidates_[c].buried = std::max(0.0, 1 - d / radius_[parent]);
    }
  }
}

Habit Attacher::habit() const {
  std::vector<double> offsets;
  for (std::uint32_t limb = 0; limb < bases_.size(); ++limb) {
    if (first_[limb + 1] - first_[limb] != 1) continue;
    const Candidate& c = candidates_[first_[limb]];
    if (c.doubt == 0 && c.buried == 0) offsets.push_back(c.offset);
  }
  if (offsets.size() < k_habit_limbs) return {0, k_habit_unknown};
  Habit habit;
  habit.offset = median(offsets);
  for (double& o : offsets) o = std::abs(o - habit.offset);
  habit.spread = std::max(k_habit_least, median(offsets));
  return habit;
}

void Attacher::rate(const Habit& habit) {
  for (std::uint32_t limb = 0; limb < bases_.size(); ++limb) {
    const auto begin = candidates_.begin() + static_cast<std::ptrdiff_t>(first_[limb]);
    const auto end = candidates_.begin() + static_cast<std::ptrdiff_t>(first_[limb + 1]);
    for (auto c = begin; c != end; ++c) {
      c->cost = std::abs(c->offset - habit.offset) / habit.spread + k_cost_too_thin * c->too_thin +
                k_cost_buried * c->buried + c->doubt;
    }
    std::stable_sort(begin, end, [](const Candidate& a, const Candidate& b) { return a.cost < b.cost; });
  }
}

// The limb of a cycle that loses least takes its next candidate; when it has none left it is a root.
void Attacher::break_cycle(std::span<const std::uint32_t> cycle) {
  std::uint32_t best = k_none;
  double best_loss = std::numeric_limits<double>::infinity();
  for (const std::uint32_t limb : cycle) {
    const std::size_t next = chosen_[limb] + 1;
    const double cost = candidates_[chosen_[limb]].cost;
    const double loss = std::min(next < first_[limb + 1] ? candidates_[next].cost : k_cost_root,
                                 std::max(k_cost_root, cost)) -
                        cost;
    const bool better = best == k_none || loss < best_loss ||
                        (loss == best_loss && limbs_.diameter[bases_[limb]] > limbs_.diameter[bases_[best]]);
    if (better) best = limb, best_loss = loss;
  }
  ++chosen_[best];
}

void Attacher::choose() {
  chosen_.assign(first_.begin(), first_.end() - 1);
  enum : std::uint8_t { unseen, on_path, done };
  std::vector<std::uint8_t> state(bases_.size(), unseen);
  std::vector<std::uint32_t> path;
  for (std::uint32_t start = 0; start < bases_.size(); ++start) {
    for (std::uint32_t limb = start; state[start] != done;) {
      path.clear();
      while (limb != k_none && state[limb] == unseen) {
        state[limb] = on_path;
        path.push_back(limb);
        limb = parent(limb);
      }
      const bool is_cycle = limb != k_none && state[limb] == on_path;
      if (is_cycle)
        break_cycle(
            std::span(path).subspan(static_cast<std::size_t>(std::ranges::find(path, limb) - path.begin())));
      for (const std::uint32_t l : path) state[l] = is_cycle ? unseen : done;
      limb = start;
    }
  }
}

}  // namespace

std::vector<Attachment> attach(const Limbs& limbs, const LimbSegments& segments, const Ground& ground,
                               std::span<const std::uint32_t> bases) {
  return Attacher(limbs, segments, ground, bases).run();
}

}  // namespace copse
