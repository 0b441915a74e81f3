#include "lib/analysis/rings/cage_rings.h"

#include "lib/analysis/surface/hull_relaxation.h"
#include "lib/analysis/surface/quads.h"
#include "lib/analysis/surface/welded_tolerances.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace copse {
namespace {

// How far a ring is from lying evenly about its centre.
double unevenness(const std::vector<Double3>& positions, std::span<const std::uint32_t> ring) {
  const std::size_t n = ring.size();
  Double3 centre;
  double radius = 0, uneven = 0;
  for (const std::uint32_t v : ring) centre += positions[v] / static_cast<double>(n);
  for (const std::uint32_t v : ring) radius += distance(positions[v], centre) / static_cast<double>(n);
  for (std::size_t i = 0; i < n; ++i) {
    const Double3 &p = positions[ring[i]], &opposite = positions[ring[(i + n / 2) % n]];
    uneven = std::max(uneven, std::abs(distance(p, centre) - radius));
    if (n % 2 == 0) uneven = std::max(uneven, distance(p + opposite, centre * 2.0) / 2);
  }
  return uneven;
}

class CageReader {
 public:
  explicit CageReader(const Cage& cage) : cage_(cage) { c_.precision = cage.precision; }

  CageRings run() {
    triangulate();
    c_.bands.band_of.assign(c_.surface.triangles.size(), k_none);
    add_quad_bands(c_.surface, partner_, c_.bands);
    c_.graph = make_ring_graph(c_.surface, c_.bands);
    if (drop_strips_across_hulls()) c_.graph = make_ring_graph(c_.surface, c_.bands);
    find_forks();
    for (std::uint32_t n = 0; n < c_.graph.nodes(); ++n) c_.was_regular.push_back(c_.is_regular(n));
    if (undo_relaxation()) c_.graph = make_ring_graph(c_.surface, c_.bands);
    return std::move(c_);
  }

 private:
  // Two triangles a quad.
  void triangulate() {
    TrunkMesh mesh;
    mesh.positions = cage_.positions;
    std::vector<std::uint32_t> first, all;
    for (std::uint32_t f = 0; f < cage_.faces.count(); ++f) {
      const auto corners = cage_.faces[f];
      first.push_back(static_cast<std::uint32_t>(mesh.triangles.size()));
      for (std::size_t i = 1; i + 1 < corners.size(); ++i) {
        all.push_back(static_cast<std::uint32_t>(mesh.triangles.size()));
        mesh.triangles.push_back({corners[0], corners[i], corners[i + 1]});
      }
    }
    c_.surface = make_surface(mesh, all);
    c_.local.assign(cage_.positions.size(), k_none);
    for (std::uint32_t v = 0; v < c_.surface.vertex.size(); ++v) c_.local[c_.surface.vertex[v]] = v;
    partner_.assign(c_.surface.triangles.size(), k_none);
    for (std::uint32_t f = 0; f < cage_.faces.count(); ++f) {
      const std::uint32_t a = c_.surface.triangle_of[first[f]];
      c_.triangle_of.push_back(a);
      if (cage_.faces[f].size() != 4) continue;
      const std::uint32_t b = c_.surface.triangle_of[first[f] + 1];
      if (partner_[a] == k_none && partner_[b] == k_none && a != b) partner_[a] = b, partner_[b] = a;
    }
  }

  // Strips of a hull that happen to close: at a ring that limbs lead away from on three sides, what has no
  // regular ring. Whether there were any.
  bool drop_strips_across_hulls() {
    const RingGraph& g = c_.graph;
    Bands kept;
    kept.band_of.assign(c_.surface.triangles.size(), k_none);
    for (std::uint32_t b = 0; b < c_.bands.count(); ++b) {
      const std::uint32_t x = g.node_of[2 * b], y = g.node_of[2 * b + 1];
      const bool is_crossed = g.bands_of[x].size() > 2 || g.bands_of[y].size() > 2;
      if (is_crossed && !c_.is_regular(x) && !c_.is_regular(y)) continue;
      kept.add(c_.bands.ring(2 * b), c_.bands.ring(2 * b + 1), c_.bands.triangles_of(b));
    }
    if (kept.count() == c_.bands.count()) return false;
    c_.bands = std::move(kept);
    return true;
  }

  std::uint32_t end_of(std::uint32_t node, std::uint32_t band) const {
    return c_.graph.node_of[2 * band] == node ? 2 * band : 2 * band + 1;
  }

  void find_forks() {
    const RingGraph& g = c_.graph;
    std::vector<std::vector<std::uint32_t>> forks;
    std::vector<std::uint8_t> taken(g.nodes(), 0);
    c_.is_hull.assign(c_.bands.count(), 0);
    for (std::uint32_t s = 0; s < g.sites; ++s) {
      std::vector<std::uint32_t> ends;
      for (const std::uint32_t n : g.ends[s]) {
        for (const std::uint32_t b : g.bands_of[n]) ends.push_back(end_of(n, b));
      }
      if (ends.size() < 3) continue;
      for (const std::uint32_t n : g.ends[s]) taken[n] = 1;
      forks.push_back(std::move(ends));
    }
    for (std::uint32_t n = 0; n < g.nodes(); ++n) {
      if (taken[n] || g.bands_of[n].size() < 3 || g.site_of[n] != k_none) continue;
      const std::uint32_t hull = band_back(n), other = g.across(n, hull);
      if (taken[other] || g.site_of[other] != k_none) continue;
      std::vector<std::uint32_t> ends;
      for (const std::uint32_t m : {n, other}) {
        taken[m] = 1;
        for (const std::uint32_t b : g.bands_of[m]) {
          if (b != hull) ends.push_back(end_of(m, b));
        }
      }
      c_.is_hull[hull] = 1;
      forks.push_back(std::move(ends));
    }
    c_.fork_of.assign(2 * std::size_t{c_.bands.count()}, k_none);
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (std::uint32_t f = 0; f < forks.size(); ++f) {
      for (const std::uint32_t e : forks[f]) pairs.emplace_back(f, e), c_.fork_of[e] = f;
    }
    c_.ends_of = make_lists(pairs, forks.size());
  }

  // Of the bands at a ring, the one that leads away from all others.
  std::uint32_t band_back(std::uint32_t node) const {
    const RingGraph& g = c_.graph;
    const auto way = [&](std::uint32_t b) {
      return normalized(g.circle[g.across(node, b)].centre - g.circle[node].centre, {});
    };
    Double3 sum;
    for (const std::uint32_t b : g.bands_of[node]) sum += way(b);
    return *std::ranges::min_element(g.bands_of[node], {}, [&](std::uint32_t b) { return dot(way(b), sum); });
  }

  bool is_at_fork(std::uint32_t node) const {
    return std::ranges::any_of(c_.graph.bands_of[node],
                               [&](std::uint32_t b) { return c_.fork_of[end_of(node, b)] != k_none; });
  }

  // The end of a band that is at a fork; k_none where none is, or both.
  std::uint32_t end_at_fork(std::uint32_t band) const {
    const std::uint32_t x = c_.graph.node_of[2 * band], y = c_.graph.node_of[2 * band + 1];
    return is_at_fork(x) == is_at_fork(y) ? k_none : is_at_fork(x) ? 2 * band : 2 * band + 1;
  }

  // The faces of hulls: those in no band, and bands between a hull and a ring that was hung on it.
  bool is_in_hull(std::uint32_t t) const {
    const std::uint32_t b = c_.bands.band_of[t];
    if (b != k_none) return c_.is_hull[b] || is_hung_[b];
    return std::ranges::any_of(c_.surface.triangles[t], [&](std::uint32_t v) {
      return std::ranges::any_of(c_.graph.nodes_of[v], [&](std::uint32_t n) { return is_at_fork(n); });
    });
  }

  // What moved in a hull: for each vertex those that it shares an edge with there.
  Lists relaxed_neighbours() const {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (std::uint32_t f = 0; f < cage_.faces.count(); ++f) {
      if (!is_in_hull(c_.triangle_of[f])) continue;
      const auto corners = cage_.faces[f];
      for (std::size_t i = 0; i < corners.size(); ++i) {
        const std::uint32_t a = c_.local[corners[i]], b = c_.local[corners[(i + 1) % corners.size()]];
        pairs.emplace_back(a, b), pairs.emplace_back(b, a);
      }
    }
    std::ranges::sort(pairs);
    return make_lists(pairs, c_.surface.positions.size());
  }

  // Half for the corners of limbs' rings, as the modifier has it, one for what else a hull has.
  std::vector<double> relaxation_weights() const {
    std::vector<double> weights(c_.surface.positions.size(), 1);
    for (std::uint32_t b = 0; b < c_.bands.count(); ++b) {
      const std::uint32_t face = is_hung_[b] ? end_at_fork(b) : k_none;
      for (const std::uint32_t end : {2 * b, 2 * b + 1}) {
        if (end == face) continue;
        for (const std::uint32_t v : c_.bands.ring(end)) weights[v] = 0.5;
      }
    }
    return weights;
  }

  bool undo_relaxation() {
    find_hung();
    std::vector<std::uint32_t> rings;
    for (std::uint32_t n = 0; n < c_.graph.nodes(); ++n) {
      if (is_at_fork(n)) rings.push_back(n);
    }
    const auto regular = [&](const std::vector<Double3>& positions) {
      return static_cast<std::size_t>(
          std::ranges::count_if(rings, [&](std::uint32_t n) { return is_regular_at(positions, n); }));
    };
    const auto least = static_cast<std::size_t>(k_relaxed_share * static_cast<double>(rings.size()));
    const std::vector<Double3> moved = c_.surface.positions;
    const double factor = undo_hull_relaxation(c_.surface.positions, relaxed_neighbours(),
                                               relaxation_weights(), regular, least);
    if (!(factor > 0)) return false;
    for (std::size_t round = 0; round < k_most_hung && try_hung(moved, factor); ++round) {
    }
    std::vector<Double3> p =
        before_hull_relaxation(moved, relaxed_neighbours(), relaxation_weights(), factor);
    if (!p.empty()) c_.surface.positions = std::move(p);
    return true;
  }

  // The ring across a band from a fork has moved where the band hangs it on the hull, as no others have that
  // are not next to forks themselves. Where that is not clear, as it stays a square or is hung on either
  // side, the band is doubtful.
  void find_hung() {
    std::vector<std::uint32_t> claims(c_.graph.nodes(), 0);
    std::vector<std::uint32_t> bands;
    for (std::uint32_t b = 0; b < c_.bands.count(); ++b) {
      const std::uint32_t end = end_at_fork(b);
      if (end == k_none || c_.was_regular[c_.graph.node_of[end]]) continue;
      bands.push_back(b);
      ++claims[c_.graph.node_of[end ^ 1u]];
    }
    is_hung_.assign(c_.bands.count(), 0);
    doubtful_.resize(c_.ends_of.count());
    for (const std::uint32_t b : bands) {
      const std::uint32_t end = end_at_fork(b), ring = c_.graph.node_of[end ^ 1u];
      is_hung_[b] = claims[ring] == 1 && !c_.was_regular[ring];
      if (!is_hung_[b] && c_.fork_of[end] != k_none) doubtful_[c_.fork_of[end]].push_back(b);
    }
  }

  // A hung ring has two corners, or as a square one, that stand where some of the hull are, once its moving
  // is undone. Tries a doubtful band of each fork; false where there are none left.
  bool try_hung(const std::vector<Double3>& moved, double factor) {
    std::vector<std::uint32_t> tried;
    std::vector<std::uint8_t> is_taken(c_.graph.nodes(), 0);
    for (auto& bands : doubtful_) {
      if (bands.empty()) continue;
      std::uint8_t& taken = is_taken[c_.graph.node_of[end_at_fork(bands.back()) ^ 1u]];
      if (std::exchange(taken, 1)) continue;
      tried.push_back(bands.back());
      bands.pop_back();
    }
    if (tried.empty()) return false;
    for (const std::uint32_t b : tried) is_hung_[b] = 1;
    const std::vector<Double3> p =
        before_hull_relaxation(moved, relaxed_neighbours(), relaxation_weights(), factor);
    for (const std::uint32_t b : tried) {
      const std::uint32_t end = end_at_fork(b);
      is_hung_[b] = !p.empty() && doubled_corners(p, end) + is_regular_at(p, c_.graph.node_of[end ^ 1u]) >= 2;
    }
    return true;
  }

  // How many corners of the ring across a band stand in the place of a corner round the fork.
  std::size_t doubled_corners(const std::vector<Double3>& p, std::uint32_t end) const {
    const auto is_doubled = [&](std::uint32_t w) {
      return std::ranges::any_of(c_.ends_of[c_.fork_of[end]], [&](std::uint32_t e) {
        const double allowed = c_.noise(c_.graph.circle[c_.graph.node_of[e]].radius);
        return std::ranges::any_of(
            c_.bands.ring(e), [&](std::uint32_t v) { return v != w && distance(p[v], p[w]) <= allowed; });
      });
    };
    return static_cast<std::size_t>(std::ranges::count_if(c_.bands.ring(end ^ 1u), is_doubled));
  }

  bool is_regular_at(const std::vector<Double3>& positions, std::uint32_t node) const {
    return unevenness(positions, c_.ring(node)) <= c_.noise(c_.graph.circle[node].radius);
  }

  const Cage& cage_;
  CageRings c_;
  std::vector<std::uint8_t> is_hung_;                 // one a band: whether it hangs a ring on a hull
  std::vector<std::vector<std::uint32_t>> doubtful_;  // one a fork: bands that may
  std::vector<std::uint32_t> partner_;                // one a triangle: the other half of its quad
};

}  // namespace

double CageRings::noise(double radius) const {
  return k_cage_noise * precision + k_cage_tolerance * radius;
}

bool CageRings::is_regular(std::uint32_t node) const {
  return unevenness(surface.positions, ring(node)) <= noise(graph.circle[node].radius);
}

CageRings read_cage_rings(const Cage& cage) {
  return CageReader(cage).run();
}

}  // namespace copse
