#include "lib/analysis/surface/sew.h"

#include "lib/analysis/surface/components.h"

#include <algorithm>
#include <array>

namespace copse {
namespace {

// An edge between two points at which several pieces meet, as one piece uses it.
struct EdgeUse {
  std::uint32_t low, high, piece;
  std::uint32_t third;    // corner of the triangle
  std::uint32_t forward;  // 1: the triangle goes from low to high
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
  bool any = false;
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const std::uint32_t v : triangles[t]) {
      if (user[v] == k_none) user[v] = piece[t];
      if (user[v] != piece[t]) user[v] = k_several, any = true;
    }
  }
  if (!any) return {};
  // Sorted into buckets by the lower end, then each small bucket: linear, whatever the number of edges.
  std::vector<std::uint32_t> first(points + 1, 0);
  const auto each = [&](const auto& visit) {
    for (std::size_t t = 0; t < triangles.size(); ++t) {
      for (int i = 0; i < 3; ++i) {
        const std::uint32_t a = triangles[t][i], b = triangles[t][(i + 1) % 3];
        if (user[a] == k_several && user[b] == k_several)
          visit(EdgeUse{std::min(a, b), std::max(a, b), piece[t], triangles[t][(i + 2) % 3], a < b});
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

// A boundary edge that two pieces share, or many edges of the same two.
struct Seam {
  std::uint32_t a, b;  // pieces, a < b
  std::int32_t folds;  // 1: folded back, wound against one another; -1: not
  friend auto operator<=>(const Seam&, const Seam&) = default;
};

// Whether two triangles on an edge lie to the same side of it although they are wound as if to two.
bool folds_back(std::span<const Double3> positions, const EdgeUse& a, const EdgeUse& b) {
  if (a.forward != b.forward) return false;
  const Double3 origin = positions[a.low], edge = positions[a.high] - origin;
  const auto away = [&](std::uint32_t corner) {
    const Double3 d = positions[corner] - origin;
    return d * dot(edge, edge) - edge * dot(d, edge);
  };
  return dot(away(a.third), away(b.third)) > 0;
}

Seam seam_between(std::span<const Double3> positions, const EdgeUse& a, const EdgeUse& b) {
  return {std::min(a.piece, b.piece), std::max(a.piece, b.piece), folds_back(positions, a, b) ? 1 : -1};
}

// What the pieces that use one edge have to do with one another: those with it on their boundary share a
// seam, each with the first that is wound the other way, or with the first of all. A single boundary use
// among inner ones is a landing.
void look_at_edge(std::span<const Double3> positions, std::span<const EdgeUse> uses, std::vector<Seam>& seams,
                  std::vector<Landing>& landings) {
  std::array<const EdgeUse*, 2> first{};  // on the boundary, by winding
  std::uint32_t inner = k_none, boundaries = 0;
  const auto each_boundary = [&](const auto& visit) {
    for (std::size_t i = 0, j = 0; i < uses.size(); i = j) {
      for (j = i + 1; j < uses.size() && uses[j].piece == uses[i].piece;) ++j;
      if (j - i > 1) {
        inner = std::min(inner, uses[i].piece);
      } else {
        visit(uses[i]);
      }
    }
  };
  each_boundary([&](const EdgeUse& use) {
    ++boundaries;
    if (first[use.forward] == nullptr) first[use.forward] = &use;
  });
  if (boundaries == 1 && inner != k_none) {
    const EdgeUse& use = first[0] != nullptr ? *first[0] : *first[1];
    landings.push_back({use.piece, inner, use.low, use.high});
  }
  if (boundaries < 2) return;
  each_boundary([&](const EdgeUse& use) {
    const EdgeUse* other = first[1 - use.forward] != nullptr ? first[1 - use.forward] : first[use.forward];
    if (other != &use) seams.push_back(seam_between(positions, use, *other));
  });
}

// Sews the pieces of seams[begin, end) (the same two) unless most of these fold back.
void sew_seam(std::span<const Seam> edges, UnionFind& surfaces) {
  std::int64_t folds = 0;
  for (const Seam& e : edges) folds += e.folds;
  if (folds <= 0) surfaces.unite(edges[0].a, edges[0].b);
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

// Calls visit with each run of elements that are of one kind.
template <class T, class Same, class Visit>
void for_each_run(std::span<const T> sorted, const Same& same, const Visit& visit) {
  for (std::size_t i = 0, j = 0; i < sorted.size(); i = j) {
    for (j = i + 1; j < sorted.size() && same(sorted[i], sorted[j]);) ++j;
    visit(sorted.subspan(i, j - i));
  }
}

}  // namespace

std::vector<std::uint32_t> sew(std::span<const Double3> positions, std::span<const Triangle> triangles,
                               std::span<const std::uint32_t> piece) {
  std::uint32_t pieces = 0;
  for (const std::uint32_t p : piece) pieces = std::max(pieces, p + 1);
  if (pieces == 1) return {0};
  UnionFind surfaces(pieces);
  const std::vector<EdgeUse> edges = contact_edges(triangles, piece);
  std::vector<Seam> seams;
  std::vector<Landing> landings;
  for_each_run(std::span(edges), same_edge,
               [&](std::span<const EdgeUse> uses) { look_at_edge(positions, uses, seams, landings); });
  std::ranges::sort(seams);
  for_each_run(
      std::span<const Seam>(seams), [](const Seam& a, const Seam& b) { return a.a == b.a && a.b == b.b; },
      [&](std::span<const Seam> same) { sew_seam(same, surfaces); });
  std::ranges::sort(landings);
  for_each_run(
      std::span<const Landing>(landings),
      [](const Landing& a, const Landing& b) { return a.piece == b.piece && a.host == b.host; },
      [&](std::span<const Landing> same) { sew_landing(same, surfaces); });
  std::vector<std::uint32_t> surface(pieces);
  for (std::uint32_t p = 0; p < pieces; ++p) surface[p] = surfaces.find(p);
  return surface;
}

}  // namespace copse
