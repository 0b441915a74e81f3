#include "lib/analysis/skeleton/skeleton_limbs.h"

#include "lib/analysis/surface/components.h"
#include "lib/analysis/surface/welded_tolerances.h"
#include "lib/formats/material.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace copse {

namespace {

using Edge = std::pair<std::uint32_t, std::uint32_t>;

class LimbFinder {
 public:
  explicit LimbFinder(const CurveSkeleton& k) : k_(k), n_(static_cast<std::uint32_t>(k.points.size())) {}

  Limbs find() {
    Limbs limbs;
    if (n_ == 0) return limbs;
    span();
    orient(find_root());
    measure();
    limbs.kept_node.assign(n_, k_none);
    build(limbs);
    for (const std::uint32_t v : order_) {  // spurs go where they start
      if (limbs.kept_node[v] == k_none) limbs.kept_node[v] = limbs.kept_node[parent_[v]];
    }
    return limbs;
  }

 private:
  // A spanning tree of the thickest edges.
  void span() {
    std::vector<std::uint32_t> order(k_.edges.size());
    std::iota(order.begin(), order.end(), 0u);
    const auto thickness = [&](std::uint32_t e) {
      return std::min(k_.radii[k_.edges[e].first], k_.radii[k_.edges[e].second]);
    };
    std::ranges::stable_sort(order, [&](auto a, auto b) { return thickness(a) > thickness(b); });
    UnionFind sets(n_);
    std::vector<Edge> tree;
    for (const std::uint32_t e : order) {
      const auto [a, b] = k_.edges[e];
      if (sets.find(a) == sets.find(b)) continue;
      sets.unite(a, b);
      tree.push_back(k_.edges[e]);
    }
    const std::size_t edges = tree.size();
    for (std::size_t i = 0; i < edges; ++i) tree.emplace_back(tree[i].second, tree[i].first);
    neighbours_ = make_lists(tree, n_);
  }

  // How thick the limb is that ends here: the widest place within its own radius of the end.
  double thickness_at(std::uint32_t end) const {
    double widest = k_.radii[end], way = 0;
    std::uint32_t last = k_none, v = end;
    while (neighbours_[v].size() <= 2) {
      std::uint32_t next = k_none;
      for (const std::uint32_t w : neighbours_[v]) {
        if (w != last) next = w;
      }
      if (next == k_none) break;
      way += distance(k_.points[v], k_.points[next]);
      last = v, v = next;
      widest = std::max(widest, k_.radii[v]);
      if (way > 2 * widest) break;
    }
    return widest;
  }

  std::uint32_t find_root() const {
    DoubleBox box;
    double widest = std::numeric_limits<double>::min();
    for (std::uint32_t v = 0; v < n_; ++v) {
      box.grow(k_.points[v]);
      widest = std::max(widest, k_.radii[v]);
    }
    const double height = std::max(box.extent().y, std::numeric_limits<double>::min());
    using Rank = std::array<double, 4>;  // higher is better
    std::uint32_t best = k_none;
    Rank best_rank{};
    for (std::uint32_t v = 0; v < n_; ++v) {
      if (neighbours_[v].size() > 1 && v != k_.base) continue;
      const Double3& p = k_.points[v];
      const double thickness = thickness_at(v);
      const double score = thickness / widest - k_lowness * (p.y - box.min.y) / height;
      const Rank rank{score, thickness, -p.x, -p.z};
      if (best == k_none || rank > best_rank) best_rank = rank, best = v;
    }
    return best;
  }

  void orient(std::uint32_t root) {
    parent_.assign(n_, k_none);
    order_ = {root};
    for (std::size_t i = 0; i < order_.size(); ++i) {
      for (const std::uint32_t w : neighbours_[order_[i]]) {
        if (w != parent_[order_[i]]) parent_[w] = order_[i], order_.push_back(w);
      }
    }
  }

  // The longest way from each node to a tip and the child that it leads through; then the child that carries
  // on the limb.
  void measure() {
    reach_.assign(n_, 0);
    std::vector<std::uint32_t> longest(n_, k_none);
    for (std::size_t i = n_; i-- > 1;) {
      const std::uint32_t v = order_[i], p = parent_[v];
      const double way = reach_[v] + distance(k_.points[v], k_.points[p]);
      if (longest[p] == k_none || way > reach_[p]) reach_[p] = way, longest[p] = v;
    }
    next_ = longest;
    for (const std::uint32_t v : order_) {
      if (neighbours_[v].size() > (parent_[v] == k_none ? 1u : 2u)) next_[v] = best_continuation(v, longest);
    }
  }

  // The node a stretch of the way before a fork.
  std::uint32_t node_before(std::uint32_t fork, double stretch) const {
    std::uint32_t v = fork;
    for (double way = 0; parent_[v] != k_none && way < stretch; v = parent_[v]) {
      way += distance(k_.points[v], k_.points[parent_[v]]);
    }
    return v;
  }

  // The thickest and straightest of the limbs that start at a fork, over their first stretch; one that is too
  // short to be called a limb counts for less.
  std::uint32_t best_continuation(std::uint32_t fork, const std::vector<std::uint32_t>& longest) const {
    const double stretch = k_fork_stretch * k_.radii[fork];
    const std::uint32_t from = node_before(fork, stretch);
    const Double3 forward = normalized(k_.points[fork] - k_.points[from], {});
    std::uint32_t best = k_none;
    double best_score = -1;
    for (const std::uint32_t w : neighbours_[fork]) {
      if (w == parent_[fork]) continue;
      const double first = distance(k_.points[fork], k_.points[w]);
      double sum = 0, way = first;
      std::size_t count = 0;
      std::uint32_t v = w;
      for (;; v = longest[v]) {
        sum += k_.radii[v], ++count;
        if (longest[v] == k_none || way > stretch) break;
        way += distance(k_.points[v], k_.points[longest[v]]);
      }
      const double thickness =
          std::min(sum / static_cast<double>(count), (reach_[w] + first) / k_limb_length);
      const double bend = dot(forward, normalized(k_.points[v] - k_.points[from], forward));
      const double score = thickness * (1 + k_straightness * bend);
      if (score > best_score) best_score = score, best = w;
    }
    return best;
  }

  void build(Limbs& limbs) const {
    struct Start {
      std::uint32_t base, first, limb, at;  // runs from base (on limb `limb`, its node `at`) through first
    };
    std::vector<Start> starts{{order_[0], next_[order_[0]], k_none, 0}};
    for (std::size_t i = 0; i < starts.size(); ++i) {
      const Start s = starts[i];
      const auto id = static_cast<std::uint32_t>(limbs.limbs.size());
      Limb limb{{s.base}, s.limb, s.at};
      for (std::uint32_t v = s.first; v != k_none; v = next_[v]) limb.nodes.push_back(v);
      for (std::size_t j = s.limb == k_none ? 0 : 1; j < limb.nodes.size(); ++j) {
        const std::uint32_t v = limb.nodes[j];
        limbs.kept_node[v] = v;
        for (const std::uint32_t w : neighbours_[v]) {
          if (w == parent_[v] || w == next_[v]) continue;
          const double way = reach_[w] + distance(k_.points[w], k_.points[v]);
          if (way > k_spur_reach * thickness_near(limb, j)) {
            starts.push_back({v, w, id, static_cast<std::uint32_t>(j)});
          }
        }
      }
      limbs.limbs.push_back(std::move(limb));
    }
  }

  // The limb's radius at a node: the median of its neighbours', as slices at forks are torn.
  double thickness_near(const Limb& limb, std::size_t at) const {
    const std::size_t from = at >= 3 ? at - 3 : 0, to = std::min(limb.nodes.size(), at + 4);
    std::vector<double> near;
    for (std::size_t i = from; i < to; ++i) near.push_back(k_.radii[limb.nodes[i]]);
    std::ranges::nth_element(near, near.begin() + static_cast<std::ptrdiff_t>(near.size() / 2));
    return near[near.size() / 2];
  }

  const CurveSkeleton& k_;
  std::uint32_t n_;
  Lists neighbours_;
  std::vector<std::uint32_t> parent_, order_, next_;
  std::vector<double> reach_;
};

}  // namespace

Limbs find_limbs(const CurveSkeleton& skeleton) {
  return LimbFinder(skeleton).find();
}

}  // namespace copse
