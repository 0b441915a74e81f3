#include "lib/analysis/ecosystem/spread_apart.h"

#include "lib/analysis/ecosystem/disc_cover.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

namespace copse {
namespace {

constexpr int k_tries_in_piece = 8, k_darts = 4;
// So many in a row that find no place in their own piece: what is left goes to the search for gaps at once.
constexpr int k_failures_in_a_row = 64;
constexpr std::uint64_t k_group = 32;  // pieces
constexpr double k_finest = 0.125;     // of the radius
// Discs round a patch that are looked at together, and round one that is too small for darts.
constexpr std::size_t k_most_near = 24, k_most_at_last = 256;
constexpr int k_barren = 6;  // halvings of a patch in which no dart hits ground that is allowed

// What is in the way of a disc: others, and feet.
class Room {
 public:
  Room(const DiscsApart& wanted, Spacing& discs)
      : discs_(discs), foot_(wanted.least_anywhere / 2), any_feet_(!wanted.feet.empty()) {
    // Points as discs, because Spacing knows discs alone: what is asked of them is smaller by their radius.
    for (const GroundPlace& at : wanted.feet) feet_.add({at.x, at.z, foot_});
  }

  bool is_free(const Disc& d) const {
    return discs_.is_free(d) && (!any_feet_ || feet_.is_free({d.x, d.z, d.radius - foot_}));
  }
  // Whether no disc of `radius` can stand in the patch. Among many much smaller ones it may be that it is not
  // told; then it is of the patch's parts.
  bool is_closed(const Patch& p, double radius, std::size_t most = k_most_near) {
    near_.clear();
    if (discs_.closes(p, radius, most, near_)) return true;
    const std::size_t discs = near_.size();
    if (any_feet_ && feet_.closes(p, radius - foot_, most, near_)) return true;
    for (std::size_t i = discs; i < near_.size(); ++i) near_[i].radius = 0;
    return near_.size() <= most && is_covered(p, near_, radius);
  }
  // A place in a gap of the patch, as is_closed has found it.
  std::optional<GroundPlace> opening(const Patch& p, double radius) const {
    return open_middle(p, near_, radius);
  }
  // The largest radius that is free here, at most `most`.
  double clearance(const GroundPlace& at, double most) const {
    const double clear = discs_.clearance(at.x, at.z, most);
    return any_feet_ ? std::min(clear, feet_.clearance(at.x, at.z, most) + foot_) : clear;
  }
  void add(const Disc& d) { discs_.add(d); }

 private:
  Spacing& discs_;
  Spacing feet_;
  double foot_;
  bool any_feet_;
  std::vector<Disc> near_;  // the patch that was asked about last
};

// Discs that wait for a gap, by radius; by place their radii are not known before, and all are 0.
class Waiting {
 public:
  struct Member {
    double radius = 0;
    std::uint64_t disc = 0;
    friend auto operator<=>(const Member&, const Member&) = default;
  };

  bool empty() const { return left_ == 0; }
  std::size_t size() const { return left_; }
  void add(const Member& m) { members_.push_back(m), ++left_; }
  void sort() { std::sort(members_.begin(), members_.end()); }
  // Both sorted, and neither open.
  void join(Waiting&& other) {
    const auto middle = static_cast<std::ptrdiff_t>(members_.size());
    members_.insert(members_.end(), other.members_.begin(), other.members_.end());
    std::inplace_merge(members_.begin(), members_.begin() + middle, members_.end());
    left_ = members_.size();
  }

  // Between these two members may be taken, and the smallest and the largest are known.
  void open() {
    link_.resize(members_.size() + 1);
    std::iota(link_.begin(), link_.end(), 0);
    smallest_ = 0;
  }
  void close() {
    std::size_t kept = 0;
    for (std::size_t k = 0; k < members_.size(); ++k)
      if (link_[k + 1] == k + 1) members_[kept++] = members_[k];
    members_.resize(kept);
    link_ = {};
  }

  const Member& smallest() const { return members_[smallest_]; }
  const Member& largest() { return members_[last_up_to(members_.size()) - 1]; }
  // The largest that is not above; the smallest when there is none.
  const Member& at_most(double radius) {
    const auto end = std::upper_bound(members_.begin(), members_.end(),
                                      Member{radius, std::numeric_limits<std::uint64_t>::max()});
    const std::size_t k = last_up_to(static_cast<std::size_t>(end - members_.begin()));
    return k == 0 ? smallest() : members_[k - 1];
  }
  void take(const Member& m) {
    const auto k = static_cast<std::size_t>(&m - members_.data());
    link_[k + 1] = k;
    if (--left_ == 0) return;
    while (link_[smallest_ + 1] != smallest_ + 1) ++smallest_;
  }

 private:
  // Of the first `end` members one more than the last that waits; 0: none. With path halving.
  std::size_t last_up_to(std::size_t end) {
    while (link_[end] != end) {
      link_[end] = link_[link_[end]];
      end = link_[end];
    }
    return end;
  }

  std::vector<Member> members_;    // ascending
  std::vector<std::size_t> link_;  // of member k at k + 1: itself, or where to look when it was taken
  std::size_t left_ = 0, smallest_ = 0;
};

// A patch that may have gaps.
struct Gap {
  Patch patch;
  int barren = 0;  // times that it was halved since a dart hit ground that is allowed
  double closed_from = std::numeric_limits<double>::infinity();  // to discs of this radius or more
};

// Some pieces side by side: who waits there, and the ground that may still have gaps. Cells that nobody has
// looked at are kept as runs of the spreader's.
struct Group {
  Waiting waiting;
  std::vector<std::pair<std::size_t, std::size_t>> cells;
  std::vector<Gap> gaps;
};

class Apart {
 public:
  Apart(const DiscsApart& wanted, const DensityField& field, const Spreader& spreader,
        const PlacementTest& test, const Random& random, Spacing& discs)
      : wanted_(wanted),
        field_(field),
        spreader_(spreader),
        test_(test),
        random_(random),
        room_(wanted, discs) {}

  ApartCounts spread() {
    std::vector<std::uint64_t> left = try_own_pieces();
    if (left.empty()) return {0, hindered_};
    std::vector<Group> groups = groups_of(left);
    left = {};
    const auto all = static_cast<double>(2 * groups.size());
    std::uint64_t searched = 0;
    while (true) {
      for (Group& g : groups) {
        search(g, random_.fork(wanted_.count + 1 + searched++));
        tell(0.5 + 0.5 * static_cast<double>(searched) / all);
      }
      if (groups.size() == 1) return {groups[0].waiting.size(), hindered_};
      groups = joined(std::move(groups));
    }
  }

 private:
  void tell(double share) const {
    if (wanted_.progress) wanted_.progress(std::min(share, 1.0));
  }

  void put(std::uint64_t disc, const Disc& at) {
    room_.add(at);
    wanted_.place(disc, {at.x, at.z});
  }

  // Answers those that found no room. In a random order: along the curve, the last ones would find their
  // piece hemmed in by the first.
  std::vector<std::uint64_t> try_own_pieces() {
    std::vector<std::uint64_t> order(wanted_.count), left;
    std::iota(order.begin(), order.end(), 0);
    random_.fork(wanted_.count).shuffle(std::span(order));
    int failures = 0;
    for (std::size_t k = 0; k < order.size(); ++k) {
      if (failures == k_failures_in_a_row) {
        left.insert(left.end(), order.begin() + static_cast<std::ptrdiff_t>(k), order.end());
        hindered_ += order.size() - k;
        break;
      }
      if (k % 1024 == 0) tell(0.5 * static_cast<double>(k) / static_cast<double>(order.size()));
      if (try_own_piece(order[k])) {
        failures = 0;
      } else {
        ++failures;
        left.push_back(order[k]);
      }
    }
    return left;
  }

  bool try_own_piece(std::uint64_t disc) {
    Random random = random_.fork(disc);
    for (int n = 0; n < k_tries_in_piece; ++n) {
      hindered_ += n == 1;
      const GroundPlace at = spreader_.draw(disc, wanted_.count, test_, random);
      const Disc d{at.x, at.z, wanted_.radius(disc, at)};
      if (!room_.is_free(d)) continue;
      put(disc, d);
      return true;
    }
    return false;
  }

  std::vector<Group> groups_of(const std::vector<std::uint64_t>& left) const {
    std::vector<Group> groups((wanted_.count + k_group - 1) / k_group);
    for (const std::uint64_t disc : left)
      groups[disc / k_group].waiting.add({wanted_.by_place ? 0 : wanted_.radius(disc, {}), disc});
    for (Group& g : groups) g.waiting.sort();
    const std::size_t cells = spreader_.cells().size();
    for (std::size_t first = 0, end = 0; first < cells; first = end) {
      const std::uint64_t group = spreader_.piece_of(first, wanted_.count) / k_group;
      for (end = first + 1; end < cells && spreader_.piece_of(end, wanted_.count) / k_group == group;) ++end;
      groups[group].cells = {{first, end}};
    }
    return groups;
  }

  static std::vector<Group> joined(std::vector<Group>&& groups) {
    std::vector<Group> pairs;
    for (std::size_t i = 0; i < groups.size(); i += 2) {
      Group& a = pairs.emplace_back(std::move(groups[i]));
      if (i + 1 == groups.size()) break;
      Group& b = groups[i + 1];
      a.waiting.join(std::move(b.waiting));
      a.gaps.insert(a.gaps.end(), b.gaps.begin(), b.gaps.end());
      for (const auto& run : b.cells) {
        if (!a.cells.empty() && a.cells.back().second == run.first)
          a.cells.back().second = run.second;
        else
          a.cells.push_back(run);
      }
    }
    return pairs;
  }

  Patch patch_of(std::uint32_t cell) const {
    const GroundPlace low = field_.point(cell, 0, 0), high = field_.point(cell, 1, 1);
    return {low.x, low.z, high.x - low.x, high.z - low.z};
  }

  void search(Group& g, Random random) {
    if (g.waiting.empty() || (g.gaps.empty() && g.cells.empty())) return;
    g.waiting.open();
    std::vector<Gap> now, next;
    for (const Gap& gap : std::exchange(g.gaps, {}))
      (radius_in(gap.patch, g) < gap.closed_from ? now : g.gaps).push_back(gap);
    for (const auto& [first, end] : std::exchange(g.cells, {}))
      for (std::size_t c = first; c < end; ++c) now.push_back({patch_of(spreader_.cells()[c])});
    while (!now.empty()) {
      random.shuffle(std::span(now));
      for (const Gap& gap : now) visit(gap, g, next, random);
      now = std::exchange(next, {});
    }
    g.waiting.close();
  }

  // Its halves go to `next` when there may be gaps in them; it stays with the group when only smaller discs
  // than those that wait may find one.
  void visit(Gap gap, Group& g, std::vector<Gap>& next, Random& random) {
    if (g.waiting.empty()) {
      g.gaps.push_back(gap);
      return;
    }
    const Patch& p = gap.patch;
    const double least = wanted_.least(p), here = radius_in(p, g);
    if (room_.is_closed(p, here)) {
      if (here == least || room_.is_closed(p, least)) return;
      gap.closed_from = here;
      g.gaps.push_back(gap);
      return;
    }
    ++gap.barren;
    for (int n = 0; n < k_darts && !g.waiting.empty(); ++n)
      if (throw_dart({p.x + p.width * random.uniform(), p.z + p.depth * random.uniform()}, g)) gap.barren = 0;
    if (gap.barren == k_barren) return;
    if (std::max(p.width, p.depth) > k_finest * here) {
      halve(gap, next);
      return;
    }
    // Too small for darts.
    if (!g.waiting.empty() && !room_.is_closed(p, here, k_most_at_last))
      if (const auto place = room_.opening(p, here)) throw_dart(*place, g);
    if (here > least) g.gaps.push_back(gap);
  }

  // No disc that waits is smaller in this patch.
  double radius_in(const Patch& p, const Group& g) const {
    return std::max(wanted_.least(p), g.waiting.smallest().radius);
  }

  static void halve(Gap gap, std::vector<Gap>& out) {
    Patch& p = gap.patch;
    const bool across = p.width >= p.depth;
    (across ? p.width : p.depth) /= 2;
    out.push_back(gap);
    (across ? p.x : p.z) += across ? p.width : p.depth;
    out.push_back(gap);
  }

  // Puts the largest of those that wait and fit here; answers whether anything may stand here.
  bool throw_dart(const GroundPlace& at, Group& g) {
    if (!(test_.weight(at.x, at.z) > 0)) return false;
    const Waiting::Member* fits = &g.waiting.smallest();
    double radius = wanted_.radius(fits->disc, at);
    if (!room_.is_free({at.x, at.z, radius})) return true;
    if (!wanted_.by_place) {
      const auto& larger = g.waiting.at_most(room_.clearance(at, g.waiting.largest().radius));
      // Unless rounding says otherwise.
      if (room_.is_free({at.x, at.z, larger.radius})) fits = &larger, radius = larger.radius;
    }
    const std::uint64_t disc = fits->disc;
    g.waiting.take(*fits);
    put(disc, {at.x, at.z, radius});
    return true;
  }

  const DiscsApart& wanted_;
  const DensityField& field_;
  const Spreader& spreader_;
  const PlacementTest& test_;
  const Random& random_;
  Room room_;
  std::uint64_t hindered_ = 0;
};

}  // namespace

GroundPlace unhindered_place(std::uint64_t disc, std::uint64_t count, const Spreader& spreader,
                             const PlacementTest& test, const Random& random) {
  Random first = random.fork(disc);
  return spreader.draw(disc, count, test, first);
}

ApartCounts spread_apart(const DiscsApart& wanted, const DensityField& field, const Spreader& spreader,
                         const PlacementTest& test, const Random& random, Spacing& discs) {
  if (wanted.count == 0) return {};
  return Apart(wanted, field, spreader, test, random, discs).spread();
}

}  // namespace copse
