#include "lib/analysis/skeleton/level_skeleton.h"

#include "lib/analysis/surface/components.h"
#include "lib/analysis/surface/welded_tolerances.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace copse {

namespace {

// A piece is a triangle's share of a slice. Triangle t has the pieces first[t] .. first[t + 1) of the slices
// lowest[t], lowest[t] + 1, ...
class Slicing {
 public:
  Slicing(const Surface& s, std::vector<double> field) : s_(s), field_(std::move(field)) {
    double reach = 0, spans = 0;
    for (double& f : field_) {
      if (!std::isfinite(f)) f = 0;  // a vertex that no triangle uses
      reach = std::max(reach, f);
    }
    for (const Triangle& t : s_.triangles) {
      const auto [low, high] = std::minmax({field_[t[0]], field_[t[1]], field_[t[2]]});
      spans += high - low;
    }
    const double pieces = k_pieces_of_triangle * static_cast<double>(s_.triangles.size()) + k_pieces_at_least;
    thickness_ = std::max(spans / pieces, reach / k_most_slices);
    if (!(thickness_ > 0)) thickness_ = 1;
    slice_.reserve(field_.size());
    for (const double f : field_) slice_.push_back(static_cast<std::uint32_t>(f / thickness_));
    first_.push_back(0);
    for (const Triangle& t : s_.triangles) {
      const auto [low, high] = std::minmax({slice_[t[0]], slice_[t[1]], slice_[t[2]]});
      lowest_.push_back(low);
      first_.push_back(first_.back() + high - low + 1);
    }
  }

  CurveSkeleton skeleton() {
    unite();
    CurveSkeleton k;
    number(k);
    measure(k);
    return k;
  }

 private:
  std::uint32_t piece(std::uint32_t t, std::uint32_t slice) const { return first_[t] + slice - lowest_[t]; }

  // Joins the pieces of a slice that share a stretch of an edge, or a vertex.
  void unite() {
    sets_ = UnionFind(first_.back());
    std::vector<std::uint32_t> at(s_.positions.size(), k_none);
    for (std::uint32_t t = 0; t < s_.triangles.size(); ++t) {
      for (std::size_t e = 0; e < 3; ++e) {
        const std::uint32_t a = s_.triangles[t][e], b = s_.triangles[t][(e + 1) % 3], n = s_.across[t][e];
        const std::uint32_t p = piece(t, slice_[a]);
        if (at[a] == k_none) at[a] = p;
        sets_.unite(at[a], p);
        if (n == k_none || n < t) continue;
        const auto [low, high] = std::minmax(slice_[a], slice_[b]);
        for (std::uint32_t slice = low; slice <= high; ++slice) sets_.unite(piece(t, slice), piece(n, slice));
      }
    }
    piece_at_ = std::move(at);
  }

  void number(CurveSkeleton& k) {
    node_.assign(first_.back(), k_none);
    std::uint32_t count = 0;
    std::vector<std::pair<std::uint32_t, std::uint32_t>> held;
    for (std::uint32_t t = 0; t < s_.triangles.size(); ++t) {
      for (std::uint32_t p = first_[t]; p < first_[t + 1]; ++p) {
        std::uint32_t& root = node_[sets_.find(p)];
        if (root == k_none) {
          root = count++;
          level_.push_back(lowest_[t] + p - first_[t]);
        }
        node_[p] = root;
        held.emplace_back(root, t);
        if (p > first_[t]) k.edges.emplace_back(std::minmax(node_[p - 1], node_[p]));
      }
    }
    std::ranges::sort(k.edges);
    const auto repeated = std::ranges::unique(k.edges);
    k.edges.erase(repeated.begin(), repeated.end());
    k.triangles = make_lists(held, count);
    for (std::size_t v = 0; v < s_.positions.size(); ++v) {
      k.node_of.push_back(piece_at_[v] == k_none ? 0 : node_[piece_at_[v]]);
    }
  }

  Double3 crossing(std::uint32_t a, std::uint32_t b, double level) const {
    const double at = (level - field_[a]) / (field_[b] - field_[a]);
    return s_.positions[a] + (s_.positions[b] - s_.positions[a]) * at;
  }

  // Where the level crosses a triangle, if it does.
  bool cut(std::uint32_t t, double level, Double3& p, Double3& q) const {
    int found = 0;
    for (std::size_t e = 0; e < 3; ++e) {
      const std::uint32_t a = s_.triangles[t][e], b = s_.triangles[t][(e + 1) % 3];
      if ((field_[a] < level) == (field_[b] < level)) continue;
      (found++ == 0 ? p : q) = crossing(a, b, level);
    }
    return found == 2;
  }

  // The centre of each piece is that of its contour half-way up the slice, by length.
  void measure(CurveSkeleton& k) const {
    for (std::uint32_t n = 0; n < level_.size(); ++n) {
      const double level = (level_[n] + 0.5) * thickness_;
      const auto triangles = k.triangles[n];
      const Double3 origin = s_.positions[s_.triangles[triangles[0]][0]];
      Double3 sum, mean, p, q;
      double contour = 0, count = 0;
      for (const std::uint32_t t : triangles) {
        if (cut(t, level, p, q)) {
          const double l = distance(p, q);
          sum += ((p + q) * 0.5 - origin) * l;
          contour += l;
        }
        for (const std::uint32_t v : s_.triangles[t]) {
          if (slice_[v] == level_[n]) mean += s_.positions[v] - origin, ++count;
        }
      }
      const bool round = contour > 0;
      if (!round && count == 0) ++count;
      k.points.push_back(origin + (round ? sum / contour : mean / count));
      k.radii.push_back(contour / (2 * std::numbers::pi));
    }
  }

  const Surface& s_;
  std::vector<double> field_;
  double thickness_ = 1;
  std::vector<std::uint32_t> slice_;           // one a vertex
  std::vector<std::uint32_t> lowest_, first_;  // one a triangle
  UnionFind sets_{0};
  std::vector<std::uint32_t> piece_at_;  // one a vertex: a piece of its slice
  std::vector<std::uint32_t> node_;      // one a piece
  std::vector<std::uint32_t> level_;     // one a node: its slice
};

}  // namespace

std::vector<std::uint32_t> lowest_end(const Surface& surface, const Lists& triangles_of) {
  if (surface.positions.empty()) return {};
  const auto lower = [&](std::uint32_t a, std::uint32_t b) {
    return surface.positions[a].y != surface.positions[b].y ? surface.positions[a].y < surface.positions[b].y
                                                            : a < b;
  };
  std::uint32_t lowest = 0;
  DoubleBox box;
  for (std::uint32_t v = 0; v < surface.positions.size(); ++v) {
    if (lower(v, lowest)) lowest = v;
    box.grow(surface.positions[v]);
  }
  std::vector<std::uint8_t> at_border(surface.positions.size(), 0);
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    for (std::size_t e = 0; e < 3; ++e) {
      if (surface.across[t][e] != k_none) continue;
      at_border[surface.triangles[t][e]] = at_border[surface.triangles[t][(e + 1) % 3]] = 1;
    }
  }
  const double limit = box.min.y + k_lowest_share * box.extent().y;
  const bool border = at_border[lowest] != 0;
  const auto belongs = [&](std::uint32_t v, std::uint32_t t, std::size_t e) {
    return border ? surface.across[t][e] == k_none && at_border[v] : surface.positions[v].y <= limit;
  };
  std::vector<std::uint8_t> seen(surface.positions.size(), 0);
  std::vector<std::uint32_t> end{lowest};
  seen[lowest] = 1;
  for (std::size_t i = 0; i < end.size(); ++i) {
    for (const std::uint32_t t : triangles_of[end[i]]) {
      for (std::size_t e = 0; e < 3; ++e) {
        const std::uint32_t a = surface.triangles[t][e], b = surface.triangles[t][(e + 1) % 3];
        if (a != end[i] && b != end[i]) continue;
        const std::uint32_t v = a == end[i] ? b : a;
        if (!seen[v] && belongs(v, t, e)) seen[v] = 1, end.push_back(v);
      }
    }
  }
  std::ranges::sort(end);
  return end;
}

CurveSkeleton level_skeleton(const Surface& surface, const Lists& triangles_of,
                             std::span<const std::uint32_t> sources) {
  CurveSkeleton k = Slicing(surface, geodesic_distance(surface, triangles_of, sources)).skeleton();
  if (!sources.empty()) k.base = k.node_of[sources[0]];
  return k;
}

}  // namespace copse
