#include "lib/analysis/skeleton/united_tubes.h"

#include "lib/analysis/rings/axis.h"
#include "lib/analysis/rings/ring_graph.h"
#include "lib/analysis/skeleton/valleys.h"
#include "lib/analysis/surface/lists.h"
#include "lib/analysis/surface/welded_tolerances.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <utility>

namespace copse {

namespace {

// The bands that lie in one piece, touch no valley and keep their number of
// vertices or run to a point.
Bands whole_bands(const CutSurface& cut, const Bands& bands) {
  Bands whole;
  whole.band_of.assign(cut.piece.size(), k_none);
  std::vector<std::uint32_t> copy(cut.origin.size(), k_none);
  for (std::uint32_t v = 0; v < cut.origin.size(); ++v) {
    if (!cut.at_valley[v]) copy[cut.origin[v]] = v;
  }
  for (std::uint32_t b = 0; b < bands.count(); ++b) {
    const auto of = bands.triangles_of(b);
    const std::size_t k = bands.ring(2 * b).size(), next = bands.ring(2 * b + 1).size();
    if (of.empty() || (next != k && next != 1) ||
        !std::ranges::all_of(of, [&](std::uint32_t t) { return cut.piece[t] == cut.piece[of[0]]; }))
      continue;
    std::array<std::vector<std::uint32_t>, 2> rings;
    bool is_whole = true;
    for (std::uint32_t side = 0; side < 2; ++side) {
      for (const std::uint32_t v : bands.ring(2 * b + side)) {
        is_whole &= copy[v] != k_none;
        rings[side].push_back(copy[v]);
      }
    }
    if (is_whole) whole.add(rings[0], rings[1], of);
  }
  return whole;
}

// A circle through points of one ring: exact for corners of a regular polygon,
// whichever are missing. Its plane stands across `axis`, turned as the points
// demand.
std::optional<RingCircle> circle_through(std::span<const Double3> points, const Double3& axis) {
  if (points.size() < 3) return {};
  Double3 mean;
  for (const Double3& p : points) mean += (p - points[0]) / static_cast<double>(points.size());
  mean += points[0];
  // The plane's normal: the widest triangle that the points span.
  Double3 normal;
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      const Double3 n = cross(points[i] - mean, points[j] - mean);
      normal += n * (dot(n, axis) < 0 ? -1.0 : 1.0);
    }
  }
  normal = normalized(normal, axis);
  const Double3 u = normalized(cross(normal, std::abs(normal.y) < 0.9 ? Double3{0, 1, 0} : Double3{1, 0, 0}));
  const Double3 v = cross(normal, u);
  // Least squares of x^2 + y^2 = 2ax + 2by + c about the mean (Kasa 1976).
  double xx = 0, xy = 0, yy = 0, xz = 0, yz = 0, zz = 0;
  for (const Double3& p : points) {
    const double x = dot(p - mean, u), y = dot(p - mean, v), z = x * x + y * y;
    xx += x * x, xy += x * y, yy += y * y, xz += x * z, yz += y * z, zz += z;
  }
  const double det = xx * yy - xy * xy;
  if (!(det > k_flat_arc * (xx + yy) * (xx + yy))) return {};
  const double a = (xz * yy - yz * xy) / det / 2, b = (yz * xx - xz * xy) / det / 2;
  return RingCircle{mean + u * a + v * b, std::sqrt(zz / static_cast<double>(points.size()) + a * a + b * b)};
}

struct Station {
  RingCircle circle;
  RadiusSource source = RadiusSource::ring;
  std::vector<std::uint32_t> vertices;  // of the cut surface
};

// One piece as a tube: stations from end to end.
struct Tube {
  std::vector<Station> stations;
  struct End {
    std::uint32_t site = k_none;
    std::uint32_t valley = k_none;  // that goes round the end
  };
  std::array<End, 2> ends;  // before the first station and behind the last
  double thickness() const {
    double most = 0;
    for (const Station& s : stations) most = std::max(most, s.circle.radius);
    return most;
  }
};

class UnitedTubes {
 public:
  UnitedTubes(CutSurface cut, const Bands& bands)
      : cut_(std::move(cut)),
        s_(cut_.surface),
        bands_(whole_bands(cut_, bands)),
        g_(make_ring_graph(s_, bands_)),
        tubes_(cut_.pieces),
        station_of_(g_.nodes(), k_none),
        site_at_(g_.sites, {k_none, k_none}) {}

  Hierarchy read() {
    sort_borders();
    if (!make_tubes()) return {};
    place_tubes();
    explain();
    return std::move(out_);
  }

 private:
  using Range = std::array<std::uint32_t, 2>;  // stations of a tube between
                                               // which something lies
  std::uint32_t piece_of(std::uint32_t node) const {
    return cut_.piece[bands_.triangles_of(g_.bands_of[node][0])[0]];
  }
  bool is_point(std::uint32_t node) const { return bands_.ring(g_.ring[node]).size() == 1; }
  std::uint32_t far_end(std::uint32_t node) const {
    const std::uint32_t site = g_.site_of[node];
    if (site == k_none || g_.ends[site].size() != 2) return k_none;
    return g_.ends[site][0] == node ? g_.ends[site][1] : g_.ends[site][0];
  }

  // Each site's edges along valleys.
  void sort_borders() {
    std::vector<std::uint32_t> site_of_triangle(s_.triangles.size(), k_none);
    for (std::uint32_t site = 0; site < g_.sites; ++site) {
      for (const std::uint32_t t : g_.patch[site]) site_of_triangle[t] = site;
    }
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (std::uint32_t h = 0; h < cut_.valley.size(); ++h) {
      if (cut_.valley[h] != k_none && site_of_triangle[h / 3] != k_none)
        pairs.emplace_back(site_of_triangle[h / 3], h);
    }
    border_ = make_lists(pairs, g_.sites);
  }

  // Nodes in order from one end to the other; empty where the piece is no tube.
  std::vector<std::uint32_t> order(std::span<const std::uint32_t> nodes) const {
    std::uint32_t start = k_none;
    for (const std::uint32_t n : nodes) {
      const std::size_t links = g_.bands_of[n].size() + (g_.site_of[n] != k_none ? 1 : 0);
      if (links > 2 || (g_.site_of[n] != k_none && g_.ends[g_.site_of[n]].size() > 2)) return {};
      if (start == k_none && g_.bands_of[n].size() == 1 && far_end(n) == k_none) start = n;
    }
    if (start == k_none) return {};
    std::vector<std::uint32_t> line{start};
    std::uint32_t last_band = k_none;
    bool by_band = false;
    for (std::uint32_t n = start; line.size() <= nodes.size();) {
      std::uint32_t next = k_none;
      for (const std::uint32_t b : g_.bands_of[n]) {
        if (b != last_band) next = g_.across(n, b), last_band = b, by_band = true;
        if (next != k_none) break;
      }
      if (next == k_none && by_band) next = far_end(n), by_band = false;
      if (next == k_none) break;
      line.push_back(n = next);
    }
    return line.size() == nodes.size() ? line : std::vector<std::uint32_t>{};
  }

  bool make_tubes() {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (std::uint32_t n = 0; n < g_.nodes(); ++n) pairs.emplace_back(piece_of(n), n);
    const Lists nodes_of = make_lists(pairs, cut_.pieces);
    std::vector<std::uint8_t> has_rings(cut_.pieces, 0);
    for (std::uint32_t p = 0; p < cut_.pieces; ++p) {
      if (nodes_of[p].empty()) continue;
      const std::vector<std::uint32_t> line = order(nodes_of[p]);
      if (line.empty()) return false;
      make_tube(p, line);
      // One ring under a cap has no axis.
      if (tubes_[p].stations.size() < 2) tubes_[p].stations.clear();
      has_rings[p] = !tubes_[p].stations.empty();
    }
    const auto lost = std::ranges::count_if(cut_.piece, [&](std::uint32_t p) { return !has_rings[p]; });
    return static_cast<double>(lost) <= (1 - k_rings_suffice) * static_cast<double>(s_.triangles.size());
  }

  void make_tube(std::uint32_t piece, std::span<const std::uint32_t> line) {
    Tube& tube = tubes_[piece];
    if (line.size() < 2) return;
    tube.ends[0].site = g_.site_of[line.front()];
    tube.ends[1].site = g_.site_of[line.back()];
    if (g_.bands_of[line.front()].size() != 1) tube.ends[0].site = k_none;
    const auto axis_before = outward(line[1], line[0]);
    find_valley(tube.ends[0], g_.circle[line[0]], axis_before);
    if (is_cut(tube.ends[0])) {
      add_partial(tube, tube.ends[0].site, line[0], line[0], axis_before, band_length(line[0]));
      std::ranges::reverse(tube.stations);
    }
    for (std::size_t i = 0; i < line.size(); ++i) {
      const std::uint32_t n = line[i], other = i > 0 ? line[i - 1] : line[1];
      const bool is_cap = is_point(n) && distance(g_.circle[n].centre, g_.circle[other].centre) <
                                             k_cap_height * g_.circle[other].radius;
      if (!is_cap) {
        const auto ring = bands_.ring(g_.ring[n]);
        tube.stations.push_back({g_.circle[n],
                                 is_point(n) ? RadiusSource::point : RadiusSource::ring,
                                 {ring.begin(), ring.end()}});
      }
      station_of_[n] = static_cast<std::uint32_t>(std::max<std::size_t>(tube.stations.size(), 1) - 1);
      if (i + 1 < line.size() && far_end(n) == line[i + 1] && !shares_band(n, line[i + 1])) {
        const std::uint32_t from = last_station(tube);
        add_partial(tube, g_.site_of[n], n, line[i + 1],
                    normalized(g_.circle[line[i + 1]].centre - g_.circle[n].centre, {0, 0, 0}),
                    std::min(band_length(n), band_length(line[i + 1])));
        site_at_[g_.site_of[n]] = {from, last_station(tube) + 1};
      }
    }
    const std::uint32_t last = last_station(tube);
    const auto axis_behind = outward(line[line.size() - 2], line.back());
    find_valley(tube.ends[1], g_.circle[line.back()], axis_behind);
    if (is_cut(tube.ends[1]))
      add_partial(tube, tube.ends[1].site, line.back(), line.back(), axis_behind, band_length(line.back()));
    if (tube.ends[0].site != k_none) site_at_[tube.ends[0].site] = {0, station_of_[line[0]] + 1};
    if (tube.ends[1].site != k_none)
      site_at_[tube.ends[1].site] = {std::max(last, 1u) - 1, last_station(tube)};
  }

  bool is_cut(const Tube::End& end) const { return end.site != k_none && !border_[end.site].empty(); }
  static std::uint32_t last_station(const Tube& tube) {
    return static_cast<std::uint32_t>(tube.stations.size() - 1);
  }
  bool shares_band(std::uint32_t a, std::uint32_t b) const {
    return std::ranges::any_of(g_.bands_of[a], [&](std::uint32_t band) { return g_.across(a, band) == b; });
  }
  Double3 outward(std::uint32_t inner, std::uint32_t end) const {
    return normalized(g_.circle[end].centre - g_.circle[inner].centre, {0, 0, 0});
  }
  double band_length(std::uint32_t node) const {
    return distance(g_.circle[node].centre, g_.circle[g_.across(node, g_.bands_of[node][0])].centre);
  }

  // The valley that goes round the axis beyond an end: the limb was cut off
  // there.
  void find_valley(Tube::End& end, const RingCircle& ring, const Double3& axis) {
    if (end.site == k_none) return;
    std::map<std::uint32_t, double> turn;
    const Double3 u = normalized(cross(axis, std::abs(axis.y) < 0.9 ? Double3{0, 1, 0} : Double3{1, 0, 0}));
    const Double3 v = cross(axis, u);
    const auto angle = [&](std::uint32_t vertex) {
      const Double3 d = s_.positions[vertex] - ring.centre;
      return std::atan2(dot(d, v), dot(d, u));
    };
    for (const std::uint32_t h : border_[end.site]) {
      const double by = angle(s_.triangles[h / 3][(h % 3 + 1) % 3]) - angle(s_.triangles[h / 3][h % 3]);
      turn[cut_.valley[h]] += std::remainder(by, k_turn);
    }
    for (const auto& [valley, sum] : turn) {
      if (std::abs(sum) > k_turn / 2) end.valley = valley;
    }
  }

  // Rings of which corners are missing, between two whole ones or beyond the
  // last (a == b).
  void add_partial(Tube& tube, std::uint32_t site, std::uint32_t a, std::uint32_t b, const Double3& axis,
                   double step) const {
    std::vector<std::uint32_t> loose;
    for (const std::uint32_t t : g_.patch[site]) {
      for (const std::uint32_t v : s_.triangles[t]) {
        if (g_.nodes_of[v].empty() && !cut_.at_valley[v]) loose.push_back(v);
      }
    }
    std::ranges::sort(loose);
    loose.erase(std::ranges::unique(loose).begin(), loose.end());
    const auto way = [&](std::uint32_t v) { return dot(s_.positions[v] - g_.circle[a].centre, axis); };
    std::ranges::stable_sort(loose, {}, way);
    double before = g_.circle[a].radius, after = g_.circle[b].radius;
    for (std::size_t i = 0; i < loose.size();) {
      std::size_t j = i + 1;
      while (j < loose.size() && way(loose[j]) - way(loose[j - 1]) < k_ring_gap * step) ++j;
      std::vector<Double3> points;
      for (std::size_t k = i; k < j; ++k) points.push_back(s_.positions[loose[k]]);
      const std::optional<RingCircle> circle =
          points.size() <= k_widest_collar ? circle_through(points, axis) : std::nullopt;
      if (circle && circle->radius > std::min(before, after) / k_partial_ratio &&
          circle->radius < std::max(before, after) * k_partial_ratio) {
        tube.stations.push_back({*circle,
                                 RadiusSource::surface,
                                 {loose.begin() + static_cast<std::ptrdiff_t>(i),
                                  loose.begin() + static_cast<std::ptrdiff_t>(j)}});
        before = circle->radius;
        if (a == b) after = before;
      }
      i = j;
    }
  }

  // Pieces from the root outward, across valleys.
  void place_tubes() {
    std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
    for (std::uint32_t h = 0; h < cut_.valley.size(); ++h) {
      if (cut_.valley[h] != k_none && !tubes_[cut_.piece[h / 3]].stations.empty())
        pairs.emplace_back(cut_.valley[h], cut_.piece[h / 3]);
    }
    const Lists pieces_at = make_lists(pairs, cut_.valleys);
    for (auto& [valley, piece] : pairs) std::swap(valley, piece);
    const Lists valleys_of = make_lists(pairs, cut_.pieces);
    first_radius_.assign(cut_.pieces, k_none);
    radius_of_station_.resize(cut_.pieces);
    const std::uint32_t root = find_root();
    if (root == k_none) return;
    place(root, k_none, k_none);
    std::vector<std::uint32_t> todo{root};
    for (std::size_t i = 0; i < todo.size(); ++i) {
      for (const std::uint32_t valley : valleys_of[todo[i]]) {
        // What holds a limb goes before what stands beside it.
        for (const std::uint32_t p : pieces_at[valley]) {
          if (first_radius_[p] != k_none) continue;
          place(p, todo[i], valley);
          todo.push_back(p);
        }
      }
    }
  }

  // The thickest of those that are cut off at no end, the lowest of alike ones.
  std::uint32_t find_root() const {
    std::uint32_t best = k_none;
    std::array<double, 2> best_rank{};
    for (std::uint32_t p = 0; p < cut_.pieces; ++p) {
      if (tubes_[p].stations.size() < 2) continue;
      const bool is_cut_off =
          std::ranges::any_of(tubes_[p].ends, [](const Tube::End& e) { return e.valley != k_none; });
      const std::array rank{is_cut_off ? 0.0 : 1.0, tubes_[p].thickness()};
      if (best == k_none || rank > best_rank) best = p, best_rank = rank;
    }
    return best;
  }

  struct Seat {
    std::uint32_t station = 0;
    double reach = 0;  // along the axis
    double off = std::numeric_limits<double>::infinity();
  };
  // Where a line comes nearest to a tube's axis.
  static Seat seat_on(const Tube& tube, const Double3& from, const Double3& out) {
    Seat best;
    for (std::uint32_t i = 0; i + 1 < tube.stations.size(); ++i) {
      const Double3 &a = tube.stations[i].circle.centre, &b = tube.stations[i + 1].circle.centre;
      const Double3 along = b - a, across = along - out * dot(along, out);
      const Double3 d = from - a, flat = d - out * dot(d, out);
      const double size = dot(across, across);
      const double at = size > 0 ? std::clamp(dot(flat, across) / size, 0.0, 1.0) : 0.0;
      const Double3 q = a + along * at;
      const double reach = std::max(dot(q - from, out), 0.0), off = distance(q, from + out * reach);
      if (off < best.off) best = {at < 0.5 ? i : i + 1, reach, off};
    }
    return best;
  }

  void place(std::uint32_t piece, std::uint32_t on, std::uint32_t valley) {
    Tube& tube = tubes_[piece];
    auto& radius = radius_of_station_[piece];
    radius.assign(tube.stations.size(), k_none);
    first_radius_[piece] = static_cast<std::uint32_t>(out_.radii.size());
    std::uint32_t start = 0, parent = k_none;
    const std::uint32_t branch = branches_++;
    if (on == k_none) {
      const auto height = [&](const Station& s) { return s.circle.centre.y; };
      if (height(tube.stations.back()) < height(tube.stations.front())) start = last_station(tube);
    } else {
      const bool at_back = tube.ends[1].valley == valley;
      if (at_back || tube.ends[0].valley == valley) {
        start = at_back ? last_station(tube) : 0;
        parent = place_base(tube, at_back, tubes_[on], radius_of_station_[on], branch);
      } else {
        const Tube& below = tubes_[on];
        const bool back = below.ends[1].valley == valley;
        const RingCircle& end = (back ? below.stations.back() : below.stations.front()).circle;
        start = seat_on(tube, end.centre, {0, 0, 0}).station;
        parent = radius_of_station_[on][back ? last_station(below) : 0];
      }
    }
    std::uint32_t last = radius[start] = add(tube.stations[start], parent, branch);
    for (std::uint32_t i = start + 1; i < tube.stations.size(); ++i)
      last = radius[i] = add(tube.stations[i], last, branch);
    if (start == 0) return;
    const std::uint32_t back = start + 1 == tube.stations.size() ? branch : branches_++;
    last = radius[start];
    for (std::uint32_t i = start; i-- > 0;) last = radius[i] = add(tube.stations[i], last, back);
  }

  // The radius that a limb begins with, on its parent's axis.
  std::uint32_t place_base(const Tube& tube, bool at_back, const Tube& below,
                           std::span<const std::uint32_t> radii_below, std::uint32_t branch) {
    const std::size_t n = tube.stations.size();
    const RingCircle& end = tube.stations[at_back ? n - 1 : 0].circle;
    const RingCircle& inner = tube.stations[at_back ? n - 2 : 1].circle;
    const double length = distance(end.centre, inner.centre);
    const Double3 out = normalized(end.centre - inner.centre, {0, 0, 0});
    const Seat seat = seat_on(below, end.centre, out);
    const double taper = length > 0 ? (end.radius - inner.radius) / length : 0;
    const double thickest = std::max(end.radius, below.stations[seat.station].circle.radius);
    Station base{{end.centre + out * seat.reach, std::clamp(end.radius + taper * seat.reach, 0.0, thickest)},
                 RadiusSource::surface,
                 {}};
    return add(base, radii_below[seat.station], branch);
  }

  std::uint32_t add(const Station& s, std::uint32_t parent, std::uint32_t branch) {
    out_.radii.push_back({s.circle.centre, 2 * s.circle.radius, parent, false, s.source, branch});
    for (const std::uint32_t v : s.vertices) out_.ring_vertices.push_back(cut_.origin[v]);
    out_.first_vertex.push_back(static_cast<std::uint32_t>(out_.ring_vertices.size()));
    return static_cast<std::uint32_t>(out_.radii.size() - 1);
  }

  // The segment between two neighbouring stations.
  std::uint32_t segment(std::uint32_t piece, std::uint32_t a, std::uint32_t b) const {
    const auto& r = radius_of_station_[piece];
    if (b >= r.size() || r[a] == k_none || r[b] == k_none) return k_none;
    if (out_.radii[r[a]].parent == r[b]) return r[a];
    return out_.radii[r[b]].parent == r[a] ? r[b] : k_none;
  }

  void explain() {
    out_.segment_of.assign(s_.triangles.size(), k_none);
    for (std::uint32_t b = 0; b < bands_.count(); ++b) {
      const std::uint32_t piece = cut_.piece[bands_.triangles_of(b)[0]];
      const auto [low, high] =
          std::minmax(station_of_[g_.node_of[2 * b]], station_of_[g_.node_of[2 * b + 1]]);
      const std::uint32_t cap = low == 0 ? 1 : low - 1;
      const std::uint32_t at =
          low < high ? segment(piece, low, high) : segment(piece, std::min(low, cap), std::max(low, cap));
      for (const std::uint32_t t : bands_.triangles_of(b)) out_.segment_of[t] = at;
    }
    for (std::uint32_t site = 0; site < g_.sites; ++site) {
      if (g_.patch[site].empty()) continue;
      const std::uint32_t piece = cut_.piece[g_.patch[site][0]];
      if (site_at_[site][0] == k_none || radius_of_station_[piece].empty()) continue;
      std::vector<std::uint32_t> segments;
      for (std::uint32_t i = site_at_[site][0]; i < site_at_[site][1]; ++i)
        segments.push_back(segment(piece, i, i + 1));
      // The one that begins the limb.
      for (const std::uint32_t i : site_at_[site]) {
        if (i >= radius_of_station_[piece].size()) continue;
        const std::uint32_t r = radius_of_station_[piece][i], base = out_.radii[r].parent;
        if (base != k_none && out_.radii[base].branch == out_.radii[r].branch) segments.push_back(r);
      }
      for (const std::uint32_t t : g_.patch[site]) explain_by_nearest(t, segments);
    }
  }

  void explain_by_nearest(std::uint32_t triangle, std::span<const std::uint32_t> segments) {
    const Triangle& c = s_.triangles[triangle];
    const Double3 p = (s_.positions[c[0]] + s_.positions[c[1]] + s_.positions[c[2]]) / 3.0;
    double least = std::numeric_limits<double>::infinity();
    for (const std::uint32_t r : segments) {
      if (r == k_none || out_.radii[r].parent == k_none) continue;
      const RadiusNode &top = out_.radii[r], &base = out_.radii[top.parent];
      const double at = nearest_on_segment(base.centre, top.centre, p);
      const double d = distance(base.centre + (top.centre - base.centre) * at, p);
      const double radius = base.diameter + (top.diameter - base.diameter) * at;
      const double apart = d / std::max(radius, std::numeric_limits<double>::min());
      if (apart < least) least = apart, out_.segment_of[triangle] = r;
    }
  }

  static constexpr double k_turn = 2 * 3.14159265358979323846;

  const CutSurface cut_;
  const Surface& s_;
  const Bands bands_;
  const RingGraph g_;
  Lists border_;                             // one a site: edges along valleys
  std::vector<Tube> tubes_;                  // one a piece; without stations where no ring was read
  std::vector<std::uint32_t> station_of_;    // one a node
  std::vector<Range> site_at_;               // one a site
  std::vector<std::uint32_t> first_radius_;  // one a piece
  std::vector<std::vector<std::uint32_t>> radius_of_station_;  // one a piece
  std::uint32_t branches_ = 0;
  Hierarchy out_;
};

}  // namespace

Hierarchy read_united_tubes(const Surface& surface, const Bands& bands) {
  if (surface.triangles.empty()) return {};
  // Tubes that leave one another at a flat angle have flat valleys, rough tubes
  // folds of their own.
  for (const double sine : {k_valley_sine, k_valley_sine / 4}) {
    CutSurface cut = cut_along_valleys(surface, bands, sine);
    if (cut.pieces < 2 || cut.valleys == 0) continue;
    Hierarchy tubes = UnitedTubes(std::move(cut), bands).read();
    if (!tubes.radii.empty()) return tubes;
  }
  return {};
}

}  // namespace copse
