#include "lib/analysis/lod/trunk_radii.h"

#include "lib/analysis/lod/limb_ladder.h"
#include "lib/analysis/lod/limb_leaves.h"
#include "lib/analysis/lod/limb_shape.h"
#include "lib/analysis/lod/ring_places.h"
#include "lib/analysis/lod/spectrum_builder.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <vector>

namespace copse {
namespace {

using Face = std::array<std::uint32_t, 3>;

constexpr double k_golden_angle = 2.399963229728653;
// Of the tree's height: what a twig may go aside under its leaves. At so much they float (floating_leaves),
// and what they are merged to is far worse: with twice as much image errors are up to half larger.
constexpr double k_hold = 0.01;

// An element of one limb. Its life counts rungs of the limb: 0 is full detail, n what the nth rung makes.
struct Piece {
  std::uint32_t limb = 0, birth = 0, death = k_none;
  std::uint32_t material = k_none, radius = k_none;
  std::uint32_t first_face = 0, end_face = 0;
};

// What all limbs are made of. Faces number the trunk's own vertices first, then those that are made.
struct Pieces {
  std::vector<SpectrumVertex> made;
  std::vector<Face> faces;
  std::vector<Piece> pieces;
};

// One limb's tubes, rung after rung. Intervals that a rung leaves as they are keep their pieces.
class LimbTubes {
 public:
  LimbTubes(const Tree& tree, const PartTriangles& trunk, const LimbChain& limb, const LimbShape& shape,
            std::uint32_t number, Pieces& out)
      : tree_(tree), trunk_(trunk), limb_(limb), shape_(shape), number_(number), out_(out) {
    rings_.resize(2 * shape.ring_count());
    for (std::size_t i = 0; i < shape.ring_count(); ++i) {
      centres_.push_back(shape.ring(i).centre), radii_.push_back(shape.ring(i).radius);
      along_.push_back(shape.length_between(0, i));
    }
  }

  // Triangles of full detail.
  std::uint32_t add_full_detail() {
    std::uint32_t full = 0;
    for (std::uint32_t i = 0; i < limb_.segments.size(); ++i) {
      Interval interval{.a = i, .b = i + 1, .first_piece = piece_count()};
      const std::size_t first = tree_.first_triangle_of_segment(limb_.segments[i]),
                        end = std::min(tree_.first_triangle_of_segment(limb_.segments[i] + 1),
                                       trunk_.triangles.size());
      for (std::size_t t = first; t < end; ++t) {
        if (t == first || trunk_.materials[t] != trunk_.materials[t - 1])
          begin(interval, 0, trunk_.materials[t]);
        add(trunk_.triangles[t]);
        ++full;
      }
      interval.end_piece = piece_count();
      now_.push_back(interval);
    }
    return full;
  }

  // Rung `birth` of the ladder takes the place of what is there.
  void take(const LimbRung& rung, std::uint32_t birth) {
    before_.swap(now_), now_.clear();
    auto old = before_.begin();
    const double wider = rung.kept.empty() ? 1 : shape_.wider(rung.kept);
    const std::vector<Double3> shifts = shifts_of(rung);
    for (std::size_t i = 0; i + 1 < rung.kept.size(); ++i) {
      const std::uint32_t a = rung.kept[i], b = rung.kept[i + 1];
      const bool own = is_own(rung, i);
      Interval interval{.a = a,
                        .b = b,
                        .sides = own ? 0 : rung.sides,
                        .wider = own ? 1 : wider,
                        .shifts = {shifts[i], shifts[i + 1]},
                        .first_piece = piece_count()};
      while (old != before_.end() && old->a < a) bury(*old++, birth);
      if (old != before_.end() && old->a == a && old->b == b && old->sides == interval.sides &&
          old->wider == interval.wider && old->shifts == interval.shifts) {
        now_.push_back(*old++);
        continue;
      }
      begin(interval, birth, shape_.material(a));
      add_tube(interval, rung.sides, i + 2 == rung.kept.size());
      interval.end_piece = piece_count();
      now_.push_back(interval);
    }
    while (old != before_.end()) bury(*old++, birth);
  }

 private:
  // Between two rings of the limb.
  struct Interval {
    std::uint32_t a = 0, b = 0, sides = 0;  // sides 0: the mesh's own triangles
    double wider = 1;
    std::array<Double3, 2> shifts{};  // of rings a and b
    std::uint32_t first_piece = 0, end_piece = 0;
  };
  // The vertices of a ring as the interval before or behind it has them.
  struct Ring {
    std::uint32_t sides = 0, first = 0;
    int turned = 0;
    double wider = 1;
    Double3 shift{};
  };

  // Whether what is between two rings that are kept is the mesh's own.
  bool is_own(const LimbRung& rung, std::size_t i) const {
    const std::uint32_t a = rung.kept[i], b = rung.kept[i + 1];
    return b == a + 1 && rung.sides == shape_.sides() && shape_.regular(a);
  }
  // What is welded to the mesh's own triangles stays where it is.
  std::vector<Double3> shifts_of(const LimbRung& rung) const {
    std::vector<std::uint8_t> fixed;
    for (std::size_t i = 0; i < rung.kept.size(); ++i)
      fixed.push_back(rung.sides == shape_.sides() && shape_.is_fork(rung.kept[i]));
    for (std::size_t i = 0; i + 1 < rung.kept.size(); ++i)
      if (is_own(rung, i)) fixed[i] = fixed[i + 1] = 1;
    return ring_shifts({centres_, along_, radii_}, rung.kept, fixed);
  }

  std::uint32_t piece_count() const { return static_cast<std::uint32_t>(out_.pieces.size()); }
  void begin(const Interval& interval, std::uint32_t birth, std::uint32_t material) {
    const auto faces = static_cast<std::uint32_t>(out_.faces.size());
    out_.pieces.push_back({.limb = number_,
                           .birth = birth,
                           .material = material,
                           .radius = limb_.radii[interval.b],
                           .first_face = faces,
                           .end_face = faces});
  }
  void add(const Face& face) {
    out_.faces.push_back(face);
    ++out_.pieces.back().end_face;
  }
  void bury(const Interval& interval, std::uint32_t death) {
    for (std::uint32_t p = interval.first_piece; p < interval.end_piece; ++p) out_.pieces[p].death = death;
  }

  // The golden angle: ribbons of neighbouring limbs face different ways.
  double ribbon_angle() const { return std::fmod(number_ * k_golden_angle, std::numbers::pi); }
  std::uint32_t make(const SpectrumVertex& vertex) {
    out_.made.push_back(vertex);
    return static_cast<std::uint32_t>(trunk_.vertices.size() + out_.made.size() - 1);
  }
  const SpectrumVertex& made(std::uint32_t number) const {
    return out_.made[number - trunk_.vertices.size()];
  }

  // Where the numbers of the vertices of a ring as they are in an interval begin in numbers_; equal vertices
  // of both intervals are shared.
  std::uint32_t ring(std::uint32_t i, std::uint32_t interval, std::uint32_t sides, int turned, double wider,
                     const Double3& shift) {
    Ring& own = rings_[2 * i + (i == interval ? 1 : 0)];
    if (own.sides == sides && own.turned == turned && own.wider == wider && own.shift == shift)
      return own.first;
    own = {sides, static_cast<std::uint32_t>(numbers_.size()), turned, wider, shift};
    const Ring& other = rings_[2 * i + (i == interval ? 0 : 1)];
    const bool alike = other.sides == sides && other.wider == wider && other.shift == shift &&
                       (i == 0 || shape_.width(i, i) == shape_.width(i, i - 1));
    const auto in_other = [&](std::size_t j) {
      const std::int64_t k = sides, at = static_cast<std::int64_t>(j) + turned - other.turned;
      return other.first + static_cast<std::size_t>(at >= 0 && at <= k ? at : (at % k + k) % k);
    };
    scratch_.clear();
    if (alike) {
      for (std::uint32_t j = 0; j < (sides == 2 ? 2 : sides + 1); ++j) {
        scratch_.push_back(made(numbers_[in_other(j)]));
        scratch_.back().texcoord = shape_.ring_texcoord(i, interval, sides, turned, ribbon_angle(), j);
      }
    } else {
      shape_.append_ring(i, interval, sides, turned, ribbon_angle(), wider, scratch_);
      for (SpectrumVertex& v : scratch_) v.position = to_float(to_double(v.position) + shift);
    }
    for (std::size_t j = 0; j < scratch_.size(); ++j) {
      const SpectrumVertex& v = scratch_[j];
      if (j == sides && v.texcoord == scratch_[0].texcoord) {
        numbers_.push_back(numbers_[own.first]);
      } else if (alike && made(numbers_[in_other(j)]) == v) {
        numbers_.push_back(numbers_[in_other(j)]);
      } else {
        numbers_.push_back(make(v));
      }
    }
    return own.first;
  }

  void add_tube(const Interval& interval, std::uint32_t sides, bool last) {
    const std::uint32_t a = interval.a, b = interval.b;
    const double wider = interval.wider;
    if (sides == 1) {
      const auto corners = shape_.spike(ribbon_angle());
      add({make(corners[0]), make(corners[1]), make(corners[2])});
      return;
    }
    const bool point = last && shape_.pointed();
    const std::uint32_t first_low = ring(a, a, sides, 0, wider, interval.shifts[0]),
                        first_high =
                            ring(b, b - 1, sides, shape_.turn(a, b, sides), wider, interval.shifts[1]);
    const auto low = [&](std::uint32_t j) { return numbers_[first_low + j]; };
    const auto high = [&](std::uint32_t j) { return numbers_[first_high + j]; };
    if (sides == 2) {
      add({low(0), low(1), high(0)});
      if (!point) add({low(1), high(1), high(0)});
      return;
    }
    for (std::uint32_t j = 0; j < sides; ++j) {
      add({low(j), low(j + 1), high(j)});
      if (!point) add({low(j + 1), high(j + 1), high(j)});
    }
    for (std::uint32_t j = 1; last && shape_.capped() && j + 1 < sides; ++j)
      add({high(0), high(j), high(j + 1)});
  }

  const Tree& tree_;
  const PartTriangles& trunk_;
  const LimbChain& limb_;
  const LimbShape& shape_;
  std::uint32_t number_;
  Pieces& out_;
  std::vector<Interval> now_, before_;
  std::vector<Double3> centres_;  // of the rings
  std::vector<double> along_, radii_;
  std::vector<Ring> rings_;             // two of every ring: as the interval before it has it, and behind
  std::vector<std::uint32_t> numbers_;  // of vertices
  std::vector<SpectrumVertex> scratch_;
};

// What a limb's ladder costs.
struct Ladder {
  std::vector<LimbRung> rungs;  // without the rings that they keep
  std::uint32_t full = 0;       // triangles
  double thickest = 0;
};

struct Move {
  double slope = 0;
  std::uint32_t limb = 0, rung = 0;
};

std::vector<std::vector<std::uint8_t>> fork_rings(const Tree& tree, const std::vector<LimbChain>& limbs) {
  std::vector<std::uint32_t> children(tree.radius_count(), 0);
  const std::vector<std::uint32_t> parent = parents(tree);
  for (const std::uint32_t p : parent)
    if (p != k_none) ++children[p];
  std::vector<std::vector<std::uint8_t>> forks(limbs.size());
  for (std::size_t l = 0; l < limbs.size(); ++l) {
    for (const std::uint32_t r : limbs[l].radii) forks[l].push_back(children[r] > 1);
  }
  return forks;
}

// All rungs of all limbs, cheapest saving first; a limb's rungs in order, its last one after those of what
// grows from it.
std::vector<Move> order_moves(const std::vector<LimbChain>& limbs, const std::vector<Ladder>& ladders) {
  std::vector<Move> moves;
  std::vector<double> final_slope(limbs.size(), 0);
  std::vector<std::size_t> final_move(limbs.size(), 0);
  for (std::uint32_t l = 0; l < limbs.size(); ++l) {
    double cost = 0, triangles = ladders[l].full, steepest = 0;
    for (std::uint32_t r = 0; r < ladders[l].rungs.size(); ++r) {
      const LimbRung& rung = ladders[l].rungs[r];
      steepest = std::max(steepest, (rung.cost - cost) / (triangles - rung.triangles));
      cost = rung.cost, triangles = rung.triangles;
      final_move[l] = moves.size();
      moves.push_back({steepest, l, r});
    }
    final_slope[l] = steepest;
  }
  for (std::size_t l = limbs.size(); l-- > 0;) {
    if (!ladders[l].rungs.empty()) moves[final_move[l]].slope = final_slope[l];
    const std::uint32_t p = limbs[l].parent;
    if (p != k_none) final_slope[p] = std::max(final_slope[p], final_slope[l]);
  }
  // Of equal slopes the later limb first: what grows from a limb comes after it in the list.
  std::stable_sort(moves.begin(), moves.end(), [](const Move& a, const Move& b) {
    if (a.slope != b.slope) return a.slope < b.slope;
    return a.limb != b.limb ? a.limb > b.limb : a.rung < b.rung;
  });
  return moves;
}

// The thinnest limb first, each with all of its rungs, but none before what grows from it.
void sort_by_diameter(const std::vector<LimbChain>& limbs, const std::vector<Ladder>& ladders,
                      std::vector<Move>& moves) {
  std::vector<double> thickest;
  for (const Ladder& ladder : ladders) thickest.push_back(ladder.thickest);
  for (std::size_t l = limbs.size(); l-- > 0;) {
    const std::uint32_t p = limbs[l].parent;
    if (p != k_none) thickest[p] = std::max(thickest[p], thickest[l]);
  }
  std::stable_sort(moves.begin(), moves.end(), [&](const Move& a, const Move& b) {
    if (thickest[a.limb] != thickest[b.limb]) return thickest[a.limb] < thickest[b.limb];
    return a.limb != b.limb ? a.limb > b.limb : a.rung < b.rung;
  });
}

bool bears_leaves(const Tree& tree, const LimbChain& limb) {
  return std::any_of(limb.radii.begin(), limb.radii.end(), [&](std::uint32_t r) {
    const Radius& radius = tree.hierarchy.radii[r];
    return (radius.flags & Radius::terminal) != 0 && radius.child_count > 0;
  });
}

// What each limb has of the silhouette of all.
std::vector<double> silhouette_shares(const Tree& tree, const std::vector<LimbChain>& limbs) {
  std::vector<double> shares;
  double all = 0;
  for (const LimbChain& limb : limbs) {
    double own = 0;
    for (std::size_t i = 1; i < limb.radii.size(); ++i) {
      const Radius &a = tree.hierarchy.radii[limb.radii[i - 1]], &b = tree.hierarchy.radii[limb.radii[i]];
      own += 0.5 * (double{a.diameter} + b.diameter) * b.distance;
    }
    shares.push_back(own), all += own;
  }
  for (double& s : shares) s = all > 0 ? s / all : 0;
  return shares;
}

Ladder climb(const Tree& tree, const std::vector<Double3>& centres, const PartTriangles& trunk,
             const LimbChain& limb, std::uint32_t number, const std::vector<std::uint8_t>& forks,
             const HangingLeaves& leaves, double share, const TrunkRadiiOptions& options, Pieces& pieces) {
  const LimbShape shape(tree, centres, trunk, limb);
  LimbTubes tubes(tree, trunk, limb, shape, number, pieces);
  Ladder ladder{.rungs = {}, .full = tubes.add_full_detail(), .thickest = 0};
  for (std::size_t i = 0; i < shape.ring_count(); ++i)
    ladder.thickest = std::max(ladder.thickest, shape.ring(i).radius);
  if (ladder.full == 0) return ladder;
  const double vanish = bears_leaves(tree, limb) ? options.vanish_with_leaves : options.vanish;
  ladder.rungs = limb_ladder(shape, forks, ladder.full, vanish, options.order, leaves, share);
  for (std::uint32_t r = 0; r < ladder.rungs.size(); ++r) {
    tubes.take(ladder.rungs[r], r + 1);
    ladder.rungs[r].kept = {};
  }
  return ladder;
}

Spectrum in_order(const PartTriangles& trunk, const Pieces& pieces, const std::vector<Ladder>& ladders,
                  const std::vector<Move>& moves) {
  SpectrumBuilder builder(LodMethod::radii);
  for (const SpectrumVertex& v : trunk.vertices) builder.vertex(v);
  for (const SpectrumVertex& v : pieces.made) builder.vertex(v);
  std::vector<std::uint32_t> first_rung{0}, step;  // of each limb; of each rung, the step that it makes
  for (const Ladder& ladder : ladders)
    first_rung.push_back(first_rung.back() + static_cast<std::uint32_t>(ladder.rungs.size()));
  step.resize(first_rung.back());
  double bound = 0;
  for (const Move& move : moves) {
    bound = std::max(bound, ladders[move.limb].rungs[move.rung].bound);
    builder.step(bound);
    step[first_rung[move.limb] + move.rung] = builder.steps();
  }
  const auto when = [&](const Piece& p, std::uint32_t rung) {
    return rung == 0 || rung == k_none ? rung : step[first_rung[p.limb] + rung - 1];
  };
  for (const Piece& p : pieces.pieces)
    builder.element({when(p, p.birth), when(p, p.death), p.material, p.radius},
                    std::span(pieces.faces).subspan(p.first_face, p.end_face - p.first_face));
  return builder.finish();
}

}  // namespace

Spectrum trunk_by_radii(const Tree& tree, const TrunkRadiiOptions& options) {
  const PartTriangles trunk = trunk_triangles(tree);
  const std::vector<LimbChain> limbs = limb_chains(tree);
  if (limbs.empty()) {
    SpectrumBuilder builder(LodMethod::radii);
    for (const SpectrumVertex& v : trunk.vertices) builder.vertex(v);
    for (std::size_t t = 0; t < trunk.triangles.size(); ++t)
      builder.element(trunk.materials[t], k_none, std::span(&trunk.triangles[t], 1));
    return builder.finish();
  }
  const std::vector<Double3> centres = absolute_centres(tree);
  const auto forks = fork_rings(tree, limbs);
  const auto leaves = limb_leaves(tree, limbs, centres);
  const double hold = tree.header.bounds.empty() ? 0 : k_hold * tree.header.bounds.extent().y;
  Pieces pieces;
  std::vector<Ladder> ladders;
  const std::vector<double> shares = silhouette_shares(tree, limbs);
  for (std::uint32_t l = 0; l < limbs.size(); ++l)
    ladders.push_back(
        climb(tree, centres, trunk, limbs[l], l, forks[l], {leaves[l], hold}, shares[l], options, pieces));
  std::vector<Move> moves = order_moves(limbs, ladders);
  if (options.order == RemovalOrder::diameter) sort_by_diameter(limbs, ladders, moves);
  return in_order(trunk, pieces, ladders, moves);
}

}  // namespace copse
