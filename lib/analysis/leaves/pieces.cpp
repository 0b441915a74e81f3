#include "lib/analysis/leaves/pieces.h"

#include "lib/analysis/surface/components.h"

#include <algorithm>

namespace copse {
namespace {

// Twice a triangle's area over the square of its longer side: what six digits of a file make of none.
constexpr double k_no_area = 1e-5;

// An edge as its lower vertex keeps it: the higher vertex, and 3 * triangle + edge.
struct Use {
  std::uint32_t high, corner;
  friend bool operator<(const Use& a, const Use& b) {
    return a.high != b.high ? a.high < b.high : a.corner < b.corner;
  }
};

// All edges, by their lower vertex.
struct EdgeLists {
  std::vector<std::uint32_t> first;  // vertices + 1 offsets
  std::vector<Use> uses;
};

template <class Visit>
void for_each_edge(std::span<const Triangle> triangles, std::span<const std::uint32_t> welded,
                   Visit&& visit) {
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    const std::uint32_t v[3] = {welded[triangles[t][0]], welded[triangles[t][1]], welded[triangles[t][2]]};
    for (std::uint32_t e = 0; e < 3; ++e) {
      const std::uint32_t a = v[e], b = v[e == 2 ? 0 : e + 1];
      if (a != b) visit(std::min(a, b), Use{std::max(a, b), 3 * t + e});
    }
  }
}

EdgeLists list_edges(std::span<const Triangle> triangles, std::span<const std::uint32_t> welded) {
  EdgeLists lists;
  // Filled from the back of each range: afterwards first[v] is where the range of v begins.
  lists.first.assign(welded.size() + 1, 0);
  for_each_edge(triangles, welded, [&](std::uint32_t low, Use) { ++lists.first[low]; });
  std::uint32_t sum = 0;
  for (std::uint32_t& n : lists.first) n = sum += n;
  lists.uses.resize(sum);
  for_each_edge(triangles, welded, [&](std::uint32_t low, Use use) { lists.uses[--lists.first[low]] = use; });
  return lists;
}

void sort_few(std::span<Use> uses) {
  constexpr std::size_t k_few = 24;
  if (uses.size() > k_few) {
    std::sort(uses.begin(), uses.end());
    return;
  }
  for (std::size_t i = 1; i < uses.size(); ++i) {
    const Use use = uses[i];
    std::size_t j = i;
    for (; j > 0 && use < uses[j - 1]; --j) uses[j] = uses[j - 1];
    uses[j] = use;
  }
}

class Joiner {
 public:
  Joiner(std::span<const std::uint32_t> part_of, std::span<const std::uint32_t> key_of_part, Pieces& pieces)
      : part_of_(part_of), key_of_part_(key_of_part), pieces_(pieces), sets_(part_of.size()) {}

  std::uint32_t key(std::uint32_t triangle) const { return key_of_part_[part_of_[triangle]]; }
  UnionFind& sets() { return sets_; }

  // All uses of one edge, by ascending triangle.
  void edge(std::span<Use> uses) {
    if (uses.size() == 1) {
      mark(uses[0], Pieces::border_0);
      return;
    }
    if (uses.size() == 2 && key(uses[0].corner / 3) == key(uses[1].corner / 3)) {
      sets_.unite(uses[0].corner / 3, uses[1].corner / 3);
      return;
    }
    const auto by_key = [&](const Use& a, const Use& b) {
      const std::uint32_t ka = key(a.corner / 3), kb = key(b.corner / 3);
      return ka != kb ? ka < kb : a.corner < b.corner;
    };
    std::sort(uses.begin(), uses.end(), by_key);
    for (std::size_t begin = 0, end = 0; begin < uses.size(); begin = end) {
      while (end < uses.size() && key(uses[end].corner / 3) == key(uses[begin].corner / 3)) ++end;
      const std::span<Use> same = uses.subspan(begin, end - begin);
      for (const Use& use : same) {
        sets_.unite(use.corner / 3, same[0].corner / 3);
        if (same.size() < uses.size()) mark(use, Pieces::neighbour_0);
        if (same.size() > 2) pieces_.edges[use.corner / 3] |= Pieces::non_manifold;
      }
      if (same.size() == 1) mark(same[0], Pieces::border_0);
    }
  }

 private:
  void mark(const Use& use, Pieces::Edges what) {
    pieces_.edges[use.corner / 3] |= static_cast<std::uint8_t>(what << (use.corner % 3));
  }

  std::span<const std::uint32_t> part_of_, key_of_part_;
  Pieces& pieces_;
  UnionFind sets_;
};

// Triangles that weld to a point have no edge; each joins the lowest triangle of its key at that point.
void join_points(std::span<const Triangle> triangles, std::span<const std::uint32_t> welded, Joiner& joiner) {
  struct Corner {
    std::uint32_t vertex, key, triangle;
    auto operator<=>(const Corner&) const = default;
  };
  const auto is_point = [&](const Triangle& t) {
    return welded[t[0]] == welded[t[1]] && welded[t[0]] == welded[t[2]];
  };
  std::vector<Corner> points;
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    if (is_point(triangles[t])) points.push_back({welded[triangles[t][0]], joiner.key(t), t});
  }
  if (points.empty()) return;
  std::sort(points.begin(), points.end());
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (points[i].vertex == points[i - 1].vertex && points[i].key == points[i - 1].key) {
      joiner.sets().unite(points[i].triangle, points[i - 1].triangle);
    }
  }
  std::vector<bool> taken(points.size(), false);
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    if (is_point(triangles[t])) continue;
    for (const std::uint32_t corner : triangles[t]) {
      const auto at =
          std::lower_bound(points.begin(), points.end(), Corner{welded[corner], joiner.key(t), 0});
      if (at == points.end() || at->vertex != welded[corner] || at->key != joiner.key(t)) continue;
      const auto point = static_cast<std::size_t>(at - points.begin());
      if (taken[point]) continue;
      taken[point] = true;
      joiner.sets().unite(t, at->triangle);
    }
  }
}

}  // namespace

Pieces edge_pieces(std::span<const Triangle> triangles, std::span<const std::uint32_t> welded,
                   std::span<const std::uint32_t> part_of, std::span<const std::uint32_t> key_of_part) {
  Pieces pieces;
  pieces.edges.assign(triangles.size(), 0);
  Joiner joiner(part_of, key_of_part, pieces);
  {
    EdgeLists lists = list_edges(triangles, welded);
    for (std::size_t v = 0; v + 1 < lists.first.size(); ++v) {
      const std::span<Use> around =
          std::span(lists.uses).subspan(lists.first[v], lists.first[v + 1] - lists.first[v]);
      sort_few(around);
      for (std::size_t begin = 0, end = 0; begin < around.size(); begin = end) {
        while (end < around.size() && around[end].high == around[begin].high) ++end;
        joiner.edge(around.subspan(begin, end - begin));
      }
    }
  }
  join_points(triangles, welded, joiner);
  pieces.of.resize(triangles.size());
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    // The root of a set is its lowest member, so it was numbered before any other.
    const std::uint32_t root = joiner.sets().find(t);
    pieces.of[t] = root == t ? pieces.count++ : pieces.of[root];
  }
  return pieces;
}

PieceTriangles triangles_of(std::span<const std::uint32_t> piece_of, std::uint32_t pieces) {
  PieceTriangles out;
  out.first.assign(pieces + std::size_t{1}, 0);
  for (const std::uint32_t piece : piece_of) ++out.first[piece];
  std::uint32_t sum = 0;
  for (std::uint32_t& n : out.first) n = sum += n;
  out.triangle.resize(piece_of.size());
  for (std::size_t t = piece_of.size(); t-- > 0;) {
    out.triangle[--out.first[piece_of[t]]] = static_cast<std::uint32_t>(t);
  }
  return out;
}

std::vector<Triangle> sound_triangles(const Mesh& mesh, std::span<const std::uint32_t> welded,
                                      std::span<const std::uint32_t> triangles) {
  std::vector<Triangle> sound;
  sound.reserve(triangles.size());
  for (const std::uint32_t t : triangles) {
    Triangle v = mesh.triangles[t];
    const Double3 a = mesh.positions[v[1]] - mesh.positions[v[0]];
    const Double3 b = mesh.positions[v[2]] - mesh.positions[v[0]];
    if (!(length(cross(a, b)) > k_no_area * std::max(dot(a, a), dot(b, b)))) continue;
    for (std::uint32_t& corner : v) corner = welded[corner];
    std::ranges::sort(v);
    if (v[0] != v[1] && v[1] != v[2]) sound.push_back(v);
  }
  std::ranges::sort(sound);
  const auto repeated = std::ranges::unique(sound);
  sound.erase(repeated.begin(), repeated.end());
  return sound;
}

}  // namespace copse
