#include "lib/analysis/surface/sew.h"

#include "lib/analysis/surface/components.h"

#include <algorithm>
#include <tuple>

namespace copse {
namespace {

// An edge between two points at which several pieces meet, as one piece uses it.
struct EdgeUse {
  std::uint32_t low, high, piece;
  friend auto operator<=>(const EdgeUse&, const EdgeUse&) = default;
};

bool same_edge(const EdgeUse& a, const EdgeUse& b) {
  return a.low == b.low && a.high == b.high;
}

// The edges whose two ends are both used by more than one piece, sorted.
std::vector<EdgeUse> contact_edges(std::span<const Triangle> triangles,
                                   std::span<const std::uint32_t> piece) {
  std::uint32_t points = 0;
  for (const Triangle& t : triangles) points = std::max(points, std::ranges::max(t) + 1);
  constexpr std::uint32_t k_several = k_none - 1;
  std::vector<std::uint32_t> user(points, k_none);
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const std::uint32_t v : triangles[t]) {
      if (user[v] == k_none) user[v] = piece[t];
      if (user[v] != piece[t]) user[v] = k_several;
    }
  }
  // Sorted into buckets by the lower end, then each small bucket: linear, whatever the number of edges.
  std::vector<std::uint32_t> first(points + 1, 0);
  const auto each = [&](const auto& visit) {
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      for (int i = 0; i < 3; ++i) {
        const std::uint32_t a = triangles[t][i], b = triangles[t][(i + 1) % 3];
        if (user[a] == k_several && user[b] == k_several)
          visit(EdgeUse{std::min(a, b), std::max(a, b), piece[t]});
      }
    }
  };
  each([&](const EdgeUse& e) { ++first[e.low + 1]; });
  for (std::uint32_t p = 0; p < points; ++p) first[p + 1] += first[p];
  std::vector<EdgeUse> edges(first[points]);
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  each([&](const EdgeUse& e) { edges[next[e.low]++] = e; });
  for (std::uint32_t p = 0; p < points; ++p) {
    std::sort(edges.begin() + first[p], edges.begin() + first[p + 1]);
  }
  return edges;
}

// A boundary edge of a piece that lies on an inner edge of another.
struct Landing {
  std::uint32_t piece, host, low, high;
  friend auto operator<=>(const Landing&, const Landing&) = default;
};

// Sews the pieces that use one edge (edges[begin, end)): those with it on their boundary to one another. A
// single boundary use among inner ones becomes a landing.
void sew_edge(std::span<const EdgeUse> uses, UnionFind& surfaces, std::vector<Landing>& landings) {
  std::uint32_t boundary = k_none, inner = k_none;
  bool sewn = false;
  for (std::size_t i = 0; i < uses.size();) {
    std::size_t j = i + 1;
    while (j < uses.size() && uses[j].piece == uses[i].piece) ++j;
    if (j - i > 1) {
      inner = std::min(inner, uses[i].piece);
    } else if (boundary == k_none) {
      boundary = uses[i].piece;
    } else {
      surfaces.unite(boundary, uses[i].piece);
      sewn = true;
    }
    i = j;
  }
  if (!sewn && boundary != k_none && inner != k_none) {
    landings.push_back({boundary, inner, uses[0].low, uses[0].high});
  }
}

// Sews the pieces of landings[begin, end) (one piece, one host) where the edges form closed loops only.
void sew_landing(std::span<const Landing> edges, UnionFind& surfaces) {
  std::vector<std::uint32_t> ends;
  for (const Landing& e : edges) ends.insert(ends.end(), {e.low, e.high});
  std::ranges::sort(ends);
  bool closed = edges.size() >= 3;
  for (std::size_t i = 0; i < ends.size() && closed; i += 2) {
    closed =
        i + 1 < ends.size() && ends[i] == ends[i + 1] && (i + 2 >= ends.size() || ends[i + 2] != ends[i]);
  }
  if (closed) surfaces.unite(edges[0].piece, edges[0].host);
}

}  // namespace

std::vector<std::uint32_t> sew(std::span<const Triangle> triangles, std::span<const std::uint32_t> piece) {
  std::uint32_t pieces = 0;
  for (const std::uint32_t p : piece) pieces = std::max(pieces, p + 1);
  UnionFind surfaces(pieces);
  const std::vector<EdgeUse> edges = contact_edges(triangles, piece);
  std::vector<Landing> landings;
  for (std::size_t i = 0; i < edges.size();) {
    std::size_t j = i + 1;
    while (j < edges.size() && same_edge(edges[i], edges[j])) ++j;
    sew_edge(std::span(edges).subspan(i, j - i), surfaces, landings);
    i = j;
  }
  std::ranges::sort(landings);
  for (std::size_t i = 0; i < landings.size();) {
    std::size_t j = i + 1;
    while (j < landings.size() && landings[j].piece == landings[i].piece &&
           landings[j].host == landings[i].host) {
      ++j;
    }
    sew_landing(std::span(landings).subspan(i, j - i), surfaces);
    i = j;
  }
  std::vector<std::uint32_t> surface(pieces);
  for (std::uint32_t p = 0; p < pieces; ++p) surface[p] = surfaces.find(p);
  return surface;
}

}  // namespace copse
