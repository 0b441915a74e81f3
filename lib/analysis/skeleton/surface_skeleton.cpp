#include "lib/analysis/skeleton/surface_skeleton.h"

#include "lib/analysis/rings/axis.h"
#include "lib/analysis/skeleton/flow_skeleton.h"
#include "lib/analysis/skeleton/level_skeleton.h"
#include "lib/analysis/skeleton/limb_samples.h"
#include "lib/analysis/skeleton/skeleton_limbs.h"
#include "lib/analysis/surface/geodesic.h"
#include "lib/analysis/surface/welded_tolerances.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace copse {

namespace {

Lists vertices_of_nodes(const CurveSkeleton& k) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::uint32_t v = 0; v < k.node_of.size(); ++v) pairs.emplace_back(k.node_of[v], v);
  return make_lists(pairs, k.points.size());
}

class HierarchyAlong {
 public:
  HierarchyAlong(const Surface& s, const CurveSkeleton& k)
      : s_(s),
        k_(k),
        limbs_(find_limbs(k)),
        vertices_of_(vertices_of_nodes(k)),
        sampler_(s, k, vertices_of_) {}

  Hierarchy make() {
    find_forks();
    for (std::uint32_t l = 0; l < limbs_.limbs.size(); ++l) add_limb(l);
    assign_vertices();
    explain();
    return std::move(out_);
  }

 private:
  // What is kept of a limb: its radii are first, first + 1, ... at these ways.
  struct Placed {
    std::uint32_t first = 0;
    std::vector<double> ways;

    std::uint32_t nearest(double way) const {
      const auto next = std::ranges::lower_bound(ways, way);
      auto i = static_cast<std::size_t>(next - ways.begin());
      if (i == ways.size() || (i > 0 && way - ways[i - 1] <= ways[i] - way)) --i;
      return first + static_cast<std::uint32_t>(i);
    }
  };

  void find_forks() {
    forks_.resize(limbs_.limbs.size());
    for (const Limb& l : limbs_.limbs) {
      profiles_.push_back(limb_profile(k_, l));
      if (l.parent == k_none) continue;
      const std::uint32_t seat = find_seat(l);
      const LimbProfile& below = profiles_[l.parent];
      const double thickness = below.thickness[l.at];
      seats_.push_back(seat);
      forks_[l.parent].push_back(
          {seat, below.way[seat] - k_fork_before * thickness, below.way[l.at] + k_fork_behind * thickness});
    }
    for (std::vector<LimbFork>& f : forks_) std::ranges::stable_sort(f, {}, &LimbFork::node);
  }

  // Where on its parent a limb grows from. Levels part above a fork; the limb's own axis leads back to its
  // middle.
  std::uint32_t find_seat(const Limb& limb) const {
    const LimbProfile &own = profiles_.back(), &below = profiles_[limb.parent];
    const Limb& parent = limbs_.limbs[limb.parent];
    const double start = below.way[limb.at], thickness = below.thickness[limb.at];
    const auto at = [&](double way) {
      const auto i = static_cast<std::size_t>(std::ranges::lower_bound(own.way, way) - own.way.begin());
      return k_.points[limb.nodes[std::min(i, limb.nodes.size() - 1)]];
    };
    const Double3 near = at(k_seat_from * thickness), far = at(k_seat_to * thickness);
    const Double3 back = normalized(near - far, {});
    std::uint32_t best = limb.at;
    double least = std::numeric_limits<double>::infinity();
    for (std::uint32_t i = limb.at;; --i) {
      if (start - below.way[i] > k_seat_reach * thickness) break;
      const Double3 d = k_.points[parent.nodes[i]] - near;
      const double off = length(d - back * dot(d, back));
      if (off < least) least = off, best = i;
      if (i == 0) break;
    }
    return best;
  }

  void add_limb(std::uint32_t id) {
    const Limb& limb = limbs_.limbs[id];
    const LimbProfile& profile = profiles_[id];
    std::uint32_t parent = k_none;
    double clearance = 0;
    if (limb.parent != k_none) {
      const std::uint32_t seat = seats_[id - 1];
      parent = placed_[limb.parent].nearest(profiles_[limb.parent].way[seat]);
      clearance = std::max(profiles_[limb.parent].thickness[limb.at], out_.radii[parent].diameter / 2);
    }
    const auto samples = keep_useful(id, thin_out(sampler_.sample(limb, profile, forks_[id], clearance)));
    Placed placed;
    placed.first = static_cast<std::uint32_t>(out_.radii.size());
    for (const LimbSample& s : samples) {
      out_.radii.push_back({s.circle.centre, 2 * s.circle.radius, parent, false, RadiusSource::surface, id});
      parent = static_cast<std::uint32_t>(out_.radii.size() - 1);
      placed.ways.push_back(s.way);
    }
    placed_.push_back(std::move(placed));
  }

  // Leaves out the samples between ends and forks that no vertex of the surface is nearest to.
  std::vector<LimbSample> keep_useful(std::uint32_t id, std::vector<LimbSample> samples) const {
    Placed all;
    for (const LimbSample& s : samples) all.ways.push_back(s.way);
    std::vector<std::uint8_t> useful(samples.size(), 0);
    const Limb& limb = limbs_.limbs[id];
    for (std::size_t i = limb.parent == k_none ? 0 : 1; i < limb.nodes.size(); ++i) {
      if (!vertices_of_[limb.nodes[i]].empty()) useful[all.nearest(profiles_[id].way[i])] = 1;
    }
    std::size_t kept = 0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (useful[i] || samples[i].fork || i == 0 || i + 1 == samples.size()) samples[kept++] = samples[i];
    }
    samples.resize(kept);
    return samples;
  }

  void assign_vertices() {
    std::vector<std::uint32_t> radius_of_node(k_.points.size(), 0);
    for (std::uint32_t l = 0; l < limbs_.limbs.size(); ++l) {
      const Limb& limb = limbs_.limbs[l];
      for (std::size_t i = limb.parent == k_none ? 0 : 1; i < limb.nodes.size(); ++i) {
        radius_of_node[limb.nodes[i]] = placed_[l].nearest(profiles_[l].way[i]);
      }
    }
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    radius_of_.resize(s_.positions.size());
    for (std::uint32_t v = 0; v < s_.positions.size(); ++v) {
      radius_of_[v] = radius_of_node[limbs_.kept_node[k_.node_of[v]]];
      pairs.emplace_back(radius_of_[v], v);
    }
    Lists lists = make_lists(pairs, out_.radii.size());
    out_.first_vertex = std::move(lists.first);
    out_.ring_vertices = std::move(lists.items);
  }

  // How far a point is from the axis of the segment that ends at radius r, in radii.
  double apart(std::uint32_t r, const Double3& p) const {
    const RadiusNode &child = out_.radii[r], &parent = out_.radii[child.parent];
    const double at = nearest_on_segment(parent.centre, child.centre, p);
    const double radius = (parent.diameter + (child.diameter - parent.diameter) * at) / 2;
    return distance(parent.centre + (child.centre - parent.centre) * at, p) /
           std::max(radius, std::numeric_limits<double>::min());
  }

  void explain() {
    out_.segment_of.assign(s_.triangles.size(), k_none);
    const auto same_limb = [&](std::uint32_t a, std::uint32_t b) {
      return b < out_.radii.size() && out_.radii[a].branch == out_.radii[b].branch;
    };
    for (std::size_t t = 0; t < s_.triangles.size(); ++t) {
      const Triangle& c = s_.triangles[t];
      const Double3 p = (s_.positions[c[0]] + s_.positions[c[1]] + s_.positions[c[2]]) / 3.0;
      double least = std::numeric_limits<double>::infinity();
      const auto offer = [&](std::uint32_t r) {
        if (out_.radii[r].parent == k_none) return;
        const double d = apart(r, p);
        if (d < least || (d == least && r < out_.segment_of[t])) least = d, out_.segment_of[t] = r;
      };
      for (const std::uint32_t v : c) {
        const std::uint32_t r = radius_of_[v];
        offer(r);
        if (same_limb(r, r + 1)) offer(r + 1);
      }
      // A long triangle is explained by the segment half-way along it.
      const auto [low, high] = std::minmax({radius_of_[c[0]], radius_of_[c[1]], radius_of_[c[2]]});
      if (high - low > 2 && same_limb(low, high)) offer(low + (high - low + 1) / 2);
    }
  }

  const Surface& s_;
  const CurveSkeleton& k_;
  const Limbs limbs_;
  const Lists vertices_of_;
  LimbSampler sampler_;
  std::vector<LimbProfile> profiles_;  // one a limb
  std::vector<std::uint32_t>
      seats_;  // one a limb but the first: the index of its parent's node that it grows from
  std::vector<std::vector<LimbFork>> forks_;  // one list a limb
  std::vector<Placed> placed_;
  std::vector<std::uint32_t> radius_of_;  // one a vertex
  Hierarchy out_;
};

}  // namespace

Hierarchy hierarchy_along(const Surface& surface, const CurveSkeleton& skeleton) {
  if (skeleton.points.empty()) return {};
  return HierarchyAlong(surface, skeleton).make();
}

Hierarchy surface_skeleton(const Surface& surface, SkeletonMethod method) {
  if (surface.triangles.empty()) return {};
  if (method == SkeletonMethod::flow) {
    const CurveSkeleton flow = flow_skeleton(surface);
    if (!flow.points.empty()) return hierarchy_along(surface, flow);
  }
  const Lists triangles_of = triangles_of_vertices(surface);
  return hierarchy_along(surface, level_skeleton(surface, triangles_of, lowest_end(surface, triangles_of)));
}

}  // namespace copse
