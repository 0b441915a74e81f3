#include "lib/analysis/lod/limb_shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace copse {
namespace {

constexpr double k_apart_widths =
    2;  // a tube that lies this many diameters aside is as wrong as can be, nearly
constexpr double k_narrowest = 0.3, k_widest = 1.5;        // of a ring's perimeter
constexpr double k_least_wider = 0.8, k_most_wider = 1.5;  // of what is made straight
constexpr double k_wider_steps = 20;                       // in 1: rungs that differ little share their rings
// A radius of so much of the tree's size doubles a weight. At 1/40 five percent of the coverage and a mean
// distance of .25 % of the height, what a level may err by, cost the same; coverage has room to spare.
constexpr double k_heavy = 1.0 / 80;
constexpr double k_turn = 2 * std::numbers::pi;
constexpr double k_widest_gap = 2.6;  // radians between neighbours on a ring: a triangle has 2.1
constexpr double k_inner_share =
    0.25;  // of the mean radius: nearer the centre is a lid's middle, no ring vertex
constexpr double k_point_share = 0.05;           // of the ring before: a thinner last ring is a point
constexpr double k_level = 1.2, k_steepest = 4;  // radii along the axis, of a level ring and of a tilted one
constexpr double k_once = 2.5;                   // of its height: up once and down once is twice
constexpr double k_tilted = 0.8;  // of its perimeter: what a tilted ring measures across the axis
// Of a side: by so much a ring may lie before the one below, or vertices that jitter would give bands that
// turn and others that do not.
constexpr double k_slack = 0.1;
constexpr std::size_t k_samples = 16;  // rings looked at when an interval's error is taken
constexpr double k_ribbon_width =
    std::numbers::pi / 2;  // in diameters: a flat strip seen from all round is 2/pi wide

// One triangle for a strip that is as large as the strip has twice its foot: blades stand close, so that
// covers too much and reaches out of the tuft. So much more of the foot covers as much as the strips did.
constexpr double k_blade = 0.35;

// In [0, k_turn).
double positive(double angle) {
  angle -= k_turn * std::floor(angle / k_turn);
  return angle < k_turn && angle >= 0 ? angle : 0;
}

// Between two directions.
double apart(double a, double b) {
  const double d = positive(a - b);
  return std::min(d, k_turn - d);
}

// Turns `v` as the least rotation from `from` to `to` (unit vectors) does.
Double3 carried(const Double3& v, const Double3& from, const Double3& to) {
  const Double3 axis = cross(from, to);
  const double c = dot(from, to);
  if (c < -0.999) return v;
  return v * c + cross(axis, v) + axis * (dot(axis, v) / (1 + c));
}

Double3 across(const Double3& axis) {
  const Double3 other = std::abs(axis.y) < 0.9 ? Double3{0, 1, 0} : Double3{1, 0, 0};
  return normalized(cross(axis, other), {1, 0, 0});
}

// What is left of a vector across the axis.
Double3 across_of(const Double3& d, const Double3& axis) {
  return d - axis * dot(d, axis);
}

// Whether the vertices go once round the axis, near a plane: level, or tilted (then they go up once and down
// once), but no crown of points, as where several limbs begin.
bool goes_round(const RingShape& ring, std::span<const RingCorner> polygon) {
  double low = 0, high = 0, up_and_down = 0, widest = 0, narrowest = k_turn;
  const auto height = [&](const RingCorner& c) { return dot(c.place - ring.centre, ring.axis); };
  for (std::size_t j = 0; j < polygon.size(); ++j) {
    const bool last = j + 1 == polygon.size();
    const RingCorner& next = polygon[last ? 0 : j + 1];
    const double gap = next.angle - polygon[j].angle + (last ? k_turn : 0), h = height(polygon[j]);
    widest = std::max(widest, gap), narrowest = std::min(narrowest, gap);
    low = std::min(low, h), high = std::max(high, h);
    up_and_down += std::abs(height(next) - h);
  }
  const double off = std::max(high, -low) / ring.radius;
  return narrowest > 1e-4 && widest < k_widest_gap &&
         (off < k_level || (off < k_steepest && up_and_down < k_once * (high - low)));
}

Float2 moved(const Float2& a, const Float2& by, float times = 1) {
  return {a.x + times * by.x, a.y + times * by.y};
}

bool near_texcoord(const Float2& a, const Float2& b) {
  return std::abs(a.x - b.x) < 1e-3f && std::abs(a.y - b.y) < 1e-3f;
}

}  // namespace

LimbShape::LimbShape(const Tree& tree, const std::vector<Double3>& centres, const PartTriangles& trunk,
                     const LimbChain& limb)
    : tree_(tree), trunk_(trunk), limb_(limb) {
  const Float3 extent = tree.header.bounds.empty() ? Float3{} : tree.header.bounds.extent();
  size_ = std::max({extent.x, extent.y, extent.z});
  make_frames(centres);
  for (std::size_t i = 0; i < rings_.size(); ++i) read_ring(i);
  first_angle_.push_back(static_cast<std::uint32_t>(angles_.size()));
  const std::size_t intervals = limb.segments.size();
  any_texcoord_.resize(intervals), regular_.resize(intervals), width_.assign(intervals, {1, 1});
  const RingShape &last = rings_.back(), &before = rings_[rings_.size() - 2];
  pointed_ = last.radius <= k_point_share * before.radius;
  std::array<std::vector<RingSide>, 2> scratch;
  flat_ = goes_flat();
  if (flat_) strips_.resize(intervals, {{{k_none, k_none}, {k_none, k_none}}});
  for (std::size_t i = 0; i < intervals; ++i) read_sides(i, scratch);
  if (flat_) unfold();
  thin_out_radii();
  choose_first_vertices();
}

void LimbShape::make_frames(const std::vector<Double3>& centres) {
  const std::size_t n = limb_.radii.size();
  rings_.resize(n), along_.assign(n, 0);
  for (std::size_t i = 0; i < n; ++i) {
    rings_[i].centre = centres[limb_.radii[i]];
    rings_[i].radius = 0.5 * tree_.hierarchy.radii[limb_.radii[i]].diameter;
  }
  for (std::size_t i = 1; i < n; ++i)
    along_[i] = along_[i - 1] + distance(rings_[i].centre, rings_[i - 1].centre);
  const auto direction = [&](std::size_t i) { return normalized(rings_[i + 1].centre - rings_[i].centre); };
  for (std::size_t i = 0; i < n; ++i) {
    const Double3 in = direction(i == 0 ? 0 : i - 1), out = direction(i + 1 < n ? i : n - 2);
    rings_[i].axis = normalized(in + out, out);
  }
  rings_[0].x = across(rings_[0].axis);
  for (std::size_t i = 1; i < n; ++i) {
    const Double3 x = carried(rings_[i - 1].x, rings_[i - 1].axis, rings_[i].axis);
    rings_[i].x = normalized(x - rings_[i].axis * dot(x, rings_[i].axis), across(rings_[i].axis));
  }
  for (RingShape& r : rings_) r.y = cross(r.axis, r.x);
}

double LimbShape::angle(std::size_t i, const Double3& d) const {
  return positive(std::atan2(dot(d, rings_[i].y), dot(d, rings_[i].x)));
}

// The polygon of a ring's vertices, if they go once round the axis; otherwise a circle of the mean diameter.
void LimbShape::read_ring(std::size_t i) {
  RingShape& ring = rings_[i];
  const std::uint32_t r = limb_.radii[i];
  const std::size_t first = tree_.first_vector_of(r), end = tree_.first_vector_of(r + 1);
  const double inner = k_inner_share * ring.radius;
  double residual = 0;
  first_angle_.push_back(static_cast<std::uint32_t>(angles_.size()));
  const auto base = static_cast<std::uint32_t>(corners_.size());
  first_corner_.push_back(base);
  for (std::size_t v = first; v < end; ++v) {
    const Double3 d = to_double(tree_.hierarchy.vectors[v]);
    angles_.push_back(angle(i, d));
    const double off = length(across_of(d, ring.axis));
    if (off <= inner) continue;
    residual += (off - ring.radius) * (off - ring.radius);
    corners_.push_back({angles_.back(), ring.centre + d});
  }
  const std::span<RingCorner> polygon = std::span(corners_).subspan(base);
  std::stable_sort(polygon.begin(), polygon.end(),
                   [](const RingCorner& a, const RingCorner& b) { return a.angle < b.angle; });
  const std::size_t n = polygon.size();
  if (n >= 3 && n <= 64 && goes_round(ring, polygon)) {
    ring.sides = static_cast<std::uint32_t>(n);
    double edges = 0;
    for (std::size_t j = 0; j < n; ++j) {
      const Double3 side = polygon[(j + 1) % n].place - polygon[j].place;
      edges += length(side);
      ring.perimeter += length(across_of(side, ring.axis));
    }
    if (ring.perimeter < k_tilted * edges) ring.radius = ring.perimeter / k_turn;
  } else {
    ring.residual = n == 0 ? 0 : std::sqrt(residual / static_cast<double>(n));
    corners_.resize(base);
    ring.perimeter = k_turn * ring.radius;
  }
}

// What the triangles of an interval say: its sides with their texture coordinates, whether it is a plain
// band.
void LimbShape::read_sides(std::size_t interval, std::array<std::vector<RingSide>, 2>& scratch) {
  const std::uint32_t s = limb_.segments[interval];
  const std::size_t first[2] = {tree_.first_vector_of(limb_.radii[interval]),
                                tree_.first_vector_of(limb_.radii[interval + 1])};
  const std::size_t end[2] = {tree_.first_vector_of(limb_.radii[interval] + 1),
                              tree_.first_vector_of(limb_.radii[interval + 1] + 1)};
  const auto ring_of = [&](std::uint32_t v) {
    const std::uint32_t p = trunk_.position_of[v];
    return p >= first[0] && p < end[0] ? 0 : p >= first[1] && p < end[1] ? 1 : 2;
  };
  const auto angle_of = [&](std::uint32_t v, std::size_t e) {
    return angles_[first_angle_[interval + e] + (trunk_.position_of[v] - first[e])];
  };
  for (auto& list : scratch) list.clear();
  std::array<std::vector<std::array<std::uint32_t, 2>>, 2> loops;  // positions at the ends of the sides
  bool plain = true, lid = false;
  std::size_t band = 0;
  double area = 0;
  for (std::size_t t = tree_.first_triangle_of_segment(s); t < tree_.first_triangle_of_segment(s + 1); ++t) {
    if (t >= trunk_.triangles.size()) break;
    const auto& corners = trunk_.triangles[t];
    area += area_of(corners);
    const int on[3] = {ring_of(corners[0]), ring_of(corners[1]), ring_of(corners[2])};
    if (on[0] == 2 || on[1] == 2 || on[2] == 2) {
      plain = false;
      continue;
    }
    for (const std::size_t c : {0u, 1u, 2u})
      any_texcoord_[interval][static_cast<std::size_t>(on[c])] = trunk_.vertices[corners[c]].texcoord;
    if (on[0] == on[1] && on[1] == on[2]) {
      lid = lid || on[0] == 1;
      plain = plain && interval + 2 == rings_.size() && on[0] == 1;
      continue;
    }
    ++band;
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t d = (c + 1) % 3;
      if (on[c] != on[d]) continue;
      const auto e = static_cast<std::size_t>(on[c]);
      loops[e].push_back({corners[c], corners[d]});
      const SpectrumVertex &a = trunk_.vertices[corners[c]], &b = trunk_.vertices[corners[d]];
      RingSide side{angle_of(corners[c], e), angle_of(corners[d], e), a.texcoord, b.texcoord};
      if (positive(side.to - side.from) > std::numbers::pi) {
        std::swap(side.from, side.to);
        std::swap(side.at_from, side.at_to);
      }
      side.to = side.from + positive(side.to - side.from);
      scratch[e].push_back(side);
    }
  }
  for (auto& list : scratch) {
    std::stable_sort(list.begin(), list.end(),
                     [](const RingSide& a, const RingSide& b) { return a.from < b.from; });
    sides_.insert(sides_.end(), list.begin(), list.end());
    first_side_.push_back(static_cast<std::uint32_t>(sides_.size()));
  }
  for (const std::size_t e : {0u, 1u}) unwind(interval, e);
  const std::size_t ka = rings_[interval].sides, kb = rings_[interval + 1].sides;
  const bool cone = interval + 2 == rings_.size() && (pointed_ || end[1] - first[1] == 1);
  regular_[interval] =
      plain && ka >= 3 && (kb >= 3 || cone) && band >= ka && band <= ka + std::max<std::size_t>(kb, 1);
  if (interval + 2 == rings_.size()) capped_ = lid && !pointed_;
  if (!regular_[interval] && is_fork(interval)) narrow(interval, area);
  for (const std::size_t e : {0u, 1u}) fit_width(interval, e, loops[e]);
  if (flat_) read_strip(interval, loops, plain && band == end[1] - first[1]);
}

// Whether the limb is a strip, a blade of grass: two vertices a ring, its tip may be one.
bool LimbShape::goes_flat() const {
  const auto count = [&](std::size_t i) {
    return tree_.first_vector_of(limb_.radii[i] + 1) - tree_.first_vector_of(limb_.radii[i]);
  };
  for (std::size_t i = 0; i + 1 < rings_.size(); ++i)
    if (count(i) != 2) return false;
  return count(rings_.size() - 1) == 2 || count(rings_.size() - 1) == 1;
}

void LimbShape::read_strip(std::size_t interval,
                           const std::array<std::vector<std::array<std::uint32_t, 2>>, 2>& edges,
                           bool plain) {
  for (const std::size_t e : {0u, 1u}) {
    if (!edges[e].empty()) strips_[interval][e] = edges[e].front();
  }
  regular_[interval] = plain;
}

// The two edges of a strip in one order all along; a ring is as wide as its two vertices are apart.
void LimbShape::unfold() {
  const auto place = [&](std::uint32_t v) { return to_double(trunk_.vertices[v].position); };
  for (std::size_t i = 0; i < strips_.size() && flat_; ++i) {
    auto& [low, high] = strips_[i];
    // A tip is one vertex; a segment without an edge at its rings is no strip.
    if (high[0] == k_none && i + 1 == strips_.size()) high = tip_of(i);
    flat_ = low[0] != k_none && high[0] != k_none;
    if (!flat_) return;
    if (i > 0 && trunk_.position_of[low[0]] != trunk_.position_of[strips_[i - 1][1][0]])
      std::swap(low[0], low[1]);
    if (dot(place(high[1]) - place(high[0]), place(low[1]) - place(low[0])) < 0) std::swap(high[0], high[1]);
  }
  for (std::size_t i = 0; i < rings_.size(); ++i) {
    RingShape& ring = rings_[i];
    const auto& [a, b] = i < strips_.size() ? strips_[i][0] : strips_[i - 1][1];
    ring.perimeter = 2 * length(across_of(place(b) - place(a), ring.axis));
    ring.radius = ring.perimeter / k_turn, ring.residual = 0;
  }
}

std::array<std::uint32_t, 2> LimbShape::tip_of(std::size_t interval) const {
  const std::uint32_t s = limb_.segments[interval], r = limb_.radii[interval + 1];
  for (std::size_t t = tree_.first_triangle_of_segment(s);
       t < std::min(tree_.first_triangle_of_segment(s + 1), trunk_.triangles.size()); ++t)
    for (const std::uint32_t v : trunk_.triangles[t])
      if (trunk_.position_of[v] >= tree_.first_vector_of(r) &&
          trunk_.position_of[v] < tree_.first_vector_of(r + 1))
        return {v, v};
  return {k_none, k_none};
}

// Where the interval's own triangles go round in another number of sides than the ring has, as where limbs
// are welded together, the tube is as wide as they are.
void LimbShape::fit_width(std::size_t interval, std::size_t end,
                          const std::vector<std::array<std::uint32_t, 2>>& loop) {
  const RingShape& ring = rings_[interval + end];
  if (loop.size() < 3 || loop.size() == ring.sides || !(ring.perimeter > 0)) return;
  std::vector<std::uint32_t> places;
  double perimeter = 0;
  for (const auto& side : loop) {
    for (const std::uint32_t v : side) places.push_back(trunk_.position_of[v]);
    perimeter += length(
        across_of(to_double(trunk_.vertices[side[0]].position) - to_double(trunk_.vertices[side[1]].position),
                  ring.axis));
  }
  std::sort(places.begin(), places.end());
  places.erase(std::unique(places.begin(), places.end()), places.end());
  const bool closed = places.size() == loop.size();
  if (closed) width_[interval][end] = std::clamp(perimeter / ring.perimeter, k_narrowest, k_widest);
}

// A radius is what is seen of the limb there.
void LimbShape::thin_out_radii() {
  const std::size_t intervals = width_.size();
  for (std::size_t i = 0; i <= intervals; ++i) {
    const double in = width_[i == 0 ? 0 : i - 1][i == 0 ? 0 : 1],
                 out = width_[i == intervals ? i - 1 : i][i == intervals ? 1 : 0];
    rings_[i].radius *= 0.5 * (in + out);
  }
}

bool LimbShape::is_fork(std::size_t i) const {
  const Radius& r = tree_.hierarchy.radii[limb_.radii[i]];
  if (r.flags & Radius::terminal) return false;
  std::uint32_t surfaces = 0;
  for (std::uint32_t c = r.first_child; c < r.first_child + r.child_count; ++c)
    surfaces += (tree_.hierarchy.radii[c].flags & Radius::joint) == 0;
  return surfaces > 1;
}

// Where limbs are welded together a ring goes round all of them. Seen from all round a closed surface covers
// a quarter of its area, so the tube begins as narrow as gives it the area of the mesh's own triangles.
void LimbShape::narrow(std::size_t interval, double area) {
  const RingShape &low = rings_[interval], &high = rings_[interval + 1];
  const double along = along_[interval + 1] - along_[interval],
               slant = std::hypot(along, (low.perimeter - high.perimeter) / k_turn);
  if (!(slant > 0) || !(low.perimeter > 0)) return;
  width_[interval][0] = std::clamp((2 * area / slant - high.perimeter) / low.perimeter, k_narrowest, 1.0);
}

double LimbShape::area_of(const std::array<std::uint32_t, 3>& corners) const {
  const Double3 a = to_double(trunk_.vertices[corners[0]].position),
                b = to_double(trunk_.vertices[corners[1]].position),
                c = to_double(trunk_.vertices[corners[2]].position);
  return 0.5 * length(cross(b - a, c - a));
}

double LimbShape::width(std::size_t i, std::size_t interval) const {
  return width_[interval][i - interval];
}

double LimbShape::wider(std::span<const std::uint32_t> kept) const {
  double area = 0, straight = 0;
  for (std::size_t i = 0; i + 1 < rings_.size(); ++i) area += length_between(i, i + 1) * girth(i, i + 1);
  for (std::size_t k = 0; k + 1 < kept.size(); ++k)
    straight += distance(rings_[kept[k]].centre, rings_[kept[k + 1]].centre) * girth(kept[k], kept[k + 1]);
  if (!(straight > 0)) return 1;
  return std::round(std::clamp(area / straight, k_least_wider, k_most_wider) * k_wider_steps) / k_wider_steps;
}

// The mean perimeter of the tube from ring a to ring b.
double LimbShape::girth(std::size_t a, std::size_t b) const {
  return 0.5 * (width(a, a) * rings_[a].perimeter + width(b, b - 1) * rings_[b].perimeter);
}

double LimbShape::weight(std::size_t i) const {
  return size_ > 0 ? 1 + rings_[i].radius / (k_heavy * size_) : 1;
}

bool LimbShape::regular() const {
  return std::all_of(regular_.begin(), regular_.end(), [](std::uint8_t r) { return r != 0; });
}

std::uint32_t LimbShape::sides() const {
  std::uint32_t most = 0;
  for (const RingShape& r : rings_) most = std::max(most, r.sides);
  return flat_ ? 2 : most >= 3 ? most : 8;
}

std::uint32_t LimbShape::material(std::size_t interval) const {
  const std::size_t t = tree_.first_triangle_of_segment(limb_.segments[interval]);
  return t < trunk_.materials.size() && t < tree_.first_triangle_of_segment(limb_.segments[interval] + 1)
             ? trunk_.materials[t]
             : tree_.trunk.material;
}

// Takes the jumps of a texture that repeats out of the sides, and goes on from the ring before it.
void LimbShape::unwind(std::size_t interval, std::size_t end) {
  const std::size_t list = 2 * interval + end;
  const std::span<RingSide> own =
      std::span(sides_).subspan(first_side_[list], first_side_[list + 1] - first_side_[list]);
  winding_.push_back({});
  if (own.empty()) return;
  Float2 shift{};
  for (std::size_t j = 0; j < own.size(); ++j) {
    RingSide& side = own[j];
    side.at_from = moved(side.at_from, shift), side.at_to = moved(side.at_to, shift);
    const bool last = j + 1 == own.size();
    const RingSide& next = own[last ? 0 : j + 1];
    const double gap = next.from + (last ? k_turn : 0) - side.to;
    const Float2 jump = moved(last ? next.at_from : moved(next.at_from, shift), side.at_to, -1);
    const Float2 whole{std::round(jump.x), std::round(jump.y)};
    if (std::abs(gap) > 1e-6 || !near_texcoord(jump, whole)) continue;
    if (last) {
      winding_[list] = moved({}, whole, -1);
    } else {
      shift = moved(shift, whole, -1);
    }
  }
  const std::size_t before = list == 0 ? 0 : list - 1;
  if (before == list || first_side_[before] == first_side_[before + 1]) return;
  const Float2 apart = moved(texcoord(interval, end == 0 ? interval - 1 : interval, 0, 1),
                             texcoord(interval + end, interval, 0, 1), -1);
  const Float2 turns{winding_[list].x == 0 ? 0 : std::round(apart.x),
                     winding_[list].y == 0 ? 0 : std::round(apart.y)};
  for (RingSide& side : own) side.at_from = moved(side.at_from, turns), side.at_to = moved(side.at_to, turns);
}

// All rings of the limb that are made begin at about the same angle, those with the mesh's own vertices at
// one of them. Where a texture that does not repeat has its seam, they begin there.
void LimbShape::choose_first_vertices() {
  double all = 0;
  for (std::size_t i = 0; i < rings_.size(); ++i) {
    RingShape& ring = rings_[i];
    const std::size_t interval = i + 1 < rings_.size() ? i : i - 1;
    const std::span<const RingSide> list = sides_of(interval, i - interval);
    for (std::size_t j = 0; j < list.size(); ++j) {
      const RingSide &a = list[j], &b = list[(j + 1) % list.size()];
      const Float2 on = moved(b.at_from, winding_[interval + i], j + 1 == list.size() ? 1 : 0),
                   jump = moved(on, a.at_to, -1);
      if (apart(a.to, b.from) < 1e-6 && !near_texcoord(jump, {}))
        ring.seam = true, ring.first = positive(b.from);
    }
    if (ring.seam || ring.sides == 0) {
      if (!ring.seam) ring.first = all;
      continue;
    }
    const double step = k_turn / ring.sides;
    double sum = 0;
    for (std::size_t j = 0; j < ring.sides; ++j) sum += polygon(i)[j].angle - step * static_cast<double>(j);
    ring.first = sum / ring.sides;
    if (i == 0) all = ring.first;
  }
  first_ = all;
}

double LimbShape::first_angle(std::size_t i, std::uint32_t sides) const {
  const RingShape& ring = rings_[i];
  if (ring.seam) return ring.first;
  if (sides != ring.sides) return first_;
  const double step = k_turn / sides;
  return ring.first + step * std::ceil((first_ - 0.5 * step - ring.first) / step);
}

double LimbShape::vertex_angle(std::size_t i, std::uint32_t sides, int turned, std::size_t j) const {
  const RingShape& ring = rings_[i];
  const double step = k_turn / sides;
  if (sides != ring.sides) return first_angle(i, sides) + step * (turned + static_cast<double>(j));
  const std::span<const RingCorner> corners = polygon(i);
  std::int64_t at = turned + static_cast<std::int64_t>(j);
  if (ring.seam) {
    const auto seam = std::lower_bound(corners.begin(), corners.end(), ring.first - 1e-6,
                                       [](const RingCorner& c, double a) { return c.angle < a; });
    at += seam - corners.begin();
  } else {
    at += std::llround((first_angle(i, sides) - ring.first) / step);
  }
  const auto k = static_cast<std::int64_t>(sides);
  const std::int64_t turns = at >= 0 ? at / k : -((k - 1 - at) / k);
  return corners[static_cast<std::size_t>(at - turns * k)].angle + k_turn * static_cast<double>(turns);
}

int LimbShape::turn(std::size_t a, std::size_t b, std::uint32_t sides) const {
  if (sides < 3 || rings_[a].seam || rings_[b].seam) return 0;
  const Double3 x = carried(rings_[a].x, rings_[a].axis, rings_[b].axis);
  const double carried_by = std::atan2(dot(x, rings_[b].y), dot(x, rings_[b].x)), step = k_turn / sides;
  const double late = first_angle(b, sides) - first_angle(a, sides) - carried_by;
  return static_cast<int>(std::ceil(-late / step - k_slack));
}

Double3 LimbShape::sample(std::size_t i, double angle) const {
  const RingShape& ring = rings_[i];
  const std::span<const RingCorner> corners = polygon(i);
  if (corners.empty())
    return ring.centre + (ring.x * std::cos(angle) + ring.y * std::sin(angle)) * ring.radius;
  angle = positive(angle);
  const auto next = std::upper_bound(corners.begin(), corners.end(), angle,
                                     [](double a, const RingCorner& c) { return a < c.angle; });
  const RingCorner& b = next == corners.end() ? corners.front() : *next;
  const RingCorner& a = next == corners.begin() ? corners.back() : *std::prev(next);
  const double width = positive(b.angle - a.angle), at = positive(angle - a.angle);
  // By angle, not by length: where the ray leaves the side is near enough.
  return a.place + (b.place - a.place) * (width > 0 ? std::min(at / width, 1.0) : 0);
}

Float2 LimbShape::texcoord(std::size_t i, std::size_t interval, double angle, double towards) const {
  const std::size_t e = i - interval;
  const std::span<const RingSide> list = sides_of(interval, e);
  if (list.empty()) {
    // A point has no sides: across from the other end, along from its own.
    if (sides_of(interval, 1 - e).empty()) return any_texcoord_[interval][e];
    return {texcoord(interval + 1 - e, interval, angle, towards).x, any_texcoord_[interval][e].y};
  }
  const double inside = positive(angle + towards * 1e-3);
  const double turns = std::floor((angle + towards * 1e-3 - list.front().from) / k_turn);
  const auto wound = [&](const Float2& at) {
    return moved(at, winding_[2 * interval + e], static_cast<float>(turns));
  };
  // The last side that begins before it; where sides overlap or lack, any one round it.
  const auto after = std::upper_bound(list.begin(), list.end(), inside,
                                      [](double a, const RingSide& s) { return a < s.from; });
  const auto n = static_cast<std::size_t>(after - list.begin()) + list.size() - 1;
  for (std::size_t j = 0; j < list.size(); ++j) {
    const RingSide& side = list[(n - j) % list.size()];
    const double at = positive(inside - side.from), width = side.to - side.from;
    if (at > width || width <= 0) continue;
    const auto w = static_cast<float>(std::clamp((at - towards * 1e-3) / width, 0.0, 1.0));
    return wound(moved(side.at_from, moved(side.at_to, side.at_from, -1), w));
  }
  return wound(list.front().at_from);
}

// Off the chord counts; along it a ring may slide.
double LimbShape::off_chord(std::size_t a, std::size_t b, std::size_t i) const {
  const Double3 d = rings_[i].centre - rings_[a].centre;
  return length(across_of(d, normalized(rings_[b].centre - rings_[a].centre, {0, 0, 0})));
}

double LimbShape::left_behind(std::size_t a, std::size_t b, std::span<const double> hanging,
                              double hold) const {
  if (hanging.empty() || b <= a + 1) return 0;
  const std::size_t inner = b - a - 1, stride = (inner + k_samples - 1) / k_samples;
  std::size_t taken = 0;
  double sum = 0;
  for (std::size_t i = a + 1; i < b; i += stride, ++taken)
    if (hanging[i] > 0 && off_chord(a, b, i) > hold) sum += hanging[i];
  return sum * static_cast<double>(inner) / static_cast<double>(taken);
}

// How far a ring lies from the one that is turned as it would be between rings a and b.
double LimbShape::turned_off(std::size_t a, std::size_t b, std::size_t i, double w) const {
  const RingShape &low = rings_[a], &high = rings_[b], &ring = rings_[i];
  if (ring.sides == 0 || low.sides != ring.sides || high.sides != ring.sides) return 0;
  const double step = k_turn / ring.sides, late = (high.first - low.first) / step;
  const double by = low.first + w * step * (late + std::ceil(-late - k_slack));
  return polygon_roughness(ring.sides) * ring.radius *
         std::abs(std::sin(std::numbers::pi * (ring.first - by) / step));
}

void LimbShape::errors(std::size_t a, std::size_t b, double& area, double& largest) const {
  area = largest = 0;
  if (b <= a + 1) return;
  const double span = along_[b] - along_[a];
  const std::size_t inner = b - a - 1, stride = (inner + k_samples - 1) / k_samples;
  std::size_t taken = 0;
  double sum = 0;
  for (std::size_t i = a + 1; i < b; i += stride, ++taken) {
    const double w = span > 0 ? (along_[i] - along_[a]) / span : 0;
    const double off = off_chord(a, b, i);
    const double thick =
        std::abs(rings_[i].radius - (rings_[a].radius + w * (rings_[b].radius - rings_[a].radius)));
    // What is seen of a limb that moved aside is what it covers no more and what it covers anew: no more than
    // all of it, however far it went.
    const double most = 2 * k_apart_widths * rings_[i].radius;
    sum += ((off > 0 ? off * most / (off + most) : 0) + 0.5 * thick) * weight(i);
    largest = std::max(largest, off + thick);
  }
  area = taken == 0 ? 0
                    : sum / static_cast<double>(taken) * span * static_cast<double>(inner) /
                          static_cast<double>(inner + 1);
}

double LimbShape::area_error(std::size_t a, std::size_t b) const {
  double area = 0, largest = 0;
  errors(a, b, area, largest);
  return area;
}

double LimbShape::turned_error(std::size_t a, std::size_t b) const {
  if (b <= a + 1) return 0;
  const double span = along_[b] - along_[a];
  const std::size_t inner = b - a - 1, stride = (inner + k_samples - 1) / k_samples;
  std::size_t taken = 0;
  double sum = 0;
  for (std::size_t i = a + 1; i < b; i += stride, ++taken)
    sum += turned_off(a, b, i, span > 0 ? (along_[i] - along_[a]) / span : 0) * weight(i);
  return sum / static_cast<double>(taken) * span * static_cast<double>(inner) /
         static_cast<double>(inner + 1);
}

double LimbShape::largest_error(std::size_t a, std::size_t b) const {
  double area = 0, largest = 0;
  errors(a, b, area, largest);
  return largest;
}

std::uint32_t LimbShape::triangles(std::size_t kept, std::uint32_t sides) const {
  const auto bands = static_cast<std::uint32_t>(kept - 1);
  if (sides == 2) return 2 * bands - (pointed_ ? 1 : 0);
  return 2 * sides * bands - (pointed_ ? sides : 0) + (capped_ ? sides - 2 : 0);
}

Float2 LimbShape::ring_texcoord(std::size_t i, std::size_t interval, std::uint32_t sides, int turned,
                                double ribbon_angle, std::size_t j) const {
  if (flat_) return trunk_.vertices[strips_[interval][i - interval][j]].texcoord;
  if (sides == 2) return texcoord(i, interval, ribbon_angle + (j == 0 ? std::numbers::pi : 0), 1);
  return texcoord(i, interval, vertex_angle(i, sides, turned, j), j == sides ? -1 : 1);
}

void LimbShape::append_ring(std::size_t i, std::size_t interval, std::uint32_t sides, int turned,
                            double ribbon_angle, double wider, std::vector<SpectrumVertex>& out) const {
  const RingShape& ring = rings_[i];
  if (flat_) {
    for (const std::uint32_t v : strips_[interval][i - interval]) {
      out.push_back(trunk_.vertices[v]);
      out.back().position = to_float(ring.centre + (to_double(out.back().position) - ring.centre) * wider);
    }
    return;
  }
  const auto texture = [&](std::size_t j) {
    return ring_texcoord(i, interval, sides, turned, ribbon_angle, j);
  };
  if (sides == 2) {
    const Double3 wide = ring.x * std::cos(ribbon_angle) + ring.y * std::sin(ribbon_angle);
    const Double3 face = cross(wide, ring.axis);
    const double half = k_ribbon_width * wider * width(i, interval) * ring.perimeter / k_turn;
    for (const double side : {-1.0, 1.0})
      out.push_back({to_float(ring.centre + wide * (side * half)), to_float(normalized(face + wide * side)),
                     texture(side < 0 ? 0 : 1)});
    return;
  }
  const std::size_t first = out.size();
  std::vector<Double3> places(sides);
  double perimeter = 0;
  for (std::uint32_t j = 0; j < sides; ++j) places[j] = sample(i, vertex_angle(i, sides, turned, j));
  for (std::uint32_t j = 0; j < sides; ++j)
    perimeter += length(across_of(places[(j + 1) % sides] - places[j], ring.axis));
  // As wide, seen from all round, as the ring itself: the mean width of a convex outline is its perimeter /
  // pi.
  const double scale =
      wider * width(i, interval) * (perimeter > 0 ? std::min(ring.perimeter / perimeter, 1.5) : 1);
  for (std::uint32_t j = 0; j < sides; ++j) {
    const Double3 out_of = places[j] - ring.centre;
    const Double3 off = across_of(out_of, ring.axis);
    const double at = vertex_angle(i, sides, turned, j);
    const bool point = dot(off, off) == 0;
    const Double3 normal = point ? ring.x * std::cos(at) + ring.y * std::sin(at) : normalized(off);
    out.push_back({to_float(ring.centre + out_of * scale), to_float(normal), texture(j)});
  }
  out.push_back(out[first]);
  out.back().texcoord = texture(sides);
}

std::array<SpectrumVertex, 3> LimbShape::spike(double ribbon_angle) const {
  const std::size_t last = rings_.size() - 1;
  std::vector<SpectrumVertex> low, high;
  const std::uint32_t ends[] = {0, static_cast<std::uint32_t>(last)};
  append_ring(0, 0, 2, 0, ribbon_angle, wider(ends), low);
  append_ring(last, last - 1, 2, 0, ribbon_angle, 1, high);
  const double first_width = width(0, 0) * rings_[0].perimeter;
  const double both =
      first_width > 0 ? 1 + (flat_ ? k_blade : 1.0) * rings_[last].perimeter / first_width : 1;
  for (SpectrumVertex& v : low)
    v.position = to_float(rings_[0].centre + (to_double(v.position) - rings_[0].centre) * both);
  high[0].position = to_float(rings_[last].centre);
  return {low[0], low[1], high[0]};
}

}  // namespace copse
