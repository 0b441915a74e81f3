#include "lib/analysis/rings/ring_graph.h"

#include "lib/analysis/surface/components.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace copse {

using Pairs = std::vector<std::pair<std::uint32_t, std::uint32_t>>;

namespace {

// Rings with the same vertices get the same node; nodes are numbered by their first ring.
void find_nodes(const Surface& surface, const Bands& bands, RingGraph& g) {
  const std::uint32_t rings = 2 * bands.count();
  std::vector<std::uint32_t> sorted = bands.vertices;
  const auto vertices = [&](std::uint32_t r) {
    return std::span(sorted).subspan(bands.first_vertex[r],
                                     bands.first_vertex[r + 1] - bands.first_vertex[r]);
  };
  for (std::uint32_t r = 0; r < rings; ++r) std::ranges::sort(vertices(r));
  std::vector<std::uint32_t> order(rings);
  std::iota(order.begin(), order.end(), 0u);
  std::ranges::sort(order, [&](std::uint32_t a, std::uint32_t b) {
    const auto va = vertices(a), vb = vertices(b);
    const auto c = std::lexicographical_compare_three_way(va.begin(), va.end(), vb.begin(), vb.end());
    return c != 0 ? c < 0 : a < b;
  });
  std::vector<std::uint32_t> first_same(rings);
  for (std::uint32_t i = 0; i < rings; ++i) {
    const bool same = i > 0 && std::ranges::equal(vertices(order[i]), vertices(order[i - 1]));
    first_same[order[i]] = same ? first_same[order[i - 1]] : order[i];
  }
  g.node_of.resize(rings);
  Pairs bands_of;
  for (std::uint32_t r = 0; r < rings; ++r) {
    if (first_same[r] == r) {
      g.node_of[r] = g.nodes();
      g.ring.push_back(r);
      g.circle.push_back(ring_circle(surface.positions, bands.ring(r)));
    } else {
      g.node_of[r] = g.node_of[first_same[r]];
    }
    bands_of.emplace_back(g.node_of[r], r / 2);
  }
  g.bands_of = make_lists(bands_of, g.nodes());
  Pairs nodes_of;
  for (std::uint32_t n = 0; n < g.nodes(); ++n) {
    for (const std::uint32_t v : bands.ring(g.ring[n])) nodes_of.emplace_back(v, n);
  }
  g.nodes_of = make_lists(nodes_of, surface.positions.size());
}

// Unites nodes and patches into sites. Elements of the union: nodes first, then triangles.
class SiteFinder {
 public:
  SiteFinder(const Surface& surface, const Bands& bands, RingGraph& g)
      : s_(surface),
        bands_(bands),
        g_(g),
        sites_(g.nodes() + surface.triangles.size()),
        clusters_(g.nodes() + surface.triangles.size()),
        meets_(g.nodes(), 0) {}

  void find() {
    for (std::uint32_t b = 0; b < bands_.count(); ++b)
      clusters_.unite(g_.node_of[2 * b], g_.node_of[2 * b + 1]);
    unite_patches();
    for (std::uint32_t t = 0; t < s_.triangles.size(); ++t) unite_across(t);
    unite_what_only_touches();
    number();
  }

 private:
  std::uint32_t element(std::uint32_t triangle) const { return g_.nodes() + triangle; }
  bool loose(std::uint32_t t) const { return bands_.band_of[t] == k_none; }

  void meet(std::uint32_t a, std::uint32_t b) {
    sites_.unite(a, b);
    clusters_.unite(a, b);
    if (a < g_.nodes()) meets_[a] = 1;
    if (b < g_.nodes()) meets_[b] = 1;
  }

  // Loose triangles around a vertex that is on no ring belong together.
  void unite_patches() {
    std::vector<std::uint32_t> first(s_.positions.size(), k_none);
    for (std::uint32_t t = 0; t < s_.triangles.size(); ++t) {
      if (!loose(t)) continue;
      for (const std::uint32_t v : s_.triangles[t]) {
        if (!g_.nodes_of[v].empty()) continue;
        if (first[v] == k_none) first[v] = t;
        meet(element(first[v]), element(t));
      }
    }
  }

  std::uint32_t node_at(std::uint32_t band, std::uint32_t a, std::uint32_t b) const {
    for (const std::uint32_t r : {2 * band, 2 * band + 1}) {
      const auto ring = bands_.ring(r);
      if (std::ranges::count(ring, a) != 0 && std::ranges::count(ring, b) != 0) return g_.node_of[r];
    }
    return k_none;
  }

  void unite_across(std::uint32_t t) {
    for (std::size_t e = 0; e < 3; ++e) {
      const std::uint32_t n = s_.across[t][e], a = s_.triangles[t][e], b = s_.triangles[t][(e + 1) % 3];
      if (n == k_none || n < t || (bands_.band_of[n] == bands_.band_of[t] && !loose(t))) continue;
      const std::uint32_t x = loose(t) ? element(t) : node_at(bands_.band_of[t], a, b);
      const std::uint32_t y = loose(n) ? element(n) : node_at(bands_.band_of[n], a, b);
      if (x != k_none && y != k_none && x != y) meet(x, y);
    }
  }

  // What is joined by nothing but a vertex is joined there.
  void unite_what_only_touches() {
    std::vector<std::uint32_t> first(s_.positions.size(), k_none);
    const auto touch = [&](std::uint32_t v, std::uint32_t x) {
      if (first[v] == k_none) first[v] = x;
      if (clusters_.find(first[v]) != clusters_.find(x)) meet(first[v], x);
    };
    for (std::uint32_t n = 0; n < g_.nodes(); ++n) {
      for (const std::uint32_t v : bands_.ring(g_.ring[n])) touch(v, n);
    }
    for (std::uint32_t t = 0; t < s_.triangles.size(); ++t) {
      if (!loose(t)) continue;
      for (const std::uint32_t v : s_.triangles[t]) touch(v, element(t));
    }
  }

  void number() {
    number_.assign(g_.nodes() + s_.triangles.size(), k_none);
    const auto site = [&](std::uint32_t x) {
      std::uint32_t& id = number_[sites_.find(x)];
      if (id == k_none) id = g_.sites++;
      return id;
    };
    g_.site_of.assign(g_.nodes(), k_none);
    Pairs ends, patch;
    for (std::uint32_t n = 0; n < g_.nodes(); ++n) {
      if (meets_[n]) ends.emplace_back(g_.site_of[n] = site(n), n);
    }
    for (std::uint32_t t = 0; t < s_.triangles.size(); ++t) {
      if (loose(t)) patch.emplace_back(site(element(t)), t);
    }
    g_.is_open.assign(g_.sites, 0);
    for (std::uint32_t t = 0; t < s_.triangles.size(); ++t) {
      for (std::size_t e = 0; e < 3; ++e) {
        if (s_.across[t][e] == k_none) mark_open(t, s_.triangles[t][e], s_.triangles[t][(e + 1) % 3]);
      }
    }
    g_.ends = make_lists(ends, g_.sites);
    g_.patch = make_lists(patch, g_.sites);
  }

  void mark_open(std::uint32_t t, std::uint32_t a, std::uint32_t b) {
    if (loose(t)) {
      g_.is_open[number_[sites_.find(element(t))]] = 1;
    } else if (const std::uint32_t n = node_at(bands_.band_of[t], a, b);
               n != k_none && g_.site_of[n] != k_none) {
      g_.is_open[g_.site_of[n]] = 1;
    }
  }

  const Surface& s_;
  const Bands& bands_;
  RingGraph& g_;
  std::vector<std::uint32_t> number_;  // one an element that stands for its site
  UnionFind sites_, clusters_;
  std::vector<std::uint8_t> meets_;
};

}  // namespace

RingGraph make_ring_graph(const Surface& surface, const Bands& bands) {
  RingGraph g;
  find_nodes(surface, bands, g);
  SiteFinder(surface, bands, g).find();
  return g;
}

}  // namespace copse
