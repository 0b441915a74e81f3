#include "lib/analysis/lod/limb_shape.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace copse {
namespace {

constexpr double k_turn = 2 * std::numbers::pi;
constexpr double k_widest_gap = 2.6;  // radians between neighbours on a ring: a triangle has 2.1
constexpr double k_inner_share =
    0.25;  // of the mean radius: nearer the centre is a lid's middle, no ring vertex
constexpr double k_point_share = 0.05;  // of the ring before: a thinner last ring is a point
constexpr std::size_t k_samples = 16;   // rings looked at when an interval's error is taken
constexpr double k_ribbon_width =
    std::numbers::pi / 2;  // in diameters: a flat strip seen from all round is 2/pi wide

double positive(double angle) {
  angle = std::fmod(angle, k_turn);
  return angle < 0 ? angle + k_turn : angle;
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

bool near_texcoord(const Float2& a, const Float2& b) {
  return std::abs(a.x - b.x) < 1e-3f && std::abs(a.y - b.y) < 1e-3f;
}

}  // namespace

LimbShape::LimbShape(const Tree& tree, const std::vector<Double3>& centres, const PartTriangles& trunk,
                     const LimbChain& limb)
    : tree_(tree), trunk_(trunk), limb_(limb) {
  make_frames(centres);
  for (std::size_t i = 0; i < rings_.size(); ++i) read_ring(i);
  const std::size_t intervals = limb.segments.size();
  sides_.resize(intervals), any_texcoord_.resize(intervals), regular_.resize(intervals);
  const RingShape &last = rings_.back(), &before = rings_[rings_.size() - 2];
  pointed_ = last.radius <= k_point_share * before.radius;
  for (std::size_t i = 0; i < intervals; ++i) read_sides(i);
  choose_phases();
}

void LimbShape::make_frames(const std::vector<Double3>& centres) {
  const std::size_t n = limb_.radii.size();
  rings_.resize(n), along_.assign(n, 0);
  for (std::size_t i = 0; i < n; ++i) rings_[i].centre = centres[limb_.radii[i]];
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

double LimbShape::angle(std::size_t i, const Double3& p) const {
  const Double3 d = p - rings_[i].centre;
  return positive(std::atan2(dot(d, rings_[i].y), dot(d, rings_[i].x)));
}

// The polygon of a ring's vertices, if they go once round the axis; otherwise a circle of the mean diameter.
void LimbShape::read_ring(std::size_t i) {
  RingShape& ring = rings_[i];
  const std::uint32_t r = limb_.radii[i];
  ring.radius = 0.5 * tree_.hierarchy.radii[r].diameter;
  const std::size_t first = tree_.first_vector_of(r), end = tree_.first_vector_of(r + 1);
  const double inner = k_inner_share * ring.radius;
  double residual = 0;
  for (std::size_t v = first; v < end; ++v) {
    const Double3 d = to_double(tree_.hierarchy.vectors[v]);
    const Double3 flat = d - ring.axis * dot(d, ring.axis);
    if (length(flat) <= inner) continue;
    residual += (length(flat) - ring.radius) * (length(flat) - ring.radius);
    ring.polygon.emplace_back(angle(i, ring.centre + d), ring.centre + d);
  }
  std::sort(ring.polygon.begin(), ring.polygon.end(),
            [](const auto& a, const auto& b) { return a.first < b.first; });
  const std::size_t n = ring.polygon.size();
  bool round = n >= 3 && n <= 64;
  for (std::size_t j = 0; round && j < n; ++j) {
    const double gap = j + 1 < n ? ring.polygon[j + 1].first - ring.polygon[j].first
                                 : ring.polygon[0].first + k_turn - ring.polygon[j].first;
    const Double3 d = ring.polygon[j].second - ring.centre;
    round = gap > 1e-4 && gap < k_widest_gap && std::abs(dot(d, ring.axis)) < 1.2 * ring.radius;
  }
  if (round) {
    ring.sides = static_cast<std::uint32_t>(n);
    for (std::size_t j = 0; j < n; ++j)
      ring.perimeter += distance(ring.polygon[j].second, ring.polygon[(j + 1) % n].second);
  } else {
    ring.residual = n == 0 ? 0 : std::sqrt(residual / static_cast<double>(n));
    ring.polygon.clear();
    ring.perimeter = k_turn * ring.radius;
  }
}

// What the triangles of an interval say: its sides with their texture coordinates, whether it is a plain
// band.
void LimbShape::read_sides(std::size_t interval) {
  const std::uint32_t s = limb_.segments[interval];
  const std::size_t first[2] = {tree_.first_vector_of(limb_.radii[interval]),
                                tree_.first_vector_of(limb_.radii[interval + 1])};
  const std::size_t end[2] = {tree_.first_vector_of(limb_.radii[interval] + 1),
                              tree_.first_vector_of(limb_.radii[interval + 1] + 1)};
  const auto ring_of = [&](std::uint32_t v) {
    const std::uint32_t p = trunk_.position_of[v];
    return p >= first[0] && p < end[0] ? 0 : p >= first[1] && p < end[1] ? 1 : 2;
  };
  bool plain = true, lid = false;
  std::size_t band = 0;
  for (std::size_t t = tree_.first_triangle_of_segment(s); t < tree_.first_triangle_of_segment(s + 1); ++t) {
    if (t >= trunk_.triangles.size()) break;
    const auto& corners = trunk_.triangles[t];
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
      const SpectrumVertex &a = trunk_.vertices[corners[c]], &b = trunk_.vertices[corners[d]];
      RingSide side{angle(interval + e, to_double(a.position)), angle(interval + e, to_double(b.position)),
                    a.texcoord, b.texcoord};
      if (positive(side.to - side.from) > std::numbers::pi) {
        std::swap(side.from, side.to);
        std::swap(side.at_from, side.at_to);
      }
      side.to = side.from + positive(side.to - side.from);
      sides_[interval][e].push_back(side);
    }
  }
  for (auto& list : sides_[interval])
    std::sort(list.begin(), list.end(), [](const RingSide& a, const RingSide& b) { return a.from < b.from; });
  const std::size_t ka = rings_[interval].sides, kb = rings_[interval + 1].sides;
  const bool cone = interval + 2 == rings_.size() && (pointed_ || end[1] - first[1] == 1);
  regular_[interval] =
      plain && ka >= 3 && (kb >= 3 || cone) && band >= ka && band <= ka + std::max<std::size_t>(kb, 1);
  if (interval + 2 == rings_.size()) capped_ = lid && !pointed_;
}

bool LimbShape::regular() const {
  return std::all_of(regular_.begin(), regular_.end(), [](std::uint8_t r) { return r != 0; });
}

std::uint32_t LimbShape::sides() const {
  std::uint32_t most = 0;
  for (const RingShape& r : rings_) most = std::max(most, r.sides);
  return most >= 3 ? most : 8;
}

std::uint32_t LimbShape::material(std::size_t interval) const {
  const std::size_t t = tree_.first_triangle_of_segment(limb_.segments[interval]);
  return t < trunk_.materials.size() && t < tree_.first_triangle_of_segment(limb_.segments[interval] + 1)
             ? trunk_.materials[t]
             : tree_.trunk.material;
}

// A ring that is made begins at the seam of the texture, or where the ring before it begins.
void LimbShape::choose_phases() {
  for (std::size_t i = 0; i < rings_.size(); ++i) {
    RingShape& ring = rings_[i];
    const double before = i == 0 ? 0 : rings_[i - 1].phase;
    ring.phase = before;
    double nearest = k_turn;
    for (const auto& [at, place] : ring.polygon) {
      const double off = std::abs(std::remainder(at - before, k_turn));
      if (off < nearest) nearest = off, ring.phase = at;
    }
    const std::size_t interval = i + 1 < rings_.size() ? i : i - 1;
    const auto& list = sides_[interval][i - interval];
    for (std::size_t j = 0; j < list.size(); ++j) {
      const RingSide &a = list[j], &b = list[(j + 1) % list.size()];
      const bool joined = std::abs(std::remainder(a.to - b.from, k_turn)) < 1e-6;
      if (joined && !near_texcoord(a.at_to, b.at_from)) ring.phase = positive(b.from);
    }
  }
}

Double3 LimbShape::sample(std::size_t i, double angle) const {
  const RingShape& ring = rings_[i];
  const Double3 out = ring.x * std::cos(angle) + ring.y * std::sin(angle);
  if (ring.polygon.empty()) return ring.centre + out * ring.radius;
  angle = positive(angle);
  const auto next = std::upper_bound(ring.polygon.begin(), ring.polygon.end(), angle,
                                     [](double a, const auto& p) { return a < p.first; });
  const auto& b = next == ring.polygon.end() ? ring.polygon.front() : *next;
  const auto& a = next == ring.polygon.begin() ? ring.polygon.back() : *std::prev(next);
  const double width = positive(b.first - a.first), at = positive(angle - a.first);
  // By angle, not by length: where the ray leaves the side is near enough.
  return a.second + (b.second - a.second) * (width > 0 ? std::min(at / width, 1.0) : 0);
}

Float2 LimbShape::texcoord(std::size_t i, std::size_t interval, double angle, double towards) const {
  const std::size_t e = i - interval;
  const auto& list = sides_[interval][e];
  if (list.empty()) {
    // A point has no sides: across from the other end, along from its own.
    const auto& other = sides_[interval][1 - e];
    if (other.empty()) return any_texcoord_[interval][e];
    return {texcoord(interval + 1 - e, interval, angle, towards).x, any_texcoord_[interval][e].y};
  }
  const double inside = angle + towards * 1e-3;
  for (const RingSide& side : list) {
    const double at = positive(inside - side.from), width = side.to - side.from;
    if (at > width || width <= 0) continue;
    const auto w = static_cast<float>(std::clamp((at - towards * 1e-3) / width, 0.0, 1.0));
    return {side.at_from.x + w * (side.at_to.x - side.at_from.x),
            side.at_from.y + w * (side.at_to.y - side.at_from.y)};
  }
  return list.front().at_from;
}

void LimbShape::errors(std::size_t a, std::size_t b, double& area, double& largest) const {
  area = largest = 0;
  if (b <= a + 1) return;
  const Double3 from = rings_[a].centre, to = rings_[b].centre;
  const double span = along_[b] - along_[a];
  const std::size_t inner = b - a - 1, stride = (inner + k_samples - 1) / k_samples;
  std::size_t taken = 0;
  double sum = 0;
  const Double3 chord = normalized(to - from, {0, 0, 0});
  for (std::size_t i = a + 1; i < b; i += stride, ++taken) {
    const double w = span > 0 ? (along_[i] - along_[a]) / span : 0;
    const Double3 d = rings_[i].centre - from;
    // Off the chord counts; along it a ring may slide.
    const double off = length(d - chord * dot(d, chord));
    const double thick =
        std::abs(rings_[i].radius - (rings_[a].radius + w * (rings_[b].radius - rings_[a].radius)));
    sum += off + 0.5 * thick;
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

std::vector<SpectrumVertex> LimbShape::ring_vertices(std::size_t i, std::size_t interval, std::uint32_t sides,
                                                     double ribbon_angle) const {
  const RingShape& ring = rings_[i];
  std::vector<SpectrumVertex> out;
  if (sides == 2) {
    const Double3 wide = ring.x * std::cos(ribbon_angle) + ring.y * std::sin(ribbon_angle);
    const Double3 face = cross(wide, ring.axis);
    const double half = k_ribbon_width * ring.perimeter / k_turn;
    for (const double side : {-1.0, 1.0}) {
      const double at = ribbon_angle + (side < 0 ? std::numbers::pi : 0);
      out.push_back({to_float(ring.centre + wide * (side * half)), to_float(normalized(face + wide * side)),
                     texcoord(i, interval, at, 1)});
    }
    return out;
  }
  std::vector<Double3> places;
  double perimeter = 0;
  for (std::uint32_t j = 0; j < sides; ++j) places.push_back(sample(i, ring.phase + k_turn * j / sides));
  for (std::uint32_t j = 0; j < sides; ++j) perimeter += distance(places[j], places[(j + 1) % sides]);
  // As wide, seen from all round, as the ring itself: the mean width of a convex outline is its perimeter /
  // pi.
  const double scale = perimeter > 0 ? std::min(ring.perimeter / perimeter, 1.5) : 1;
  for (std::uint32_t j = 0; j <= sides; ++j) {
    const Double3 out_of = places[j % sides] - ring.centre;
    const double at = ring.phase + k_turn * j / sides;
    const Double3 flat = out_of - ring.axis * dot(out_of, ring.axis);
    out.push_back({to_float(ring.centre + out_of * scale),
                   to_float(normalized(flat, ring.x * std::cos(at) + ring.y * std::sin(at))),
                   texcoord(i, interval, at, j == sides ? -1 : 1)});
  }
  return out;
}

}  // namespace copse
