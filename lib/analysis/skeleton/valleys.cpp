#include "lib/analysis/skeleton/valleys.h"

#include "lib/analysis/surface/components.h"
#include "lib/analysis/surface/lists.h"
#include "lib/analysis/surface/welded_tolerances.h"

#include <array>
#include <map>
#include <utility>

namespace copse {

namespace {

class ValleyCutter {
 public:
  // `sine`: by how much a valley bends inward.
  ValleyCutter(const Surface& s, const Bands& bands, double sine)
      : sine_(sine),
        s_(s),
        bands_(bands),
        is_cut_(3 * s.triangles.size(), 0),
        on_ring_(s.positions.size(), 0) {}

  CutSurface cut() {
    find_rings();
    find_concave_edges();
    prune();
    number_pieces();
    find_shared();
    number_valleys();
    split();
    return std::move(out_);
  }

 private:
  Double3 corner(std::uint32_t t, std::size_t e) const { return s_.positions[s_.triangles[t][e % 3]]; }

  // Rings of bands that keep their number of vertices are no valleys, and
  // neither are the diagonals between them, which fold inward where rings are
  // turned.
  void find_rings() {
    for (std::uint32_t b = 0; b < bands_.count(); ++b) {
      if (bands_.ring(2 * b).size() != bands_.ring(2 * b + 1).size()) continue;
      for (const std::uint32_t r : {2 * b, 2 * b + 1}) {
        for (const std::uint32_t v : bands_.ring(r)) on_ring_[v] = 1;
      }
    }
  }

  // Unit normals. Of slivers, as a union leaves them, that of what lies across
  // their longest edge.
  void find_normals() {
    normal_.resize(s_.triangles.size());
    std::vector<std::pair<std::uint32_t, std::uint32_t>> slivers;
    for (std::uint32_t t = 0; t < s_.triangles.size(); ++t) {
      const Double3 n = cross(corner(t, 1) - corner(t, 0), corner(t, 2) - corner(t, 0));
      normal_[t] = normalized(n, {0, 0, 0});
      std::size_t longest = 0;
      std::array<double, 3> side{};
      for (std::size_t e = 0; e < 3; ++e) {
        side[e] = distance(corner(t, e), corner(t, e + 1));
        if (side[e] > side[longest]) longest = e;
      }
      if (length(n) < k_sliver * side[longest] * side[longest] && s_.across[t][longest] != k_none)
        slivers.emplace_back(t, s_.across[t][longest]);
    }
    for (int round = 0; round < 2; ++round) {  // slivers may lie side by side
      for (const auto& [t, beside] : slivers) normal_[t] = normal_[beside];
    }
  }

  // Which side is outside: by the volume, about a point of the surface.
  bool is_turned_over() const {
    double volume = 0;
    for (std::uint32_t t = 0; t < s_.triangles.size(); ++t) {
      const Double3 a = corner(t, 0) - s_.positions[0];
      volume += dot(cross(corner(t, 1) - s_.positions[0], corner(t, 2) - s_.positions[0]), a);
    }
    return volume < 0;
  }

  void find_concave_edges() {
    find_normals();
    const double outward = is_turned_over() ? -1 : 1;
    for (std::uint32_t t = 0; t < s_.triangles.size(); ++t) {
      for (std::size_t e = 0; e < 3; ++e) {
        const std::uint32_t n = s_.across[t][e];
        if (n == k_none || on_ring_[s_.triangles[t][e]] || on_ring_[s_.triangles[t][(e + 1) % 3]]) continue;
        const Double3 inward = cross(normal_[t], normalized(corner(t, e + 1) - corner(t, e), {0, 0, 0}));
        const double sine = outward * dot(normal_[n], inward);
        is_cut_[3 * t + e] = sine > (dot(normal_[n], normal_[t]) < 0 ? 0 : sine_);
      }
    }
  }

  std::uint32_t other_side(std::uint32_t t, std::size_t e) const {
    const std::uint32_t n = s_.across[t][e], a = s_.triangles[t][e], b = s_.triangles[t][(e + 1) % 3];
    return 3 * n + static_cast<std::uint32_t>(edge_between(s_.triangles[n], a, b));
  }

  // What ends somewhere is no line where tubes meet, which goes all round.
  void prune() {
    for (std::uint32_t h = 0; h < is_cut_.size(); ++h) {
      if (is_cut_[h]) is_cut_[other_side(h / 3, h % 3)] = 1;
    }
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (std::uint32_t h = 0; h < is_cut_.size(); ++h) {
      if (!is_cut_[h] || other_side(h / 3, h % 3) < h) continue;
      pairs.emplace_back(s_.triangles[h / 3][h % 3], h);
      pairs.emplace_back(s_.triangles[h / 3][(h % 3 + 1) % 3], h);
    }
    edges_at_ = make_lists(pairs, s_.positions.size());
    std::vector<std::uint32_t> degree(s_.positions.size()), todo;
    for (std::uint32_t v = 0; v < degree.size(); ++v) {
      degree[v] = static_cast<std::uint32_t>(edges_at_[v].size());
      if (degree[v] == 1) todo.push_back(v);
    }
    while (!todo.empty()) {
      const std::uint32_t v = todo.back();
      todo.pop_back();
      for (const std::uint32_t h : edges_at_[v]) {
        if (!is_cut_[h]) continue;
        is_cut_[h] = is_cut_[other_side(h / 3, h % 3)] = 0;
        for (const std::size_t end : {h % 3, (h % 3 + 1) % 3}) {
          if (--degree[s_.triangles[h / 3][end]] == 1) todo.push_back(s_.triangles[h / 3][end]);
        }
      }
    }
  }

  void number_pieces() {
    UnionFind joined(s_.triangles.size());
    for (std::uint32_t t = 0; t < s_.triangles.size(); ++t) {
      for (std::size_t e = 0; e < 3; ++e) {
        if (s_.across[t][e] != k_none && !is_cut_[3 * t + e]) joined.unite(t, s_.across[t][e]);
      }
    }
    std::vector<std::uint32_t> number(s_.triangles.size(), k_none);
    for (std::uint32_t t = 0; t < s_.triangles.size(); ++t) {
      std::uint32_t& id = number[joined.find(t)];
      if (id == k_none) id = out_.pieces++;
      out_.piece.push_back(id);
    }
  }

  void find_shared() {
    is_shared_.assign(s_.positions.size(), 0);
    std::vector<std::uint32_t> piece_of(s_.positions.size(), k_none);
    for (std::uint32_t t = 0; t < s_.triangles.size(); ++t) {
      for (const std::uint32_t v : s_.triangles[t]) {
        if (piece_of[v] == k_none) piece_of[v] = out_.piece[t];
        if (piece_of[v] != out_.piece[t]) is_shared_[v] = 1;
      }
    }
  }

  // A crack between two pieces divides them as well.
  bool divides(std::uint32_t h) const {
    const std::uint32_t beyond = s_.across[h / 3][h % 3];
    if (beyond != k_none) return is_cut_[h] && out_.piece[h / 3] != out_.piece[beyond];
    return is_shared_[s_.triangles[h / 3][h % 3]] && is_shared_[s_.triangles[h / 3][(h % 3 + 1) % 3]];
  }

  // Valleys that touch are one.
  void number_valleys() {
    UnionFind joined(s_.positions.size());
    for (std::uint32_t h = 0; h < is_cut_.size(); ++h) {
      if (divides(h)) joined.unite(s_.triangles[h / 3][h % 3], s_.triangles[h / 3][(h % 3 + 1) % 3]);
    }
    std::vector<std::uint32_t> number(s_.positions.size(), k_none);
    out_.valley.assign(is_cut_.size(), k_none);
    for (std::uint32_t h = 0; h < is_cut_.size(); ++h) {
      if (!divides(h)) continue;
      std::uint32_t& id = number[joined.find(s_.triangles[h / 3][h % 3])];
      if (id == k_none) id = out_.valleys++;
      out_.valley[h] = id;
    }
  }

  void split() {
    Surface& cut = out_.surface;
    cut.across = s_.across;
    cut.triangles = s_.triangles;
    std::vector<std::uint8_t> at_valley(s_.positions.size(), 0);
    for (std::uint32_t h = 0; h < out_.valley.size(); ++h) {
      if (out_.valley[h] == k_none) continue;
      cut.across[h / 3][h % 3] = k_none;
      at_valley[s_.triangles[h / 3][h % 3]] = at_valley[s_.triangles[h / 3][(h % 3 + 1) % 3]] = 1;
    }
    for (std::uint32_t v = 0; v < at_valley.size(); ++v) at_valley[v] |= is_shared_[v];
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> copies;
    std::vector<std::uint32_t> copy(s_.positions.size(), k_none);
    for (std::uint32_t t = 0; t < cut.triangles.size(); ++t) {
      for (std::size_t c = 0; c < 3; ++c) {
        const std::uint32_t v = s_.triangles[t][c];
        std::uint32_t& id =
            at_valley[v] ? copies.try_emplace({v, out_.piece[t]}, k_none).first->second : copy[v];
        if (id == k_none) {
          id = static_cast<std::uint32_t>(cut.positions.size());
          cut.positions.push_back(s_.positions[v]);
          out_.origin.push_back(v);
          out_.at_valley.push_back(at_valley[v]);
        }
        cut.triangles[t][c] = id;
      }
    }
  }

  const double sine_;
  const Surface& s_;
  const Bands& bands_;
  std::vector<std::uint8_t> is_cut_;     // one an edge of each triangle
  std::vector<std::uint8_t> on_ring_;    // one a vertex
  std::vector<std::uint8_t> is_shared_;  // one a vertex: by several pieces
  std::vector<Double3> normal_;          // one a triangle
  Lists edges_at_;                       // one a vertex: concave edges
  CutSurface out_;
};

}  // namespace

CutSurface cut_along_valleys(const Surface& surface, const Bands& bands, double sine) {
  if (surface.triangles.empty()) return {};
  return ValleyCutter(surface, bands, sine).cut();
}

}  // namespace copse
