#include "lib/analysis/lod/leaf_clusters.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace copse {
namespace {

constexpr std::size_t k_slow = 64;  // a round that merges less than this part of the nodes is helped
constexpr double k_never = std::numeric_limits<double>::infinity();

// What the cost of a merge needs of a node: small, so that a window of them stays in the cache.
struct Node {
  Double3 centre, normal;  // the normal's length is how much its leaves agree, 0 to 1
  double area, weight, cost;
};

// Spreads the low 21 bits over every third bit.
std::uint64_t spread(std::uint64_t x) {
  x &= 0x1fffff;
  x = (x | x << 32) & 0x1f00000000ffff;
  x = (x | x << 16) & 0x1f0000ff0000ff;
  x = (x | x << 8) & 0x100f00f00f00f00f;
  x = (x | x << 4) & 0x10c30c30c30c30c3;
  return (x | x << 2) & 0x1249249249249249;
}

class Clustering {
 public:
  Clustering(std::span<const Patch> patches, const ClusterOptions& options) : options_(options) {
    nodes_.reserve(2 * patches.size());
    for (const Patch& p : patches) {
      const Double3 n = p.area > 0 ? eigen_free_normal(p) : Double3{0, 1, 0};
      nodes_.push_back({p.centre(), n, p.area, std::max(p.visible, options.least_seen * p.opaque), 0});
      box_.grow(nodes_.back().centre);
    }
  }

  std::vector<PatchMerge> run(std::span<const std::uint32_t> group_of) {
    std::vector<std::uint32_t> all(group_of.size());
    std::iota(all.begin(), all.end(), 0u);
    std::vector<std::uint64_t> keys(all.size());
    for (const std::uint32_t i : all) keys[i] = key(i);
    std::sort(all.begin(), all.end(), [&](std::uint32_t a, std::uint32_t b) {
      if (group_of[a] != group_of[b]) return group_of[a] < group_of[b];
      return keys[a] != keys[b] ? keys[a] < keys[b] : a < b;
    });
    std::vector<std::uint32_t> left;
    for (std::size_t i = 0, j = 0; i < all.size(); i = j) {
      for (j = i + 1; j < all.size() && group_of[all[j]] == group_of[all[i]];) ++j;
      std::vector<std::uint32_t> group(all.begin() + i, all.begin() + j);
      merge_all(group, options_.largest);
      left.insert(left.end(), group.begin(), group.end());
    }
    merge_all(sorted(left), options_.largest);
    crowded_ = true;
    merge_all(sorted(left), 0);
    return std::move(merges_);
  }

 private:
  // A patch of one triangle, or of a few that nearly agree, faces along the axis of most facing.
  static Double3 eigen_free_normal(const Patch& p) {
    const Symmetric3& f = p.facing;
    const auto& m = f.m;
    const std::array<Double3, 3> columns{{{m[0], m[3], m[4]}, {m[3], m[1], m[5]}, {m[4], m[5], m[2]}}};
    const Double3* best = &columns[0];
    for (const Double3& c : columns)
      if (dot(c, c) > dot(*best, *best)) best = &c;
    const Double3 n = normalized(*best);
    return n * std::sqrt(std::clamp(f.along(n) / p.area, 0.0, 1.0));
  }

  std::uint64_t key(std::uint32_t node) const {
    const Double3 e = box_.extent(), c = nodes_[node].centre - box_.min;
    const double scale = std::max({e.x, e.y, e.z});
    const auto cell = [&](double v) {
      return static_cast<std::uint64_t>(scale > 0 ? std::clamp(v / scale, 0.0, 1.0) * 0x1fffff : 0);
    };
    return spread(cell(c.x)) | spread(cell(c.y)) << 1 | spread(cell(c.z)) << 2;
  }

  std::vector<std::uint32_t>& sorted(std::vector<std::uint32_t>& nodes) {
    std::vector<std::pair<std::uint64_t, std::uint32_t>> keyed;
    for (const std::uint32_t n : nodes) keyed.emplace_back(key(n), n);
    std::sort(keyed.begin(), keyed.end());
    for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i] = keyed[i].second;
    return nodes;
  }

  double cost(const Node& a, const Node& b, double largest) const {
    if (largest > 0 && a.area + b.area > largest) return k_never;
    const Double3 d = a.centre - b.centre;
    const double agree = dot(a.normal, b.normal), weights = a.weight + b.weight;
    const double turned = options_.turning / 12 * (a.area + b.area) * (1 - agree * agree);
    if (crowded_) return std::max(a.area + b.area - options_.largest, 0.0) * (a.area + b.area);
    return weights > 0 ? a.weight * b.weight / weights * (dot(d, d) + turned) : 0;
  }

  std::uint32_t merge(std::uint32_t i, std::uint32_t j, double price) {
    const Node a = nodes_[std::min(i, j)], b = nodes_[std::max(i, j)];
    const double area = a.area + b.area, share = area > 0 ? a.area / area : 0.5;
    const Double3 towards = dot(a.normal, b.normal) < 0 ? -b.normal : b.normal;
    const double worst = std::max({price, a.cost, b.cost});
    merges_.push_back({std::min(i, j), std::max(i, j), worst});
    nodes_.push_back({a.centre * share + b.centre * (1 - share), a.normal * share + towards * (1 - share),
                      area, a.weight + b.weight, worst});
    return static_cast<std::uint32_t>(nodes_.size() - 1);
  }

  // Merges pairs that are each other's best until one node is left, or no pair may be merged. What is left
  // stays in `list`. A node that may be merged with none of its neighbours is set aside. Where hardly any
  // pair is mutual (distances that grow along the order), neighbours are paired as they come: a round always
  // takes a fixed share of the nodes away.
  void merge_all(std::vector<std::uint32_t>& list, double largest) {
    std::vector<std::uint32_t> aside;
    while (list.size() > 1) {
      const std::size_t before = list.size();
      find_best(list, largest);
      std::size_t out = 0;
      for (std::size_t i = 0; i < before; ++i) {
        const std::uint32_t j = best_[i];
        if (j == k_nobody)
          aside.push_back(list[i]);
        else if (best_[j] != i)
          list[out++] = list[i];
        else if (i < j)
          list[out++] = merge(list[i], list[j], price_[i]);
      }
      list.resize(out);
      if (before - out < before / k_slow) pair_neighbours(list, largest);
    }
    list.insert(list.end(), aside.begin(), aside.end());
    std::sort(list.begin(), list.end());
  }

  void pair_neighbours(std::vector<std::uint32_t>& list, double largest) {
    std::size_t out = 0;
    for (std::size_t i = 0; i < list.size(); ++i) {
      const double c = i + 1 < list.size() ? cost(nodes_[list[i]], nodes_[list[i + 1]], largest) : k_never;
      const std::uint32_t a = list[i];
      list[out++] = c < k_never ? merge(a, list[++i], c) : a;
    }
    list.resize(out);
  }

  void find_best(const std::vector<std::uint32_t>& list, double largest) {
    best_.assign(list.size(), k_nobody), price_.assign(list.size(), k_never);
    for (std::uint32_t i = 0; i < list.size(); ++i) {
      const Node& a = nodes_[list[i]];
      const auto end = std::min<std::size_t>(list.size(), i + options_.window + 1);
      for (std::uint32_t j = i + 1; j < end; ++j) {
        const double c = cost(a, nodes_[list[j]], largest);
        // Of equal costs the pair that comes first in the order wins for both: some pair is always mutual.
        if (c < price_[i]) price_[i] = c, best_[i] = j;
        if (c < price_[j]) price_[j] = c, best_[j] = i;
      }
    }
  }

  static constexpr std::uint32_t k_nobody = 0xffffffffu;
  ClusterOptions options_;
  DoubleBox box_;
  bool crowded_ = false;  // only what exceeds `largest` is left: as little as can be is to exceed it
  std::vector<Node> nodes_;
  std::vector<PatchMerge> merges_;
  std::vector<std::uint32_t> best_;
  std::vector<double> price_;
};

}  // namespace

std::vector<PatchMerge> cluster_leaves(std::span<const Patch> patches,
                                       std::span<const std::uint32_t> group_of,
                                       const ClusterOptions& options) {
  return Clustering(patches, options).run(group_of);
}

}  // namespace copse
