#include "lib/analysis/trunk/welded.h"

#include "lib/analysis/rings/cage_axes.h"
#include "lib/analysis/rings/fork_rings.h"
#include "lib/analysis/rings/implied_rings.h"
#include "lib/analysis/skeleton/surface_skeleton.h"
#include "lib/analysis/skeleton/united_tubes.h"
#include "lib/analysis/surface/reverse_subdivision.h"
#include "lib/analysis/surface/surface.h"
#include "lib/analysis/surface/welded_tolerances.h"
#include "lib/analysis/trunk/fit.h"

#include <utility>

#include <fmt/format.h>

namespace copse {

namespace {

// The surface skeleton, and the name of the method that made it. `may_flow`: whether a tenth of a second is
// at hand.
std::pair<Hierarchy, const char*> skeletonize(const Surface& surface, SurfaceMethod method, bool may_flow) {
  if (method == SurfaceMethod::flow) {
    return {surface_skeleton(surface, SkeletonMethod::flow), "mean-curvature flow"};
  }
  Hierarchy levels = surface_skeleton(surface, SkeletonMethod::levels);
  if (method == SurfaceMethod::automatic && may_flow) {
    const double cost = fit_of(surface, levels).cost();
    if (cost > k_poor_fit) {
      Hierarchy flow = surface_skeleton(surface, SkeletonMethod::flow);
      if (fit_of(surface, flow).cost() < k_clearly_better * cost)
        return {std::move(flow), "mean-curvature flow"};
    }
  }
  return {std::move(levels), "levels"};
}

// One radius round everything, for a surface of which nothing can be read.
void add_only_radius(const Surface& s, Hierarchy& h) {
  std::vector<std::uint32_t> all(s.positions.size());
  for (std::uint32_t v = 0; v < all.size(); ++v) all[v] = v;
  const RingCircle c = ring_circle(s.positions, all);
  h.radii.push_back({c.centre, 2 * c.radius, k_none, false, RadiusSource::surface, 0});
  h.ring_vertices = std::move(all);
  h.first_vertex = {0, static_cast<std::uint32_t>(h.ring_vertices.size())};
  h.segment_of.assign(s.triangles.size(), k_none);
}

// What a tool has cut into squares shows many more rings than a person would draw.
Hierarchy as_drawn(const Surface& s, Hierarchy rings) {
  if (!is_evenly_cut(rings)) return rings;
  Hierarchy drawn = without_implied_rings(rings);
  drawn.notes.push_back(fmt::format(
      "surface of {} triangles at mesh triangle {}: {} of {} rings lie at even steps between the "
      "others, as a subdivision puts them, and are left out",
      s.triangles.size(), s.order.front(), rings.radii.size() - drawn.radii.size(), rings.radii.size()));
  return drawn;
}

// The axes of a skin that was subdivided; no radii where the surface is none.
Hierarchy axes_of_skin(const Surface& s) {
  const std::optional<Cage> cage = reverse_subdivision(s);
  if (!cage) return {};
  Hierarchy axes = cage_axes(*cage);
  if (axes.radii.empty()) return {};
  axes.notes.push_back(fmt::format(
      "surface of {} triangles at mesh triangle {}: subdivided {} from a cage of {} polygons{}, undone to "
      "{:.2g} m; the "
      "radii are the corners of the axes within the cage",
      s.triangles.size(), s.order.front(), cage->levels == 1 ? "once" : fmt::format("{} times", cage->levels),
      cage->faces.count(), cage->is_on_limit ? ", on its limit surface" : "", cage->precision));
  return axes;
}

// What a union was made of, where that explains nearly all of the surface; else no radii.
Hierarchy tubes_of_union(const Surface& s, const RingReading& rings) {
  Hierarchy united = read_united_tubes(s, rings.bands);
  if (united.radii.empty()) return {};
  const Fit fit = fit_of(s, united);
  if (fit.explained < k_rings_suffice || fit.cost() > fit_of(s, rings.hierarchy).cost()) return {};
  united.notes.push_back(
      fmt::format("surface of {} triangles at mesh triangle {}: a union of tubes, taken apart along the "
                  "valleys where they "
                  "meet; corners that the union took from rings are completed",
                  s.triangles.size(), s.order.front()));
  return united;
}

Hierarchy recover_surface(const Surface& s, const WeldedOptions& options, bool may_flow) {
  if (options.method != WeldedMethod::surface) {
    if (Hierarchy axes = axes_of_skin(s); !axes.radii.empty()) return axes;
  }
  RingReading rings;
  if (options.method != WeldedMethod::surface) rings = read_fork_rings(s);
  if (options.method == WeldedMethod::rings) {
    if (rings.hierarchy.radii.empty()) add_only_radius(s, rings.hierarchy);
    return as_drawn(s, std::move(rings.hierarchy));
  }
  if (rings.in_bands >= k_rings_suffice) return as_drawn(s, std::move(rings.hierarchy));
  if (options.method == WeldedMethod::automatic) {
    Hierarchy united = tubes_of_union(s, rings);
    if (!united.radii.empty()) return united;
  }
  auto [skeleton, name] = skeletonize(s, options.surface, may_flow);
  if (!rings.hierarchy.radii.empty() &&
      fit_of(s, rings.hierarchy).cost() <= k_rings_may_cost * fit_of(s, skeleton).cost()) {
    return as_drawn(s, std::move(rings.hierarchy));
  }
  if (skeleton.radii.empty()) add_only_radius(s, skeleton);
  skeleton.notes.push_back(
      fmt::format("surface of {} triangles at mesh triangle {}: skeleton by {}, as {:.0f} % of it "
                  "lies between rings",
                  s.triangles.size(), s.order.front(), name, 100 * rings.in_bands));
  return std::move(skeleton);
}

}  // namespace

Hierarchy recover_welded(const TrunkMesh& whole, std::span<const std::uint32_t> triangles,
                         const WeldedOptions& options) {
  if (triangles.empty()) return {};
  const Surface surface = make_surface(whole, triangles);
  // At most 1 / k_flow_share surfaces of a mesh can be this large, so the time that flowing takes is bounded.
  const bool may_flow =
      triangles.size() <= k_flow_triangles &&
      static_cast<double>(triangles.size()) >= k_flow_share * static_cast<double>(whole.triangles.size());
  Hierarchy h = recover_surface(surface, options, may_flow);
  for (std::uint32_t& v : h.ring_vertices) v = surface.vertex[v];
  std::vector<std::uint32_t> segment_of;
  segment_of.reserve(triangles.size());
  for (const std::uint32_t t : surface.triangle_of) segment_of.push_back(h.segment_of[t]);
  h.segment_of = std::move(segment_of);
  return h;
}

}  // namespace copse
