#include "lib/analysis/rings/ring_front.h"

#include <algorithm>
#include <limits>

namespace copse {
namespace {

constexpr std::uint32_t k_fresh = k_none - 1;  // in ring_of_: beyond the current ring, place_ is the index

}  // namespace

RingFront::RingFront(const TrunkMesh& mesh, const Fans& fans)
    : mesh_(mesh),
      fans_(fans),
      ring_of_(mesh.positions.size(), k_none),
      place_(mesh.positions.size(), 0),
      owner_(mesh.triangles.size(), k_none),
      lid_(mesh.triangles.size(), 0) {}

void RingFront::forget() {
  for (const std::uint32_t v : rings_.vertices) ring_of_[v] = k_none;
  for (const std::uint32_t v : fresh_) ring_of_[v] = k_none;
  for (const std::uint32_t t : touched_) owner_[t] = k_none, lid_[t] = 0;
  rings_.parent.clear();
  rings_.first_vertex.assign(1, 0);
  rings_.vertices.clear();
  closed_.clear();
  touched_.clear();
  fresh_.clear();
}

bool RingFront::read(std::span<const std::uint32_t> start, bool closed, RingSizes sizes) {
  forget();
  rings_.parent.push_back(k_none);
  rings_.vertices.assign(start.begin(), start.end());
  rings_.first_vertex.push_back(static_cast<std::uint32_t>(start.size()));
  closed_.push_back(closed);
  for (std::uint32_t i = 0; i < start.size(); ++i) {
    if (ring_of_[start[i]] != k_none) return false;  // the loop crosses itself
    ring_of_[start[i]] = 0;
    place_[start[i]] = i;
  }
  for (std::uint32_t ring = 0; ring < rings_.size(); ++ring) {
    if (!expand(ring, sizes)) return false;
  }
  return true;
}

bool RingFront::expand(std::uint32_t ring, RingSizes sizes) {
  if (!collect(ring) || !link_fresh() || !trace_chains()) return false;
  if (chains_.size() > 1) std::ranges::stable_sort(bands_, {}, &Band::chain);
  const std::uint32_t size = static_cast<std::uint32_t>(rings_.ring(ring).size());
  std::size_t begin = 0;
  for (std::uint32_t c = 0; c < chains_.size(); ++c) {
    const Chain chain = chains_[c];
    if (sizes == RingSizes::constant && size > 1 && chain.size > 1 && chain.size != size) return false;
    std::size_t end = begin;
    while (end < bands_.size() && bands_[end].chain == c) ++end;
    const auto bands = std::span(bands_).subspan(begin, end - begin);
    if (!check_band(ring, chain, bands)) return false;
    append_ring(ring, chain, bands);
    begin = end;
  }
  fresh_.clear();
  return true;
}

bool RingFront::collect(std::uint32_t ring) {
  bands_.clear();
  fresh_.clear();
  std::size_t lids = touched_.size();
  const std::uint32_t begin = rings_.first_vertex[ring], end = rings_.first_vertex[ring + 1];
  for (std::uint32_t i = begin; i < end; ++i) {
    for (const std::uint32_t t : fans_.of(rings_.vertices[i])) {
      if (owner_[t] == k_none && !collect(ring, t)) return false;
    }
  }
  // A lid without a centre has two triangles less than the ring has vertices; a ring has two sides.
  lids = touched_.size() - lids - bands_.size();
  return lids == 0 || lids + 4 <= 2 * std::size_t{end - begin};
}

bool RingFront::collect(std::uint32_t ring, std::uint32_t triangle) {
  std::uint32_t on_ring[3], fresh[3];
  int ring_count = 0, fresh_count = 0;
  for (const std::uint32_t v : mesh_.triangles[triangle]) {
    if (ring_of_[v] == ring) {
      on_ring[ring_count++] = place_[v];
      continue;
    }
    if (ring_of_[v] == k_none) {
      ring_of_[v] = k_fresh;
      place_[v] = static_cast<std::uint32_t>(fresh_.size());
      fresh_.push_back(v);
    }
    if (ring_of_[v] != k_fresh) return false;  // back to a ring that is done: not a tree of tubes
    fresh[fresh_count++] = place_[v];
  }
  owner_[triangle] = ring;
  touched_.push_back(triangle);
  const std::uint32_t size = rings_.first_vertex[ring + 1] - rings_.first_vertex[ring];
  if (ring_count == 3) {
    lid_[triangle] = 1;
  } else if (ring_count == 2) {
    std::uint32_t at = std::min(on_ring[0], on_ring[1]);
    const std::uint32_t other = std::max(on_ring[0], on_ring[1]);
    if (at == 0 && other == size - 1 && size > 2) {
      at = other;
    } else if (other != at + 1) {
      return false;  // a chord of the ring
    }
    bands_.push_back({triangle, at, fresh[0], k_none, 0});
  } else {
    bands_.push_back({triangle, on_ring[0], fresh[0], fresh[1], 0});
  }
  return true;
}

bool RingFront::link_fresh() {
  neighbour_.assign(fresh_.size(), {k_none, k_none});
  degree_.assign(fresh_.size(), 0);
  for (const Band& band : bands_) {
    if (band.b == k_none) continue;
    if (degree_[band.a] == 2 || degree_[band.b] == 2) return false;
    neighbour_[band.a][degree_[band.a]++] = band.b;
    neighbour_[band.b][degree_[band.b]++] = band.a;
  }
  return true;
}

bool RingFront::trace_chains() {
  chains_.clear();
  chain_vertices_.clear();
  chain_of_.assign(fresh_.size(), k_none);
  place_in_chain_.resize(fresh_.size());
  for (std::uint32_t start = 0; start < fresh_.size(); ++start) {
    if (chain_of_[start] != k_none) continue;
    Chain chain{static_cast<std::uint32_t>(chain_vertices_.size()), 0, false};
    std::uint32_t previous = k_none, current = start;
    while (current != k_none && chain_of_[current] == k_none) {
      chain_of_[current] = static_cast<std::uint32_t>(chains_.size());
      place_in_chain_[current] = chain.size++;
      chain_vertices_.push_back(current);
      const auto& [first, second] = neighbour_[current];
      const std::uint32_t next = first == previous ? second : first;
      previous = current;
      current = next;
    }
    chain.closed = current == start;
    // A closed ring, a point, or the rung of a strip: two vertices with one edge.
    const bool is_rung = chain.size == 2 && degree_[start] == 1;
    if (!chain.closed && chain.size != 1 && !is_rung) return false;
    chains_.push_back(chain);
  }
  for (Band& band : bands_) band.chain = chain_of_[band.a];
  return true;
}

bool RingFront::check_band(std::uint32_t ring, const Chain& chain, std::span<const Band> bands) {
  const std::uint32_t size = rings_.first_vertex[ring + 1] - rings_.first_vertex[ring];
  if (size > 1 && chain.size > 1 && is_closed(ring) != chain.closed) return false;
  const std::uint32_t edges = size == 1 ? 0 : is_closed(ring) ? size : size - 1;
  const std::uint32_t chain_edges = chain.size == 1 ? 0 : chain.closed ? chain.size : chain.size - 1;
  over_edge_.assign(size, k_none);
  fan_size_.assign(size, 0);
  std::uint32_t seen_edges = 0, seen_chain_edges = 0;
  for (const Band& band : bands) {
    if (band.b != k_none) {
      ++fan_size_[band.at];
      ++seen_chain_edges;
      continue;
    }
    // The two edges of a flat ring join the same vertices; which is which does not matter.
    const std::uint32_t at = size == 2 && over_edge_[0] != k_none && is_closed(ring) ? 1 : band.at;
    if (over_edge_[at] != k_none) return false;
    over_edge_[at] = band.a;
    ++seen_edges;
  }
  if (seen_edges != edges || seen_chain_edges != chain_edges) return false;
  forward_ = true;
  if (size < 3 || chain.size < 3 || check_winding(chain)) return true;
  forward_ = false;
  return check_winding(chain);
}

// Once round the ring, the vertices over its edges must go once round the chain, each as many steps on as
// its fan has triangles.
bool RingFront::check_winding(const Chain& chain) {
  const std::size_t size = over_edge_.size();
  for (std::size_t j = 0; j < size; ++j) {
    const std::uint32_t from = place_in_chain_[over_edge_[j == 0 ? size - 1 : j - 1]];
    const std::uint32_t to = place_in_chain_[over_edge_[j]];
    const std::uint32_t steps = (forward_ ? to + chain.size - from : from + chain.size - to) % chain.size;
    if (steps != fan_size_[j] % chain.size) return false;
  }
  return true;
}

// The place in the chain of the neighbour of the ring's vertex 0 that is nearest to it.
std::uint32_t RingFront::nearest_in_first_fan(std::uint32_t ring, const Chain& chain) const {
  const Double3& from = mesh_.positions[rings_.ring(ring)[0]];
  std::uint32_t place = place_in_chain_[over_edge_.back()];
  std::uint32_t best = place;
  double best_distance = std::numeric_limits<double>::infinity();
  for (std::uint32_t step = 0; step <= fan_size_[0] && step < chain.size; ++step) {
    const double d = distance(from, mesh_.positions[fresh_[chain_vertices_[chain.first + place]]]);
    if (d < best_distance) best = place, best_distance = d;
    place = (forward_ ? place + 1 : place + chain.size - 1) % chain.size;
  }
  return best;
}

void RingFront::append_ring(std::uint32_t parent, const Chain& chain, std::span<const Band> bands) {
  const std::uint32_t ring = rings_.size();
  const bool oriented = over_edge_.size() > 2 && chain.size > 2;
  std::uint32_t place = oriented ? nearest_in_first_fan(parent, chain) : 0;
  for (std::uint32_t i = 0; i < chain.size; ++i) {
    const std::uint32_t v = fresh_[chain_vertices_[chain.first + place]];
    rings_.vertices.push_back(v);
    place = (forward_ ? place + 1 : place + chain.size - 1) % chain.size;
  }
  for (std::uint32_t i = 0; i < chain.size; ++i) {
    const std::uint32_t v = rings_.vertices[rings_.vertices.size() - chain.size + i];
    ring_of_[v] = ring;
    place_[v] = i;
  }
  rings_.parent.push_back(parent);
  rings_.first_vertex.push_back(static_cast<std::uint32_t>(rings_.vertices.size()));
  closed_.push_back(chain.closed);
  for (const Band& band : bands) owner_[band.triangle] = ring;
}

}  // namespace copse
