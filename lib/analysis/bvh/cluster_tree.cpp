#include "lib/analysis/bvh/cluster_tree.h"

#include "lib/analysis/bvh/hilbert_rtree.h"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace copse {
namespace {

constexpr std::size_t k_window = 16;  // neighbours on either side along the curve

struct Cluster {
  std::uint32_t id = 0;
  DoubleBox box;
};

double joint_surface(DoubleBox a, const DoubleBox& b) {
  a.grow(b);
  const Double3 e = a.extent();
  return e.x * e.y + e.y * e.z + e.z * e.x;
}

// Of pairs that are alike, those whose places differ in the last bit alone come first: then equal boxes pair
// up all at once.
using Rank = std::tuple<double, bool, std::size_t, std::size_t>;
Rank rank_of(const std::vector<Cluster>& clusters, std::size_t i, std::size_t j) {
  return {joint_surface(clusters[i].box, clusters[j].box), (i ^ 1) != j, std::min(i, j), std::max(i, j)};
}

std::vector<std::size_t> nearest(const std::vector<Cluster>& clusters) {
  std::vector<std::size_t> out(clusters.size());
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    const std::size_t begin = i > k_window ? i - k_window : 0,
                      end = std::min(i + k_window + 1, clusters.size());
    std::size_t best = i == begin ? i + 1 : begin;
    Rank least = rank_of(clusters, i, best);
    for (std::size_t j = begin; j < end; ++j) {
      if (j == i || j == best) continue;
      const Rank rank = rank_of(clusters, i, j);
      if (rank < least) least = rank, best = j;
    }
    out[i] = best;
  }
  return out;
}

// Boxes so large that surfaces overflow, or so small that they vanish, are brought to a size of about 1.
std::vector<DoubleBox> scaled(std::span<const DoubleBox> boxes) {
  DoubleBox all;
  for (const DoubleBox& b : boxes) all.grow(b);
  const Double3 half = all.max * 0.5 - all.min * 0.5;
  const double reach = std::max({half.x, half.y, half.z});
  const int exponent = reach > 0 ? std::clamp(std::ilogb(reach), -1000, 1000) : 0;
  const Double3 middle = all.min * 0.5 + all.max * 0.5;
  std::vector<DoubleBox> out;
  out.reserve(boxes.size());
  for (const DoubleBox& b : boxes) {
    const double s = std::ldexp(1.0, -exponent);
    out.push_back({(b.min - middle) * s, (b.max - middle) * s});
  }
  return out;
}

}  // namespace

BoxTree cluster_tree(std::span<const DoubleBox> boxes) {
  if (boxes.empty()) return {};
  const auto items = static_cast<std::uint32_t>(boxes.size());
  const std::vector<DoubleBox> unit = scaled(boxes);
  std::vector<Double3> centres;
  for (const DoubleBox& b : unit) centres.push_back(b.centre());
  std::vector<Cluster> clusters;
  for (const std::uint32_t i : hilbert_order(centres)) clusters.push_back({i, unit[i]});
  std::vector<std::vector<std::uint32_t>> inner;
  while (clusters.size() > 1) {
    const std::vector<std::size_t> partner = nearest(clusters);
    std::vector<Cluster> next;
    for (std::size_t i = 0; i < clusters.size(); ++i) {
      const std::size_t j = partner[i];
      if (partner[j] != i) {
        next.push_back(clusters[i]);
      } else if (i < j) {
        DoubleBox box = clusters[i].box;
        box.grow(clusters[j].box);
        next.push_back({items + static_cast<std::uint32_t>(inner.size()), box});
        inner.push_back({clusters[i].id, clusters[j].id});
      }
    }
    clusters = std::move(next);
  }
  return flatten(inner, items, clusters[0].id);
}

}  // namespace copse
