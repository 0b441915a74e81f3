#include "tools/treegrow/layout.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>

namespace copse::grow {
namespace {

constexpr std::uint64_t k_dither_key = 10;

// How far apart, as a share of the spacing of its rings, a ring and a branch may be for the branch to hang on
// it.
constexpr double k_snap = 0.4;

class LayoutMaker {
 public:
  LayoutMaker(const Species& species, const Skeleton& skeleton, const Breaks& breaks, const Detail& detail)
      : species_(species), skeleton_(skeleton), breaks_(breaks), detail_(detail) {}

  Layout run(std::int64_t leaves, std::uint64_t most_triangles) {
    layout_.stems.resize(skeleton_.stems.size());
    children_.resize(skeleton_.stems.size() + 1);
    join_at_.resize(skeleton_.stems.size());
    sort_children();
    for (std::size_t i = 0; i < skeleton_.stems.size(); ++i) {
      lay_stem(i);
      if (layout_.rings.size() <= most_triangles + layout_.stems.size()) continue;
      layout_.trunk_triangles = 2 * layout_.rings.size();  // at least
      return std::move(layout_);
    }
    share_leaves(leaves);
    for (std::size_t i = 0; i < skeleton_.stems.size(); ++i) layout_.trunk_triangles += count_stem(i);
    layout_.leaf_triangles = layout_.leaves * leaf_form(breaks_).triangles;
    return std::move(layout_);
  }

 private:
  bool grass() const { return species_.grass.blades > 0; }
  bool free() const { return breaks_.has(Break::free_tubes) || breaks_.has(Break::laid_against); }
  std::uint32_t sides(std::size_t i) const;
  std::size_t segments(const Stem& stem) const;
  void sort_children();
  void lay_stem(std::size_t i);
  std::vector<double> uniform(const Stem& stem) const;
  void force(std::vector<double>& rings, const Stem& stem, std::span<const std::uint32_t> children);
  void open_saddles(std::vector<double>& rings, const Stem& stem, std::span<const std::uint32_t> children);
  void open_patches(std::vector<double>& rings, const Stem& stem, std::span<const std::uint32_t> children);
  std::uint64_t count_stem(std::size_t i) const;
  void share_leaves(std::int64_t wanted);
  double ground_parameter(const Stem& stem) const;

  const Species& species_;
  const Skeleton& skeleton_;
  const Breaks& breaks_;
  const Detail& detail_;
  Layout layout_;
  std::vector<std::uint32_t> children_;    // offsets into child_list_
  std::vector<std::uint32_t> child_list_;  // of each stem, by ascending parent_at
  std::vector<double> join_at_;  // parameter of the parent's ring that a stem hangs on (free ones: unused)
};

void LayoutMaker::sort_children() {
  const auto& stems = skeleton_.stems;
  for (const Stem& stem : stems)
    if (stem.kind != StemKind::root) ++children_[stem.parent + 1];
  for (std::size_t i = 1; i < children_.size(); ++i) children_[i] += children_[i - 1];
  child_list_.resize(children_.back());
  std::vector<std::uint32_t> next(children_.begin(), children_.end() - 1);
  for (std::uint32_t i = 0; i < stems.size(); ++i)
    if (stems[i].kind != StemKind::root) child_list_[next[stems[i].parent]++] = i;
  for (std::size_t i = 0; i < stems.size(); ++i)
    std::stable_sort(child_list_.begin() + children_[i], child_list_.begin() + children_[i + 1],
                     [&](auto a, auto b) { return stems[a].parent_at < stems[b].parent_at; });
}

std::uint32_t LayoutMaker::sides(std::size_t i) const {
  const Stem& stem = skeleton_.stems[i];
  if (grass()) return 2;
  if (breaks_.pulls_faces() && stem.kind != StemKind::root) return 4;
  const bool vary = breaks_.has(Break::vary_k);
  double k = (vary ? species_.levels[stem.level].sides : species_.ring_size) * detail_.sides;
  k = std::max(3.0, std::round(k));
  if (breaks_.has(Break::huge_rings) && (!vary || stem.level == 0)) k *= 12;
  // The saddle of a welded fork and the patch of an extruded one have two equal halves.
  const bool halves = breaks_.has(Break::welded_forks) || breaks_.has(Break::extruded);
  if (halves) k = std::max(4.0, 2 * std::ceil(k / 2));
  if (halves && stem.kind != StemKind::root) k = std::min<double>(k, layout_.stems[stem.parent].k);
  return static_cast<std::uint32_t>(k);
}

std::size_t LayoutMaker::segments(const Stem& stem) const {
  const Level& level = species_.levels[stem.level];
  if (grass()) return static_cast<std::size_t>(std::max(1.0, std::round(level.segments)));
  double usual = skeleton_.height * level.length;
  for (std::size_t l = 1; l < stem.level; ++l) usual *= species_.levels[l].length * 0.7;
  const double share = std::sqrt(std::clamp(stem.length / usual, 0.02, 2.0));
  // Rounded up or down by the stem's own lot: the mean over many stems follows the detail smoothly.
  const double dither = stem.random.fork(k_dither_key).uniform();
  const double n = std::floor(level.segments * detail_.segments * share + dither);
  return static_cast<std::size_t>(std::max(n, stem.level == 0 ? 3.0 : 1.0));
}

// Where a root's body is wholly above the ground: only its first ring may lie below (digest 000, E41).
double LayoutMaker::ground_parameter(const Stem& stem) const {
  constexpr int k_steps = 512;
  for (int i = 1; i < k_steps / 2; ++i) {
    const double t = static_cast<double>(i) / k_steps;
    const Double3 along = stem_direction(stem, t);
    const double lean = std::hypot(along.x, along.z) + (breaks_.has(Break::rough) ? 0.15 : 0);
    const double tilt = lean * (1.2 + species_.lobe_depth) * stem_radius(species_, stem, t);
    if (stem_position(stem, t).y - tilt > 0.003 * skeleton_.height) return t;
  }
  return 0.5;
}

std::vector<double> LayoutMaker::uniform(const Stem& stem) const {
  std::vector<double> rings;
  double start = 0;
  if (stem.kind == StemKind::root) {
    rings.push_back(0);
    start = ground_parameter(stem);
  } else if (!free()) {
    start = stem.exit;
  }
  const std::size_t n = segments(stem);
  for (std::size_t i = 0; i <= n; ++i)
    rings.push_back(i == n ? 1 : start + (1 - start) * static_cast<double>(i) / static_cast<double>(n));
  return rings;
}

// Gives each child a ring to hang on.
void LayoutMaker::force(std::vector<double>& rings, const Stem& stem,
                        std::span<const std::uint32_t> children) {
  const std::size_t lowest = stem.kind == StemKind::root ? 1 : 0;  // nothing grows under the ground
  const double low = rings[lowest], spacing = rings[lowest + 1] - low;
  for (const std::uint32_t child : children) {
    double at = skeleton_.stems[child].parent_at;
    at = std::clamp(at, low + 0.02 * (1 - low), 1 - 0.02 * (1 - low));
    auto above = static_cast<std::size_t>(std::lower_bound(rings.begin(), rings.end(), at) - rings.begin());
    const std::size_t nearest = at - rings[above - 1] < rings[above] - at ? above - 1 : above;
    if (std::abs(rings[nearest] - at) < k_snap * spacing) {
      join_at_[child] = rings[nearest];
      continue;
    }
    const double gap = rings[above] - rings[above - 1];
    at = std::clamp(at, rings[above - 1] + 0.3 * gap, rings[above] - 0.3 * gap);
    rings.insert(rings.begin() + static_cast<std::ptrdiff_t>(above), at);
    join_at_[child] = at;
  }
}

// A ring of its own for each child that is not an end. Where children crowd they move up, and down again at
// the tip, so that no ring comes nearer to the next than a file can tell.
void LayoutMaker::open_saddles(std::vector<double>& rings, const Stem& stem,
                               std::span<const std::uint32_t> children) {
  if (children.empty()) return;
  const std::size_t lowest = stem.kind == StemKind::root ? 1 : 0;
  const double low = rings[lowest], margin = 0.02 * (1 - low);
  const double room = (1 - low - 2 * margin) / static_cast<double>(children.size());
  const double apart = std::min(k_snap * (rings[lowest + 1] - low), 0.6 * room);
  std::vector<double> at;
  double end = low + margin;
  for (const std::uint32_t child : children) {
    at.push_back(std::max(end, skeleton_.stems[child].parent_at));
    end = at.back() + apart;
  }
  end = 1 - margin;
  for (std::size_t c = children.size(); c-- > 0;) {
    at[c] = std::min(at[c], end);
    end = at[c] - apart;
    join_at_[children[c]] = at[c];
  }
  const auto is_inner = [&](double r) { return r > low && r < rings.back(); };
  const auto gives_way = [&](double r) {
    return is_inner(r) && std::ranges::any_of(at, [&](double c) { return std::abs(c - r) < apart / 2; });
  };
  std::vector<double> result;
  std::ranges::copy_if(rings, std::back_inserter(result), std::not_fn(gives_way));
  result.insert(result.end(), at.begin(), at.end());
  std::ranges::sort(result);
  rings = std::move(result);
}

// Two rings of their own for each child, as far apart as the child is thick, with nothing in between. Where
// children crowd, patches move up, and down again at the tip: there is room for all of them.
void LayoutMaker::open_patches(std::vector<double>& rings, const Stem& stem,
                               std::span<const std::uint32_t> children) {
  if (children.empty()) return;
  const std::size_t lowest = stem.kind == StemKind::root ? 1 : 0;
  const double low = rings[lowest], margin = 0.02 * (1 - low);
  const double room = (1 - low - 2 * margin) / static_cast<double>(children.size());
  std::vector<double> from, size;
  double end = low + margin;
  for (const std::uint32_t child : children) {
    const Stem& s = skeleton_.stems[child];
    size.push_back(std::min(2.2 * s.radius / std::max(1e-9, stem.length), 0.6 * room));
    from.push_back(std::max(end + 0.2 * size.back(), s.parent_at - 0.5 * size.back()));
    end = from.back() + size.back();
  }
  end = 1 - margin;
  for (std::size_t c = children.size(); c-- > 0;) {
    from[c] = std::min(from[c], end - size[c]);
    end = from[c] - 0.2 * size[c];
  }
  std::vector<double> result(rings.begin(), rings.begin() + static_cast<std::ptrdiff_t>(lowest) + 1);
  std::size_t next = result.size();
  for (std::size_t c = 0; c < children.size(); ++c) {
    for (; next < rings.size() && rings[next] < from[c] - 0.2 * size[c]; ++next)
      if (rings[next] > result.back() + 0.2 * size[c]) result.push_back(rings[next]);
    join_at_[children[c]] = from[c];
    result.push_back(from[c]);
    result.push_back(from[c] + size[c]);
    while (next + 1 < rings.size() && rings[next] < result.back() + 0.2 * size[c]) ++next;
  }
  for (; next < rings.size(); ++next) result.push_back(rings[next]);
  rings = std::move(result);
}

void LayoutMaker::lay_stem(std::size_t i) {
  const Stem& stem = skeleton_.stems[i];
  StemLayout& own = layout_.stems[i];
  own.k = sides(i);
  std::vector<double> rings = uniform(stem);
  const auto children = std::span(child_list_).subspan(children_[i], children_[i + 1] - children_[i]);
  if (breaks_.pulls_out()) {
    open_patches(rings, stem, children);
  } else if (free()) {
    std::vector<std::uint32_t> forks;  // only an arm of a fork needs a ring where it begins
    std::ranges::copy_if(children, std::back_inserter(forks),
                         [&](auto c) { return skeleton_.stems[c].kind == StemKind::fork; });
    force(rings, stem, forks);
  } else if (breaks_.has(Break::welded_forks)) {
    open_saddles(rings, stem, children);
  } else {
    force(rings, stem, children);
  }
  own.first = static_cast<std::uint32_t>(layout_.rings.size());
  own.count = static_cast<std::uint32_t>(rings.size());
  layout_.rings.insert(layout_.rings.end(), rings.begin(), rings.end());
  for (const std::uint32_t child : children) {
    const auto ring = std::lower_bound(rings.begin(), rings.end(), join_at_[child]) - rings.begin();
    layout_.stems[child].join = static_cast<std::uint32_t>(ring);
  }
}

std::uint64_t LayoutMaker::count_stem(std::size_t i) const {
  const Stem& stem = skeleton_.stems[i];
  const StemLayout& own = layout_.stems[i];
  const std::uint64_t k = own.k;
  std::uint64_t triangles = (own.count - 1) * band_triangles(own.k);
  if (stem.kind != StemKind::root && !free()) {
    if (breaks_.has(Break::welded_forks)) {
      triangles += 2 * k;
    } else if (breaks_.pulls_out()) {
      triangles += k + 2;  // a band of 2 k, less a patch of k / 2 - 1 quads
      if (breaks_.has(Break::inset_faces)) triangles += 2 * k;
    } else {
      triangles += k + layout_.stems[stem.parent].k;
    }
  }
  if (k == 2) return triangles;
  const std::uint64_t ends = stem.kind == StemKind::root || free() ? 2 : 1;
  if (breaks_.has(Break::capped_fan)) triangles += ends * k;
  if (breaks_.has(Break::capped_ngon)) triangles += ends * (k - 2);
  if (breaks_.has(Break::pointed)) triangles += k;
  if (breaks_.has(Break::collapsed_rings)) triangles += 2 * k;
  return triangles;
}

void LayoutMaker::share_leaves(std::int64_t wanted) {
  const auto& stems = skeleton_.stems;
  const double weight = skeleton_.leaf_weight;
  if (weight <= 0) return;
  const double last = static_cast<double>(species_.levels.size() - 1);
  double bearers = 0, usual = 0;  // stems of the last level, and their leaves at detail 1
  for (const Stem& stem : stems) bearers += stem.level == last ? 1 : 0;
  usual = std::max(1.0, bearers / skeleton_.twigs) * species_.leaves.count;
  const LeafForm form = leaf_form(breaks_);
  double count = std::round(usual * detail_.leaves * form.count);
  if (wanted >= 0) count = static_cast<double>(wanted);
  layout_.leaves = static_cast<std::uint64_t>(count);
  layout_.leaf_scale = std::clamp(1 / std::sqrt(std::max(1.0, count) / (usual * form.count)), 0.02, 3.0);
  double sum = 0;
  std::uint64_t given = 0;
  for (std::size_t i = 0; i < stems.size(); ++i) {
    sum += stems[i].leaf_weight;
    const auto due =
        std::min(layout_.leaves, static_cast<std::uint64_t>(std::floor(sum / weight * count + 0.5)));
    layout_.stems[i].leaves = static_cast<std::uint32_t>(due - given);
    given = due;
  }
  layout_.leaves = given;
}

}  // namespace

LeafForm leaf_form(const Breaks& breaks) {
  using enum Break;
  static const LeafForm k_forms[] = {
      {quad_cards, 2, 1, 1, 1, 1},
      {crossed_cards, 4, 2, 0.6, 1.1, 1.1},
      {bent_cards, 8, 1, 0.6, 1.2, 1.2},
      {two_sided_cards, 4, 2, 1, 1, 1},
      {discs, 6, 1, 1, 1, 1},
      {fronds, 24, 1, 0.2, 2.2, 1.6},
      {needles, 2, 1, 6, 0.7, 0.05},
      {blobs, 80, 1, 0.03, 3.6, 3.6},
  };
  for (const LeafForm& form : k_forms)
    if (breaks.has(form.kind)) return form;
  return {free_tubes, 1, 1, 1.25, 1.2, 1.3};
}

Layout lay_out(const Species& species, const Skeleton& skeleton, const Breaks& breaks, const Detail& detail,
               std::int64_t leaves, std::uint64_t most_triangles) {
  return LayoutMaker(species, skeleton, breaks, detail).run(leaves, most_triangles);
}

std::uint64_t total_triangles(const Layout& layout, const Breaks& breaks) {
  const std::uint64_t clean = layout.trunk_triangles + layout.leaf_triangles;
  return clean + (breaks.has(Break::duplicate_triangles) ? clean / 50 : 0) +
         (breaks.has(Break::degenerate_triangles) ? clean / 50 : 0);
}

}  // namespace copse::grow
