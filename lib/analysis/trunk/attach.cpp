#include "lib/analysis/trunk/attach.h"

#include "lib/analysis/rings/taper.h"
#include "lib/analysis/surface/lists.h"
#include "lib/analysis/surface/tolerances.h"
#include "lib/analysis/trunk/arborescence.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace copse {
namespace {

// A possible parent of a limb.
struct Candidate {
  std::uint32_t limb = 0, ring = 0, segment = 0;
  double offset = 0;    // of the base from the axis, in radii
  double edge = 0;      // of the base edge that is nearest to the axis, likewise; < 0 beyond the axis
  double ratio = 0;     // ln of the child's radius over the parent's
  double too_thin = 0;  // ln of how much thinner the parent is than a parent may be; 0 if it is not
  double buried = 0;    // 1 at the centre of the parent's own buried base, 0 a radius away from it
  double noise = 0;     // of the offset: what rounding makes of a coordinate, in radii
  double gap = 0;
  double doubt = 0;  // cost of what is unusual about it
  double cost = 0;
};

// How the limbs of this file are set on their parents: with their centre or with their edge at this offset.
struct Habit {
  double Candidate::*measure = &Candidate::offset;
  double offset = 0, spread = 1;
  double ratio = 0, ratio_spread = 0;  // ln of a child's radius over its parent's; spread 0: unknown
};

Lists segments_of_rings(const Limbs& limbs, const LimbSegments& segments) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::uint32_t s = 0; s < segments.rings.size(); ++s) {
    for (const std::uint32_t r : segments.rings[s]) pairs.emplace_back(limbs.alive(r), s);
  }
  return make_lists(pairs, limbs.rings());
}

class Attacher {
 public:
  Attacher(const Limbs& limbs, const LimbSegments& segments, const Ground& ground,
           std::span<const std::uint32_t> bases, std::span<const std::uint32_t> roots)
      : limbs_(limbs),
        segments_(segments),
        ground_(ground),
        segments_at_(segments_of_rings(limbs, segments)),
        natural_bases_(bases),
        bases_(bases.begin(), bases.end()),
        named_(!roots.empty()),
        is_named_(limbs.size, 0) {
    for (const std::uint32_t l : roots) is_named_[l] = 1;
  }

  std::vector<Attachment> run() {
    look_round();
    Habit usual = habit();
    if (turn_doubtful(usual)) {
      look_round();
      usual = habit();
    }
    for (std::uint32_t l = 0; l < bases_.size(); ++l) rate(l, usual);
    choose();
    std::vector<Attachment> attachments(bases_.size());
    for (std::uint32_t l = 0; l < bases_.size(); ++l) {
      attachments[l].base = natural_bases_[l];
      if (chosen_[l] == k_none) continue;
      attachments[l] = {bases_[l], candidates_[chosen_[l]].ring, candidates_[chosen_[l]].gap};
    }
    return attachments;
  }

 private:
  void look_round() {
    measure_limbs();
    find_candidates();
    mark_buried();
  }
  void measure_limbs();
  bool turn_doubtful(const Habit& usual);
  double cost_by_other_end(std::uint32_t limb, const Habit& usual);
  void find_candidates();
  void find_candidates(std::uint32_t limb);
  bool find_turned(std::uint32_t limb);
  bool on_plate(const Nearness& near) const;
  void drop_plates();
  void mark_buried();
  Habit habit(double Candidate::*measure) const;
  Habit habit() const;
  static double cost(const Candidate& candidate, const Habit& habit);
  Candidate best_along(const Candidate& nearest, std::uint32_t base, double radius, const Habit& habit) const;
  void rate(std::uint32_t limb, const Habit& habit);
  void choose();
  double lean(const Nearness& near, std::uint32_t base) const;
  Candidate candidate(const Nearness& near, std::uint32_t base, double radius) const;
  bool stands_on_ground(std::uint32_t limb, std::span<const Candidate> candidates) const;

  const Limbs& limbs_;
  const LimbSegments& segments_;
  const Ground& ground_;
  Lists segments_at_;  // one a ring
  std::span<const std::uint32_t> natural_bases_;
  std::vector<std::uint32_t> bases_;                         // by which limbs are attached, if they are
  bool named_;                                               // whether somebody says which limbs are roots
  std::vector<std::uint8_t> is_named_;                       // one a limb
  double size_ = 0;                                          // of the whole trunk
  double lowest_ = std::numeric_limits<double>::infinity();  // y of the lowest base
  std::vector<double> reach_;                                // from a limb's base to its farthest ring
  std::vector<std::uint32_t> farthest_;                      // that ring
  std::vector<double> radius_, mean_radius_;                 // of a limb at its base, and of all its rings
  std::vector<std::uint32_t> other_end_;                     // of a limb with two; k_none
  std::vector<std::uint32_t> first_;                         // of each limb's candidates; limbs + 1
  std::vector<Nearness> found_;
  std::vector<Candidate> candidates_;  // limb by limb
  std::vector<std::uint32_t> chosen_;  // candidate; k_none: a root
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
  DoubleBox box;
  for (const Double3& c : limbs_.centre) box.grow(c);
  size_ = length(box.extent());
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

// How far a base ring reaches towards the axis of a possible parent, as a share of its radius: the sine of
// the angle between its normal and the way to the axis.
double Attacher::lean(const Nearness& near, std::uint32_t base) const {
  const Segment& s = segments_.tree.segments()[near.segment];
  const Double3 out = normalized(limbs_.centre[base] - (s.a + (s.b - s.a) * near.t), {0, 0, 0});
  const double along = dot(out, limbs_.normal[base]);
  return std::sqrt(std::max(0.0, 1 - along * along));
}

Candidate Attacher::candidate(const Nearness& near, std::uint32_t base, double radius) const {
  const auto& rings = segments_.rings[near.segment];
  std::uint32_t ring = rings[near.t < 0.5 ? 0 : 1];
  // Nothing grows from a point if there is a ring to grow from.
  if (limbs_.source[ring] == RadiusSource::point) ring = rings[near.t < 0.5 ? 1 : 0];
  Candidate c;
  c.segment = near.segment;
  c.ring = limbs_.alive(ring);
  c.limb = limbs_.limb[c.ring];
  const double wide = std::max(near.radius, radius / 2);
  c.offset = wide > 0 ? near.distance / wide : 0;
  c.ratio = std::log(radius / std::max(near.radius, radius / k_much_thicker));
  if (!std::isfinite(c.ratio)) c.ratio = 0;  // points
  c.too_thin = std::max(0.0, c.ratio - std::log(k_thicker_child));
  c.edge = wide > 0 ? (near.distance - radius * lean(near, base)) / wide : 0;
  c.noise = wide > 0 ? k_rounding * size_ / wide : 0;
  c.gap = near.gap();
  return c;
}

// Whether a limb comes out of the ground and not out of one of its possible parents.
bool Attacher::stands_on_ground(std::uint32_t limb, std::span<const Candidate> candidates) const {
  if (named_) return false;
  const std::uint32_t base = bases_[limb];
  const double rise = limbs_.centre[farthest_[limb]].y - limbs_.centre[base].y;
  if (ground_.is_below(base)) {
    // A branch may droop below the ground, and twigs may grow from it there.
    const auto droops = [&](const Candidate& c) { return !ground_.is_below(natural_bases_[c.limb]); };
    return rise > 0 && !ground_.is_below(farthest_[limb]) && std::ranges::none_of(candidates, droops);
  }
  if (ground_.is_floor(base)) return rise > 0;
  const auto holds = [&](const Candidate& c) {
    const bool in_log = c.gap < 0 && is_level(segments_.tree.segments()[c.segment]);
    return in_log || c.offset <= k_ground_offset;
  };
  return rise > reach_[limb] / 2 && limbs_.centre[base].y - lowest_ <= k_ground_level * radius_[limb] &&
         std::ranges::none_of(candidates, holds);
}

void Attacher::find_candidates() {
  first_.assign(1, 0);
  candidates_.clear();
  for (std::uint32_t limb = 0; limb < bases_.size(); ++limb) {
    if (bases_[limb] != k_none) find_candidates(limb);
    first_.push_back(static_cast<std::uint32_t>(candidates_.size()));
  }
}

bool Attacher::on_plate(const Nearness& near) const {
  return limbs_.plate(limbs_.limb[limbs_.alive(segments_.rings[near.segment][0])]);
}

// Trees stand on the ground, they do not grow from it.
void Attacher::drop_plates() {
  std::erase_if(found_, [&](const Nearness& near) { return on_plate(near); });
}

void Attacher::find_candidates(std::uint32_t limb) {
  if (limbs_.plate(limb) || is_named_[limb]) return;
  const std::size_t begin = candidates_.size();
  const double radius = radius_[limb];
  const std::uint32_t base = bases_[limb];
  const Double3& at = limbs_.centre[base];
  segments_.tree.near(at, k_contact_reach * radius, radius / 2, limb, k_candidates, found_);
  drop_plates();
  for (const Nearness& near : found_) candidates_.push_back(candidate(near, base, radius));
  const bool on_ground = stands_on_ground(limb, std::span(candidates_).subspan(begin));
  if (on_ground) candidates_.resize(begin);
  if (on_ground || !found_.empty() || find_turned(limb)) return;
  Nearness near;
  if (segments_.tree.nearest(at, k_float_gap * reach_[limb], limb, near) && !on_plate(near)) {
    candidates_.push_back(candidate(near, base, radius));
    candidates_.back().doubt = k_cost_doubt;
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
  drop_plates();
  for (const Nearness& near : found_) {
    if (mean_radius_[limb] > k_thicker_child * near.radius) continue;
    candidates_.push_back(candidate(near, end, radius));
    candidates_.back().doubt = k_cost_doubt;
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

// The narrowest range that holds as many possible parents as half the limbs. Each limb's true parent lies
// where the file sets branches; wrong ones lie anywhere.
Habit Attacher::habit(double Candidate::*measure) const {
  std::vector<double> offsets;
  std::size_t held = 0;
  for (std::uint32_t limb = 0; limb < bases_.size(); ++limb) {
    const std::size_t before = offsets.size();
    for (std::uint32_t c = first_[limb]; c < first_[limb + 1]; ++c) {
      if (candidates_[c].doubt == 0 && candidates_[c].too_thin == 0)
        offsets.push_back(candidates_[c].*measure);
    }
    held += offsets.size() > before;
  }
  if (held < k_habit_limbs) return {.offset = 0, .spread = k_habit_unknown};
  std::ranges::sort(offsets);
  const std::size_t half = held / 2;
  std::size_t begin = 0;
  for (std::size_t i = 1; i + half < offsets.size(); ++i) {
    if (offsets[i + half] - offsets[i] < offsets[begin + half] - offsets[begin]) begin = i;
  }
  const double low = offsets[begin], high = offsets[begin + half];
  return {
      .measure = measure, .offset = (low + high) / 2, .spread = std::max(k_habit_least, (high - low) / 2)};
}

Habit Attacher::habit() const {
  const Habit centre = habit(&Candidate::offset), edge = habit(&Candidate::edge);
  Habit best = edge.spread < centre.spread ? edge : centre;
  // How thick children are, going by the possible parent of each that fits best so far.
  std::vector<double> ratios;
  for (std::uint32_t limb = 0; limb < bases_.size(); ++limb) {
    const auto candidates = std::span(candidates_).subspan(first_[limb], first_[limb + 1] - first_[limb]);
    if (candidates.empty()) continue;
    ratios.push_back(
        std::ranges::min(candidates, {}, [&](const Candidate& c) { return cost(c, best); }).ratio);
  }
  if (ratios.size() < k_habit_limbs) return best;
  const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
  std::ranges::nth_element(ratios, middle);
  best.ratio = *middle;
  for (double& r : ratios) r = std::abs(r - best.ratio);
  std::ranges::nth_element(ratios, middle);
  best.ratio_spread = std::max(k_habit_least_ratio, *middle);
  return best;
}

double Attacher::cost(const Candidate& c, const Habit& habit) {
  // Both level off: how far out an outlier lies tells little.
  const auto levelled = [](double unusual, double most) { return most * unusual / (most + unusual); };
  const double offset = std::abs(c.*habit.measure - habit.offset) / std::max(habit.spread, c.noise);
  const double ratio = habit.ratio_spread > 0 ? std::abs(c.ratio - habit.ratio) / habit.ratio_spread : 0;
  return levelled(offset, k_cost_offset) + levelled(ratio, k_cost_ratio) + k_cost_too_thin * c.too_thin +
         k_cost_buried * c.buried + c.doubt;
}

// A possible parent with its cost. Where the parent bends or changes its thickness, the segment that the limb
// was set on may be the next one to that which is nearest.
Candidate Attacher::best_along(const Candidate& nearest, std::uint32_t base, double radius,
                               const Habit& habit) const {
  Candidate best = nearest;
  best.cost = cost(nearest, habit);
  for (const std::uint32_t ring : segments_.rings[nearest.segment]) {
    for (const std::uint32_t segment : segments_at_[limbs_.alive(ring)]) {
      if (segment == nearest.segment) continue;
      const Nearness near = nearness(segments_.tree.segments(), segment, limbs_.centre[base]);
      if (near.gap() > k_contact_reach * radius) continue;
      Candidate other = candidate(near, base, radius);
      other.buried = nearest.buried;
      other.doubt = nearest.doubt;
      other.cost = cost(other, habit);
      if (other.cost < best.cost) best = other;
    }
  }
  return best;
}

// What it costs at least to hang a limb on another one by the end that is not its base. What itself begins
// there is no parent.
double Attacher::cost_by_other_end(std::uint32_t limb, const Habit& usual) {
  const std::uint32_t end = other_end_[limb];
  const double radius = limbs_.diameter[end] / 2;
  segments_.tree.near(limbs_.centre[end], k_contact_reach * radius, radius / 2, limb, k_candidates, found_);
  drop_plates();
  double least = std::numeric_limits<double>::infinity();
  for (const Nearness& near : found_) {
    const Candidate c = candidate(near, end, radius);
    const std::uint32_t base = bases_[c.limb];
    const bool begins_here =
        base != k_none && distance(limbs_.centre[base], limbs_.centre[end]) <= 2 * radius;
    if (!begins_here) least = std::min(least, best_along(c, end, radius, usual).cost);
  }
  return least;
}

// A limb as thick at one end as at the other, and near something with both, begins with the end that is set
// as the bases of this file are: what it tapers by may be how rough its rings are. Whether there was any to
// turn.
bool Attacher::turn_doubtful(const Habit& usual) {
  const std::vector<std::uint8_t> possible = thick_ends(limbs_, end_rings(limbs_));
  bool turned = false;
  std::vector<std::uint32_t> bases = bases_;
  for (std::uint32_t limb = 0; limb < bases_.size(); ++limb) {
    const std::uint32_t base = bases_[limb], end = other_end_[limb];
    if (base == k_none || end == k_none || !possible[base] || !possible[end]) continue;
    if (limbs_.diameter[end] <= 0 || ground_.is_below(base) || ground_.is_floor(base)) continue;
    const auto candidates = std::span(candidates_).subspan(first_[limb], first_[limb + 1] - first_[limb]);
    double now = std::numeric_limits<double>::infinity();
    for (const Candidate& c : candidates) now = std::min(now, best_along(c, base, radius_[limb], usual).cost);
    if (candidates.empty() || now <= k_cost_turn || cost_by_other_end(limb, usual) + k_cost_turn >= now)
      continue;
    bases[limb] = end;
    turned = true;
  }
  bases_ = std::move(bases);
  return turned;
}

// The costs of a limb's possible parents.
void Attacher::rate(std::uint32_t limb, const Habit& habit) {
  for (std::uint32_t i = first_[limb]; i < first_[limb + 1]; ++i) {
    candidates_[i] = best_along(candidates_[i], bases_[limb], radius_[limb], habit);
  }
}

// Where nothing else decides, the lowest and thickest limb is the root.
void Attacher::choose() {
  double highest = lowest_, thickest = 0;
  for (std::uint32_t limb = 0; limb < bases_.size(); ++limb) {
    if (bases_[limb] == k_none) continue;
    highest = std::max(highest, limbs_.centre[natural_bases_[limb]].y);
    thickest = std::max(thickest, radius_[limb]);
  }
  std::vector<double> root_cost(bases_.size(), k_cost_root);
  for (std::uint32_t limb = 0; limb < bases_.size(); ++limb) {
    if (bases_[limb] == k_none) continue;
    if (highest > lowest_) {
      root_cost[limb] += (limbs_.centre[natural_bases_[limb]].y - lowest_) / (highest - lowest_);
    }
    if (thickest > 0) root_cost[limb] += 1 - radius_[limb] / thickest;
  }
  std::vector<ParentArc> arcs;
  arcs.reserve(candidates_.size());
  for (const Candidate& c : candidates_) arcs.push_back({c.limb, c.cost});
  chosen_ = cheapest_arborescence(first_, arcs, root_cost);
}

}  // namespace

std::vector<Attachment> attach(const Limbs& limbs, const LimbSegments& segments, const Ground& ground,
                               std::span<const std::uint32_t> bases, std::span<const std::uint32_t> roots) {
  return Attacher(limbs, segments, ground, bases, roots).run();
}

}  // namespace copse
