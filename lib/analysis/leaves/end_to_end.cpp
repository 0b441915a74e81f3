#include "lib/analysis/leaves/end_to_end.h"

#include "lib/analysis/surface/components.h"
#include "lib/analysis/surface/tolerances.h"
#include "lib/analysis/surface/weld.h"

#include <algorithm>
#include <array>
#include <numeric>
#include <tuple>
#include <utility>

namespace copse {
namespace {

struct BorderRing {
  std::uint32_t piece = 0, material = k_none;
  Double3 centre, inward;  // inward: towards the mean of the corners across its edges
  double radius = 0;
};

// The border of one piece, ring by ring.
class Border {
 public:
  Border(const Mesh& mesh, std::span<const std::uint32_t> welded) : mesh_(mesh), welded_(welded) {}

  // Calls use(ring) for each closed ring; what runs through a vertex twice is none.
  template <class Use>
  void for_each_ring(const Pieces& pieces, std::span<const std::uint32_t> triangles, Use&& use) {
    collect(pieces, triangles);
    for (std::size_t i = 0; i < ends_.size();) {
      std::size_t end = i;
      while (end < ends_.size() && ends_[end].vertex == ends_[i].vertex) ++end;
      if (!done_[i]) {
        walk(i);
        if (closed_) use(ring());
      }
      i = end;
    }
  }

 private:
  struct End {                            // of a border edge
    std::uint32_t vertex, other, across;  // across: the third corner of its triangle
    auto operator<=>(const End&) const = default;
  };

  void collect(const Pieces& pieces, std::span<const std::uint32_t> triangles) {
    ends_.clear();
    for (const std::uint32_t t : triangles) {
      for (int e = 0; e < 3; ++e) {
        if (!(pieces.edges[t] & Pieces::border_0 << e)) continue;
        const std::uint32_t a = welded_[mesh_.triangles[t][e]], b = welded_[mesh_.triangles[t][(e + 1) % 3]];
        if (a == b) continue;
        const std::uint32_t across = welded_[mesh_.triangles[t][(e + 2) % 3]];
        ends_.push_back({a, b, across}), ends_.push_back({b, a, across});
      }
    }
    std::ranges::sort(ends_);
    done_.assign(ends_.size(), false);
  }

  // All border edges that are joined to ends_[from], in no order: a ring's centre and radius need none.
  void walk(std::size_t from) {
    closed_ = true;
    vertices_.clear(), across_.clear();
    todo_.assign(1, from);
    done_[from] = true;
    while (!todo_.empty()) {
      const std::size_t first = todo_.back();
      todo_.pop_back();
      vertices_.push_back(ends_[first].vertex);
      std::size_t at = first;
      for (; at < ends_.size() && ends_[at].vertex == ends_[first].vertex; ++at) {
        across_.push_back(ends_[at].across);
        const auto next = static_cast<std::size_t>(
            std::ranges::lower_bound(ends_, End{ends_[at].other, 0, 0}) - ends_.begin());
        if (!std::exchange(done_[next], true)) todo_.push_back(next);
      }
      closed_ = closed_ && at == first + 2;
    }
    closed_ = closed_ && vertices_.size() >= 3;
  }

  Double3 mean(std::span<const std::uint32_t> vertices) const {
    Double3 sum;
    for (const std::uint32_t v : vertices) sum += mesh_.positions[v] / static_cast<double>(vertices.size());
    return sum;
  }
  BorderRing ring() const {
    BorderRing ring;
    ring.centre = mean(vertices_);
    ring.inward = normalized(mean(across_) - ring.centre, {});
    for (const std::uint32_t v : vertices_)
      ring.radius += distance(mesh_.positions[v], ring.centre) / static_cast<double>(vertices_.size());
    return ring;
  }

  const Mesh& mesh_;
  std::span<const std::uint32_t> welded_;
  std::vector<End> ends_;
  std::vector<char> done_;  // at the first end of each vertex
  std::vector<std::size_t> todo_;
  std::vector<std::uint32_t> vertices_, across_;
  bool closed_ = true;
};

// As far apart as what was computed twice or rounded by a file may be, and never by much of the ring.
double reach(double radius, double size) {
  return std::max(k_join_tolerance * radius, std::min(k_weld_of_edge * radius, 2 * k_rounding * size));
}

// Of rings in one place, those that lead away to its two sides. Limbs that begin side by side in one place
// lead to one.
void join_opposite(std::span<const BorderRing> rings, std::span<const std::uint32_t> here,
                   UnionFind& chains) {
  const auto are_opposite = [&](std::uint32_t a, std::uint32_t b) {
    return dot(rings[a].inward, rings[b].inward) < 0;
  };
  const auto back =
      std::ranges::find_if(here, [&](std::uint32_t r) { return are_opposite(here.front(), r); });
  if (back == here.end()) return;
  for (const std::uint32_t r : here) {
    if (are_opposite(here.front(), r)) chains.unite(rings[here.front()].piece, rings[r].piece);
    if (are_opposite(*back, r)) chains.unite(rings[*back].piece, rings[r].piece);
  }
}

}  // namespace

std::vector<std::uint32_t> end_to_end(const Mesh& mesh, std::span<const std::uint32_t> welded,
                                      const Pieces& pieces, const PieceTriangles& triangles,
                                      std::span<const std::uint32_t> asked) {
  DoubleBox box;
  for (const Double3& p : mesh.positions) box.grow(p);
  const double size = box.empty() ? 0 : length(box.extent());
  Border border(mesh, welded);
  std::vector<BorderRing> rings;
  for (const std::uint32_t p : asked) {
    const std::uint32_t material = mesh.parts[mesh.part_of[triangles.of(p)[0]]].material;
    border.for_each_ring(pieces, triangles.of(p), [&](BorderRing ring) {
      ring.piece = p, ring.material = material;
      if (ring.radius > 0) rings.push_back(ring);
    });
  }
  std::vector<Double3> centres;
  std::vector<double> reaches;
  for (const BorderRing& r : rings) centres.push_back(r.centre), reaches.push_back(reach(r.radius, size));
  const std::vector<std::uint32_t> place = weld(centres, reaches);
  std::vector<std::uint32_t> order(rings.size());
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::sort(order, {}, [&](std::uint32_t r) {
    return std::tuple(place[r], rings[r].material, rings[r].radius, rings[r].piece);
  });
  UnionFind chains(pieces.count);
  for (std::size_t begin = 0, end = 0; begin < order.size(); begin = end) {
    for (end = begin + 1; end < order.size() && place[order[begin]] == place[order[end]]; ++end) {
      const BorderRing &a = rings[order[end - 1]], &b = rings[order[end]];
      if (a.material != b.material || b.radius - a.radius > reach(b.radius, size)) break;
    }
    join_opposite(rings, std::span(order).subspan(begin, end - begin), chains);
  }
  std::vector<std::uint32_t> chain_of(pieces.count);
  for (std::uint32_t p = 0; p < pieces.count; ++p) chain_of[p] = chains.find(p);
  return chain_of;
}

}  // namespace copse
