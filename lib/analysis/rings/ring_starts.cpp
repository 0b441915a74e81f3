#include "lib/analysis/rings/ring_starts.h"

#include "lib/analysis/surface/lids.h"

#include <algorithm>
#include <cmath>

namespace copse {

RingStarts::RingStarts(const TrunkMesh& mesh, const Fans& fans)
    : mesh_(mesh),
      fans_(fans),
      local_(mesh.triangles.size()),
      boundary_(mesh.positions.size(), k_not_looked),
      met_(mesh.positions.size(), 0) {}

void RingStarts::sides_at(std::uint32_t vertex) {
  sides_.clear();
  for (const std::uint32_t t : fans_.of(vertex)) {
    for (const std::uint32_t v : mesh_.triangles[t]) {
      if (v != vertex) sides_.push_back({v, t});
    }
  }
  looked_at_ += sides_.size();
  std::ranges::sort(sides_);
}

RingStarts::Pair RingStarts::boundary_neighbours(std::uint32_t vertex) {
  if (boundary_[vertex] == k_not_looked) boundary_[vertex] = look_for_boundary(vertex);
  return boundary_[vertex];
}

RingStarts::Pair RingStarts::look_for_boundary(std::uint32_t vertex) {
  const auto each_neighbour = [&](const auto& visit) {
    for (const std::uint32_t t : fans_.of(vertex)) {
      for (const std::uint32_t v : mesh_.triangles[t]) {
        if (v != vertex) visit(v);
      }
    }
  };
  each_neighbour([&](std::uint32_t v) { met_[v] = met_[v] == 0 ? 1 : 2; });
  Pair found = k_no_boundary;
  std::size_t count = 0;
  each_neighbour([&](std::uint32_t v) {
    ++looked_at_;
    if (met_[v] == 1 && ++count <= 2) found[count - 1] = v;
    met_[v] = 0;
  });
  return count == 2 ? Pair{std::min(found[0], found[1]), std::max(found[0], found[1])} : k_no_boundary;
}

std::uint32_t RingStarts::first_on_boundary(std::span<const std::uint32_t> vertices) {
  for (const std::uint32_t v : vertices) {
    if (boundary_neighbours(v)[0] != k_none) return v;
  }
  return k_none;
}

RingStarts::Ring RingStarts::loop_through(std::uint32_t vertex) {
  Ring loop;
  return follow(
             vertex, [](std::uint32_t) { return false; }, loop)
             ? loop
             : Ring{};
}

template <class GivenUp>
bool RingStarts::follow(std::uint32_t vertex, const GivenUp& given_up, Ring& way) {
  way.clear();
  std::uint32_t previous = k_none, current = vertex;
  do {
    const auto [a, b] = boundary_neighbours(current);
    if (a == k_none || given_up(current)) return false;  // loops touch here, or where this leads
    way.push_back(current);
    const std::uint32_t next = a == previous ? b : a;
    previous = current;
    current = next;
  } while (current != vertex);
  return true;
}

std::vector<RingStarts::Ring> RingStarts::loops(std::span<const std::uint32_t> vertices) {
  std::vector<Ring> found;
  std::vector<std::uint32_t> seen;
  for (const std::uint32_t v : vertices) {
    if (boundary_neighbours(v)[0] == k_none) continue;
    seen.push_back(v);
  }
  // Every loop is found once from each of its vertices; keep it at the lowest. A way that leads to where
  // loops touch leads there from each of its vertices too.
  std::vector<std::uint8_t> done(seen.size(), 0);
  const auto is_done = [&](std::uint32_t v) -> std::uint8_t& {
    return done[static_cast<std::size_t>(std::ranges::lower_bound(seen, v) - seen.begin())];
  };
  Ring way;
  for (std::size_t i = 0; i < seen.size(); ++i) {
    if (done[i]) continue;
    const bool is_loop = follow(seen[i], is_done, way);
    for (const std::uint32_t v : way) is_done(v) = 1;
    if (is_loop) found.push_back(way);
  }
  return found;
}

// A tube of k-rings that starts at an apex: the k vertices round it have k triangles of the apex, two each,
// and the band to the next ring, 3k corners between them; or the same fan again (two apexes), or a lid (k - 2
// triangles, all three corners on the ring).
bool RingStarts::may_be_apex(std::uint32_t vertex) const {
  const std::size_t k = fans_.of(vertex).size();
  std::size_t corners = 0;  // at the vertices of the link, each counted from both its fan triangles
  for (const std::uint32_t t : fans_.of(vertex)) {
    for (const std::uint32_t v : mesh_.triangles[t]) {
      if (v != vertex) corners += fans_.of(v).size();
    }
  }
  return k >= 3 && (corners == 2 * 5 * k || corners == 2 * 4 * k || corners + 12 == 2 * 5 * k);
}

std::vector<RingStarts::Ring> RingStarts::lids(std::span<const std::uint32_t> triangles, double smooth) {
  std::vector<Triangle> corners;
  for (std::uint32_t i = 0; i < triangles.size(); ++i) {
    local_[triangles[i]] = i;
    corners.push_back(mesh_.triangles[triangles[i]]);
  }
  std::vector<SharedEdge> edges;  // between exactly two triangles, found from their lower end
  for (const std::uint32_t t : triangles) {
    for (const std::uint32_t v : mesh_.triangles[t]) {
      if (fans_.of(v).front() != t) continue;  // visit each vertex once: from its first triangle
      sides_at(v);
      for (std::size_t i = 0; i + 1 < sides_.size(); ++i) {
        const Side &a = sides_[i], &b = sides_[i + 1];
        if (a.neighbour != b.neighbour || a.neighbour < v) continue;
        edges.push_back({v, a.neighbour, local_[a.triangle], local_[b.triangle]});
      }
    }
  }
  std::vector<Ring> rims;
  for (Lid& lid : find_lids(mesh_.positions, corners, edges, smooth)) {
    if (lid.middle == k_none) rims.push_back(std::move(lid.rim));
  }
  return rims;
}

std::vector<RingStarts::Ring> RingStarts::rungs(std::span<const std::uint32_t> vertices) const {
  std::vector<Ring> starts;
  for (const std::uint32_t v : vertices) {
    if (fans_.of(v).size() != 1) continue;  // an ear
    for (const std::uint32_t w : mesh_.triangles[fans_.of(v)[0]]) {
      if (w != v) starts.push_back({v, w});
    }
    starts.push_back({v});
  }
  return starts;
}

}  // namespace copse
