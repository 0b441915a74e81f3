#include "lib/analysis/leaves/leaf_groups.h"

#include "lib/analysis/leaves/merge_groups.h"
#include "lib/analysis/leaves/nearest_points.h"
#include "lib/analysis/round/minimal_sphere.h"
#include "lib/formats/random.h"

#include <algorithm>
#include <numeric>

namespace copse {
namespace {

using Indices = std::vector<std::uint32_t>;

// --- who belongs together --------------------------------------------------------------------------------

Indices nearest_terminals(std::span<const Double3> leaves, std::span<const Double3> terminals) {
  const NearestPoints tree(terminals);
  Indices nearest(leaves.size());
  for (std::size_t l = 0; l < leaves.size(); ++l) nearest[l] = tree.nearest(leaves[l]);
  return nearest;
}

int longest_axis(const DoubleBox& box) {
  const Double3 e = box.extent();
  if (e.x >= e.y && e.x >= e.z) return 0;
  return e.y >= e.z ? 1 : 2;
}

// Halves sets of leaves along their longest axis. Clusters are numbered in the order of the halves, so that
// neighbours have numbers that are near.
Indices clusters(std::span<const Double3> leaves) {
  Indices order(leaves.size()), cluster(leaves.size());
  std::iota(order.begin(), order.end(), 0u);
  std::vector<std::span<std::uint32_t>> open{order};
  std::uint32_t count = 0;
  while (!open.empty()) {
    const std::span<std::uint32_t> set = open.back();
    open.pop_back();
    if (set.size() <= k_leaves_of_a_cluster) {
      for (const std::uint32_t leaf : set) cluster[leaf] = count;
      ++count;
      continue;
    }
    DoubleBox box;
    for (const std::uint32_t leaf : set) box.grow(leaves[leaf]);
    const int axis = longest_axis(box);
    const std::size_t half = set.size() / 2;
    std::nth_element(set.begin(), set.begin() + static_cast<std::ptrdiff_t>(half), set.end(),
                     [&](std::uint32_t a, std::uint32_t b) {
                       return leaves[a][axis] != leaves[b][axis] ? leaves[a][axis] < leaves[b][axis] : a < b;
                     });
    open.push_back(set.subspan(half));
    open.push_back(set.first(half));
  }
  return cluster;
}

// Renumbers what `of` names to 0, 1, ... in ascending order; answers the old numbers.
Indices compact(Indices& of, std::size_t names) {
  std::vector<std::uint32_t> number(names, k_none);
  for (const std::uint32_t name : of) number[name] = 0;
  Indices used;
  for (std::uint32_t name = 0; name < names; ++name) {
    if (number[name] == k_none) continue;
    number[name] = static_cast<std::uint32_t>(used.size());
    used.push_back(name);
  }
  for (std::uint32_t& name : of) name = number[name];
  return used;
}

// Applies the limit; `terminal` is one a group and shrinks with them. Answers how many groups were joined.
std::uint32_t limit_groups(std::span<const Double3> leaves, std::uint32_t limit, Indices& group_of,
                           Indices& terminal) {
  if (limit == 0 || terminal.size() <= limit) return 0;
  Indices count(terminal.size(), 0);
  std::vector<Double3> mean(terminal.size());
  for (std::size_t l = 0; l < leaves.size(); ++l) {
    const std::uint32_t g = group_of[l];
    mean[g] += (leaves[l] - mean[g]) / static_cast<double>(++count[g]);
  }
  const Indices into = merge_groups(mean, count, limit);
  for (std::uint32_t& g : group_of) g = into[g];
  const auto before = static_cast<std::uint32_t>(terminal.size());
  Indices kept;
  for (const std::uint32_t g : compact(group_of, terminal.size())) kept.push_back(terminal[g]);
  terminal = std::move(kept);
  return before - static_cast<std::uint32_t>(terminal.size());
}

// --- spheres ---------------------------------------------------------------------------------------------

// The corners of a group's leaves, relative to the origin; repeats do no harm.
void read_corners(const Mesh& mesh, const LeafGeometry& leaves, std::span<const std::uint32_t> members,
                  const Double3& origin, std::vector<Double3>& points) {
  points.clear();
  for (const std::uint32_t leaf : members) {
    for (const std::uint32_t t : leaves.of(leaf)) {
      for (const std::uint32_t v : mesh.triangles[t]) points.push_back(mesh.positions[v] - origin);
    }
  }
}

// The smallest sphere of the points in double, about a float32 centre, widened to the points in float32.
StoredSphere sphere_of(std::span<const Double3> points) {
  const Float3 centre = to_float(minimal_sphere(points).centre);
  EnclosingRadius radius(centre);
  for (const Double3& p : points) radius.add(p), radius.add(rounded_to_float(p));
  return {centre, radius.radius()};
}

// --- order -----------------------------------------------------------------------------------------------

struct Keyed {
  double key;
  std::uint32_t leaf;
  auto operator<=>(const Keyed&) const = default;
};

// `from` is relative to the origin, as what is stored is: far from 0 a sum with it would be rounded.
void sort_by_distance(std::span<std::uint32_t> members, std::span<const Double3> centres,
                      const Double3& origin, const Double3& from) {
  std::vector<Keyed> keyed;
  for (const std::uint32_t leaf : members) {
    const Double3 d = centres[leaf] - origin - from;
    keyed.push_back({dot(d, d), leaf});
  }
  std::sort(keyed.begin(), keyed.end());
  for (std::size_t i = 0; i < members.size(); ++i) members[i] = keyed[i].leaf;
}

void sort_at_random(std::span<std::uint32_t> members, const Random& stream) {
  std::vector<std::pair<std::uint64_t, std::uint32_t>> keyed;
  for (const std::uint32_t leaf : members) keyed.emplace_back(stream.fork(leaf).next(), leaf);
  std::sort(keyed.begin(), keyed.end());
  for (std::size_t i = 0; i < members.size(); ++i) members[i] = keyed[i].second;
}

constexpr std::uint64_t k_order_stream = 0x6c6561662d6f7264;  // "leaf-ord"

}  // namespace

LeafGroups leaf_groups(const Mesh& mesh, const LeafGeometry& leaves, std::span<const Double3> terminals,
                       const GroupOptions& options) {
  LeafGroups out;
  out.of_terminal.assign(terminals.size(), k_none);
  if (leaves.count() == 0) return out;
  const bool hang = !terminals.empty();
  out.group_of = hang ? nearest_terminals(leaves.centres, terminals) : clusters(leaves.centres);
  out.terminal = compact(out.group_of, hang ? terminals.size() : leaves.count());
  out.merged = limit_groups(leaves.centres, options.max_groups, out.group_of, out.terminal);

  out.groups.resize(out.terminal.size());
  for (const std::uint32_t g : out.group_of) ++out.groups[g].count;
  Indices next;
  std::uint32_t first = 0;
  for (LeafGroup& g : out.groups) {
    g.first = first;
    next.push_back(first);
    first += g.count;
  }
  out.order.resize(leaves.count());
  for (std::uint32_t l = 0; l < leaves.count(); ++l) out.order[next[out.group_of[l]]++] = l;

  std::vector<Double3> corners;
  const Random stream = Random(options.seed).fork(k_order_stream);
  for (std::uint32_t g = 0; g < out.groups.size(); ++g) {
    LeafGroup& group = out.groups[g];
    const std::span<std::uint32_t> members = std::span(out.order).subspan(group.first, group.count);
    read_corners(mesh, leaves, members, options.origin, corners);
    const StoredSphere sphere = sphere_of(corners);
    group.centre = sphere.centre;
    group.radius = sphere.radius;
    double area = 0;
    for (const std::uint32_t leaf : members) area += leaves.areas[leaf];
    group.mean_area = static_cast<float>(area / group.count);
    if (options.order == LeafOrder::random) {
      sort_at_random(members, stream);
    } else {
      const bool from_terminal = options.order == LeafOrder::terminal && hang;
      const Double3 from =
          from_terminal ? terminals[out.terminal[g]] - options.origin : to_double(group.centre);
      sort_by_distance(members, leaves.centres, options.origin, from);
    }
    if (hang) out.of_terminal[out.terminal[g]] = g;
  }
  if (!hang) std::fill(out.terminal.begin(), out.terminal.end(), k_none);
  return out;
}

}  // namespace copse
