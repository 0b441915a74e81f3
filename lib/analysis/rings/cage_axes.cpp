#include "lib/analysis/rings/cage_axes.h"

#include "lib/analysis/rings/axis.h"
#include "lib/analysis/rings/cage_rings.h"
#include "lib/analysis/rings/hull_frames.h"
#include "lib/analysis/rings/polyline_simplification.h"
#include "lib/analysis/surface/welded_tolerances.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace copse {
namespace {

// The closed curve that subdividing a ring `levels` times makes of it.
double smoothed_radius(std::vector<Double3> ring, std::uint32_t levels, bool to_limit) {
  std::vector<Double3> next;
  for (std::uint32_t l = 0; l < levels; ++l) {
    next.clear();
    const std::size_t n = ring.size();
    for (std::size_t i = 0; i < n; ++i) {
      const Double3 &before = ring[(i + n - 1) % n], &here = ring[i], &after = ring[(i + 1) % n];
      next.push_back((before + here * 6.0 + after) / 8.0);
      next.push_back((here + after) / 2.0);
    }
    ring.swap(next);
  }
  const std::size_t n = ring.size();
  Double3 centre;
  for (const Double3& p : ring) centre += p;
  centre = centre / static_cast<double>(n);
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const Double3 limit = (ring[(i + n - 1) % n] + ring[i] * 4.0 + ring[(i + 1) % n]) / 6.0;
    sum += distance(to_limit ? limit : ring[i], centre);
  }
  return sum / static_cast<double>(n);
}

// A ring, or the place where limbs meet.
struct Station {
  std::uint32_t node = k_none;  // of the ring; k_none: a fork
  std::uint32_t fork = k_none;  // of the cage's rings
  std::uint32_t parent = k_none;
  Double3 centre{}, normal{};
  double radius = 0;
  bool is_whole = false;   // a ring whose corners were not moved
  bool was_moved = false;  // some of them were, before that was undone
  bool is_dropped = false;
  bool is_kept = false;
};

class CageAxes {
 public:
  explicit CageAxes(const Cage& cage)
      : cage_(cage),
        smoothed_square_(
            smoothed_radius({{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}, cage.levels, cage.is_on_limit)),
        c_(read_cage_rings(cage)),
        s_(c_.surface),
        bands_(c_.bands),
        g_(c_.graph) {}

  Hierarchy run() {
    if (bands_.count() == 0 || 2 * bands_.triangles.size() < s_.triangles.size()) return {};
    place_stations();
    list_neighbours();
    solve_frames();
    stations_[0].is_kept = true;  // everything hangs on it, also where it is no end
    for (std::uint32_t i = 0; i < stations_.size(); ++i) {
      if (!is_fork(i)) continue;
      if (stations_[i].is_whole) {
        set_fork_radius(i);
      } else {
        meet(i);
      }
    }
    for (std::uint32_t i = 0; i < stations_.size(); ++i) {
      if (is_fixed(i)) keep_corners(i);
    }
    return result();
  }

 private:
  std::span<const std::uint32_t> ring(std::uint32_t node) const { return c_.ring(node); }
  bool is_fork(std::uint32_t i) const { return stations_[i].node == k_none; }
  bool is_fixed(std::uint32_t i) const { return is_fork(i) || neighbours_[i].size() != 2; }
  double noise(double radius) const { return c_.noise(radius); }

  // Puts back the one corner of a square that was moved; false where more were, or the ring is no square.
  bool mend_square(std::vector<Double3>& p) const {
    if (p.size() != 4) return false;
    for (std::size_t moved = 0; moved < 4; ++moved) {
      const Double3 &a = p[(moved + 1) % 4], &opposite = p[(moved + 2) % 4], &b = p[(moved + 3) % 4];
      const Double3 u = a - opposite, v = b - opposite;
      const double size = length(u), allowed = 2 * noise(size);
      if (std::abs(size - length(v)) > allowed || std::abs(dot(u, normalized(v, {}))) > allowed) continue;
      p[moved] = a + b - opposite;
      return true;
    }
    return false;
  }

  std::vector<Double3> points_of(std::uint32_t node) const {
    std::vector<Double3> points;
    for (const std::uint32_t v : ring(node)) points.push_back(s_.positions[v]);
    return points;
  }

  std::uint32_t add_ring(std::uint32_t node, std::uint32_t parent) {
    std::vector<Double3> points = points_of(node);
    Station station{.node = node, .parent = parent};
    station.is_whole = c_.is_regular(node);
    station.was_moved = !station.is_whole || !c_.was_regular[node];
    station.is_whole = station.is_whole || mend_square(points);
    const std::size_t n = points.size();
    for (const Double3& p : points) station.centre += p / static_cast<double>(n);
    for (std::size_t i = 0; i < n; ++i) {
      station.normal += cross(points[i] - station.centre, points[(i + 1) % n] - station.centre);
    }
    station.normal = normalized(station.normal, {});
    station.radius = smoothed_radius(std::move(points), cage_.levels, cage_.is_on_limit);
    stations_.push_back(station);
    return static_cast<std::uint32_t>(stations_.size() - 1);
  }

  // The thickest of the rings that end a limb, lower ones first among equals.
  std::uint32_t find_root() const {
    std::uint32_t best = k_none;
    for (std::uint32_t n = 0; n < g_.nodes(); ++n) {
      const bool is_end =
          g_.bands_of[n].size() == 1 && (g_.site_of[n] == k_none || g_.ends[g_.site_of[n]].size() == 1);
      if (is_end && (best == k_none || g_.circle[n].radius > g_.circle[best].radius)) best = n;
    }
    return best == k_none ? 0 : best;
  }

  std::uint32_t end_of(std::uint32_t node, std::uint32_t band) const {
    return g_.node_of[2 * band] == node ? 2 * band : 2 * band + 1;
  }

  // A station with the bands that the walk has yet to follow from it.
  struct Arrival {
    std::uint32_t station, node;
    std::uint32_t by;  // the end by which the walk came; k_none: it begins here
  };

  // From the root over bands, and at forks and from tube to tube over hulls.
  void place_stations() {
    station_of_.assign(2 * std::size_t{bands_.count()}, k_none);
    fork_station_.assign(c_.ends_of.count(), k_none);
    entered_.assign(g_.sites, 0);
    const std::uint32_t root = find_root();
    todo_.push_back({add_ring(root, k_none), root, k_none});
    while (!todo_.empty()) {
      const Arrival at = todo_.back();
      todo_.pop_back();
      const std::uint32_t fork = at.by == k_none ? k_none : c_.fork_of[at.by];
      if (fork != k_none) {
        enter(fork, at);
      } else {
        go_on(at);
      }
    }
  }

  // Follows a band from the station at its near end to a new one at its far end.
  void follow(std::uint32_t station, std::uint32_t end) {
    station_of_[end] = station;
    const std::uint32_t far = end ^ 1u;
    if (station_of_[far] != k_none) return;
    const std::uint32_t node = g_.node_of[far];
    station_of_[far] = add_ring(node, station);
    todo_.push_back({station_of_[far], node, far});
  }

  void enter(std::uint32_t fork, const Arrival& at) {
    if (fork_station_[fork] != k_none) return;
    const std::uint32_t station = fork_station_[fork] = add_fork(at.station, fork);
    for (const std::uint32_t end : c_.ends_of[fork]) {
      if (end == at.by || station_of_[end] != k_none) continue;
      follow(add_ring(g_.node_of[end], station), end);
    }
  }

  void go_on(const Arrival& at) {
    std::uint32_t parent = at.station;
    // A limb that was put on a whole ring of another one leads away from it as a third.
    if (g_.bands_of[at.node].size() >= 3) parent = add_fork(at.station, k_none);
    for (const std::uint32_t b : g_.bands_of[at.node]) {
      const std::uint32_t end = end_of(at.node, b);
      if (end == at.by || c_.is_hull[b] || station_of_[end] != k_none) continue;
      if (c_.fork_of[end] != k_none) {
        enter(c_.fork_of[end], {at.station, at.node, end});
      } else {
        follow(parent, end);
      }
    }
    const std::uint32_t site = g_.site_of[at.node];
    if (site == k_none || entered_[site]) return;
    entered_[site] = 1;
    for (const std::uint32_t other : g_.ends[site]) {
      if (other == at.node) continue;
      for (const std::uint32_t b : g_.bands_of[other]) {
        const std::uint32_t end = end_of(other, b);
        if (station_of_[end] == k_none) follow(add_ring(other, parent), end);
      }
    }
  }

  std::uint32_t add_fork(std::uint32_t parent, std::uint32_t fork) {
    stations_.push_back({.fork = fork, .parent = parent});
    return static_cast<std::uint32_t>(stations_.size() - 1);
  }

  // The squares next to forks, and the forks, as they were before the squares were hulled.
  void solve_frames() {
    FrameGraph graph;
    for (const Station& s : stations_) {
      FrameGraph::Corners corners{k_none, k_none, k_none, k_none};
      if (s.node != k_none) {
        if (ring(s.node).size() != 4) return;
        std::ranges::copy(ring(s.node), corners.begin());
      }
      graph.corners.push_back(corners);
      graph.is_regular.push_back(s.node != k_none && c_.is_regular(s.node));
    }
    graph.neighbours = neighbours_;
    const std::vector<Frame> frames =
        solve_hull_frames(s_.positions, graph, [&](double radius) { return noise(radius); });
    take(frames);
  }

  void take(const std::vector<Frame>& frames) {
    for (std::uint32_t i = 0; i < stations_.size(); ++i) {
      if (!frames[i].is_face) continue;
      stations_[i].is_whole = false;
      stations_[i].is_dropped = true;
    }
    for (std::uint32_t i = 0; i < stations_.size(); ++i) {
      if (!frames[i].is_solved) continue;
      stations_[i].centre = frames[i].centre;
      stations_[i].is_whole = true;
      for (const std::uint32_t n : neighbours_[i]) {
        const std::uint32_t ring = frames[n].is_face ? next(i, n) : n;
        Station& s = stations_[ring];
        s.centre = frames[ring].centre;
        s.normal = frames[ring].normal;
        s.radius = frames[ring].reach * smoothed_square_;
        s.is_whole = true;
        s.was_moved = false;
      }
    }
  }

  // The station after `here`, which has two, coming from `before`.
  std::uint32_t next(std::uint32_t before, std::uint32_t here) const {
    const auto around = neighbours_[here];
    return around[0] == before ? around[1] : around[0];
  }

  // Where the rings of a limb lead straight to a fork, so do their radii.
  void set_fork_radius(std::uint32_t fork) {
    Station& station = stations_[fork];
    std::vector<double> led, beside;
    for (std::uint32_t n : neighbours_[fork]) {
      std::uint32_t before = fork;
      if (stations_[n].is_dropped) before = std::exchange(n, next(fork, n));
      const Station& a = stations_[n];
      beside.push_back(a.radius);
      if (is_fixed(n)) continue;
      const Station& b = stations_[next(before, n)];
      const double step = distance(a.centre, b.centre);
      if (b.node == k_none || !b.is_whole || !(step > 0)) continue;
      const Line line{a.centre, (a.centre - b.centre) / step, a.radius, (a.radius - b.radius) / step, {}, 0};
      const double way = distance(station.centre, a.centre);
      if (line.off(station.centre) <= tolerance(line) * std::max(1.0, way / step))
        led.push_back(line.radius_beyond(way));
    }
    std::vector<double>& radii = led.empty() ? beside : led;
    std::ranges::sort(radii);
    station.radius = radii[radii.size() / 2];
  }

  void list_neighbours() {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (std::uint32_t i = 0; i < stations_.size(); ++i) {
      if (stations_[i].parent == k_none) continue;
      pairs.emplace_back(i, stations_[i].parent);
      pairs.emplace_back(stations_[i].parent, i);
    }
    neighbours_ = make_lists(pairs, stations_.size());
  }

  // The stations from `from` by way of its neighbour `next` to the next one that stays in any case.
  std::vector<std::uint32_t> chain(std::uint32_t from, std::uint32_t next) const {
    std::vector<std::uint32_t> way{from, next};
    while (!is_fixed(way.back())) {
      const auto around = neighbours_[way.back()];
      way.push_back(around[0] == way[way.size() - 2] ? around[1] : around[0]);
    }
    return way;
  }

  // Where the axis of a limb goes beyond the first two whole rings that follow one another, towards the
  // chain's beginning, and how thick it gets.
  struct Line {
    Double3 point, direction;
    double radius = 0, slope = 0;
    std::vector<std::uint32_t> chain;
    std::size_t at = 0;  // the place of the first of these rings in the chain
    double off(const Double3& p) const { return length(cross(p - point, direction)); }
    // So far beyond the point; where it would have run out, as thick as there.
    double radius_beyond(double way) const {
      const double there = radius + slope * way;
      return there > 0 ? there : radius;
    }
  };

  bool find_line(const std::vector<std::uint32_t>& way, bool mended, Line& line) const {
    const auto counts = [&](const Station& s) { return s.is_whole && (mended || !s.was_moved); };
    for (std::size_t i = 1; i + 1 < way.size(); ++i) {
      const Station &a = stations_[way[i]], &b = stations_[way[i + 1]];
      if (!counts(a) || !counts(b)) continue;
      const double step = distance(a.centre, b.centre);
      if (!(step > 0)) continue;
      // A whole ring stands in the plane that halves the bend.
      const Double3 along = (a.centre - b.centre) / step;
      line = {a.centre, normalized(a.normal * (2 * dot(a.normal, along)) - along, along),
              a.radius, (a.radius - b.radius) / step,
              way,      i};
      return true;
    }
    return false;
  }

  // The point that is nearest to all lines; nothing where they are parallel.
  static bool nearest(const std::vector<Line>& lines, Double3& point) {
    Double3 a, b, c, right;
    const Double3 origin = lines[0].point;
    for (const Line& l : lines) {
      const Double3 d = l.direction, p = l.point - origin;
      a += Double3{1, 0, 0} - d * d.x;
      b += Double3{0, 1, 0} - d * d.y;
      c += Double3{0, 0, 1} - d * d.z;
      right += p - d * dot(d, p);
    }
    const double det = dot(a, cross(b, c));
    if (!(det > k_cage_parallel)) return false;
    point = origin + Double3{dot(right, cross(b, c)), dot(a, cross(right, c)), dot(a, cross(b, right))} / det;
    return is_finite(point);
  }

  double tolerance(const Line& line) const { return 2 * noise(line.radius); }

  // Puts a fork where its limbs' axes meet: those that rings tell which were never moved, or else those of
  // mended rings too.
  void meet(std::uint32_t fork) {
    Station& station = stations_[fork];
    std::vector<Line> unmoved, mended;
    for (const std::uint32_t n : neighbours_[fork]) {
      station.centre += stations_[n].centre / static_cast<double>(neighbours_[fork].size());
      station.radius = std::max(station.radius, stations_[n].radius);
      const std::vector<std::uint32_t> way = chain(fork, n);
      Line line;
      if (find_line(way, false, line)) unmoved.push_back(line);
      if (find_line(way, true, line)) mended.push_back(line);
    }
    const bool exactly = settle(fork, unmoved, 1) || settle(fork, mended, 1);
    if (!exactly && !settle(fork, mended, k_about_meeting)) return;
    for (const std::vector<Line>* lines : {&unmoved, &mended}) {
      for (const Line& l : *lines) {
        if (l.off(station.centre) <= tolerance(l)) straighten(l);
      }
    }
    for (const Line& l : unmoved) keep_corner(l);
  }

  // The meeting point of the lines, or of as many as meet; the others have a corner between. False where no
  // two meet.
  bool settle(std::uint32_t fork, std::vector<Line> lines, double slack) {
    Double3 point;
    while (lines.size() >= 2 && nearest(lines, point)) {
      const auto worst =
          std::ranges::max_element(lines, {}, [&](const Line& l) { return l.off(point) / tolerance(l); });
      if (worst->off(point) > slack * tolerance(*worst)) {
        lines.erase(worst);
        continue;
      }
      std::vector<double> radii;
      for (const Line& l : lines) radii.push_back(l.radius_beyond(distance(point, l.point)));
      std::ranges::sort(radii);
      stations_[fork].centre = point;
      stations_[fork].radius = radii[radii.size() / 2];
      return true;
    }
    return false;
  }

  // All that lies between a line's first ring and the fork that it leads to is implied.
  void straighten(const Line& line) {
    for (std::size_t i = 1; i < line.at; ++i) stations_[line.chain[i]].is_dropped = true;
  }

  // The line of a limb does not lead to the fork: of the moved rings before it, the nearest is a corner.
  void keep_corner(const Line& line) {
    if (line.at < 2 || stations_[line.chain[line.at - 1]].is_dropped) return;
    for (std::size_t i = 1; i < line.at; ++i) {
      if (stations_[line.chain[i]].is_whole && !stations_[line.chain[i]].is_dropped)
        return;  // mended: tells more
    }
    Station& corner = stations_[line.chain[line.at - 1]];
    const double along = dot(corner.centre - line.point, line.direction);
    corner.centre = line.point + line.direction * along;
    corner.radius = line.radius_beyond(along);
    corner.is_kept = true;
  }

  // Along the limbs that leave a station: what is on no straight line between others stays.
  void keep_corners(std::uint32_t from) {
    stations_[from].is_kept = true;
    for (const std::uint32_t n : neighbours_[from]) {
      std::vector<std::uint32_t> way = chain(from, n);
      if (way.back() < from) continue;  // from its other end
      const std::uint32_t last = way.back();
      // Where every ring was moved, they are all there is.
      const auto is_told = [&](std::uint32_t i) { return !is_fixed(i) && stations_[i].is_whole; };
      if (std::ranges::any_of(way, is_told)) {
        std::erase_if(way, [&](std::uint32_t i) {
          const Station& s = stations_[i];
          return i != from && i != last && (s.is_dropped || (!s.is_whole && !s.is_kept));
        });
      }
      keep_needed(way);
    }
  }

  // Of the stations along a way, what those that are kept do not imply.
  void keep_needed(const std::vector<std::uint32_t>& way) {
    std::vector<std::uint8_t> keep;
    for (std::size_t i = 0; i < way.size(); ++i) {
      keep.push_back(i == 0 || i + 1 == way.size() || stations_[way[i]].is_kept);
    }
    simplify_polyline(keep, [&](std::size_t a, std::size_t b, std::size_t i) {
      const Station &first = stations_[way[a]], &last = stations_[way[b]], &s = stations_[way[i]];
      const double at = nearest_on_segment(first.centre, last.centre, s.centre);
      const double off = distance(first.centre + (last.centre - first.centre) * at, s.centre) +
                         std::abs(first.radius + (last.radius - first.radius) * at - s.radius);
      return off / (s.was_moved ? k_moved_tolerance * s.radius : 2 * noise(s.radius));
    });
    for (std::size_t i = 1; i + 1 < way.size(); ++i) stations_[way[i]].is_kept = keep[i];
  }

  Hierarchy result() {
    std::vector<std::uint32_t> radius_of(stations_.size(), k_none);  // or of the nearest before it that stays
    std::uint32_t branches = 0;
    Hierarchy h;
    std::vector<std::uint8_t> goes_on;  // one a radius: whether its branch has
    for (std::uint32_t i = 0; i < stations_.size(); ++i) {
      const Station& s = stations_[i];
      const std::uint32_t parent = s.parent == k_none ? k_none : radius_of[s.parent];
      radius_of[i] = parent;
      if (!s.is_kept) continue;
      radius_of[i] = static_cast<std::uint32_t>(h.radii.size());
      const bool first = parent == k_none || std::exchange(goes_on[parent], 1);
      h.radii.push_back({s.centre, 2 * s.radius, parent, false,
                         s.node == k_none ? RadiusSource::surface : RadiusSource::ring,
                         first ? branches++ : h.radii[parent].branch});
      goes_on.push_back(0);
    }
    own_vertices(h);
    explain(radius_of, h);
    return h;
  }

  // A ring has its corners; a fork those of the rings next to it that stay nowhere.
  void own_vertices(Hierarchy& h) const {
    std::vector<std::uint8_t> owned(s_.positions.size(), 0);
    for (std::uint32_t i = 0; i < stations_.size(); ++i) {
      if (!stations_[i].is_kept || stations_[i].node == k_none) continue;
      for (const std::uint32_t v : ring(stations_[i].node)) owned[v] = 1;
    }
    std::vector<std::uint8_t> given(s_.positions.size(), 0);
    for (std::uint32_t i = 0; i < stations_.size(); ++i) {
      const Station& s = stations_[i];
      if (!s.is_kept) continue;
      const auto give = [&](std::uint32_t v) {
        if (!std::exchange(given[v], 1)) h.ring_vertices.push_back(cage_.vertex[s_.vertex[v]]);
      };
      if (s.node != k_none) {
        for (const std::uint32_t v : ring(s.node)) give(v);
      } else if (s.fork != k_none) {
        for (const std::uint32_t end : c_.ends_of[s.fork]) {
          for (const std::uint32_t v : bands_.ring(end)) {
            if (!owned[v]) give(v);
          }
        }
      }
      h.first_vertex.push_back(static_cast<std::uint32_t>(h.ring_vertices.size()));
    }
  }

  // The segment that each triangle of the surface lies round.
  void explain(const std::vector<std::uint32_t>& radius_of, Hierarchy& h) const {
    // Of each station, the radius that ends the segment it lies on, from itself outward.
    std::vector<std::uint32_t> outward(stations_.size(), k_none);
    for (std::size_t i = stations_.size(); i-- > 0;) {
      if (stations_[i].is_kept) outward[i] = radius_of[i];
      const std::uint32_t parent = stations_[i].parent;
      if (parent != k_none && !stations_[parent].is_kept && outward[parent] == k_none)
        outward[parent] = outward[i];
    }
    std::vector<std::uint32_t> segment(s_.triangles.size(), k_none);
    std::vector<std::uint32_t> around;
    for (std::uint32_t t = 0; t < segment.size(); ++t) {
      around.clear();
      if (const std::uint32_t b = bands_.band_of[t]; b != k_none && !c_.is_hull[b]) {
        const std::uint32_t x = station_of_[2 * b], y = station_of_[2 * b + 1];
        for (const auto& [child, parent] : {std::pair(x, y), std::pair(y, x)}) {
          if (child != k_none && stations_[child].parent == parent) around.push_back(outward[child]);
        }
      } else {
        for (const std::uint32_t v : s_.triangles[t]) {
          for (const std::uint32_t n : g_.nodes_of[v]) {
            for (const std::uint32_t at : g_.bands_of[n])
              segments_at(station_of_[end_of(n, at)], outward, radius_of, h, around);
          }
        }
      }
      segment[t] = nearest_segment(h, around, t);
    }
    spread(segment);
    h.segment_of.reserve(cage_.face_of.size());
    for (const std::uint32_t f : cage_.face_of) h.segment_of.push_back(segment[c_.triangle_of[f]]);
  }

  // What no ring touches goes with what lies beside it.
  void spread(std::vector<std::uint32_t>& segment) const {
    std::vector<std::uint32_t> todo;
    for (std::uint32_t t = 0; t < segment.size(); ++t) {
      if (segment[t] != k_none) todo.push_back(t);
    }
    for (std::size_t i = 0; i < todo.size(); ++i) {
      for (const std::uint32_t n : s_.across[todo[i]]) {
        if (n == k_none || segment[n] != k_none) continue;
        segment[n] = segment[todo[i]];
        todo.push_back(n);
      }
    }
  }

  void segments_at(std::uint32_t station, const std::vector<std::uint32_t>& outward,
                   const std::vector<std::uint32_t>& radius_of, const Hierarchy& h,
                   std::vector<std::uint32_t>& around) const {
    if (station == k_none) return;
    for (const std::uint32_t r : {outward[station], radius_of[station]}) {
      if (r != k_none && h.radii[r].parent != k_none) around.push_back(r);
    }
    for (const std::uint32_t n : neighbours_[station]) {
      if (stations_[n].parent == station && outward[n] != k_none) around.push_back(outward[n]);
    }
  }

  std::uint32_t nearest_segment(const Hierarchy& h, std::vector<std::uint32_t>& around,
                                std::uint32_t t) const {
    std::ranges::sort(around);
    const Triangle& c = s_.triangles[t];
    const Double3 p = (s_.positions[c[0]] + s_.positions[c[1]] + s_.positions[c[2]]) / 3.0;
    std::uint32_t best = k_none;
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint32_t r : around) {
      if (r == k_none || h.radii[r].parent == k_none) continue;
      const RadiusNode &child = h.radii[r], &parent = h.radii[child.parent];
      const double at = nearest_on_segment(parent.centre, child.centre, p);
      const double d = distance(parent.centre + (child.centre - parent.centre) * at, p);
      if (d < least) least = d, best = r;
    }
    return best;
  }

  const Cage& cage_;
  double smoothed_square_;  // the radius of what a square is subdivided to whose corners are 1 off its centre
  CageRings c_;
  Surface& s_;
  Bands& bands_;
  RingGraph& g_;
  std::vector<Station> stations_;                         // parents before children
  std::vector<std::uint32_t> station_of_, fork_station_;  // one an end, one a fork; k_none: none yet
  std::vector<std::uint8_t> entered_;                     // one a site
  std::vector<Arrival> todo_;
  Lists neighbours_;
};

}  // namespace

Hierarchy cage_axes(const Cage& cage) {
  return CageAxes(cage).run();
}

}  // namespace copse
