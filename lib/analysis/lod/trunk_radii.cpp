#include "lib/analysis/lod/trunk_radii.h"

#include "lib/analysis/lod/limb_ladder.h"
#include "lib/analysis/lod/limb_shape.h"
#include "lib/analysis/lod/spectrum_builder.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace copse {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

// A limb while the spectrum is built: which elements stand for it now.
class LimbState {
 public:
  LimbState(const Tree& tree, const std::vector<Double3>& centres, const PartTriangles& trunk,
            const LimbChain& limb, std::uint32_t number)
      : tree_(tree), limb_(limb), shape_(tree, centres, trunk, limb), number_(number) {}

  const LimbShape& shape() const { return shape_; }

  void add_full_detail(const PartTriangles& trunk, SpectrumBuilder& builder) {
    for (std::uint32_t i = 0; i < limb_.segments.size(); ++i) {
      const std::size_t first = tree_.first_triangle_of_segment(limb_.segments[i]),
                        end = std::min(tree_.first_triangle_of_segment(limb_.segments[i] + 1),
                                       trunk.triangles.size());
      for (std::size_t t = first; t < end;) {
        std::size_t run = t;
        while (run < end && trunk.materials[run] == trunk.materials[t]) ++run;
        add(builder, {i, i + 1, 0}, trunk.materials[t],
            {trunk.triangles.begin() + static_cast<std::ptrdiff_t>(t),
             trunk.triangles.begin() + static_cast<std::ptrdiff_t>(run)});
        full_ += static_cast<std::uint32_t>(run - t);
        t = run;
      }
    }
  }
  std::uint32_t full() const { return full_; }

  // Replaces what stands for the limb by the tube of a rung; intervals that stay as they are keep their
  // elements.
  void take(const LimbRung& rung, SpectrumBuilder& builder) {
    std::map<Interval, std::vector<std::uint32_t>> old;
    old.swap(elements_);
    for (std::size_t i = 0; i + 1 < rung.kept.size(); ++i) {
      const std::uint32_t a = rung.kept[i], b = rung.kept[i + 1];
      const bool own = b == a + 1 && rung.sides == shape_.sides() && shape_.regular(a);
      const bool last = i + 2 == rung.kept.size();
      const Interval interval{a, b, own ? 0 : rung.sides};
      if (const auto at = old.find(interval); at != old.end()) {
        elements_.insert(old.extract(at));
      } else {
        add(builder, interval, shape_.material(a), tube(builder, a, b, rung.sides, last));
      }
    }
    for (const auto& [interval, elements] : old) {
      for (const std::uint32_t e : elements) builder.remove(e);
    }
  }

 private:
  struct Interval {
    std::uint32_t a, b, sides;  // sides 0: the mesh's own triangles
    auto operator<=>(const Interval&) const = default;
  };

  void add(SpectrumBuilder& builder, const Interval& interval, std::uint32_t material,
           const Triangles& triangles) {
    elements_[interval].push_back(builder.element(material, limb_.radii[interval.b], triangles));
  }

  // The vertices of a ring as they are in an interval; equal ones of both intervals are shared.
  const std::vector<std::uint32_t>& ring(SpectrumBuilder& builder, std::uint32_t i, std::uint32_t interval,
                                         std::uint32_t sides) {
    std::vector<std::uint32_t>& numbers = rings_[{i, interval, sides}];
    if (!numbers.empty()) return numbers;
    // The golden angle: ribbons of neighbouring limbs face different ways.
    const double angle = std::fmod(number_ * 2.399963229728653, std::numbers::pi);
    const std::vector<SpectrumVertex> vertices = shape_.ring_vertices(i, interval, sides, angle);
    const auto other = rings_.find({i, i == interval ? interval - 1 : i, sides});
    for (std::size_t j = 0; j < vertices.size(); ++j) {
      std::uint32_t same = k_none;
      if (sides > 2 && j + 1 == vertices.size() && vertices[j].texcoord == vertices[0].texcoord)
        same = numbers[0];
      if (other != rings_.end() && same == k_none && made_[other->second[j]] == vertices[j])
        same = other->second[j];
      if (same == k_none) {
        same = builder.vertex(vertices[j]);
        made_[same] = vertices[j];
      }
      numbers.push_back(same);
    }
    return numbers;
  }

  Triangles tube(SpectrumBuilder& builder, std::uint32_t a, std::uint32_t b, std::uint32_t sides, bool last) {
    const bool point = last && shape_.pointed();
    const std::uint32_t n = std::max(sides, 2u);
    const std::vector<std::uint32_t> low = ring(builder, a, a, n), high = ring(builder, b, b - 1, n);
    Triangles out;
    if (sides == 1 || (sides == 2 && point)) {
      out.push_back({low[0], low[1], high[0]});
    } else if (sides == 2) {
      out.push_back({low[0], low[1], high[1]});
      out.push_back({low[0], high[1], high[0]});
    } else {
      for (std::uint32_t j = 0; j < sides; ++j) {
        out.push_back({low[j], low[j + 1], high[j + 1]});
        if (!point) out.push_back({low[j], high[j + 1], high[j]});
      }
      for (std::uint32_t j = 1; last && shape_.capped() && j + 1 < sides; ++j)
        out.push_back({high[0], high[j], high[j + 1]});
    }
    return out;
  }

  const Tree& tree_;
  const LimbChain& limb_;
  LimbShape shape_;
  std::uint32_t number_;
  std::uint32_t full_ = 0;
  std::map<Interval, std::vector<std::uint32_t>> elements_;
  std::map<std::array<std::uint32_t, 3>, std::vector<std::uint32_t>> rings_;
  std::map<std::uint32_t, SpectrumVertex> made_;
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
std::vector<Move> order_moves(const std::vector<LimbChain>& limbs,
                              const std::vector<std::vector<LimbRung>>& ladders,
                              const std::vector<std::uint32_t>& full) {
  std::vector<Move> moves;
  std::vector<double> final_slope(limbs.size(), 0);
  std::vector<std::size_t> final_move(limbs.size(), 0);
  for (std::uint32_t l = 0; l < limbs.size(); ++l) {
    double cost = 0, triangles = full[l], steepest = 0;
    for (std::uint32_t r = 0; r < ladders[l].size(); ++r) {
      const LimbRung& rung = ladders[l][r];
      steepest = std::max(steepest, (rung.cost - cost) / (triangles - rung.triangles));
      cost = rung.cost, triangles = rung.triangles;
      final_move[l] = moves.size();
      moves.push_back({steepest, l, r});
    }
    final_slope[l] = steepest;
  }
  for (std::size_t l = limbs.size(); l-- > 0;) {
    if (!ladders[l].empty()) moves[final_move[l]].slope = final_slope[l];
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
void sort_by_diameter(const std::vector<LimbChain>& limbs, const std::vector<LimbState>& states,
                      std::vector<Move>& moves) {
  std::vector<double> thickest(limbs.size(), 0);
  for (std::size_t l = limbs.size(); l-- > 0;) {
    for (std::size_t i = 0; i < states[l].shape().ring_count(); ++i)
      thickest[l] = std::max(thickest[l], states[l].shape().ring(i).radius);
    const std::uint32_t p = limbs[l].parent;
    if (p != k_none) thickest[p] = std::max(thickest[p], thickest[l]);
  }
  std::stable_sort(moves.begin(), moves.end(), [&](const Move& a, const Move& b) {
    if (thickest[a.limb] != thickest[b.limb]) return thickest[a.limb] < thickest[b.limb];
    return a.limb != b.limb ? a.limb > b.limb : a.rung < b.rung;
  });
}

}  // namespace

Spectrum trunk_by_radii(const Tree& tree, const TrunkRadiiOptions& options) {
  const PartTriangles trunk = trunk_triangles(tree);
  SpectrumBuilder builder(LodMethod::radii);
  for (const SpectrumVertex& v : trunk.vertices) builder.vertex(v);
  const std::vector<LimbChain> limbs = limb_chains(tree);
  if (limbs.empty()) {
    for (std::size_t t = 0; t < trunk.triangles.size(); ++t)
      builder.element(trunk.materials[t], k_none, std::span(&trunk.triangles[t], 1));
    return builder.finish();
  }
  const std::vector<Double3> centres = absolute_centres(tree);
  const auto forks = fork_rings(tree, limbs);
  std::vector<LimbState> states;
  std::vector<std::vector<LimbRung>> ladders(limbs.size());
  std::vector<std::uint32_t> full;
  states.reserve(limbs.size());
  for (std::uint32_t l = 0; l < limbs.size(); ++l) {
    states.emplace_back(tree, centres, trunk, limbs[l], l);
    states[l].add_full_detail(trunk, builder);
    full.push_back(states[l].full());
    if (full[l] > 0)
      ladders[l] = limb_ladder(states[l].shape(), forks[l], full[l], options.vanish, options.order);
  }
  std::vector<Move> moves = order_moves(limbs, ladders, full);
  if (options.order == RemovalOrder::diameter) sort_by_diameter(limbs, states, moves);
  double bound = 0;
  for (const Move& move : moves) {
    const LimbRung& rung = ladders[move.limb][move.rung];
    bound = std::max(bound, rung.bound);
    builder.step(bound);
    states[move.limb].take(rung, builder);
  }
  return builder.finish();
}

}  // namespace copse
