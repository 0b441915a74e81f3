#include "lib/analysis/rings/ring_walk.h"

#include "lib/analysis/rings/axis.h"
#include "lib/analysis/surface/welded_tolerances.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <limits>
#include <tuple>

namespace copse {

namespace {

class RingWalk {
 public:
  RingWalk(const Surface& s, const Bands& bands, const RingGraph& g)
      : s_(s),
        bands_(bands),
        g_(g),
        radius_of_(g.nodes(), k_none),
        branch_of_(g.nodes(), k_none),
        is_seated_(g.nodes(), 0),
        holder_(g.nodes(), k_none),
        owned_(s.positions.size(), 0),
        is_lid_(s.triangles.size(), 0),
        joint_of_(g.sites, k_none),
        entered_(g.sites, 0) {
    for (const std::uint32_t t : bands.lids) is_lid_[t] = 1;
  }

  Hierarchy walk() {
    out_.segment_of.assign(s_.triangles.size(), k_none);
    find_holders();
    const std::uint32_t root = find_root();
    if (root == k_none) return std::move(out_);
    place(root, k_none, branches_++);
    walk_tube(root);
    while (!waiting_.empty()) {
      const std::uint32_t node = waiting_.front();
      waiting_.pop_front();
      if (!entered_[g_.site_of[node]]) enter(g_.site_of[node], node);
    }
    place_far_ends();
    explain_caps();
    explain_insets();
    for (std::uint32_t site = 0; site < g_.sites; ++site) explain_site(site);
    return std::move(out_);
  }

 private:
  std::span<const std::uint32_t> ring(std::uint32_t node) const { return bands_.ring(g_.ring[node]); }
  bool is_point(std::uint32_t node) const { return ring(node).size() == 1; }

  // Whether a vertex closes a limb's end rather than drawing it out to a point.
  bool is_cap(std::uint32_t point, std::uint32_t node) const {
    return distance(g_.circle[point].centre, g_.circle[node].centre) < k_cap_height * g_.circle[node].radius;
  }

  // Two rings with a band between them that hold all of this ring, and an edge of it or more each, the
  // thicker first: it is the hole in that band that a limb grows out of, and no ring of its own from
  // whichever side the walk comes. k_none for others.
  using Holders = std::array<std::uint32_t, 2>;
  Holders find_holders(std::uint32_t node) const {
    const std::uint32_t site = g_.site_of[node];
    if (site == k_none || is_point(node)) return k_no_holders;
    std::vector<std::uint32_t> at;
    for (const std::uint32_t v : ring(node)) {
      for (const std::uint32_t m : g_.nodes_of[v]) {
        if (m != node && !is_point(m)) at.push_back(m);
      }
    }
    if (at.size() < ring(node).size()) return k_no_holders;
    std::ranges::sort(at);
    const auto held = [&](std::uint32_t m) {
      const auto range = std::ranges::equal_range(at, m);
      return static_cast<std::size_t>(std::ranges::distance(range));
    };
    for (auto i = at.begin(); i != at.end(); i = std::upper_bound(i, at.end(), *i)) {
      const std::size_t of_a = held(*i);
      if (of_a < 2) continue;
      for (const std::uint32_t band : g_.bands_of[*i]) {
        const std::uint32_t b = g_.across(*i, band);
        const std::size_t of_b = held(b);
        if (of_b < 2 || of_a + of_b != ring(node).size()) continue;
        return g_.circle[b].radius > g_.circle[*i].radius ? Holders{b, *i} : Holders{*i, b};
      }
    }
    return k_no_holders;
  }

  // Of the two that hold a hole the thicker one, unless it is a hole itself and the other is none; where both
  // are holes, what holds them.
  void find_holders() {
    std::vector<Holders> holders;
    for (std::uint32_t n = 0; n < g_.nodes(); ++n) holders.push_back(find_holders(n));
    const auto is_hole = [&](std::uint32_t n) { return holders[n][0] != k_none; };
    for (std::uint32_t n = 0; n < g_.nodes(); ++n) {
      std::uint32_t on = n;
      for (std::uint32_t steps = 0; is_hole(on) && steps < g_.nodes(); ++steps)
        on = is_hole(holders[on][0]) && !is_hole(holders[on][1]) ? holders[on][1] : holders[on][0];
      // Holes that hold one another in a circle are none.
      holder_[n] = on == n || is_hole(on) ? k_none : on;
    }
  }

  // How well a ring may be the base of the whole: 0 at an end that is open or capped, or lies with others at
  // a border; less at a pointed end; least where the limb goes on.
  double root_penalty(std::uint32_t node) const {
    if (const std::uint32_t site = g_.site_of[node]; site != k_none) {
      const bool is_end = g_.ends[site].size() == 1;
      const bool is_lid =
          is_end && std::ranges::all_of(g_.patch[site], [&](std::uint32_t t) { return is_lid_[t] != 0; });
      // A closed lump at the end of a limb may be anything.
      return g_.is_open[site] || is_lid ? 0 : is_end ? 0.5 : 2;
    }
    if (g_.bands_of[node].size() == 1) return 0;
    double least = 2;
    for (const std::uint32_t b : g_.bands_of[node]) {
      const std::uint32_t other = g_.across(node, b);
      if (is_point(other)) least = std::min(least, is_cap(other, node) ? 0 : 0.5);
    }
    return least;
  }

  std::uint32_t find_root() const {
    DoubleBox box;
    double widest = std::numeric_limits<double>::min();
    for (const RingCircle& c : g_.circle) box.grow(c.centre), widest = std::max(widest, c.radius);
    const double height = std::max(box.extent().y, std::numeric_limits<double>::min());
    using Rank = std::array<double, 4>;  // higher is better
    std::uint32_t best = k_none;
    Rank best_rank{};
    for (std::uint32_t n = 0; n < g_.nodes(); ++n) {
      if (is_point(n) || holder_[n] != k_none) continue;
      const RingCircle& c = g_.circle[n];
      const double score =
          c.radius / widest - k_lowness * (c.centre.y - box.min.y) / height - root_penalty(n);
      const Rank rank{score, c.radius, -c.centre.x, -c.centre.z};
      if (best == k_none || rank > best_rank) best_rank = rank, best = n;
    }
    return best;
  }

  std::uint32_t add_radius(const RingCircle& c, std::uint32_t parent, RadiusSource source,
                           std::uint32_t branch) {
    out_.radii.push_back({c.centre, 2 * c.radius, parent, false, source, branch});
    out_.first_vertex.push_back(static_cast<std::uint32_t>(out_.ring_vertices.size()));
    return static_cast<std::uint32_t>(out_.radii.size() - 1);
  }
  void own(std::uint32_t v) {
    if (owned_[v]) return;
    owned_[v] = 1;
    out_.ring_vertices.push_back(v);
  }

  void place(std::uint32_t node, std::uint32_t parent, std::uint32_t branch) {
    for (const std::uint32_t v : ring(node)) own(v);
    radius_of_[node] = add_radius(g_.circle[node], parent,
                                  is_point(node) ? RadiusSource::point : RadiusSource::ring, branch);
    branch_of_[node] = branch;
  }
  void seat(std::uint32_t node, std::uint32_t radius, std::uint32_t branch) {
    radius_of_[node] = radius;
    branch_of_[node] = branch;
    is_seated_[node] = 1;
  }

  void explain(std::uint32_t band, std::uint32_t segment) {
    for (std::uint32_t i = bands_.first_triangle[band]; i < bands_.first_triangle[band + 1]; ++i) {
      out_.segment_of[bands_.triangles[i]] = segment;
    }
  }

  // Places all rings that bands lead to from a placed one, and notes the sites on the way.
  void walk_tube(std::uint32_t start) {
    std::vector<std::uint32_t> todo{start};
    while (!todo.empty()) {
      const std::uint32_t n = todo.back();
      todo.pop_back();
      if (g_.site_of[n] != k_none) waiting_.push_back(n);
      bool carries_on = true;
      for (const std::uint32_t b : g_.bands_of[n]) {
        const std::uint32_t m = g_.across(n, b);
        if (radius_of_[m] != k_none) continue;
        if (is_point(m) && is_cap(m, n)) {
          seat(m, radius_of_[n], branch_of_[n]);
          continue;
        }
        const std::uint32_t held_by = holder_[m], on = held_by == k_none ? m : held_by;
        if (radius_of_[on] == k_none) {
          place(on, radius_of_[n], carries_on ? branch_of_[n] : branches_++);
          carries_on = false;
          explain(b, radius_of_[on]);
          todo.push_back(on);
        }
        if (on != m) seat(m, radius_of_[on], branch_of_[on]);
        if (out_.radii[radius_of_[n]].parent == radius_of_[on]) explain(b, radius_of_[n]);
        if (on != m || holder_[n] != k_none) beside_holes_.push_back(b);
      }
    }
  }

  // The radius that most of the ring lies on, k_none when no more than half of it lies on placed rings.
  std::uint32_t find_seat(std::uint32_t node) const {
    std::vector<std::uint32_t> holders;
    std::size_t held = 0;
    for (const std::uint32_t v : ring(node)) {
      const std::size_t before = holders.size();
      for (const std::uint32_t m : g_.nodes_of[v]) {
        if (radius_of_[m] != k_none && !is_seated_[m]) holders.push_back(radius_of_[m]);
      }
      held += holders.size() > before;
    }
    if (2 * held <= ring(node).size()) return k_none;
    std::ranges::sort(holders);
    std::uint32_t best = k_none;
    std::ptrdiff_t most = 0;
    for (auto i = holders.begin(); i != holders.end();) {
      const auto j = std::upper_bound(i, holders.end(), *i);
      if (j - i > most) most = j - i, best = *i;
      i = j;
    }
    return best;
  }

  // The way a limb goes away from the site that it ends at, over the length of its own thickness, because the
  // rings next to a fork lean; zero for a ring without bands.
  Double3 direction(std::uint32_t end) const {
    std::uint32_t last = k_none, n = end;
    for (bool on = true; on;) {
      on = false;
      for (const std::uint32_t b : g_.bands_of[n]) {
        const std::uint32_t m = g_.across(n, b);
        if (b == last || m == end || is_point(m)) continue;
        on = distance(g_.circle[m].centre, g_.circle[end].centre) < 2 * g_.circle[end].radius;
        last = b, n = m;
        break;
      }
    }
    return normalized(g_.circle[n].centre - g_.circle[end].centre, {});
  }

  // The ends of a site that are still to be placed: holes last, those that lie least on placed rings first
  // (what goes on, before what sits on it), then the thickest.
  std::vector<std::uint32_t> ends_to_place(std::uint32_t site) const {
    struct End {
      bool is_hole;
      std::size_t held;
      double radius;
      std::uint32_t node;
    };
    std::vector<End> ends;
    for (const std::uint32_t n : g_.ends[site]) {
      if (radius_of_[n] != k_none) continue;
      std::size_t held = 0;
      for (const std::uint32_t v : ring(n)) held += owned_[v];
      ends.push_back({holder_[n] != k_none, held, g_.circle[n].radius, n});
    }
    std::ranges::stable_sort(ends, [](const End& a, const End& b) {
      return std::tuple(a.is_hole, a.held, -a.radius) < std::tuple(b.is_hole, b.held, -b.radius);
    });
    std::vector<std::uint32_t> nodes;
    for (const End& e : ends) nodes.push_back(e.node);
    return nodes;
  }

  std::uint32_t best_continuation(std::uint32_t from, std::span<const std::uint32_t> ends) const {
    const Double3 forward = -direction(from);
    std::uint32_t best = k_none;
    double best_score = -std::numeric_limits<double>::infinity();
    for (const std::uint32_t n : ends) {
      const double score = g_.circle[n].radius / std::max(g_.circle[from].radius, g_.circle[n].radius) +
                           dot(forward, direction(n));
      if (score > best_score) best_score = score, best = n;
    }
    return best;
  }

  void enter(std::uint32_t site, std::uint32_t from) {
    entered_[site] = 1;
    const std::vector<std::uint32_t> ends = ends_to_place(site);
    std::uint32_t parent = radius_of_[from];
    if (ends.size() >= 2) parent = place_joint(site, from, ends);
    const std::uint32_t next = best_continuation(from, ends);
    for (const bool sits : {true, false}) {  // what sits on a radius that is placed, first
      for (const std::uint32_t n : ends) {
        if (radius_of_[n] != k_none) continue;  // placed, or a limb that comes back to its own site
        const std::uint32_t held_by = holder_[n] == k_none ? k_none : radius_of_[holder_[n]];
        if (sits && held_by == k_none) continue;
        const std::uint32_t branch = n == next ? branch_of_[from] : branches_++;
        const std::uint32_t on = held_by == k_none ? find_seat(n) : held_by;
        if (on != k_none) {
          seat(n, on, branch);
        } else {
          place(n, parent, branch);
        }
        walk_tube(n);
      }
    }
  }

  // A radius for the vertices of the site that no ring holds; the entry's own where there are none.
  std::uint32_t place_joint(std::uint32_t site, std::uint32_t from, std::span<const std::uint32_t> ends) {
    const std::size_t before = out_.ring_vertices.size();
    for (const std::uint32_t t : g_.patch[site]) {
      for (const std::uint32_t v : s_.triangles[t]) {
        if (g_.nodes_of[v].empty()) own(v);
      }
    }
    if (out_.ring_vertices.size() == before) return radius_of_[from];
    std::vector<AxisLine> lines{{g_.circle[from].centre, direction(from), g_.circle[from].radius}};
    double thickest = 0;
    for (const std::uint32_t n : ends) {
      lines.push_back({g_.circle[n].centre, direction(n), g_.circle[n].radius});
      thickest = std::max(thickest, g_.circle[n].radius);
    }
    const RingCircle joint{meeting_point(lines), (g_.circle[from].radius + thickest) / 2};
    return joint_of_[site] = add_radius(joint, radius_of_[from], RadiusSource::surface, branch_of_[from]);
  }

  // The segments that end at a node or start there.
  void segments_at(std::uint32_t node, std::vector<std::uint32_t>& segments) const {
    const std::uint32_t r = radius_of_[node];
    if (r == k_none) return;
    if (out_.radii[r].parent != k_none) segments.push_back(r);
    for (const std::uint32_t b : g_.bands_of[node]) {
      const std::uint32_t child = radius_of_[g_.across(node, b)];
      if (child != k_none && out_.radii[child].parent == r) segments.push_back(child);
    }
  }

  void explain_caps() {
    std::vector<std::uint32_t> segments;
    for (std::uint32_t n = 0; n < g_.nodes(); ++n) {
      if (!is_point(n) || !is_seated_[n]) continue;
      segments.clear();
      segments_at(g_.across(n, g_.bands_of[n][0]), segments);
      if (!segments.empty()) explain(g_.bands_of[n][0], segments[0]);
    }
  }

  // A limb whose last ring runs out into something that is no tube, a flared foot or a knob, goes on to where
  // that ends.
  void place_far_ends() {
    for (std::uint32_t site = 0; site < g_.sites; ++site) {
      if (g_.ends[site].size() != 1) continue;
      const std::uint32_t end = g_.ends[site][0];
      if (is_point(end) || radius_of_[end] == k_none) continue;
      const Double3 out = -direction(end), from = g_.circle[end].centre;
      const std::size_t before = out_.ring_vertices.size();
      double farthest = 0;
      for (const std::uint32_t t : g_.patch[site]) {
        for (const std::uint32_t v : s_.triangles[t]) {
          if (g_.nodes_of[v].empty()) farthest = std::max(farthest, dot(s_.positions[v] - from, out));
        }
      }
      if (farthest <= k_far_end * g_.circle[end].radius) continue;
      for (const std::uint32_t t : g_.patch[site]) {
        for (const std::uint32_t v : s_.triangles[t]) {
          if (g_.nodes_of[v].empty() && dot(s_.positions[v] - from, out) >= farthest / 2) own(v);
        }
      }
      double wide = 0;
      for (std::size_t i = before; i < out_.ring_vertices.size(); ++i) {
        const Double3 off = s_.positions[out_.ring_vertices[i]] - from;
        wide += length(off - out * dot(off, out));
      }
      wide /= static_cast<double>(out_.ring_vertices.size() - before);
      joint_of_[site] =
          add_radius({from + out * farthest, wide}, radius_of_[end], RadiusSource::surface, branch_of_[end]);
    }
  }

  // The triangle goes with the segment whose axis is nearest, in its own radii.
  void explain_by_nearest(std::uint32_t triangle, std::span<const std::uint32_t> segments) {
    const Triangle& c = s_.triangles[triangle];
    const Double3 p = (s_.positions[c[0]] + s_.positions[c[1]] + s_.positions[c[2]]) / 3.0;
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint32_t r : segments) {
      const RadiusNode &child = out_.radii[r], &parent = out_.radii[child.parent];
      const double at = nearest_on_segment(parent.centre, child.centre, p);
      const double d = distance(parent.centre + (child.centre - parent.centre) * at, p);
      const double radius = parent.diameter + (child.diameter - parent.diameter) * at;
      const double apart = d / std::max(radius, std::numeric_limits<double>::min());
      if (apart < least) least = apart, out_.segment_of[triangle] = r;
    }
  }

  // What lies between the hole in a limb's side and a ring within that side, before a limb is pulled out of
  // it, is the side's.
  void explain_insets() {
    for (const std::uint32_t band : beside_holes_) {
      const std::uint32_t a = g_.node_of[2 * band], b = g_.node_of[2 * band + 1];
      const std::uint32_t hole = holder_[a] != k_none ? a : b, inset = hole == a ? b : a;
      const std::uint32_t radius = radius_of_[hole];
      if (radius == k_none) continue;
      for (const std::uint32_t side : g_.bands_of[holder_[hole]]) {
        const std::uint32_t other = g_.across(holder_[hole], side);
        if (radius_of_[other] == k_none || radius_of_[other] == radius) continue;
        const std::uint32_t segment =
            out_.radii[radius].parent == radius_of_[other] ? radius : radius_of_[other];
        if (out_.radii[segment].parent != (segment == radius ? radius_of_[other] : radius)) continue;
        const RadiusNode &top = out_.radii[segment], &base = out_.radii[top.parent];
        const Double3& p = g_.circle[inset].centre;
        const double at = nearest_on_segment(base.centre, top.centre, p);
        const double within = (base.diameter + (top.diameter - base.diameter) * at) / 2;
        if (at > 0 && at < 1 && distance(p, base.centre + (top.centre - base.centre) * at) <= within)
          explain(band, segment);
      }
    }
  }

  void explain_site(std::uint32_t site) {
    std::vector<std::uint32_t> segments;
    if (joint_of_[site] != k_none) segments.push_back(joint_of_[site]);
    for (const std::uint32_t n : g_.ends[site]) segments_at(n, segments);
    std::ranges::sort(segments);
    for (const std::uint32_t t : g_.patch[site]) explain_by_nearest(t, segments);
  }

  static constexpr Holders k_no_holders{k_none, k_none};

  const Surface& s_;
  const Bands& bands_;
  const RingGraph& g_;
  Hierarchy out_;
  std::vector<std::uint32_t> radius_of_, branch_of_;  // one a node; of its seat where it is no radius itself
  std::vector<std::uint8_t> is_seated_;               // one a node
  std::vector<std::uint32_t> holder_;                 // one a node: what a hole lies on; k_none for no hole
  std::vector<std::uint8_t> owned_;                   // one a vertex
  std::vector<std::uint8_t> is_lid_;                  // one a triangle
  std::vector<std::uint32_t> joint_of_;               // one a site: the radius between its limbs
  std::vector<std::uint8_t> entered_;                 // one a site
  std::vector<std::uint32_t> beside_holes_;           // bands
  std::deque<std::uint32_t> waiting_;                 // placed nodes whose sites are still to be entered
  std::uint32_t branches_ = 0;
};

}  // namespace

Hierarchy walk_rings(const Surface& surface, const Bands& bands, const RingGraph& graph) {
  return RingWalk(surface, bands, graph).walk();
}

}  // namespace copse
