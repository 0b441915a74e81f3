#include "lib/analysis/surface/sew.h"

#include "lib/analysis/surface/components.h"
#include "lib/analysis/surface/winding.h"

#include <algorithm>
#include <array>

namespace copse {
namespace {

// Seam edges that are wound alike for each that is not, in a file that winds its triangles with care.
constexpr std::uint64_t k_wound_seams = 16;

// An edge between two points at which several pieces meet, as one piece uses it.
struct EdgeUse {
  std::uint32_t low, high, piece, triangle;
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
          visit(EdgeUse{std::min(a, b), std::max(a, b), piece[t], static_cast<std::uint32_t>(t), a < b});
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
  std::uint32_t low, high;
  std::int32_t folds;  // 1: folded back, wound against one another; -1: not
  friend auto operator<=>(const Seam&, const Seam&) = default;
};

// What the pieces that use one edge have to do with one another.
class Contacts {
 public:
  Contacts(std::span<const Double3> positions, std::span<const Triangle> triangles,
           std::span<const std::uint32_t> piece)
      : positions_(positions),
        triangles_(triangles),
        piece_(piece),
        edges_(contact_edges(triangles, piece)) {}

  void find() {
    each_edge([&](std::span<EdgeUse> uses) { doubt(uses); });
    if (!doubtful_.empty() && (along_ == 0 || !is_wound())) wind_alike();
    each_edge([&](std::span<EdgeUse> uses) { look_at(uses); });
    std::ranges::sort(seams);
    std::ranges::sort(landings);
  }

  // Whether nearly all seams say that the file's triangles are wound alike from piece to piece.
  bool is_wound() const { return k_wound_seams * against_ <= along_; }

  std::vector<Seam> seams;
  std::vector<Landing> landings;

 private:
  template <class Visit>
  void each_edge(const Visit& visit) {
    for (std::size_t i = 0, j = 0; i < edges_.size(); i = j) {
      for (j = i + 1; j < edges_.size() && same_edge(edges_[i], edges_[j]);) ++j;
      visit(std::span(edges_).subspan(i, j - i));
    }
  }

  // Calls `on_boundary` for each use that is its piece's only one; returns the first piece that has several.
  template <class Visit>
  static std::uint32_t each_boundary(std::span<EdgeUse> uses, const Visit& on_boundary) {
    std::uint32_t inner = k_none;
    for (std::size_t i = 0, j = 0; i < uses.size(); i = j) {
      for (j = i + 1; j < uses.size() && uses[j].piece == uses[i].piece;) ++j;
      if (j - i > 1) {
        inner = std::min(inner, uses[i].piece);
      } else {
        on_boundary(uses[i]);
      }
    }
    return inner;
  }

  // Whether two triangles on an edge lie to the same side of it.
  bool lie_alike(const EdgeUse& a, const EdgeUse& b) const {
    const Double3 origin = positions_[a.low], edge = positions_[a.high] - origin;
    const auto away = [&](const EdgeUse& use) {
      Double3 d;
      for (const std::uint32_t v : triangles_[use.triangle]) {
        if (v != use.low && v != use.high) d = positions_[v] - origin;
      }
      return d * dot(edge, edge) - edge * dot(d, edge);
    };
    return dot(away(a), away(b)) > 0;
  }

  // Only where triangles lie to the same side does it matter how they are wound.
  void doubt(std::span<EdgeUse> uses) {
    const EdgeUse *first = nullptr, *last = nullptr;
    bool alike = false;
    std::size_t boundaries = 0;
    each_boundary(uses, [&](EdgeUse& use) {
      alike = alike || (last != nullptr && lie_alike(*last, use));
      if (first == nullptr) first = &use;
      last = &use;
      ++boundaries;
    });
    if (boundaries == 2 && !alike) ++(first->forward == last->forward ? against_ : along_);
    if (!alike && boundaries < 3) return;
    each_boundary(uses, [&](EdgeUse& use) { doubtful_.push_back(use.piece); });
  }

  // The triangles of doubtful pieces are wound alike within each piece, as far as edges of two triangles
  // tell, and outward where that encloses anything. The edges are then used as these go.
  void wind_alike() {
    std::ranges::sort(doubtful_);
    doubtful_.erase(std::unique(doubtful_.begin(), doubtful_.end()), doubtful_.end());
    std::vector<std::uint32_t> some;
    for (std::uint32_t t = 0; t < triangles_.size(); ++t) {
      if (std::ranges::binary_search(doubtful_, piece_[t])) some.push_back(t);
    }
    std::vector<Triangle> corners;
    std::vector<std::uint32_t> pieces;
    for (const std::uint32_t t : some) corners.push_back(triangles_[t]), pieces.push_back(piece_[t]);
    const std::vector<std::uint8_t> turned = turned_triangles(positions_, corners, pieces);
    for (EdgeUse& use : edges_) {
      const auto at = std::ranges::lower_bound(some, use.triangle);
      if (at != some.end() && *at == use.triangle)
        use.forward ^= turned[static_cast<std::size_t>(at - some.begin())];
    }
  }

  Seam seam_between(const EdgeUse& a, const EdgeUse& b) const {
    const bool folds = a.forward == b.forward && lie_alike(a, b);
    return {std::min(a.piece, b.piece), std::max(a.piece, b.piece), a.low, a.high, folds ? 1 : -1};
  }

  // Those with the edge on their boundary share a seam, each with the first that is wound the other way, or
  // with the first of all. A single boundary use among inner ones is a landing.
  void look_at(std::span<EdgeUse> uses) {
    std::array<const EdgeUse*, 2> first{};  // on the boundary, by winding
    std::uint32_t boundaries = 0;
    const std::uint32_t inner = each_boundary(uses, [&](EdgeUse& use) {
      ++boundaries;
      if (first[use.forward] == nullptr) first[use.forward] = &use;
    });
    if (boundaries == 1 && inner != k_none) {
      const EdgeUse& use = first[0] != nullptr ? *first[0] : *first[1];
      landings.push_back({use.piece, inner, use.low, use.high});
    }
    if (boundaries < 2) return;
    each_boundary(uses, [&](EdgeUse& use) {
      const EdgeUse* other = first[1 - use.forward] != nullptr ? first[1 - use.forward] : first[use.forward];
      if (other != &use) seams.push_back(seam_between(use, *other));
    });
  }

  std::span<const Double3> positions_;
  std::span<const Triangle> triangles_;
  std::span<const std::uint32_t> piece_;
  std::vector<EdgeUse> edges_;
  std::vector<std::uint32_t> doubtful_;  // pieces
  std::uint64_t along_ = 0,
                against_ = 0;  // seam edges that are no folds, by how the file winds the triangles there
};

// Whether some of the edges form a closed way.
bool go_round(std::span<const Seam> edges) {
  std::vector<std::uint32_t> ends;
  for (const Seam& e : edges) ends.insert(ends.end(), {e.low, e.high});
  std::ranges::sort(ends);
  ends.erase(std::unique(ends.begin(), ends.end()), ends.end());
  return edges.size() >= ends.size();
}

// Sews the pieces of seams[begin, end) (the same two) unless most of these fold back; where winding says
// little, all the way round something.
void sew_seam(std::span<const Seam> edges, bool is_wound, UnionFind& surfaces) {
  std::int64_t folds = 0;
  for (const Seam& e : edges) folds += e.folds;
  if (folds <= 0 || (!is_wound && !go_round(edges))) surfaces.unite(edges[0].a, edges[0].b);
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
  Contacts contacts(positions, triangles, piece);
  contacts.find();
  for_each_run(
      std::span<const Seam>(contacts.seams),
      [](const Seam& a, const Seam& b) { return a.a == b.a && a.b == b.b; },
      [&](std::span<const Seam> same) { sew_seam(same, contacts.is_wound(), surfaces); });
  for_each_run(
      std::span<const Landing>(contacts.landings),
      [](const Landing& a, const Landing& b) { return a.piece == b.piece && a.host == b.host; },
      [&](std::span<const Landing> same) { sew_landing(same, surfaces); });
  std::vector<std::uint32_t> surface(pieces);
  for (std::uint32_t p = 0; p < pieces; ++p) surface[p] = surfaces.find(p);
  return surface;
}

}  // namespace copse
