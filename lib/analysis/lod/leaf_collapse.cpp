#include "lib/analysis/lod/leaf_collapse.h"

#include "lib/analysis/lod/crown_field.h"
#include "lib/analysis/lod/hausdorff_errors.h"
#include "lib/analysis/lod/leaf_agglomeration.h"
#include "lib/analysis/lod/leaf_elements.h"
#include "lib/analysis/lod/leaf_matching.h"
#include "lib/analysis/lod/leaf_occlusion.h"
#include "lib/analysis/lod/leaf_pieces.h"
#include "lib/analysis/lod/leaf_shape.h"
#include "lib/analysis/lod/leaf_surfaces.h"
#include "lib/analysis/lod/leaf_twins.h"
#include "lib/analysis/lod/leaf_views.h"
#include "lib/analysis/lod/radius_ancestors.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

namespace copse {
namespace {

using Face = DrawnLeaf::Face;

constexpr double k_prior = 20;    // pixels that the field's word on a leaf is worth
constexpr double k_good = 0.1;    // pixels of change in all views: no better successor is looked for
constexpr double k_layers = 7;    // of leaves, behind which nothing is seen whichever way it lies
constexpr double k_seen = 0.001;  // of its pixels, what a core may change in the picture when it grows
constexpr double k_many = 0.7, k_many_thin = 0.24;  // of the triangles: no pictures before no more are left
constexpr std::size_t k_many_leaves = 2000;         // of fewer each matters more
constexpr double k_too_much = 1.08;                 // coverage at which closed forms end,
constexpr int k_check_views = 2;                    // seen from so many sides
constexpr std::uint64_t k_check_turn = 1u << 20;
constexpr double k_full = 0.25;     // of the merges of a round, where none fits
constexpr double k_doubt = 8;       // pixels that the field's word counts before any picture is drawn
constexpr double k_margin = 0.022;  // of the crown's width, out of its hull

// What a quality spends.
struct Effort {
  double leaf_pixels;  // that a leaf of mean size covers in each view
  double round;        // of the leaves: how many at most go between two drawings
  double sharper;      // pictures are kept until their pixels are so much too small
  int sides;           // to which a leaf may grow
  bool every_pixel;    // of a candidate is looked at
  bool quick;          // closed forms first
};

Effort effort_of(CollapseQuality quality) {
  return quality == CollapseQuality::exact ? Effort{5, 0.12, 1.6, 4, true, false}
                                           : Effort{3, 0.25, 1.6, 2, false, true};
}

int cells_for(std::size_t triangles) {
  return std::clamp(static_cast<int>(2 * std::cbrt(double(triangles))), 8, 64);
}

CrownField field_of(const LeafPieces& pieces, int cells) {
  std::vector<FoliageTriangle> triangles(pieces.part.triangles.size());
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (int c = 0; c < 3; ++c)
      triangles[t].corners[c] = to_double(pieces.part.vertices[pieces.part.triangles[t][c]].position);
    triangles[t].opacity = pieces.opacity_of(t);
  }
  return {triangles, cells > 0 ? cells : cells_for(triangles.size()), k_quick_margin};
}

using Drawn = DrawnLeaf;

// The corners of a leaf while it is moved: no more than a card's.
struct Corners {
  std::array<Double3, 4> at{};
  std::size_t count = 0;
  void push(const Double3& p) { at[count++] = p; }
  std::span<Double3> span() { return std::span(at).first(count); }
  std::span<const Double3> span() const { return std::span(at).first(count); }
};

// What may take the place of two leaves.
struct Successor {
  Drawn drawn;
  std::uint32_t like = k_none;  // the node that it looks like
  double cost = std::numeric_limits<double>::infinity();
};

class Collapse {
 public:
  // `pieces` are what is collapsed, `full` what they are to look like.
  Collapse(const Tree& tree, const Looks& looks, const LeafPieces& pieces, const LeafPieces& full,
           const LeafCollapseOptions& options)
      : pieces_(pieces),
        full_(full),
        looks_(looks),
        options_(options),
        effort_(effort_of(options.quality)),
        field_(field_of(full, options.cells)),
        ancestors_(tree),
        elements_(pieces) {
    shape_.emptiness = options.emptiness;
    shape_.largest = options.largest * field_.cross_section();
    for (const SpectrumVertex& v : full.part.vertices) box_.grow(to_double(v.position));
    for (const SpectrumVertex& v : pieces.part.vertices) box_.grow(to_double(v.position));
    offset_ = box_.empty() ? Double3{} : box_.centre();
  }

  Spectrum run() {
    make_nodes();
    show_source();
    // What is near is looked at one after the other: it meets the same pixels.
    std::vector<Double3> centres;
    for (const Node& n : nodes_) centres.push_back(n.drawn.centre());
    alive_ = curve_order(centres);
    leave_hidden();
    merge_many();
    while (alive_.size() > 1) round();
    return elements_.finish();
  }

 private:
  struct Node {
    std::uint32_t piece = 0;          // whose material and texture it has
    std::uint32_t triangle = k_none;  // of the source, when it is one of a piece's
    std::uint32_t radius = k_none, group = k_none;
    Patch patch;
    Drawn drawn;
    bool core = false;  // took the area of leaves from everywhere
  };
  struct Merge {
    std::vector<std::uint32_t> members;  // places in alive_: the host first
    Successor successor;
    double price = 0;  // a triangle
    bool core = false, fits = true;
  };

  void make_nodes() {
    for (std::uint32_t n = 0; n < elements_.size(); ++n) {
      const std::uint32_t p = elements_.piece(n);
      const auto source = elements_.source(n);
      Node node{.piece = p,
                .triangle = pieces_.list[p].card ? k_none : source.front(),
                .radius = pieces_.list[p].radius,
                .group = pieces_.list[p].group,
                .patch = {},
                .drawn = elements_.drawn(n)};
      for (const std::uint32_t t : source) node.patch += patch(t);
      area_ += node.patch.area;
      nodes_.push_back(node);
    }
  }

  Patch patch(std::uint32_t triangle) const {
    std::array<Double3, 3> corners;
    Double3 shading{};
    for (int c = 0; c < 3; ++c) {
      const SpectrumVertex& v = pieces_.part.vertices[pieces_.part.triangles[triangle][c]];
      corners[c] = to_double(v.position);
      shading += to_double(v.normal) / 3;
    }
    const Double3 middle = (corners[0] + corners[1] + corners[2]) / 3;
    const double seen = field_.exposure(middle), open = field_.at(middle).openness;
    for (Double3& c : corners) c -= offset_;
    Patch p = patch_of(corners, pieces_.opacity_of(triangle), seen);
    p.open = p.area * open, p.shading = shading * p.area, p.up = pieces_.up_of(triangle) * p.area;
    return p;
  }

  // The pieces as the pictures see them.
  void show_source() {
    for (const std::uint32_t t : full_.triangles) source_faces_.push_back(full_.part.triangles[t]);
    for (const LeafPiece& piece : full_.list)
      source_.push_back({full_.part.vertices,
                         std::span(source_faces_).subspan(piece.first, piece.last - piece.first),
                         mask_of(piece.material)});
  }

  const AlphaMask* mask_of(const Node& node) const { return mask_of(pieces_.list[node.piece].material); }
  const AlphaMask* mask_of(std::uint32_t m) const {
    return m < looks_.masks.size() && !looks_.masks[m].opaque.empty() ? &looks_.masks[m] : nullptr;
  }
  ViewedLeaf viewed(const Node& node) const {
    return {node.drawn.vertices(), node.drawn.triangles(), mask_of(node)};
  }

  std::vector<ViewedLeaf> viewed(std::span<const std::uint32_t> nodes) const {
    std::vector<ViewedLeaf> out;
    for (const std::uint32_t n : nodes) out.push_back(viewed(nodes_[n]));
    return out;
  }

  // Of the triangles of full detail those that are drawn.
  double share() const {
    std::size_t triangles = 0;
    for (const std::uint32_t n : alive_) triangles += nodes_[n].drawn.triangles().size();
    return double(triangles) / double(std::max<std::size_t>(1, full_.triangles.size()));
  }

  // What no one misses leaves, and comes back, merged, when fewer leaves are needed than that would take.
  void leave_hidden() {
    if (alive_.size() < 2 || share() <= Occlusion::k_least) return;
    std::vector<float> prior;
    for (const std::uint32_t n : alive_) {
      const Patch& p = nodes_[n].patch;
      prior.push_back(
          area_ > 0 ? float(k_doubt * (p.open + options_.other * p.visible) * double(alive_.size()) / area_)
                    : 0.0f);
    }
    const Occlusion o =
        leaves_by_occlusion(viewed(alive_), offset_, 0.55 * length(box_.extent()), box_,
                            {.samples = 8 * effort_.leaf_pixels,
                             .other = options_.other,
                             .coverage = Occlusion::k_coverage,
                             .least = 1 + std::size_t(Occlusion::k_least * double(full_.triangles.size())),
                             .prior = prior});
    if (o.gone.empty()) return;
    double triangles = 0;
    std::vector<std::uint32_t> together;
    for (std::size_t i = 0; i < o.gone.size(); ++i) {
      const std::uint32_t n = alive_[o.gone[i]];
      triangles += double(nodes_[n].drawn.triangles().size()), together.push_back(n);
      if (i + 1 < o.gone.size() && o.step(i + 1) == o.step(i)) continue;
      std::sort(together.begin(), together.end());
      elements_.remove(together), together.clear();
    }
    elements_.hold(alive_, (share() * double(full_.triangles.size()) - triangles) * Occlusion::k_shown);
    left_ = share() - triangles / double(full_.triangles.size());
    see_as_source(o);
  }

  // What stays shows what all leaves do, and is drawn sooner.
  void see_as_source(const Occlusion& o) {
    std::vector<std::uint8_t> gone(alive_.size(), 0);
    for (const std::uint32_t leaf : o.gone) gone[leaf] = 1;
    source_.clear(), source_faces_.clear();
    std::vector<std::size_t> first;
    for (std::size_t i = 0; i < alive_.size(); ++i) {
      first.push_back(source_faces_.size());
      if (gone[i] == 0)
        for (const std::uint32_t t : elements_.source(alive_[i]))
          source_faces_.push_back(pieces_.part.triangles[t]);
    }
    first.push_back(source_faces_.size());
    for (std::size_t i = 0; i < alive_.size(); ++i)
      if (gone[i] == 0)
        source_.push_back({pieces_.part.vertices,
                           std::span(source_faces_).subspan(first[i], first[i + 1] - first[i]),
                           mask_of(nodes_[alive_[i]])});
  }

  // Of leaves that closed forms have made, as pictures see them that are as fine as the first of them.
  double coverage_of(std::span<const QuickMerges::Leaf> leaves, std::optional<LeafViews>& views) const {
    std::vector<ViewedLeaf> all;
    for (const QuickMerges::Leaf& l : leaves)
      all.push_back({l.drawn.vertices(), l.drawn.triangles(), mask_of(nodes_[l.node])});
    if (!views) {
      const double pixel = std::sqrt(area_ / (2 * effort_.leaf_pixels * double(leaves.size())));
      views.emplace(offset_, 0.55 * length(box_.extent()), std::isfinite(pixel) ? pixel : 0, k_check_turn,
                    k_check_views, box_);
      views->set_source(source_);
    }
    views->look(all);
    return views->coverage();
  }

  // As long as there are many, pictures say no more than closed forms: in a crown that hides little, longer.
  void merge_many() {
    const auto many = std::size_t((left_ > 0.5 ? k_many_thin : k_many) * double(full_.triangles.size()));
    if (!effort_.quick || alive_.size() < k_many_leaves || pieces_.triangles.size() <= many) return;
    std::optional<LeafViews> views;
    const auto good = [&](std::span<const QuickMerges::Leaf> left) {
      return coverage_of(left, views) <= k_too_much;
    };
    QuickMerges merges = merge_quickly(pieces_, field_, ancestors_, elements_, many, good);
    std::vector<Patch> sums(nodes_.size());
    for (std::uint32_t n = 0; n < nodes_.size(); ++n) sums[merges.host[n]] += nodes_[n].patch;
    alive_.clear();
    for (QuickMerges::Leaf& l : merges.leaves) {
      Node& node = nodes_[l.node];
      node.patch = sums[l.node], node.radius = l.radius, node.group = l.group;
      node.drawn = l.drawn;
      alive_.push_back(l.node);
    }
  }

  // Pictures as fine as the leaves that are left, so that a round costs what they are many.
  void sharpen() {
    double area = 0;
    for (const std::uint32_t n : alive_) area += nodes_[n].patch.area;
    mean_area_ = area / double(alive_.size());
    const double pixel = std::sqrt(area / (2 * effort_.leaf_pixels * double(alive_.size())));
    if (views_ && !(pixel > effort_.sharper * asked_)) return;
    asked_ = std::isfinite(pixel) ? pixel : 0;
    // Of very many leaves each matters less.
    const int views = effort_.every_pixel || alive_.size() < k_many_leaves ? LeafViews::k_most_views : 6;
    views_.emplace(offset_, 0.55 * length(box_.extent()), asked_, turns_++, views, box_);
    views_->set_source(source_);
  }

  void round() {
    sharpen();
    const std::vector<LeafViews::Count> counts = views_->look(viewed(alive_));
    weigh(views_->coverage());
    std::vector<MatchLeaf> leaves;
    vanish_.clear();
    for (std::size_t i = 0; i < alive_.size(); ++i) {
      const Node& n = nodes_[alive_[i]];
      const Patch& p = n.patch;
      // Few pixels say little: what the field says counts as some more of them.
      const double covered = std::max<double>(counts[i].total, 0.5), sure = 1 / (covered + k_prior);
      const double open = p.area > 0 ? p.open / p.area : 1, seen = p.opaque > 0 ? p.visible / p.opaque : 1;
      leaves.push_back({n.drawn.centre(), facing(p), p.area, covered,
                        covered * sure * (counts[i].sole + k_prior * open),
                        covered * sure * (0.5 * counts[i].seen + k_prior * seen), n.group});
      vanish_.push_back(counts[i].sole + options_.other * (0.5 * counts[i].seen - counts[i].sole));
    }
    weights_.room = room(counts);
    weights_.holds = [&](std::uint32_t i) { return held(i); };
    if (full_up_) weights_.cores = 0;
    // Of very many leaves more at a time: each of them matters less.
    const double most = effort_.round * std::clamp(std::sqrt(double(alive_.size()) / 1e4), 1.0, 2.0);
    weights_.most = std::max<std::size_t>(1, std::size_t(most * double(alive_.size())));
    std::vector<LeafMatch> matches = match_leaves(leaves, weights_);
    std::sort(matches.begin(), matches.end(),
              [](const LeafMatch& x, const LeafMatch& y) { return x.host < y.host; });
    std::vector<Merge> merges(matches.size());
    if (effort_.every_pixel)
      judge<LeafViews::Exchange>(matches, merges);
    else
      judge<LeafViews::Estimate>(matches, merges);
    std::stable_sort(merges.begin(), merges.end(),
                     [](const Merge& x, const Merge& y) { return x.price < y.price; });
    // The cheapest, with three in four of all that would go.
    std::size_t guests = 0, kept = 0;
    for (const Merge& m : merges) guests += m.members.size() - 1;
    for (std::size_t gone = 0; kept < merges.size() && 4 * gone < 3 * guests; ++kept)
      gone += merges[kept].members.size() - 1;
    merges.resize(kept);
    // What does not fit waits: it may fit with another.
    const auto late =
        std::stable_partition(merges.begin(), merges.end(), [](const Merge& m) { return m.fits; });
    full_up_ = late == merges.begin();
    const auto some = static_cast<std::ptrdiff_t>(std::max<double>(1, k_full * double(merges.size())));
    merges.erase(late != merges.begin() ? late : merges.begin() + some, merges.end());
    for (Merge& m : merges) apply(m);
    std::erase(alive_, k_none);
    elements_.show_at(alive_.size() == 1 ? 0 : share() * double(full_.triangles.size()));
  }

  template <class Judge>
  void judge(std::span<const LeafMatch> matches, std::vector<Merge>& merges) const {
    tbb::enumerable_thread_specific<Judge> judges([&] { return Judge(*views_); });
    tbb::parallel_for(std::size_t{0}, matches.size(),
                      [&](std::size_t i) { merges[i] = merge_of(matches[i], judges.local()); });
  }

  // What the cores may still take: of a crown in which leaves hide one another k_layers times over, nothing.
  double room(std::span<const LeafViews::Count> counts) {
    double covered = 0, seen = 0, area = 0, hidden = 0;
    for (const LeafViews::Count& c : counts) covered += c.total, seen += 0.5 * c.seen;
    if (hidden_share_ < 0) hidden_share_ = covered > 0 ? std::max(0.0, 1 - k_layers * seen / covered) : 0;
    for (const std::uint32_t n : alive_) {
      area += nodes_[n].patch.area;
      if (nodes_[n].core) hidden += nodes_[n].patch.area;
    }
    return hidden_share_ * area - hidden;
  }

  // Coverage is held where it was: the more there is too much of it, the less may be gained.
  void weigh(double coverage) {
    const double too_much = std::clamp(20 * (coverage - 1), -1.0, 1.0);
    weights_.window = options_.window, weights_.largest = shape_.largest, weights_.other = options_.other;
    weights_.lost = 1 - too_much, weights_.gained = 1 + too_much;
  }

  static Double3 facing(const Patch& p) {
    if (!(p.area > 0)) return {0, 1, 0};
    const auto& m = p.facing.m;
    const std::array<Double3, 3> columns{{{m[0], m[3], m[4]}, {m[3], m[1], m[5]}, {m[4], m[5], m[2]}}};
    const Double3* best = &columns[0];
    for (const Double3& c : columns)
      if (dot(c, c) > dot(*best, *best)) best = &c;
    const Double3 n = normalized(*best);
    return n * std::sqrt(std::clamp(p.facing.along(n) / p.area, 0.0, 1.0));
  }

  double limit(double area) const { return shape_.largest > 0 ? std::min(area, shape_.largest) : area; }

  // The best that can take the place of the alive leaves of a match.
  template <class Judge>
  Merge merge_of(const LeafMatch& match, Judge& judge) const {
    Merge out{{match.host}, {}, 0, match.core};
    out.members.insert(out.members.end(), match.guests.begin(), match.guests.end());
    Patch sum;
    std::vector<ViewedLeaf> gone;
    double triangles = 0, vanish = 0;
    const Node* look = nullptr;
    for (const std::uint32_t m : out.members) {
      const Node& n = nodes_[alive_[m]];
      sum += n.patch, triangles += double(n.drawn.triangles().size());
      if (look == nullptr || n.patch.visible > look->patch.visible) look = &n;
      // What comes to a core from everywhere is not looked at again: what it shows is known.
      if (match.core && m != match.host)
        vanish += vanish_[m];
      else
        gone.push_back(viewed(n));
    }
    judge.remove(std::span(out.members).first(gone.size()), gone);
    const double area = limit(sum.area);
    const auto consider = [&](Successor s, const Node& like) {
      s.cost = cost(s, like, judge) + missing(s.drawn, area);
      if (s.cost < out.successor.cost) out.successor = std::move(s);
      return out.successor.cost < k_good;
    };
    bool good = false;
    // First about their centres; the vertices of the better one tell to which side it should grow.
    const auto grow = [&](std::uint32_t k, std::uint32_t about) {
      const Node& n = nodes_[alive_[k]];
      if (good || n.drawn.frond != nullptr) return;
      if (std::optional<Drawn> d = grown(n, area, about)) good = consider({std::move(*d), k}, n);
    };
    grow(match.host, 0);
    if (gone.size() == 2) grow(match.guests.front(), 0);
    const std::uint32_t better = out.successor.like == k_none ? match.host : out.successor.like;
    for (const std::uint32_t about : sides(nodes_[alive_[better]].drawn, sum.centre() + offset_))
      if (about != 0) grow(better, about);
    if (!good && !match.core) {
      good = consider(between(sum, *look), *look);
      const Node& like = out.successor.like == k_none ? *look : nodes_[alive_[out.successor.like]];
      if (!good && sum.area > 6 * mean_area_) search(out.successor, like, area, judge);
    }
    if (out.successor.drawn.corners == 0) consider(between(sum, *look), *look);
    // Where nothing larger fits into the hull, no cut one should lose more than the one that goes.
    const auto keep = [&](std::uint32_t k) {
      const Node& n = nodes_[alive_[k]];
      if (n.drawn.frond == nullptr && out.successor.drawn.area() < n.drawn.area()) consider({n.drawn, k}, n);
    };
    keep(match.host);
    if (gone.size() == 2) keep(match.guests.front());
    out.successor.cost += vanish;
    out.fits = out.successor.drawn.area() > 0.99 * area;
    out.price = out.successor.cost / std::max(triangles - double(out.successor.drawn.faces), 0.5);
    return out;
  }

  // The vertices (from 1 on) about which it may grow, those first that let it grow toward `goal`; 0: no more.
  std::array<std::uint32_t, 4> sides(const Drawn& drawn, const Double3& goal) const {
    std::array<std::uint32_t, 4> out{};
    if (drawn.frond != nullptr) return out;
    const Double3 c = drawn.centre();
    std::array<double, 4> toward{};
    for (std::uint32_t k = 0; k < drawn.corners; ++k) {
      const double along = dot(to_double(drawn.corner[k].position) - c, goal - c);
      std::uint32_t at = k;
      for (; at > 0 && along < toward[at - 1]; --at) toward[at] = toward[at - 1], out[at] = out[at - 1];
      toward[at] = along, out[at] = k + 1;
    }
    for (int k = effort_.sides; k < 4; ++k) out[k] = 0;
    return out;
  }

  // The area that an alive leaf can grow to without being seen to, within the crown's hull.
  double held(std::uint32_t place) const {
    const Node& node = nodes_[alive_[place]];
    if (node.drawn.frond != nullptr) return 0;
    LeafViews::Estimate judge(*views_);
    const ViewedLeaf gone = viewed(node);
    judge.remove(std::span(&place, 1), std::span(&gone, 1));
    const double per_area = views_->views() / (2 * views_->pixel() * views_->pixel());
    const auto fits = [&](double area) {
      for (std::uint32_t about = 0; about <= node.drawn.corners; ++about) {
        std::optional<Drawn> d = grown(node, area, about);
        if (d && cost({std::move(*d), place}, node, judge) < k_seen * area * per_area) return true;
      }
      return false;
    };
    double low = node.patch.area, high = std::max(shape_.largest, low);
    for (int i = 0; i < 5; ++i) {
      const double middle = std::sqrt(low * high);
      (fits(middle) ? low : high) = middle;
    }
    return low;
  }

  // What the area costs that a successor lacks: as much as if all of it was to be seen.
  double missing(const Drawn& drawn, double area) const {
    const double pixel = views_->pixel();
    return views_->views() * std::max(area - drawn.area(), 0.0) / (2 * pixel * pixel);
  }

  template <class Judge>
  double cost(const Successor& s, const Node& like, Judge& judge) const {
    const LeafViews::Change c = judge.add({s.drawn.vertices(), s.drawn.triangles(), mask_of(like)}, s.like);
    return c.covered + weights_.other * c.other;
  }

  // Compass search: moves, turns and stretches a large leaf to where it does least harm.
  template <class Judge>
  void search(Successor& best, const Node& like, double area, Judge& judge) const {
    double step = 1;
    for (int round = 0; round < 4; ++round) {
      const double before = best.cost;
      for (int way = 0; way < 14; ++way) {
        std::optional<Drawn> d = varied(best.drawn, way / 2, way % 2 != 0 ? -step : step);
        if (!d) continue;
        Successor s{std::move(*d), best.like};
        s.cost = cost(s, like, judge) + missing(s.drawn, area);
        if (s.cost < best.cost) best = std::move(s);
      }
      if (best.cost >= before) step /= 2;
    }
  }

  // 0-2: moved along an axis, 3-5: turned about one, 6: stretched.
  std::optional<Drawn> varied(const Drawn& drawn, int what, double step) const {
    Drawn out = drawn;
    const Double3 c = drawn.centre();
    const double size = std::sqrt(drawn.area());
    const auto corner = [&](int k) { return to_double(drawn.corner[drawn.face[0][k]].position); };
    const Double3 u = normalized(corner(1) - corner(0));
    const Double3 n = normalized(cross(u, corner(2) - corner(0)));
    const std::array<Double3, 3> axes{u, cross(n, u), n};
    Double3 move{};
    if (what < 3) move = axes[what] * (0.35 * step * size);
    const Double3 &p = axes[(what + 1) % 3], &q = axes[(what + 2) % 3];
    const double cosine = std::cos(0.5 * step), sine = std::sin(0.5 * step), stretch = std::exp(0.3 * step);
    const auto turned = [&](const Double3& v) {
      const double x = dot(v, p), y = dot(v, q);
      return v + p * (x * (cosine - 1) - y * sine) + q * (x * sine + y * (cosine - 1));
    };
    const auto stretched = [&](const Double3& v) {
      return v + axes[0] * (dot(v, axes[0]) * (stretch - 1)) +
             axes[1] * (dot(v, axes[1]) * (1 / stretch - 1));
    };
    Corners corners;
    for (SpectrumVertex& v : out.own()) {
      const Double3 r = to_double(v.position) - c;
      corners.push(c + (what < 3 ? r + move : what < 6 ? turned(r) : stretched(r)));
      if (what >= 3 && what < 6) v.normal = to_float(normalized(turned(to_double(v.normal))));
    }
    if (!inside(corners.span())) return {};
    for (std::size_t i = 0; i < corners.count; ++i) out.corner[i].position = to_float(corners.at[i]);
    return out;
  }

  Double3 way_back(std::span<const Double3> corners) const {
    return field_.hull().way_back(corners, k_margin * field_.hull().width());
  }
  bool inside(std::span<const Double3> corners) const { return field_.hull().fits(corners, 1.1 * k_margin); }

  // The leaf itself, grown about its centre (0) or one of its vertices (1, ...).
  // Nothing when it does not fit into the crown's hull.
  std::optional<Drawn> grown(const Node& node, double area, std::uint32_t about) const {
    Drawn out = node.drawn;
    const double now = out.area();
    const Double3 fixed = about == 0 ? out.centre() : to_double(out.corner[about - 1].position);
    const double by = now > 0 ? std::sqrt(area / now) : 1;
    Corners corners;
    for (const SpectrumVertex& v : out.own()) corners.push(fixed + (to_double(v.position) - fixed) * by);
    const auto move = field_.hull().move_in(corners.span(), 1.1 * k_margin, k_margin);
    if (!move) return {};
    for (Double3& c : corners.span()) c += *move;
    for (std::size_t c = 0; c < corners.count; ++c) out.corner[c].position = to_float(corners.at[c]);
    return out;
  }

  // What fits nowhere is cut to what does.
  void fit(std::span<Double3> corners) const {
    constexpr double k_cut = 0.96;
    for (int tries = 0; tries < 40 && !inside(corners); ++tries) {
      Double3 centre{};
      for (const Double3& c : corners) centre += c / double(corners.size());
      for (Double3& c : corners) c = centre + (c - centre) * k_cut;
      const Double3 back = way_back(corners);
      for (Double3& c : corners) c += back;
    }
  }

  Successor between(const Patch& sum, const Node& look) const {
    ShapeOptions options = shape_;
    options.card = pieces_.list[look.piece].cut == LeafCut::card;
    options.textured = pieces_.list[look.piece].card;
    const LeafShape shape = leaf_shape(sum, &field_, offset_, options);
    const bool agree = dot(sum.shading, sum.shading) > 0.25 * sum.area * sum.area;
    const Double3 faces = dot(shape.normal, sum.shading) < 0 ? -shape.normal : shape.normal;
    const std::uint32_t triangle =
        look.triangle == k_none ? pieces_.triangles[pieces_.list[look.piece].first] : look.triangle;
    std::array<Double3, 4> corners = shape.corners;
    fit(std::span(corners).first(options.card ? 4 : 3));
    Successor out;
    out.drawn =
        leaf_of_shape(pieces_, look.piece, triangle, corners, agree ? normalized(sum.shading) : faces);
    return out;
  }

  // One leaf after the other joins the first, which grows toward what it is to be in the end.
  void apply(const Merge& merge) {
    const std::uint32_t host = alive_[merge.members.front()];
    std::uint32_t look = host;
    gone_.clear();
    for (const std::uint32_t m : merge.members) {
      const std::uint32_t n = alive_[m];
      if (nodes_[n].patch.visible > nodes_[look].patch.visible) look = n;
      gone_.push_back(n), alive_[m] = k_none;
    }
    if (merge.successor.like != k_none)
      look = gone_[std::find(merge.members.begin(), merge.members.end(), merge.successor.like) -
                   merge.members.begin()];
    Node node = nodes_[look];
    node.core = merge.core || nodes_[host].core;
    node.patch = {}, node.radius = nodes_[host].radius, node.group = nodes_[host].group;
    for (const std::uint32_t n : gone_) {
      node.patch += nodes_[n].patch;
      node.radius = ancestors_.common(node.radius, nodes_[n].radius);
      if (nodes_[n].group != node.group) node.group = k_none;
    }
    node.drawn = merge.successor.drawn;
    elements_.merge(gone_, node.drawn, pieces_.list[node.piece].material, node.radius);
    nodes_[host] = node, alive_[merge.members.front()] = host;
  }

  const LeafPieces &pieces_, &full_;
  Looks looks_;
  LeafCollapseOptions options_;
  Effort effort_;
  CrownField field_;
  RadiusAncestors ancestors_;
  LeafElements elements_;
  ShapeOptions shape_;
  MatchOptions weights_;
  DoubleBox box_;
  Double3 offset_;
  std::vector<Face> source_faces_;  // piece after piece
  std::vector<ViewedLeaf> source_;
  std::optional<LeafViews> views_;
  double left_ = 1;  // of the triangles, when what no one misses has left
  double area_ = 0;  // m², of all leaves
  double asked_ = 0, mean_area_ = 0, hidden_share_ = -1;
  std::uint64_t turns_ = 0;
  bool full_up_ = false;  // no leaf fits any larger: none takes more from everywhere
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> gone_;
  std::vector<std::uint32_t> alive_;
  std::vector<double> vanish_;  // what each alive leaf costs when it vanishes, pixels
};

}  // namespace

Spectrum collapse_spectrum(const Tree& tree, const Looks& looks, const LeafCollapseOptions& options,
                           CollapsedLumps* report) {
  const LeafPieces all = leaf_pieces(tree);
  const std::optional<LeafTwins> twins = part_twins(all);
  const LeafPieces& pieces = twins ? twins->left : all;
  const auto collapse = [&](const LeafPieces& some) {
    return options.quality == CollapseQuality::fast
               ? agglomerate_leaves(tree, looks, some, pieces.triangles.size())
               : Collapse(tree, looks, some, pieces, options).run();
  };
  const std::optional<SurfaceCollapse> lumps = collapse_surfaces(pieces);
  if (report != nullptr && lumps)
    *report = {.lumps = lumps->lumps,
               .triangles = lumps->triangles,
               .left = static_cast<std::uint32_t>(lumps->left.triangles.size()),
               .share = lumps->share};
  Spectrum s = lumps ? joined(lumps->spectrum, collapse(lumps->left)) : collapse(pieces);
  if (report != nullptr && twins) report->twins = static_cast<std::uint32_t>(twins->gone.size());
  if (twins) s = twins_first(all, *twins, s);
  if (options.errors) s.errors = hausdorff_errors(s);
  return s;
}

}  // namespace copse
