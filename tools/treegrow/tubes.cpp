#include "tools/treegrow/tubes.h"

#include "tools/treegrow/joints.h"
#include "tools/treegrow/rotation.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace copse::grow {
namespace {

constexpr std::uint64_t k_rough_key = 20, k_phase_key = 21, k_loose_key = 22;
constexpr std::size_t k_tube_segments = 3;  // of a tube that is laid end to end with others
constexpr double k_rough = 0.12;            // of the radius
constexpr double k_loose = 1e-6;            // of the height
constexpr double k_inset = 0.7;             // of a face that is inset
constexpr double k_point = 2;               // how far a pointed tip runs out, in radii

// Where a ring's loop is in the mesh.
struct LoopPlace {
  std::uint32_t vertex = 0, last_vertex = 0, texcoord = 0;
};

class TubeBuilder {
 public:
  TubeBuilder(const Species& species, const Skeleton& skeleton, const Layout& layout, const Breaks& breaks,
              Surface& surface, Truth& truth)
      : species_(species),
        skeleton_(skeleton),
        layout_(layout),
        breaks_(breaks),
        surface_(surface),
        truth_(truth) {}

  Tubes run();

 private:
  const Stem& stem() const { return skeleton_.stems[current_]; }
  const StemLayout& own() const { return layout_.stems[current_]; }
  std::size_t global(std::size_t ring) const { return own().first + ring; }
  bool free() const { return breaks_.has(Break::free_tubes) || breaks_.has(Break::laid_against); }
  bool opens() const { return breaks_.has(Break::welded_forks) || breaks_.pulls_out(); }
  bool cut_after(std::size_t ring) const;

  void build_stem();
  Double3 start_point() const;
  void place_points();
  Loop build_start(std::uint32_t& truth_ring);
  Loop base_loop() const;
  Loop inset(const Loop& base);
  Double3 ring_offset(std::size_t ring, double angle) const;
  Double3 ring_normal(std::size_t ring, double angle) const;
  Loop loop_of(const LoopPlace& place, std::uint32_t k) const;
  Loop add_ring(std::size_t ring);
  Loop add_copy(const Loop& loop, std::size_t ring, std::uint32_t& truth_ring);
  std::uint32_t twin(std::uint32_t vertex);
  void add_v(std::size_t ring);
  void close_start(const Loop& loop);
  void close_tip(const Loop& loop, std::uint32_t truth_ring);
  std::size_t opening_column(std::size_t ring, std::uint32_t child, std::size_t count) const;
  void finish_base(Loop& base);
  Loop open_saddle(std::size_t ring, const Loop& loop, std::uint32_t child);
  void band_with_patch(std::size_t ring, const Loop& lower, const Loop& upper, std::uint32_t child);
  std::uint32_t add_truth(const Loop& loop, std::uint32_t parent);
  void add_tip_truth(const Double3& at, std::uint32_t parent);
  std::uint32_t attach(TruthBranch& branch);
  std::uint32_t attach_free(TruthBranch& branch) const;

  const Species& species_;
  const Skeleton& skeleton_;
  const Layout& layout_;
  const Breaks& breaks_;
  Surface& surface_;
  Truth& truth_;
  Tubes tubes_;

  std::vector<std::uint32_t> truth_ring_;  // of each layout ring
  std::vector<LoopPlace> loops_;           // of each layout ring
  std::vector<std::uint32_t> opener_;      // of each layout ring: the branch that opens it
  std::vector<Loop> bases_;                // of each stem: what it starts from, if it opens its parent

  std::size_t current_ = 0;
  std::vector<StemPoint> points_;
  double phase_ = 0;   // turn of the ring's first vertex
  double turned_ = 0;  // turn of the present tube of several
  double v_ = 0;       // texture coordinate along the stem
  double tile_ = 1;    // length of one repetition of the texture
  double repeat_ = 1;  // repetitions round the stem
  Random loose_{0};
};

bool TubeBuilder::cut_after(std::size_t ring) const {
  if (!breaks_.has(Break::end_to_end) && !breaks_.has(Break::end_to_end_turned)) return false;
  if (ring == 0 || ring + 1 >= own().count || ring % k_tube_segments != 0 || own().k == 2) return false;
  // A ring that a branch has opened stays whole, or the opening would lead between two tubes.
  return !opens() || (opener_[global(ring)] == k_none && opener_[global(ring - 1)] == k_none);
}

// Where the stem begins: on the middle line of its parent's tube or, laid against it, so far outside that its
// first ring just touches the surface.
Double3 TubeBuilder::start_point() const {
  const TubePlace at = tube_place(layout_, tubes_, stem().parent, stem().parent_at);
  if (!breaks_.has(Break::laid_against)) return at.centre;
  const Double3 out = perpendicular(at.along, points_[0].along);
  const double tilt = std::sqrt(std::max(0.0, 1 - std::pow(dot(points_[0].along, out), 2)));
  return at.centre + out * (at.radius + points_[0].radius * tilt);
}

// Frames of all rings, moved onto the parent's tube.
void TubeBuilder::place_points() {
  const auto rings = layout_.rings_of(current_);
  points_ = stem_points(species_, stem(), {rings.begin(), rings.end()});
  const double least = species_.min_radius * skeleton_.height;
  for (StemPoint& p : points_) p.radius = std::max(p.radius, least);
  if (stem().kind == StemKind::root) {  // a root ring lies flat
    points_[0].along = k_up;
    points_[0].side = perpendicular(k_up, points_[0].side);
    points_[0].up = cross(points_[0].along, points_[0].side);
  } else {
    tubes_.shift[current_] = start_point() - stem_position(stem(), 0);
  }
  for (StemPoint& p : points_) p.centre += tubes_.shift[current_];
  double mean = 0;
  for (const StemPoint& p : points_) mean += p.radius / static_cast<double>(points_.size());
  const double trunk = species_.ratio * skeleton_.height;
  repeat_ = std::max(1.0, std::round(species_.bark_repeat * std::sqrt(points_[0].radius / trunk)));
  tile_ = 2 * std::numbers::pi * mean / repeat_;
  if (breaks_.has(Break::one_material)) tile_ *= repeat_, repeat_ = 1;
  v_ = 0;
}

std::uint32_t TubeBuilder::twin(std::uint32_t vertex) {
  if (!breaks_.has(Break::loose_seams)) return surface_.twin(vertex);
  const double r = k_loose * skeleton_.height / std::numbers::sqrt3;
  return surface_.twin(vertex, {loose_.around(0, r), loose_.around(0, r), loose_.around(0, r)});
}

Double3 TubeBuilder::ring_offset(std::size_t ring, double angle) const {
  const StemPoint& p = points_[ring];
  double radius = p.radius;
  if (stem().kind == StemKind::root && species_.lobes > 0) {
    const double foot = std::pow(std::max(0.0, 1 - 7 * layout_.rings[global(ring)]), 2);
    radius *= 1 + species_.lobe_depth * foot * std::cos(species_.lobes * angle);
  }
  return (p.side * std::cos(angle) + p.up * std::sin(angle)) * radius;
}

Double3 TubeBuilder::ring_normal(std::size_t ring, double angle) const {
  if (own().k == 2) return k_up;  // billboards are lit as the ground is
  const std::size_t a = ring > 0 ? ring - 1 : 0, b = std::min(ring + 1, points_.size() - 1);
  const StemPoint& p = points_[ring];
  const double run = distance(points_[a].centre, points_[b].centre);
  const double slope = run > 0 ? (points_[b].radius - points_[a].radius) / run : 0;
  return normalized(p.side * std::cos(angle) + p.up * std::sin(angle) - p.along * slope);
}

void TubeBuilder::add_v(std::size_t ring) {
  if (ring > 0) v_ += distance(points_[ring].centre, points_[ring - 1].centre) / tile_;
}

Loop TubeBuilder::loop_of(const LoopPlace& place, std::uint32_t k) const {
  Loop loop;
  const std::uint32_t columns = k == 2 ? 1 : k;
  for (std::uint32_t c = 0; c <= columns; ++c) {
    loop.vertex.push_back(c < columns ? place.vertex + c : place.last_vertex);
    loop.texcoord.push_back(place.texcoord + c);
  }
  return loop;
}

Loop TubeBuilder::add_ring(std::size_t ring) {
  const std::uint32_t k = own().k;
  const std::uint32_t columns = k == 2 ? 1 : k;
  Random rough = stem().random.fork(k_rough_key + ring * 64);
  std::uint32_t first = 0, texcoord = 0;
  for (std::uint32_t c = 0; c < k; ++c) {
    const double angle = 2 * std::numbers::pi * c / k + phase_ + turned_;
    Double3 offset = ring_offset(ring, angle);
    if (breaks_.has(Break::rough) && k > 2) {
      offset *= rough.around(1, k_rough);
      offset += points_[ring].along * (points_[ring].radius * rough.around(0, k_rough));
      if (ring == 0 && stem().kind == StemKind::root)
        offset.y = std::min(offset.y, 0.0);  // nothing of a root ring above where it lies
    }
    const std::uint32_t v = surface_.vertex(points_[ring].centre + offset, ring_normal(ring, angle));
    if (c == 0) first = v;
  }
  const double width = breaks_.has(Break::one_material) ? 0.5 : 1;
  for (std::uint32_t c = 0; c <= columns; ++c) {
    const std::uint32_t t =
        surface_.texcoord(width * repeat_ * c / columns, own().k == 2 ? layout_.rings[global(ring)] : v_);
    if (c == 0) texcoord = t;
  }
  const std::uint32_t last = breaks_.has(Break::seams) && k > 2 ? twin(first) : first;
  return loop_of({first, k == 2 ? first + 1 : last, texcoord}, k);
}

// The same ring again, for a tube that is laid end to end with the one below; turned, if that is asked for.
Loop TubeBuilder::add_copy(const Loop& loop, std::size_t ring, std::uint32_t& truth_ring) {
  if (breaks_.has(Break::end_to_end_turned)) {
    turned_ += std::numbers::pi / own().k;
    Loop turned = add_ring(ring);
    const std::uint32_t below = truth_ring;
    truth_ring = add_truth(turned, below);
    truth_.rings[truth_ring].same_as = below;
    return turned;
  }
  Loop copy = loop;
  const std::size_t k = loop.columns();
  for (std::size_t c = 0; c < k; ++c) copy.vertex[c] = twin(loop.vertex[c]);
  copy.vertex[k] = breaks_.has(Break::seams) ? twin(loop.vertex[k]) : copy.vertex[0];
  return copy;
}

// Centre and diameter are those of the vertices as they are in the mesh.
std::uint32_t TubeBuilder::add_truth(const Loop& loop, std::uint32_t parent) {
  const std::size_t k = own().k;
  TruthRing ring;
  for (std::size_t c = 0; c < k; ++c) ring.centre += surface_.position(loop.vertex[c]);
  ring.centre = ring.centre / static_cast<double>(k);
  for (std::size_t c = 0; c < k; ++c)
    ring.diameter += distance(surface_.position(loop.vertex[c]), ring.centre) * 2 / static_cast<double>(k);
  ring.parent = parent;
  ring.branch = static_cast<std::uint32_t>(current_);
  truth_.rings.push_back(ring);
  return static_cast<std::uint32_t>(truth_.rings.size() - 1);
}

void TubeBuilder::add_tip_truth(const Double3& at, std::uint32_t parent) {
  TruthRing ring;
  ring.centre = at;
  ring.parent = parent;
  ring.branch = static_cast<std::uint32_t>(current_);
  ring.tip = true;
  truth_.rings.push_back(ring);
}

void TubeBuilder::close_start(const Loop& loop) {
  if (own().k == 2) return;
  if (breaks_.has(Break::capped_fan)) add_fan(surface_, loop, points_[0].centre, -points_[0].along, true);
  if (breaks_.has(Break::capped_ngon)) add_ngon(surface_, loop, true);
}

void TubeBuilder::close_tip(const Loop& loop, std::uint32_t truth_ring) {
  if (own().k == 2) return;
  const StemPoint& end = points_.back();
  const Double3 point = end.centre + end.along * (k_point * end.radius);
  if (breaks_.has(Break::capped_fan)) add_fan(surface_, loop, end.centre, end.along, false);
  if (breaks_.has(Break::capped_ngon)) add_ngon(surface_, loop, false);
  if (breaks_.has(Break::pointed)) {
    add_fan(surface_, loop, point, end.along, false);
    add_tip_truth(surface_.position(surface_.last_vertex()), truth_ring);
  }
  if (breaks_.has(Break::collapsed_rings)) {
    Loop tip = loop;
    for (std::size_t c = 0; c < tip.vertex.size(); ++c) {
      const bool again = c + 1 == tip.vertex.size() && !breaks_.has(Break::seams);
      tip.vertex[c] = again ? tip.vertex[0] : surface_.vertex(point, end.along);
    }
    add_band(surface_, loop, tip);
    add_tip_truth(surface_.position(tip.vertex[0]), truth_ring);
  }
}

// The parent's columns that a branch opens: those that face it.
std::size_t TubeBuilder::opening_column(std::size_t ring, std::uint32_t child, std::size_t count) const {
  const Stem& branch = skeleton_.stems[child];
  const Double3 d = stem_position(branch, std::max(branch.exit, 0.05)) - stem_position(branch, 0);
  const StemPoint& p = points_[ring];
  const double angle = std::atan2(dot(d, p.up), dot(d, p.side)) - phase_ - turned_;
  const double k = own().k;
  const double column = std::round(angle / (2 * std::numbers::pi) * k - static_cast<double>(count) / 2);
  return static_cast<std::size_t>(column - std::floor(column / k) * k) % own().k;
}

// A branch's loop gets texture coordinates of its own, and a twin where the branch's seam will be.
void TubeBuilder::finish_base(Loop& base) {
  const std::size_t k = base.vertex.size();
  const double width = breaks_.has(Break::one_material) ? 0.5 : 1;
  base.vertex.push_back(breaks_.has(Break::seams) ? twin(base.vertex[0]) : base.vertex[0]);
  for (std::size_t c = 0; c <= k; ++c)
    base.texcoord.push_back(surface_.texcoord(width * static_cast<double>(c) / static_cast<double>(k), -0.2));
}

// Welded fork: an arc of the ring and a saddle over it are the branch's loop; the stem goes on from the rest
// of the ring and the saddle, which it returns.
Loop TubeBuilder::open_saddle(std::size_t ring, const Loop& loop, std::uint32_t child) {
  const std::size_t k = own().k, count = layout_.stems[child].k / 2;
  const std::size_t first = opening_column(ring, child, count);
  const StemPoint& p = points_[ring];
  const double thick = std::min(1.0, skeleton_.stems[child].radius / p.radius);
  const double room = ring + 1 < points_.size() ? distance(points_[ring + 1].centre, p.centre) : p.radius;
  const double rise = std::min(1.6 * thick * p.radius, 0.5 * room);
  const auto at = [&](std::size_t c) {
    return surface_.placement().undo(surface_.position(loop.vertex[c % k]));
  };
  Loop rest = loop, base;
  for (std::size_t c = 0; c <= count; ++c) base.vertex.push_back(loop.vertex[(first + c) % k]);
  for (std::size_t c = 1; c < count; ++c) {
    const double f = static_cast<double>(c) / static_cast<double>(count);
    const Double3 arc = at(first + c), chord = at(first) * (1 - f) + at(first + count) * f;
    const Double3 saddle =
        arc + (chord - arc) * (0.7 * thick) + p.along * (rise * std::sin(std::numbers::pi * f));
    const std::size_t column = (first + c) % k;
    const Double3 normal = normalized(p.along + normalized(arc - p.centre) * (1 - 0.7 * thick));
    rest.vertex[column] = surface_.vertex(saddle, normal);
    const Float2 uv = surface_.mesh().texcoords[loop.texcoord[column]];
    rest.texcoord[column] = surface_.texcoord(uv.x, uv.y + rise / tile_);
    if (column != 0) continue;
    rest.vertex[k] = breaks_.has(Break::seams) ? twin(rest.vertex[0]) : rest.vertex[0];
    const Float2 end = surface_.mesh().texcoords[loop.texcoord[k]];
    rest.texcoord[k] = surface_.texcoord(end.x, end.y + rise / tile_);
  }
  for (std::size_t c = count - 1; c > 0; --c) base.vertex.push_back(rest.vertex[(first + c) % k]);
  finish_base(base);
  bases_[child] = std::move(base);
  return rest;
}

// Extruded: the quads between two rings that face the branch are left out; their outline is its loop.
void TubeBuilder::band_with_patch(std::size_t ring, const Loop& lower, const Loop& upper,
                                  std::uint32_t child) {
  const std::size_t k = own().k, count = layout_.stems[child].k / 2 - 1;
  const std::size_t first = opening_column(ring, child, count);
  Loop base;
  for (std::size_t c = 0; c <= count; ++c) base.vertex.push_back(lower.vertex[(first + c) % k]);
  for (std::size_t c = count + 1; c-- > 0;) base.vertex.push_back(upper.vertex[(first + c) % k]);
  finish_base(base);
  bases_[child] = std::move(base);
  add_band(surface_, lower, upper, first, count);
}

// What the first band of a branch starts from.
Loop TubeBuilder::base_loop() const {
  if (opens()) return bases_[current_];
  const StemLayout& parent = layout_.stems[stem().parent];
  const std::size_t ring = parent.first + own().join;
  return loop_of(loops_[ring], parent.k);
}

// A smaller copy of a face in its middle, with the frame that is left of the face.
Loop TubeBuilder::inset(const Loop& base) {
  std::vector<Double3> corners;
  Double3 middle;
  for (std::size_t c = 0; c < base.columns(); ++c) {
    corners.push_back(surface_.placement().undo(surface_.position(base.vertex[c])));
    middle += corners[c] / static_cast<double>(base.columns());
  }
  const Double3 out = normalized(cross(corners[1] - corners[0], corners[2] - corners[0]));
  Loop ring;
  for (const Double3& p : corners)
    ring.vertex.push_back(surface_.vertex(middle + (p - middle) * k_inset, out));
  finish_base(ring);
  add_band(surface_, base, ring);
  return ring;
}

// The two rings of the parent that a free tube's first ring lies between, and the nearer of them.
std::uint32_t TubeBuilder::attach_free(TruthBranch& branch) const {
  const StemLayout& parent = layout_.stems[stem().parent];
  const Double3 p = points_[0].centre;
  double best = std::numeric_limits<double>::infinity();
  std::size_t lower = 0;
  for (std::size_t r = 0; r + 1 < parent.count; ++r) {
    const Double3 a = tubes_.centres[parent.first + r], ab = tubes_.centres[parent.first + r + 1] - a;
    const double t = std::clamp(dot(p - a, ab) / std::max(dot(ab, ab), 1e-300), 0.0, 1.0);
    const double d = distance(p, a + ab * t);
    // Where it leaves from a ring itself, what lies above that ring.
    if (d <= best + 1e-9 * skeleton_.height) best = std::min(best, d), lower = r;
  }
  const std::size_t a = parent.first + lower;
  branch.attach[0] = truth_ring_[a];
  branch.attach[1] = truth_ring_[a + 1];
  return distance(p, tubes_.centres[a + 1]) < distance(p, tubes_.centres[a]) ? branch.attach[1]
                                                                             : branch.attach[0];
}

// The parent of a stem's first ring.
std::uint32_t TubeBuilder::attach(TruthBranch& branch) {
  if (stem().kind == StemKind::root) return k_none;
  truth_.branches[stem().parent].terminal = false;
  branch.parent = stem().parent;
  if (free()) return attach_free(branch);
  const std::size_t ring = layout_.stems[stem().parent].first + own().join;
  branch.attach[0] = branch.attach[1] = truth_ring_[ring];
  if (breaks_.pulls_out()) branch.attach[1] = truth_ring_[ring + 1];
  return branch.attach[0];
}

Loop TubeBuilder::build_start(std::uint32_t& truth_ring) {
  TruthBranch branch;
  branch.level = stem().level;
  branch.first = static_cast<std::uint32_t>(truth_.rings.size());
  branch.k = own().k;
  const std::uint32_t parent = attach(branch);
  truth_.branches.push_back(branch);
  if (parent == k_none || free()) {
    phase_ = own().k == 2 ? 0 : stem().random.fork(k_phase_key).uniform(0, 2 * std::numbers::pi);
    Loop loop = add_ring(0);
    close_start(loop);
    truth_ring = add_truth(loop, parent);
    return loop;
  }
  Loop base = base_loop();
  if (breaks_.has(Break::inset_faces)) {
    base = inset(base);
    truth_ring = add_truth(base, parent);
  }
  phase_ = best_phase(surface_, base, points_[0].centre, points_[0].side, points_[0].up);
  Loop loop = add_ring(0);
  if (base.columns() == loop.columns()) {
    add_band(surface_, base, loop);
  } else {
    add_zipper(surface_, base, loop);
  }
  truth_ring = add_truth(loop, breaks_.has(Break::inset_faces) ? truth_ring : parent);
  return loop;
}

void TubeBuilder::build_stem() {
  place_points();
  for (std::size_t r = 0; r < own().count; ++r) {
    tubes_.centres[global(r)] = points_[r].centre;
    tubes_.radii[global(r)] = points_[r].radius;
  }
  loose_ = stem().random.fork(k_loose_key);
  turned_ = 0;
  std::uint32_t truth_ring = k_none;
  Loop below = build_start(truth_ring);
  const auto note = [&](std::size_t r, const Loop& loop) {
    loops_[global(r)] = {loop.vertex[0], loop.vertex.back(), loop.texcoord[0]};
    tubes_.first_vertex[global(r)] = loop.vertex[0];
    truth_ring_[global(r)] = truth_ring;
  };
  note(0, below);
  for (std::size_t r = 1; r < own().count; ++r) {
    add_v(r);
    const std::uint32_t opener = opener_[global(r - 1)];
    if (opener != k_none && breaks_.has(Break::welded_forks)) below = open_saddle(r - 1, below, opener);
    Loop loop = add_ring(r);
    truth_ring = add_truth(loop, truth_ring);
    if (opener != k_none && breaks_.pulls_out()) {
      band_with_patch(r - 1, below, loop, opener);
    } else {
      add_band(surface_, below, loop);
    }
    note(r, loop);
    below = cut_after(r) ? add_copy(loop, r, truth_ring) : std::move(loop);
  }
  close_tip(below, truth_ring);
  TruthBranch& branch = truth_.branches.back();
  branch.rings = static_cast<std::uint32_t>(truth_.rings.size()) - branch.first;
}

Tubes TubeBuilder::run() {
  const std::size_t rings = layout_.rings.size(), stems = skeleton_.stems.size();
  tubes_.centres.resize(rings);
  tubes_.radii.resize(rings);
  tubes_.first_vertex.resize(rings);
  tubes_.shift.resize(stems);
  truth_ring_.resize(rings);
  loops_.resize(rings);
  bases_.resize(opens() ? stems : 0);
  opener_.assign(rings, k_none);
  for (std::uint32_t s = 0; opens() && s < stems; ++s)
    if (skeleton_.stems[s].kind != StemKind::root)
      opener_[layout_.stems[skeleton_.stems[s].parent].first + layout_.stems[s].join] = s;
  for (current_ = 0; current_ < stems; ++current_) build_stem();
  return std::move(tubes_);
}

}  // namespace

Tubes build_tubes(const Species& species, const Skeleton& skeleton, const Layout& layout,
                  const Breaks& breaks, Surface& surface, Truth& truth) {
  return TubeBuilder(species, skeleton, layout, breaks, surface, truth).run();
}

TubePlace tube_place(const Layout& layout, const Tubes& tubes, std::size_t stem, double t) {
  const auto rings = layout.rings_of(stem);
  const auto last = static_cast<std::ptrdiff_t>(rings.size()) - 1;
  const auto above =
      std::clamp<std::ptrdiff_t>(std::lower_bound(rings.begin(), rings.end(), t) - rings.begin(), 1, last);
  const auto i = static_cast<std::size_t>(above);
  const double u = std::clamp((t - rings[i - 1]) / (rings[i] - rings[i - 1]), 0.0, 1.0);
  const std::size_t b = layout.stems[stem].first + i, a = b - 1;
  return {tubes.centres[a] * (1 - u) + tubes.centres[b] * u, normalized(tubes.centres[b] - tubes.centres[a]),
          tubes.radii[a] * (1 - u) + tubes.radii[b] * u};
}

}  // namespace copse::grow
