#include "lib/analysis/surface/surface.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace copse {

namespace {

// A triangle's edge, seen from the lower of its two vertices; small, as there are three a triangle.
struct EdgeUse {
  std::uint32_t high;  // the other vertex
  std::uint32_t half;  // three times the triangle and the edge of it
  std::uint32_t triangle() const { return half / 3; }
  std::uint32_t edge() const { return half % 3; }
  auto operator<=>(const EdgeUse&) const = default;
};

// Items 0 .. count - 1 sorted into buckets: begin[b] .. begin[b + 1] of `items`.
struct Buckets {
  std::vector<std::uint32_t> begin, items;
};

Buckets triangles_by_lowest(const std::vector<Triangle>& triangles, std::size_t vertices) {
  Buckets b;
  b.begin.assign(vertices + 1, 0);
  for (const Triangle& t : triangles) ++b.begin[std::min({t[0], t[1], t[2]}) + 1];
  for (std::size_t v = 0; v < vertices; ++v) b.begin[v + 1] += b.begin[v];
  b.items.resize(triangles.size());
  std::vector<std::uint32_t> next(b.begin.begin(), b.begin.end() - 1);
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    const Triangle& t = triangles[i];
    b.items[next[std::min({t[0], t[1], t[2]})]++] = i;
  }
  return b;
}

// The first triangle with the same three vertices, for each.
std::vector<std::uint32_t> first_of_same(const std::vector<Triangle>& triangles, std::size_t vertices) {
  const Buckets b = triangles_by_lowest(triangles, vertices);
  std::vector<std::uint32_t> first(triangles.size());
  struct Key {
    std::uint32_t middle, high, triangle;
    auto operator<=>(const Key&) const = default;
  };
  std::vector<Key> keys;
  for (std::size_t v = 0; v < vertices; ++v) {
    keys.clear();
    for (std::uint32_t i = b.begin[v]; i < b.begin[v + 1]; ++i) {
      Triangle t = triangles[b.items[i]];
      std::ranges::sort(t);
      keys.push_back({t[1], t[2], b.items[i]});
    }
    std::ranges::sort(keys);
    for (std::size_t i = 0; i < keys.size(); ++i) {
      const bool same = i > 0 && keys[i].middle == keys[i - 1].middle && keys[i].high == keys[i - 1].high;
      first[keys[i].triangle] = same ? first[keys[i - 1].triangle] : keys[i].triangle;
    }
  }
  return first;
}

class EdgePairing {
 public:
  EdgePairing(Surface& surface, std::span<const std::uint32_t> piece) : surface_(surface), piece_(piece) {}

  // Whether more than two triangles meet at an edge (three times the triangle and the edge of it).
  bool is_crowded(std::uint32_t half) const { return std::ranges::binary_search(crowded_, half); }

  void pair_all() {
    surface_.non_manifold_edges = surface_.border_edges = 0;
    surface_.across.assign(surface_.triangles.size(), Triangle{k_none, k_none, k_none});
    bucket_edges();
    for (std::size_t v = 0; v + 1 < begin_.size(); ++v) {
      const auto from = uses_.begin() + begin_[v], to = uses_.begin() + begin_[v + 1];
      std::sort(from, to);
      for (auto i = from; i != to;) {
        auto j = i;
        while (j != to && j->high == i->high) ++j;
        pair_edge(static_cast<std::uint32_t>(v), {i, j});
        i = j;
      }
    }
    std::ranges::sort(crowded_);
  }

 private:
  void bucket_edges() {
    const auto each = [&](const auto& visit) {
      for (std::uint32_t t = 0; t < surface_.triangles.size(); ++t) {
        for (std::uint32_t e = 0; e < 3; ++e) {
          const std::uint32_t a = surface_.triangles[t][e], b = surface_.triangles[t][(e + 1) % 3];
          visit(std::min(a, b), EdgeUse{std::max(a, b), 3 * t + e});
        }
      }
    };
    begin_.assign(surface_.positions.size() + 1, 0);
    each([&](std::uint32_t low, const EdgeUse&) { ++begin_[low + 1]; });
    for (std::size_t v = 0; v + 1 < begin_.size(); ++v) begin_[v + 1] += begin_[v];
    uses_.resize(begin_.back());
    std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
    each([&](std::uint32_t low, const EdgeUse& use) { uses_[next[low]++] = use; });
  }

  void join(const EdgeUse& a, const EdgeUse& b) {
    surface_.across[a.triangle()][a.edge()] = b.triangle();
    surface_.across[b.triangle()][b.edge()] = a.triangle();
  }

  // Whether it runs from the lower to the higher vertex.
  bool is_rising(const EdgeUse& use) const {
    return surface_.triangles[use.triangle()][(use.edge() + 1) % 3] == use.high;
  }

  void pair_edge(std::uint32_t low, std::span<EdgeUse> uses) {
    if (uses.size() == 1) ++surface_.border_edges;
    if (uses.size() == 2) join(uses[0], uses[1]);
    if (uses.size() > 2) {
      ++surface_.non_manifold_edges;
      for (const EdgeUse& use : uses) crowded_.push_back(use.half);
      if (!pair_by_piece(uses)) pair_by_matter(low, uses);
    }
  }

  bool pair_by_piece(std::span<EdgeUse> uses) {
    std::ranges::sort(uses, [&](const EdgeUse& a, const EdgeUse& b) {
      const std::uint32_t pa = piece_[a.triangle()], pb = piece_[b.triangle()];
      return pa != pb ? pa < pb : a.half < b.half;
    });
    const auto piece = [&](std::size_t i) { return piece_[uses[i].triangle()]; };
    bool paired = false;
    for (std::size_t i = 0, j = 0; i < uses.size(); i = j) {
      while (j < uses.size() && piece(j) == piece(i)) ++j;
      if (j - i == 2) join(uses[i], uses[i + 1]), paired = true;
    }
    return paired;
  }

  // Turns about the edge; between a triangle that runs one way and the next one, which runs the other way,
  // there is matter on one side and air on the other.
  void pair_by_matter(std::uint32_t low, std::span<EdgeUse> uses) {
    if (uses.size() % 2 != 0) return;
    const Double3 origin = surface_.positions[low];
    const Double3 axis = normalized(surface_.positions[uses[0].high] - origin);
    const Double3 any = std::abs(axis.x) < 0.5 ? Double3{1, 0, 0} : Double3{0, 1, 0};
    const Double3 u = normalized(cross(axis, any)), v = cross(axis, u);
    std::vector<std::pair<double, std::size_t>> turn;
    for (std::size_t i = 0; i < uses.size(); ++i) {
      const std::uint32_t apex = third_corner(surface_.triangles[uses[i].triangle()], low, uses[i].high);
      const Double3 d = surface_.positions[apex] - origin;
      turn.emplace_back(std::atan2(dot(d, v), dot(d, u)), i);
    }
    std::ranges::sort(turn);
    for (std::size_t i = 0; i < turn.size(); ++i) {
      if (is_rising(uses[turn[i].second]) == is_rising(uses[turn[(i + 1) % turn.size()].second])) return;
    }
    // With u, v, axis right-handed, a triangle that runs up the edge faces the side of growing angle, so
    // matter lies before it.
    const std::size_t first = is_rising(uses[turn[0].second]) ? turn.size() - 1 : 0;
    for (std::size_t i = 0; i < turn.size(); i += 2) {
      join(uses[turn[(first + i) % turn.size()].second], uses[turn[(first + i + 1) % turn.size()].second]);
    }
  }

  Surface& surface_;
  std::span<const std::uint32_t> piece_;
  std::vector<std::uint32_t> begin_, crowded_;
  std::vector<EdgeUse> uses_;
};

// Two triangles that share an edge, by the four corners of both, ascending.
struct Pair {
  std::array<std::uint32_t, 4> corners;
  std::uint32_t t, u;
  auto operator<=>(const Pair&) const = default;
};

// Four points are a quad and no solid: six volumes over the cube of the longest side.
bool is_flat(const std::vector<Double3>& positions, const std::array<std::uint32_t, 4>& corners) {
  constexpr double k_flat = 0.2;
  const Double3 a = positions[corners[0]];
  const Double3 u = positions[corners[1]] - a, v = positions[corners[2]] - a, w = positions[corners[3]] - a;
  const double longest = std::max({length(u), length(v), length(w)});
  return longest > 0 && std::abs(dot(cross(u / longest, v / longest), w / longest)) <= k_flat;
}

// Whether two triangles on an edge lie to both sides of it, as the halves of a quad do.
bool are_opposite(const std::vector<Double3>& positions, std::uint32_t a, std::uint32_t b,
                  const std::array<std::uint32_t, 2>& tips) {
  const Double3 along = normalized(positions[b] - positions[a]);
  const auto away = [&](std::uint32_t tip) {
    const Double3 d = normalized(positions[tip] - positions[a]);
    return d - along * dot(d, along);
  };
  return dot(away(tips[0]), away(tips[1])) < 0;
}

// For each triangle the one that stands for it: itself but where a surface is laid double and the second
// layer cuts a quad by the other diagonal, as exporters do that cut each face from its first corner. Empty
// where there are none.
std::vector<std::uint32_t> without_second_diagonals(const Surface& s, const EdgePairing& edges) {
  std::vector<Pair> pairs;
  for (std::uint32_t t = 0; t < s.triangles.size(); ++t) {
    for (std::uint32_t e = 0; e < 3; ++e) {
      const std::uint32_t u = s.across[t][e];
      if (u == k_none || u < t || edges.is_crowded(3 * t + e)) continue;
      const bool beside = edges.is_crowded(3 * t + (e + 1) % 3) || edges.is_crowded(3 * t + (e + 2) % 3);
      if (!beside) continue;
      const std::uint32_t a = s.triangles[t][e], b = s.triangles[t][(e + 1) % 3];
      const std::array tips{third_corner(s.triangles[t], a, b), third_corner(s.triangles[u], a, b)};
      if (!are_opposite(s.positions, a, b, tips)) continue;
      Pair pair{{a, b, tips[0], tips[1]}, t, u};
      std::ranges::sort(pair.corners);
      if (is_flat(s.positions, pair.corners)) pairs.push_back(pair);
    }
  }
  std::ranges::sort(pairs);
  std::vector<std::uint32_t> stands_for;
  for (std::size_t i = 1; i < pairs.size(); ++i) {
    const Pair &first = pairs[i - 1], &second = pairs[i];
    if (first.corners != second.corners) continue;
    if (second.t == first.t || second.t == first.u || second.u == first.u)
      continue;  // three faces round a point
    if (stands_for.empty()) {
      stands_for.resize(s.triangles.size());
      std::iota(stands_for.begin(), stands_for.end(), 0u);
    }
    if (stands_for[first.t] != first.t || stands_for[first.u] != first.u) continue;
    stands_for[second.t] = first.t, stands_for[second.u] = first.u;
  }
  return stands_for;
}

// The triangles with compact numbers of vertices; `used` receives the vertices in ascending order.
std::vector<Triangle> number_vertices(const TrunkMesh& whole, std::span<const std::uint32_t> triangles,
                                      std::vector<std::uint32_t>& used) {
  std::vector<Triangle> local;
  local.reserve(triangles.size());
  std::uint32_t low = k_none, high = 0;
  for (const std::uint32_t t : triangles) {
    local.push_back(whole.triangles[t]);
    for (const std::uint32_t v : local.back()) low = std::min(low, v), high = std::max(high, v);
  }
  if (local.empty()) return local;
  if (high - low < 24 * local.size()) {  // nearly always: a table costs less than sorting
    std::vector<std::uint32_t> number(high - low + 1, 0);
    for (const Triangle& t : local) {
      for (const std::uint32_t v : t) number[v - low] = 1;
    }
    for (std::uint32_t i = 0; i < number.size(); ++i) {
      if (number[i] == 0) continue;
      number[i] = static_cast<std::uint32_t>(used.size());
      used.push_back(low + i);
    }
    for (Triangle& t : local) {
      for (std::uint32_t& v : t) v = number[v - low];
    }
  } else {
    for (const Triangle& t : local) used.insert(used.end(), t.begin(), t.end());
    std::ranges::sort(used);
    const auto repeated = std::ranges::unique(used);
    used.erase(repeated.begin(), repeated.end());
    for (Triangle& t : local) {
      for (std::uint32_t& v : t) {
        v = static_cast<std::uint32_t>(std::ranges::lower_bound(used, v) - used.begin());
      }
    }
  }
  return local;
}

// Leaves out the triangles that others stand for.
void keep_standing(Surface& s, std::vector<std::uint32_t>& piece, std::span<const std::uint32_t> stands_for) {
  std::vector<std::uint32_t> number(stands_for.size(), k_none);
  std::uint32_t kept = 0;
  for (std::uint32_t t = 0; t < stands_for.size(); ++t) {
    if (stands_for[t] != t) continue;
    s.triangles[kept] = s.triangles[t], s.order[kept] = s.order[t], piece[kept] = piece[t];
    number[t] = kept++;
  }
  s.triangles.resize(kept), s.order.resize(kept), piece.resize(kept);
  for (std::uint32_t& t : s.triangle_of) t = number[stands_for[t]];
}

}  // namespace

Surface make_surface(const TrunkMesh& whole, std::span<const std::uint32_t> triangles) {
  Surface s;
  s.triangles = number_vertices(whole, triangles, s.vertex);
  s.positions.reserve(s.vertex.size());
  for (std::uint32_t v : s.vertex) s.positions.push_back(whole.positions[v]);

  s.triangle_of = first_of_same(s.triangles, s.positions.size());
  std::vector<std::uint32_t> piece;
  piece.reserve(triangles.size()), s.order.reserve(triangles.size());
  std::uint32_t kept = 0;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    if (const std::uint32_t first = s.triangle_of[i]; first != i) {
      s.triangle_of[i] = s.triangle_of[first];
      continue;
    }
    s.triangle_of[i] = kept;
    s.triangles[kept++] = s.triangles[i];
    s.order.push_back(!whole.file_order.empty() ? whole.file_order[triangles[i]]
                      : whole.source.empty()    ? i
                                                : whole.source[triangles[i]]);
    piece.push_back(whole.piece.empty() ? 0 : whole.piece[triangles[i]]);
  }
  s.triangles.resize(kept);
  EdgePairing edges(s, piece);
  edges.pair_all();
  if (s.non_manifold_edges == 0) return s;
  if (const auto stands_for = without_second_diagonals(s, edges); !stands_for.empty()) {
    keep_standing(s, piece, stands_for);
    EdgePairing(s, piece).pair_all();
  }
  return s;
}

std::vector<std::uint32_t> border_loop(const Surface& surface, std::uint32_t triangle, std::size_t edge) {
  std::vector<std::uint32_t> loop;
  std::uint32_t t = triangle;
  std::uint32_t a = surface.triangles[t][edge], b = surface.triangles[t][(edge + 1) % 3];
  const std::uint32_t first = a, second = b;
  do {
    loop.push_back(a);
    for (;;) {
      const std::uint32_t x = third_corner(surface.triangles[t], a, b);
      const std::uint32_t n =
          surface.across[t][static_cast<std::size_t>(edge_between(surface.triangles[t], b, x))];
      a = x;
      if (n == k_none) break;
      t = n;
    }
    std::swap(a, b);
  } while (t != triangle || a != first || b != second);
  return loop;
}

}  // namespace copse
