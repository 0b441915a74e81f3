#include "tools/bvfit/compare.h"

#include "lib/formats/random.h"
#include "lib/runtime/volume_tests.h"

#include <algorithm>
#include <chrono>
#include <numbers>

#include <fmt/format.h>

namespace copse::bvfit {
namespace {

using Chosen = std::vector<const FittedVolume*>;  // one a node of the tree

Chosen chosen_of(const Hierarchy& h, std::span<const SetFit> fits) {
  Chosen chosen;
  std::size_t inner = 0;
  for (const BoxNode& n : h.tree.nodes) {
    const SetFit& fit = n.item != k_none ? fits[h.items[n.item]] : h.inner[inner++];
    chosen.push_back(&fit.volumes[fit.chosen]);
  }
  return chosen;
}

// What finding all that a random ray (or plane) meets costs in tests: every child of a node that is met is
// tested; a node is met in proportion to its surface (mean width).
struct SearchCost {
  double rays = 0, planes = 0;
};
SearchCost search_cost(const Hierarchy& h, const Chosen& chosen, const Choosing& choosing) {
  const auto volume = [&](std::size_t i) -> const FittedVolume& { return *chosen[i]; };
  const VolumeMeasures root = volume(0).measures;
  SearchCost cost;
  for (std::uint32_t i = 0; i < chosen.size(); ++i) {
    const BoxNode& n = h.tree.nodes[i];
    if (n.item != k_none) continue;
    double children = 0;
    for (std::uint32_t c = i + 1; c < n.skip; c = h.tree.nodes[c].skip) {
      Candidate candidate{volume(c).method.kind, {}, 0};
      if (const auto* k = std::get_if<Kdop<float>>(&volume(c).volume)) candidate.slabs = k->normals.size();
      children += choosing.costs.of(candidate);
    }
    const VolumeMeasures& m = volume(i).measures;
    cost.rays += children * (root.surface > 0 ? m.surface / root.surface : 1);
    cost.planes += children * (root.mean_width > 0 ? m.mean_width / root.mean_width : 1);
  }
  return cost;
}

// --- what frustums take
// ----------------------------------------------------------------------------------------

using Frustum = std::array<FloatPlane, 5>;  // near and four sides

Double3 random_direction(Random& random) {
  const double z = random.around(0, 1), a = random.uniform(0, 2 * std::numbers::pi);
  const double r = std::sqrt(std::max(0.0, 1 - z * z));
  return {r * std::cos(a), r * std::sin(a), z};
}

// An eye within three radii of the scene's ball that looks at a place in it, 30 degrees wide.
Frustum random_frustum(const BoundingSphere<double>& scene, Random& random) {
  constexpr double k_half_angle = std::numbers::pi / 12;
  const Double3 eye = scene.centre + random_direction(random) * (scene.radius * random.uniform(0.2, 3));
  const Double3 at = scene.centre + random_direction(random) * (scene.radius * random.uniform());
  const Double3 along = normalized(at - eye, {0, 0, 1});
  const Double3 side = normalized(cross(along, random_direction(random)), {1, 0, 0}), up = cross(side, along);
  Frustum frustum;
  const auto plane = [&](const Double3& inward) {
    return FloatPlane{to_float(inward), static_cast<float>(-dot(inward, eye))};
  };
  const double s = std::sin(k_half_angle), c = std::cos(k_half_angle);
  frustum = {plane(along), plane(along * s + side * c), plane(along * s - side * c),
             plane(along * s + up * c), plane(along * s - up * c)};
  return frustum;
}

struct QueryCounts {
  double nodes = 0, pairs = 0, found = 0;  // a query
};

// From the root with the planes that are still undecided; below what no plane crosses nothing is tested.
void ask(const Hierarchy& h, const Chosen& chosen, const Frustum& frustum, QueryCounts& counts) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> open;  // end of a node's run, planes undecided in it
  for (std::uint32_t i = 0; i < chosen.size();) {
    while (!open.empty() && open.back().first <= i) open.pop_back();
    std::uint32_t mask = open.empty() ? (1u << frustum.size()) - 1 : open.back().second;
    const BoxNode& n = h.tree.nodes[i];
    ++counts.nodes;
    bool outside = false;
    for (std::size_t k = 0; k < frustum.size() && !outside; ++k) {
      if ((mask >> k & 1) == 0) continue;
      ++counts.pairs;
      const Visibility side = side_of(chosen[i]->volume, frustum[k]);
      outside = side == Visibility::outside;
      if (side == Visibility::inside) mask &= ~(1u << k);
    }
    if (!outside && (mask == 0 || n.item != k_none)) counts.found += n.count;
    if (outside || mask == 0) {
      i = n.skip;
    } else {
      open.emplace_back(n.skip, mask), ++i;
    }
  }
}

QueryCounts count_queries(const Hierarchy& h, const Chosen& chosen, const BoundingSphere<double>& scene) {
  constexpr int k_queries = 1000;
  Random random(1);
  QueryCounts counts;
  for (int q = 0; q < k_queries; ++q) ask(h, chosen, random_frustum(scene, random), counts);
  return {counts.nodes / k_queries, counts.pairs / k_queries, counts.found / k_queries};
}

BoundingSphere<double> ball_of(const Input& input) {
  DoubleBox box;
  for (const Double3& p : input.points) box.grow(p);
  return {box.centre(), length(box.extent()) / 2};
}

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

// T6.1 of the dissertation: the time to compute all volumes of its model 1.
const char* seed_time(const std::string& kind) {
  if (kind == "kd2") return "19 h 26 min";
  if (kind == "kd3") return "8 h 8 min";
  return kind == "kd4" ? "3 h 43 min" : "";
}

}  // namespace

Result<std::string> compare_hierarchies(std::span<const PartSet> parts, std::span<const SetFit> fits,
                                        const Input& input, const std::vector<FitMethod>& methods,
                                        const Options& options, const Choosing& choosing, Context& context) {
  Stage stage = context.stage("compare");
  Table table{"Hierarchies",
              {"hierarchy", "nodes", "depth", "build and fit, s", "cost of a ray", "cost of a plane",
               "nodes a frustum", "pairs a frustum", "parts found", "dissertation (T6.1)"},
              {}};
  std::string out = fmt::format(
      "hierarchies over {} parts ({} triangles); ray and plane in tests of a sphere; of a random frustum the "
      "nodes\n"
      "visited, the pairs of plane and volume tested, the parts found; beside T6.1's times for 394 670 "
      "faces\n\n"
      "    {:<9} {:>6} {:>5} {:>8} {:>7} {:>7} {:>7} {:>7} {:>7}  {}\n",
      std::count_if(parts.begin(), parts.end(), is_hierarchy_item), input.mesh.triangles.size(), "kind",
      "nodes", "depth", "time, s", "ray", "plane", "visited", "pairs", "found", "T6.1");
  std::size_t nodes = 0;
  const BoundingSphere<double> scene = ball_of(input);
  for (const std::string kind : k_hierarchies) {
    const double start = now();
    auto h = build_hierarchy(kind, parts, input);
    if (!h) return std::unexpected(h.error());
    if (auto ok = fit_hierarchy(*h, parts, methods, options, choosing, stage); !ok)
      return std::unexpected(ok.error());
    const double seconds = now() - start;
    nodes += h->inner.size();
    const Chosen chosen = chosen_of(*h, fits);
    const SearchCost cost = search_cost(*h, chosen, choosing);
    const QueryCounts counts = count_queries(*h, chosen, scene);
    const std::vector<std::string> row{kind,
                                       std::to_string(h->tree.nodes.size()),
                                       std::to_string(depth(h->tree)),
                                       fmt::format("{:.3g}", seconds),
                                       fmt::format("{:.4g}", cost.rays),
                                       fmt::format("{:.4g}", cost.planes),
                                       fmt::format("{:.0f}", counts.nodes),
                                       fmt::format("{:.0f}", counts.pairs),
                                       fmt::format("{:.0f}", counts.found),
                                       seed_time(kind)};
    out += fmt::format("    {:<9} {:>6} {:>5} {:>8} {:>7} {:>7} {:>7} {:>7} {:>7}  {}\n", row[0], row[1],
                       row[2], row[3], row[4], row[5], row[6], row[7], row[8], row[9]);
    table.rows.push_back(row);
  }
  stage.items(nodes, "nodes");
  context.report().tables.push_back(std::move(table));
  return out + "\n";
}

}  // namespace copse::bvfit
