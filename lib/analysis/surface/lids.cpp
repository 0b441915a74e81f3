#include "lib/analysis/surface/lids.h"

#include "lib/analysis/surface/components.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace copse {
namespace {

Double3 unit_normal(std::span<const Double3> positions, const Triangle& t) {
  const auto [a, b, c] = t;
  return normalized(cross(normalized(positions[b] - positions[a]), normalized(positions[c] - positions[a])),
                    {0, 0, 0});
}

// The edges as one closed loop; empty where they are none.
std::vector<std::uint32_t> loop_of(std::span<const std::array<std::uint32_t, 2>> edges) {
  std::vector<std::array<std::uint32_t, 2>> ends;  // (vertex, the other end)
  for (const auto& [a, b] : edges) ends.push_back({a, b}), ends.push_back({b, a});
  std::ranges::sort(ends);
  for (std::size_t i = 0; i < ends.size(); i += 2) {
    if (ends[i][0] != ends[i + 1][0] || (i > 0 && ends[i - 1][0] == ends[i][0])) return {};
  }
  std::vector<std::uint32_t> loop;
  std::uint32_t previous = k_none, current = ends[0][0];
  do {
    loop.push_back(current);
    const auto at = std::ranges::lower_bound(ends, std::array<std::uint32_t, 2>{current, 0});
    const std::uint32_t next = (*at)[1] == previous ? (*(at + 1))[1] : (*at)[1];
    previous = current;
    current = next;
  } while (current != ends[0][0] && loop.size() <= edges.size());
  return loop.size() == edges.size() ? loop : std::vector<std::uint32_t>{};
}

// The vertex in the middle of a fan; k_none where the triangles are none.
std::uint32_t middle_of(const Lid& lid, std::span<const Triangle> triangles) {
  for (const std::uint32_t v : triangles[lid.triangles[0]]) {
    const auto holds = [&](std::uint32_t t) { return std::ranges::count(triangles[t], v) != 0; };
    if (std::ranges::all_of(lid.triangles, holds) && std::ranges::count(lid.rim, v) == 0) return v;
  }
  return k_none;
}

}  // namespace

std::vector<Lid> find_lids(std::span<const Double3> positions, std::span<const Triangle> triangles,
                           std::span<const SharedEdge> edges, double smooth,
                           std::span<const std::uint8_t> settled) {
  std::vector<Double3> normals;
  normals.reserve(triangles.size());
  for (const Triangle& t : triangles) normals.push_back(unit_normal(positions, t));
  UnionFind patches(triangles.size());
  for (const SharedEdge& e : edges) {
    if (!settled.empty() && (settled[e.t] != 0 || settled[e.u] != 0)) continue;
    if (std::abs(dot(normals[e.t], normals[e.u])) > smooth) patches.unite(e.t, e.u);
  }
  std::vector<std::uint32_t> patch_of(triangles.size()), size(triangles.size(), 0), rim(triangles.size(), 0);
  for (std::uint32_t t = 0; t < triangles.size(); ++t) ++size[patch_of[t] = patches.find(t)];
  for (const SharedEdge& e : edges) {
    if (patch_of[e.t] != patch_of[e.u]) ++rim[patch_of[e.t]], ++rim[patch_of[e.u]];
  }
  // The rim of a disc has two edges more than the disc has triangles, less two for each inner vertex.
  const auto may_be_lid = [&](std::uint32_t patch) {
    return rim[patch] == size[patch] + 2 || (rim[patch] == size[patch] && rim[patch] >= 3);
  };
  struct Crease {
    std::uint32_t patch;
    std::array<std::uint32_t, 2> edge;
  };
  std::vector<Crease> creases;
  for (const SharedEdge& e : edges) {
    const std::uint32_t t = patch_of[e.t], u = patch_of[e.u];
    if (t == u) continue;
    if (may_be_lid(t)) creases.push_back({t, {e.a, e.b}});
    if (may_be_lid(u)) creases.push_back({u, {e.a, e.b}});
  }
  std::ranges::stable_sort(creases, {}, &Crease::patch);
  std::vector<std::uint32_t> lid_of(triangles.size(), k_none);
  std::vector<Lid> lids;
  std::vector<std::array<std::uint32_t, 2>> around;
  for (std::size_t i = 0; i < creases.size();) {
    const std::uint32_t patch = creases[i].patch;
    around.clear();
    for (; i < creases.size() && creases[i].patch == patch; ++i) around.push_back(creases[i].edge);
    std::vector<std::uint32_t> loop = loop_of(around);
    if (loop.empty()) continue;
    lid_of[patch] = static_cast<std::uint32_t>(lids.size());
    lids.push_back({std::move(loop), {}, k_none});
  }
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    if (const std::uint32_t lid = lid_of[patch_of[t]]; lid != k_none) lids[lid].triangles.push_back(t);
  }
  for (Lid& lid : lids) {
    if (lid.triangles.size() == lid.rim.size()) lid.middle = middle_of(lid, triangles);
  }
  std::erase_if(
      lids, [](const Lid& lid) { return lid.triangles.size() == lid.rim.size() && lid.middle == k_none; });
  return lids;
}

}  // namespace copse
