#include "lib/analysis/rings/band_growth.h"

#include "lib/analysis/rings/hole_filling.h"
#include "lib/analysis/surface/components.h"
#include "lib/analysis/surface/tolerances.h"
#include "lib/analysis/surface/welded_tolerances.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace copse {

namespace {

constexpr std::size_t k_no_limit = std::numeric_limits<std::size_t>::max();

// How long a front may be that a ring of `k` vertices has led to: forks join a few rings, not a hundred.
constexpr std::size_t limit_after(std::size_t k) {
  return 8 * k + 64;
}

double angle_between(const Double3& a, const Double3& b) {
  return std::atan2(length(cross(a, b)), dot(a, b));
}

bool holds(const Triangle& t, std::uint32_t a, std::uint32_t b) {
  return std::ranges::count(t, a) != 0 && std::ranges::count(t, b) != 0;
}

}  // namespace

BandGrowth::BandGrowth(const Surface& surface, Bands& bands)
    : surface_(surface),
      bands_(bands),
      patched_(surface),
      ends_(surface),
      band_of_(bands.band_of),
      claimed_(surface.triangles.size(), 0),
      seen_(3 * surface.triangles.size(), 0),
      mark_(surface.positions.size(), 0),
      degree_(surface.positions.size(), 0) {
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    claimed_[t] = bands.band_of[t] != k_none;
    for (const std::uint32_t v : surface.triangles[t]) ++degree_[v];
  }
  for (const std::uint32_t t : bands.lids) claimed_[t] = 1;
}

void BandGrowth::push(std::uint32_t read_triangle, std::uint32_t a, std::uint32_t b, std::size_t limit) {
  const std::uint32_t n = beyond(read_triangle, a, b);
  if (unread(n)) queue_.push_back({n, a, b, limit});
}

// Walks along the border of what is not read, turning about each of its vertices through the triangles that
// touch it; false when the front is longer than the limit. Triangles across edges are partners, so walking is
// a permutation of the border's edges and always comes back.
bool BandGrowth::walk(const Edge& start) {
  step_.ring.clear(), step_.next.clear(), step_.triangles.clear();
  step_.near.clear(), step_.far.clear();
  step_.corner = false;
  ++walks_;
  Edge e = start;
  std::size_t steps = 0;
  do {
    seen_[3 * e.triangle + static_cast<std::size_t>(edge_between(triangle(e.triangle), e.a, e.b))] = walks_;
    step_.ring.push_back(e.a);
    step_.near.push_back(e);
    std::uint32_t t = e.triangle, x = third_corner(triangle(t), e.a, e.b);
    std::uint32_t n = beyond(t, e.b, x);
    step_.corner |= !unread(n);
    while (unread(n)) {
      if (step_.next.empty() || step_.next.back() != x) step_.next.push_back(x);
      step_.triangles.push_back(n);
      const std::uint32_t y = third_corner(triangle(n), e.b, x);
      t = n;
      n = beyond(n, e.b, y);
      if (unread(n)) step_.far.push_back({t, x, y, 0});
      x = y;
      if (++steps > start.limit) return false;
    }
    e.triangle = t, e.a = e.b, e.b = x;
    if (++steps > start.limit) return false;
  } while (e.triangle != start.triangle || e.a != start.a || e.b != start.b);
  if (step_.next.size() > 1 && step_.next.front() == step_.next.back()) step_.next.pop_back();
  return true;
}

bool BandGrowth::is_simple(std::span<const std::uint32_t> ring) {
  for (const std::uint32_t v : ring) {
    if (mark_[v] == stamp_) return false;
    mark_[v] = stamp_;
  }
  return true;
}

// Whether the walked step is a band: two simple cycles without a common vertex, or a cycle and a point.
bool BandGrowth::is_strip() {
  if (step_.corner || step_.ring.size() < 3 || step_.next.empty() || step_.next.size() == 2) return false;
  if (step_.next.size() > 1 && step_.far.size() != step_.next.size()) return false;
  ++stamp_;
  return is_simple(step_.ring) && is_simple(step_.next);
}

// Whether the walked step goes along a limb rather than across a plate.
bool BandGrowth::is_gentle() const {
  const RingCircle a = ring_circle(surface_.positions, step_.ring);
  const RingCircle b = ring_circle(surface_.positions, step_.next);
  return std::abs(a.radius - b.radius) <= distance(a.centre, b.centre);
}

void BandGrowth::claim(std::span<const std::uint32_t> ring, std::span<const std::uint32_t> next,
                       std::span<const std::uint32_t> triangles) {
  for (const std::uint32_t t : triangles) {
    claimed_[t] = 1;
    band_of_[t] = bands_.count();
    if (patched_.is_stand_in(t)) stand_ins_of_[bands_.count()].push_back(t);
  }
  bands_.add(ring, next, triangles);
  committed_at_ = walks_;
}

void BandGrowth::commit() {
  claim(step_.ring, step_.next, step_.triangles);
  for (const Edge& e : step_.far) push(e.triangle, e.a, e.b, limit_after(step_.next.size()));
}

// Whether the walked front is a border of the surface or the rim of a lid, or no longer than the longest ring
// that has led to it. Where limbs share vertices, what is left of their rings is no longer than they are;
// where a front runs round a hole that a limb sits in, it is.
bool BandGrowth::is_expected() const {
  std::size_t longest = 0, borders = 0;
  for (const Edge& e : step_.near) {
    const std::uint32_t behind = beyond(e.triangle, e.a, e.b);
    const std::uint32_t band = behind == k_none ? k_none : band_of_[behind];
    if (!is_band(band)) {  // a border, or a lid
      borders += behind == k_none || !patched_.is_stand_in(behind);
      continue;
    }
    longest = std::max({longest, bands_.ring(2 * band).size(), bands_.ring(2 * band + 1).size()});
  }
  return borders == step_.ring.size() || step_.ring.size() <= longest;
}

void BandGrowth::read_regular() {
  while (!queue_.empty()) {
    const Edge e = queue_.front();
    queue_.pop_front();
    if (!unread(e.triangle)) continue;
    const auto edge = static_cast<std::size_t>(edge_between(triangle(e.triangle), e.a, e.b));
    if (seen_[3 * e.triangle + edge] > committed_at_) continue;  // nothing has changed since
    if (!walk(e) || !is_strip()) continue;
    const double k = static_cast<double>(step_.ring.size()), l = static_cast<double>(step_.next.size());
    if ((k == l || l == 1) && is_expected()) {
      commit();
    } else if (is_gentle()) {
      parked_.push({l == 1 ? 0 : std::abs(std::log(k / l)), serial_++, e});
    }
  }
}

void BandGrowth::run(bool change) {
  read_regular();
  while (change && !parked_.empty()) {
    const Edge e = parked_.top().edge;
    parked_.pop();
    if (!unread(e.triangle) || !walk(e) || !is_strip() || !is_gentle()) continue;
    commit();
    read_regular();
  }
}

void BandGrowth::start_at_borders() {
  ++walks_;
  for (std::uint32_t t = 0; t < surface_.triangles.size(); ++t) {
    for (std::size_t e = 0; e < 3; ++e) {
      if (!unread(t) || patched_.across(t, e) != k_none || seen_[3 * t + e] != 0) continue;
      const Edge start{t, triangle(t)[(e + 1) % 3], triangle(t)[e], k_no_limit};
      walk(start);  // marks the whole border as seen
      queue_.push_back(start);
    }
  }
  committed_at_ = walks_;
}

// The triangles round a vertex in order, when they close and none is read.
bool BandGrowth::collect_fan(std::uint32_t v, std::uint32_t start, Fan& fan) {
  fan.link.clear(), fan.triangles.clear();
  fan.angle = 0;
  std::uint32_t t = start,
                x = third_corner(triangle(t), v, v == triangle(t)[0] ? triangle(t)[1] : triangle(t)[0]);
  do {
    const std::uint32_t y = third_corner(triangle(t), v, x);
    fan.link.push_back(x);
    fan.triangles.push_back(t);
    const Double3 p = surface_.positions[v];
    fan.angle += angle_between(surface_.positions[x] - p, surface_.positions[y] - p);
    x = y;
    t = beyond(t, v, x);
    if (!unread(t)) return false;
  } while (t != start);
  ++stamp_;
  return fan.link.size() >= 3 && fan.link.size() == degree_[v] && is_simple(fan.link);
}

// Whether rings of the fan's size follow behind it. Nothing stays read.
bool BandGrowth::continues_behind(const Fan& fan, int rings) {
  std::vector<std::uint32_t> tried = fan.triangles;
  for (const std::uint32_t t : tried) claimed_[t] = 1;
  const std::size_t k = fan.link.size();
  const std::uint32_t n = beyond(fan.triangles[0], fan.link[0], fan.link[1]);
  Edge e{n, fan.link[0], fan.link[1], limit_after(k)};
  bool good = unread(n);
  for (int i = 0; good && i < rings; ++i) {
    good = walk(e) && step_.ring.size() == k && step_.next.size() == k && is_strip() && is_gentle();
    if (!good) break;
    for (const std::uint32_t t : step_.triangles) claimed_[t] = 1;
    tried.insert(tried.end(), step_.triangles.begin(), step_.triangles.end());
    const Edge far = step_.far[0];
    e = {beyond(far.triangle, far.a, far.b), far.a, far.b, limit_after(k)};
    good = unread(e.triangle) || i + 1 == rings;
  }
  for (const std::uint32_t t : tried) claimed_[t] = 0;
  return good;
}

bool BandGrowth::is_point(std::uint32_t v, const Fan& fan, Points which) {
  const int rings = which == Points::followed_by_a_ring ? 1 : 2;
  if (fan.angle <= k_point_angle)
    return ends_.is_round(fan.link) && (which == Points::all || continues_behind(fan, rings));
  // The ring behind the link has as many vertices as the link when the link's have five triangles on average.
  std::uint64_t degrees = 0;
  for (const std::uint32_t x : fan.link) degrees += degree_[x];
  return degree_[v] == fan.link.size() && degrees == 5 * fan.link.size() && ends_.is_round(fan.link) &&
         continues_behind(fan, rings) && !ends_.is_lid_corner(v);
}

void BandGrowth::read_fan(std::uint32_t v, const Fan& fan) {
  claim(fan.link, std::span(&v, 1), fan.triangles);
  for (std::size_t i = 0; i < fan.link.size(); ++i) {
    push(fan.triangles[i], fan.link[i], fan.link[(i + 1) % fan.link.size()], limit_after(fan.link.size()));
  }
}

// The first triangle that is not read at each vertex.
std::vector<std::uint32_t> BandGrowth::first_unread() const {
  std::vector<std::uint32_t> first(surface_.positions.size(), k_none);
  for (std::uint32_t t = 0; t < surface_.triangles.size(); ++t) {
    if (!unread(t)) continue;
    for (const std::uint32_t v : triangle(t)) first[v] = std::min(first[v], t);
  }
  return first;
}

void BandGrowth::start_at_points(Points which) {
  const std::vector<std::uint32_t> first = first_unread();
  Fan fan;
  for (std::uint32_t v = 0; v < first.size(); ++v) {
    if (unread(first[v]) && collect_fan(v, first[v], fan) && is_point(v, fan, which)) read_fan(v, fan);
  }
  committed_at_ = walks_;
}

void BandGrowth::start_at_lids(double smooth, int rings, Lids which) {
  for (const Lid& lid : ends_.lids(smooth)) {
    if (!ends_.may_close(lid, which) || !is_unread(lid)) continue;
    Fan fan{lid.rim, lid.triangles, 0};
    const auto at_start = [&](std::uint32_t t) { return holds(triangle(t), lid.rim[0], lid.rim[1]); };
    std::ranges::stable_partition(fan.triangles, at_start);
    if (!continues_behind(fan, rings)) continue;
    close_with_lid(lid);
    push_rim(lid);
  }
  committed_at_ = walks_;  // what was tried has walked where fronts may still begin
}

bool BandGrowth::is_unread(const Lid& lid) const {
  return std::ranges::all_of(lid.triangles, [&](std::uint32_t t) { return unread(t); });
}

// Its number among the bands and lids.
std::uint32_t BandGrowth::close_with_lid(const Lid& lid) {
  const std::uint32_t number = k_first_lid + static_cast<std::uint32_t>(closing_.size());
  closing_.push_back(lid);
  bands_.lids.insert(bands_.lids.end(), lid.triangles.begin(), lid.triangles.end());
  for (const std::uint32_t t : lid.triangles) claimed_[t] = 1, band_of_[t] = number;
  committed_at_ = walks_;
  return number;
}

// Undoes the last close_with_lid().
void BandGrowth::open_again() {
  for (const std::uint32_t t : closing_.back().triangles) claimed_[t] = 0, band_of_[t] = k_none;
  bands_.lids.resize(bands_.lids.size() - closing_.back().triangles.size());
  closing_.pop_back();
}

void BandGrowth::push_rim(const Lid& lid) {
  for (const std::uint32_t t : lid.triangles) {
    for (std::size_t e = 0; e < 3; ++e) {
      push(t, triangle(t)[e], triangle(t)[(e + 1) % 3], limit_after(lid.rim.size()));
    }
  }
}

void BandGrowth::start_at_lids_beside_limbs(double smooth) {
  for (const std::size_t most : {std::size_t{1}, k_widest_collar}) {
    // Stand-ins are no part of a surface: its own triangles come first.
    const std::span<const std::uint8_t> settled(claimed_.data(), surface_.triangles.size());
    for (const Lid& lid : ends_.lids_beside(smooth, settled)) {
      if (lid.rim.size() > k_widest_collar || !ends_.may_close(lid, Lids::any) || !is_unread(lid)) continue;
      const std::uint32_t number = close_with_lid(lid);
      const std::uint32_t first = bands_.count();
      if (read_past_limbs(2 * number, most)) {
        read_regular();
        read_past_limbs_from(first);  // before another lid is believed: a box can be read along three axes
      } else {
        open_again();
      }
    }
  }
}

void BandGrowth::close_rings() {
  std::vector<std::uint8_t> seen(surface_.triangles.size(), 0);
  std::vector<std::uint32_t> patch;
  for (std::uint32_t start = 0; start < seen.size(); ++start) {
    if (seen[start] || !unread(start)) continue;
    patch.assign(1, start);
    seen[start] = 1;
    std::size_t rim = 0;
    std::uint32_t band = k_none;
    bool is_lid = true;
    for (std::size_t i = 0; i < patch.size(); ++i) {
      for (std::size_t e = 0; e < 3; ++e) {
        const std::uint32_t n = patched_.across(patch[i], e);
        if (unread(n)) {
          is_lid &= !patched_.is_stand_in(n);
          if (patched_.is_stand_in(n) || seen[n]) continue;
          seen[n] = 1;
          patch.push_back(n);
          continue;
        }
        ++rim;
        if (band == k_none && n != k_none) band = band_of_[n];
        is_lid &= n != k_none && band_of_[n] == band && is_band(band);
      }
    }
    if (!is_lid || rim != patch.size() + 2) continue;
    if (bands_.ring(2 * band).size() != rim && bands_.ring(2 * band + 1).size() != rim) continue;
    bands_.lids.insert(bands_.lids.end(), patch.begin(), patch.end());
    for (const std::uint32_t t : patch) claimed_[t] = 1;
  }
}

void BandGrowth::close_fans() {
  const std::vector<std::uint32_t> first = first_unread();
  Fan fan;
  for (std::uint32_t v = 0; v < first.size(); ++v) {
    if (!unread(first[v]) || !collect_fan(v, first[v], fan)) continue;
    std::size_t bordered = 0;
    std::uint32_t band = k_none;
    bool one_band = true;
    for (std::size_t i = 0; i < fan.link.size(); ++i) {
      const std::uint32_t n = beyond(fan.triangles[i], fan.link[i], fan.link[(i + 1) % fan.link.size()]);
      if (n == k_none || !is_band(band_of_[n])) continue;
      one_band &= band == k_none || band == band_of_[n];
      band = band_of_[n];
      ++bordered;
    }
    if (!one_band || 2 * bordered < fan.link.size()) continue;
    // Of two points at a fork each has half of the ring below; the corner of a box has less.
    const std::size_t ring = std::max(bands_.ring(2 * band).size(), bands_.ring(2 * band + 1).size());
    if (2 * bordered >= ring) read_fan(v, fan);
  }
}

void BandGrowth::start_at_bands(std::uint32_t first) {
  for (std::uint32_t i = bands_.first_triangle[first]; i < bands_.triangles.size(); ++i) {
    claimed_[bands_.triangles[i]] = 1;
  }
  for (std::uint32_t b = first; b < bands_.count(); ++b) {
    const std::size_t k = bands_.ring(2 * b).size() + bands_.ring(2 * b + 1).size();
    for (std::uint32_t i = bands_.first_triangle[b]; i < bands_.first_triangle[b + 1]; ++i) {
      const Triangle t = triangle(bands_.triangles[i]);
      for (std::size_t e = 0; e < 3; ++e) push(bands_.triangles[i], t[e], t[(e + 1) % 3], limit_after(k));
    }
  }
  committed_at_ = walks_;
}

std::span<const std::uint32_t> BandGrowth::polygon_of(std::uint32_t ring) const {
  return is_band(ring / 2) ? bands_.ring(ring)
                           : std::span<const std::uint32_t>(closing_[ring / 2 - k_first_lid].rim);
}

// Of a band, its stand-ins last, or of a lid.
std::vector<std::uint32_t> BandGrowth::triangles_of(std::uint32_t band) const {
  if (!is_band(band)) return closing_[band - k_first_lid].triangles;
  const auto own = bands_.triangles_of(band);
  std::vector<std::uint32_t> triangles(own.begin(), own.end());
  if (const auto more = stand_ins_of_.find(band); more != stand_ins_of_.end())
    triangles.insert(triangles.end(), more->second.begin(), more->second.end());
  return triangles;
}

std::vector<BandGrowth::Side> BandGrowth::sides_of(std::uint32_t ring) const {
  const auto polygon = polygon_of(ring);
  const std::vector<std::uint32_t> triangles = triangles_of(ring / 2);
  std::vector<Side> sides;
  sides.reserve(polygon.size());
  std::size_t at = 0;  // a band's triangles go round with its rings: the next side's is mostly the next
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const std::uint32_t a = polygon[i], b = polygon[(i + 1) % polygon.size()];
    for (std::size_t tried = 0; tried < triangles.size(); ++tried, ++at) {
      if (at >= triangles.size()) at = 0;
      const std::uint32_t t = triangles[at];
      if (!holds(triangle(t), a, b)) continue;
      sides.push_back({a, b, t, beyond(t, a, b)});
      break;
    }
  }
  return sides;
}

void BandGrowth::stand_in(std::span<const Side> hole, std::span<const Triangle> triangles) {
  patched_.close(hole, triangles);
  claimed_.resize(patched_.size(), 0);
  band_of_.resize(claimed_.size(), k_none);
  seen_.resize(3 * claimed_.size(), 0);
}

// Undoes the last stand_in(), whose triangles nothing has claimed.
void BandGrowth::take_back(std::span<const Side> hole) {
  patched_.reopen(hole);
  claimed_.resize(patched_.size());
  band_of_.resize(claimed_.size());
  seen_.resize(3 * claimed_.size());
}

void BandGrowth::fill(std::uint32_t ring) {
  const std::vector<Side> sides = sides_of(ring);
  std::vector<HoleCorner> corners;
  for (const std::uint32_t v : bands_.ring(ring)) corners.push_back({v, k_none});
  for (HoleCorner& corner : corners) {
    for (const Side& s : sides) {
      if (s.a == corner.vertex && s.outside != k_none) corner.band = band_of_[s.outside];
    }
  }
  const auto first = static_cast<std::uint32_t>(patched_.size());
  const std::size_t size = corners.size();
  stand_in(sides, fill_polygon(surface_.positions, std::move(corners)));
  for (std::uint32_t t = first; t < patched_.size(); ++t) {
    for (std::size_t e = 0; e < 3; ++e) {
      if (!unread(patched_.across(t, e))) {
        queue_.push_back({t, triangle(t)[e], triangle(t)[(e + 1) % 3], limit_after(8 * size)});
      }
    }
  }
}

// The rings of other bands that share sides with a ring that has something unread beyond other sides; none
// where a border runs.
std::vector<std::uint32_t> BandGrowth::limbs_beyond(std::span<const Side> sides) const {
  std::vector<std::uint32_t> limbs;
  bool is_open = false;
  for (const Side& s : sides) {
    if (s.outside == k_none) return {};
    is_open |= unread(s.outside);
    if (!is_band(band_of_[s.outside])) continue;  // unread, or a lid
    const std::uint32_t first = 2 * band_of_[s.outside];
    for (const std::uint32_t r : {first, first + 1}) {
      const auto other = bands_.ring(r);
      if (other.size() < 3 || other.size() > k_widest_collar) continue;
      if (std::ranges::count(other, s.a) != 0 && std::ranges::count(other, s.b) != 0) limbs.push_back(r);
    }
  }
  std::ranges::sort(limbs);
  limbs.erase(std::unique(limbs.begin(), limbs.end()), limbs.end());
  return is_open ? limbs : std::vector<std::uint32_t>{};
}

// Closes the hole of the limb that ends in `ring`, which the band `band` borders on one arc.
bool BandGrowth::close_strip(std::uint32_t ring, std::uint32_t band) {
  const std::vector<Side> sides = sides_of(ring);
  std::vector<std::uint8_t> on_ring;
  for (const Side& s : sides) on_ring.push_back(s.outside != k_none && band_of_[s.outside] == band);
  if (sides.size() != bands_.ring(ring).size()) return false;
  const std::vector<Triangle> strip = strip_across(surface_.positions, bands_.ring(ring), on_ring);
  if (strip.empty()) return false;
  stand_in(sides, strip);
  return true;
}

// The same where the limb was cut into a band that begins at a border: the border runs along the limb's ring.
bool BandGrowth::close_strip_at_border(std::span<const Side> sides, std::uint32_t ring) {
  std::vector<std::uint8_t> at_border;
  bool is_open = false;
  for (const Side& s : sides) {
    at_border.push_back(s.outside == k_none);
    is_open |= unread(s.outside);
  }
  if (!is_open || sides.size() != bands_.ring(ring).size()) return false;
  const std::vector<Triangle> strip = strip_across(surface_.positions, bands_.ring(ring), at_border);
  if (strip.empty()) return false;
  stand_in(sides, strip);
  return true;
}

// Reads the band from a border that a stand-in lies at, if it keeps the number of vertices.
bool BandGrowth::read_from_border(const Side& border, std::uint32_t first_stand_in, std::size_t k) {
  while (!holds(triangle(first_stand_in), border.a, border.b)) ++first_stand_in;
  if (!walk({first_stand_in, border.a, border.b, limit_after(k)}) || !is_strip() ||
      step_.next.size() != step_.ring.size() || !is_expected()) {
    return false;
  }
  commit();
  return true;
}

bool BandGrowth::read_past_limb_at_border(std::uint32_t ring, std::span<const Side> sides) {
  const auto first = static_cast<std::uint32_t>(patched_.size());
  const auto border = std::ranges::find(sides, k_none, &Side::outside);
  if (border == sides.end() || !close_strip_at_border(sides, ring)) return false;
  if (read_from_border(*border, first, sides.size())) return true;
  take_back(sides);
  return false;
}

// Bands that begin at a border and that several limbs were cut into.
void BandGrowth::read_past_limbs_at_borders() {
  UnionFind borders(surface_.positions.size());
  for (std::size_t t = 0; t < surface_.triangles.size(); ++t) {
    for (std::size_t e = 0; e < 3; ++e) {
      if (surface_.across[t][e] == k_none)
        borders.unite(surface_.triangles[t][e], surface_.triangles[t][(e + 1) % 3]);
    }
  }
  std::vector<std::pair<std::uint32_t, std::uint32_t>> rings;  // border, ring
  for (std::uint32_t ring = 0; ring < 2 * bands_.count(); ++ring) {
    const std::size_t k = bands_.ring(ring).size();
    if (k < 3 || k > k_widest_collar || !borders_unread(ring / 2)) continue;
    const std::vector<Side> sides = sides_of(ring);
    const auto at = std::ranges::find(sides, k_none, &Side::outside);
    if (at != sides.end()) rings.emplace_back(borders.find(at->a), ring);
  }
  std::ranges::sort(rings);
  for (auto i = rings.begin(); i != rings.end();) {
    const auto end = std::find_if(i, rings.end(), [&](const auto& r) { return r.first != i->first; });
    const auto first = static_cast<std::uint32_t>(patched_.size());
    std::vector<std::vector<Side>> closed;
    std::size_t k = 0;
    for (; i != end; ++i) {
      std::vector<Side> sides = sides_of(i->second);
      if (!close_strip_at_border(sides, i->second)) continue;
      k += sides.size();
      closed.push_back(std::move(sides));
    }
    if (closed.empty()) continue;
    const Side border = *std::ranges::find(closed.front(), k_none, &Side::outside);
    if (closed.size() > 1 && read_from_border(border, first, k)) continue;
    for (; !closed.empty(); closed.pop_back()) take_back(closed.back());
  }
}

// Whether the walked front is a ring of a band or lid: all of what lies behind it is that.
bool BandGrowth::runs_along(std::uint32_t band) const {
  return std::ranges::all_of(step_.near, [&](const Edge& e) {
    const std::uint32_t behind = beyond(e.triangle, e.a, e.b);
    return behind != k_none && band_of_[behind] == band;
  });
}

bool BandGrowth::read_past_limbs(std::uint32_t ring, std::size_t most) {
  const std::vector<Side> round = sides_of(ring);
  if (read_past_limb_at_border(ring, round)) return true;
  const std::vector<std::uint32_t> limbs = limbs_beyond(round);
  if (limbs.empty() || limbs.size() > most) return false;
  std::vector<std::vector<Side>> closed;
  for (const std::uint32_t limb : limbs) {
    std::vector<Side> sides = sides_of(limb);
    if (!close_strip(limb, ring / 2)) break;
    closed.push_back(std::move(sides));
  }
  bool good = closed.size() == limbs.size();
  if (good) {
    const Side s = sides_of(ring)[0];
    good = unread(s.outside) && walk({s.outside, s.a, s.b, limit_after(round.size())}) && is_strip() &&
           runs_along(ring / 2) && step_.ring.size() == round.size() && step_.next.size() == round.size();
  }
  if (good) {
    commit();
    return true;
  }
  while (!closed.empty()) {
    take_back(closed.back());
    closed.pop_back();
  }
  return false;
}

bool BandGrowth::borders_unread(std::uint32_t band) const {
  return std::ranges::any_of(triangles_of(band), [&](std::uint32_t t) {
    return unread(patched_.across(t, 0)) || unread(patched_.across(t, 1)) || unread(patched_.across(t, 2));
  });
}

void BandGrowth::read_past_limbs() {
  read_past_limbs_from(0);
  read_past_limbs_at_borders();
  read_regular();
}

// Beyond the bands from `first` on, and those that they have reached.
void BandGrowth::read_past_limbs_from(std::uint32_t first) {
  // One limb first: a limb of four sides can pass for what two other ends sit on.
  read_past_limbs_of(1, first);
  read_past_limbs_of(k_widest_collar, first);
}

void BandGrowth::read_past_limbs_of(std::size_t most, std::uint32_t first) {
  std::vector<std::uint32_t> todo;
  std::vector<std::uint8_t> listed;
  const auto list = [&](std::uint32_t band) {
    for (const std::uint32_t ring : {2 * band, 2 * band + 1}) {
      const std::size_t k = bands_.ring(ring).size();
      if (listed[ring] || k < 3 || k > k_widest_collar) continue;
      listed[ring] = 1;
      todo.push_back(ring);
    }
  };
  std::uint32_t known = first;
  // New bands, and those that they have reached.
  const auto list_new = [&] {
    listed.resize(2 * std::size_t{bands_.count()}, 0);
    for (; known < bands_.count(); ++known) {
      list(known);
      for (const std::uint32_t t : bands_.triangles_of(known)) {
        for (const std::uint32_t n : surface_.across[t]) {
          if (n != k_none && bands_.band_of[n] != k_none) list(bands_.band_of[n]);
        }
      }
    }
  };
  list_new();
  for (std::size_t i = 0; i < todo.size(); ++i) {
    listed[todo[i]] = 0;
    if (!borders_unread(todo[i] / 2) || !read_past_limbs(todo[i], most)) continue;
    read_regular();
    list_new();
  }
}

// The share of a ring's edges that have something unread on their far side; 0 for rings on a border.
double BandGrowth::open_share(std::uint32_t ring) {
  const std::uint32_t band = ring / 2;
  ++stamp_;
  is_simple(bands_.ring(ring));  // marks its vertices
  std::size_t open = 0, border = 0;
  for (std::uint32_t i = bands_.first_triangle[band]; i < bands_.first_triangle[band + 1]; ++i) {
    const std::uint32_t t = bands_.triangles[i];
    for (std::size_t e = 0; e < 3; ++e) {
      if (mark_[triangle(t)[e]] != stamp_ || mark_[triangle(t)[(e + 1) % 3]] != stamp_) continue;
      open += unread(patched_.across(t, e)), border += patched_.across(t, e) == k_none;
    }
  }
  return border > 0 ? 0 : static_cast<double>(open) / static_cast<double>(bands_.ring(ring).size());
}

void BandGrowth::fill_collars() {
  // Where a limb sits in another one, the hole for it and the rings of that other one are open in part. The
  // hole is so at its sides alone.
  struct Collar {
    double open, radius;
    std::uint32_t ring;
    auto operator<=>(const Collar&) const = default;
  };
  std::vector<Collar> collars;
  for (std::uint32_t r = 0; r < 2 * bands_.count(); ++r) {
    const std::size_t k = bands_.ring(r).size();
    if (k < 3 || k > k_widest_collar) continue;
    const double open = open_share(r);
    if (open > 0) collars.push_back({open, ring_circle(surface_.positions, bands_.ring(r)).radius, r});
  }
  std::ranges::sort(collars);
  for (const Collar& c : collars) {
    if (open_share(c.ring) == 0) continue;  // filling another one has led past it
    fill(c.ring);
    committed_at_ = walks_;
    read_regular();
  }
}

}  // namespace copse
