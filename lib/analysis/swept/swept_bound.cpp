#include "lib/analysis/swept/swept_bound.h"

#include "lib/analysis/swept/force_plane.h"
#include "lib/analysis/swept/length_polytope.h"

#include <algorithm>
#include <limits>
#include <queue>

namespace copse {
namespace {

constexpr double k_infinity = std::numeric_limits<double>::infinity();
constexpr double k_cube_half = 0.41421357;  // tan(pi / 8), rounded up
constexpr std::size_t k_most_working = 32;
constexpr int k_most_rounds = 24;          // of separating in one cell
constexpr double k_sticks_out = 1e-3;      // of the radius: a point that a separation has missed
constexpr double k_least_progress = 0.15;  // of what a cell's bound lacks; less, and it is halved
constexpr int k_search_depth = 9;          // cells no deeper than this try a descent
constexpr double k_moves_far = 0.1;        // of the farthest: a coordinate that may be halved
constexpr double k_swings_far = 0.1;       // the same, of a needle
constexpr double k_promising = 1.05;       // volume after a rough descent, to the best: worth an exact one

struct Cell {
  double bound = 0;
  std::size_t id = 0;
  int depth = 0;
  RotationCell rotations;
  std::vector<std::uint32_t> planes;   // of the pool
  std::vector<std::uint32_t> working;  // points
};

struct Later {  // least bound first, then the oldest
  bool operator()(const Cell& a, const Cell& b) const {
    return a.bound != b.bound ? a.bound > b.bound : a.id > b.id;
  }
};

class BranchAndBound {
 public:
  BranchAndBound(Swept kind, std::span<const Double3> points, const SweptBoundOptions& options,
                 SweptFit& best)
      : kind_(kind), points_(points), options_(options), best_(best), volume_(best.volume()) {
    for (const Double3& p : points) reach_ = std::max(reach_, length(p));
    if (kind == Swept::lozenge) look_for_needle();
  }
  SweptBound run();

 private:
  void plant();
  void look_for_needle();
  void push(Cell cell);
  void process(Cell cell);
  Double3 swings_of(const Cell& cell) const;
  int axis_to_halve(const Cell& cell) const;
  void halve(const Cell& cell, const LengthPolytope& polytope);
  bool outside(const RotationCell& cell) const;
  LengthPolytope polytope_of(const Cell& cell) const;
  double least_lean(const Cell& cell, int side) const;
  void cut(LengthPolytope& polytope, std::uint32_t plane, const RotationCell& cell) const;
  void separate_from(const Cell& cell, const Axes& frame, const SweptLengths& lengths,
                     SeparationState& state);
  bool add_missed(const Axes& frame, const SeparationState& state, std::vector<std::uint32_t>& working) const;
  void search(const Cell& cell, const Axes& start);
  bool spent() const;
  // Of every polytope, before the planes.
  int own_cuts() const { return (options_.least_radius > 0 ? 1 : 0) + (is_needle() ? 2 : 0); }
  bool is_needle() const { return needle_ != Double3{}; }
  double target() const { return volume_ / (1 + options_.gap); }

  Swept kind_;
  std::span<const Double3> points_;
  SweptBoundOptions options_;
  SweptFit& best_;
  double volume_, reach_ = 0;
  Double3 needle_;              // between two points far apart, of thin points round a lozenge; else 0
  double closed_ = k_infinity;  // the least bound of the cells that are done with
  std::vector<ForcePlane> pool_;
  std::priority_queue<Cell, std::vector<Cell>, Later> open_;
  std::size_t cells_ = 0, separations_ = 0;
};

// The cells at the root: rotations R(g) F. A capsule's turns about its own axis are left out; its directions
// and their opposites are one. A lozenge's frames are those of the cube's rotation group modulo the
// rectangle's: the same cube of g about each choice of the axis across.
void BranchAndBound::plant() {
  const bool capsule = kind_ == Swept::capsule;
  const double half = capsule ? 1 : k_cube_half, offset = half / 3;
  // The best frame comes to lie a third off the centre, never on the border of a cell; of a needle on the
  // line of frames that turn about it, so that cells as thin as it can hold all of them.
  const Double3 turn{capsule ? 0 : offset, offset, -offset};
  const Axes base = orthonormal(turned(best_.frame, is_needle() ? Double3{} : turn));
  for (int k = 0; k < (capsule ? 1 : 3); ++k) {
    Cell cell;
    cell.rotations.frame = {base[k], base[(k + 1) % 3], base[(k + 2) % 3]};
    cell.rotations.low = {capsule ? 0 : -half, -half, -half};
    cell.rotations.high = -cell.rotations.low * (is_needle() ? 2 : 1);
    if (capsule) cell.rotations.low.x = cell.rotations.high.x = 0;
    cell.working = extreme_points(points_, cell.rotations.frame);
    push(std::move(cell));
  }
}

// Whether every rotation of the cell is also in another cell.
bool BranchAndBound::outside(const RotationCell& cell) const {
  double square = 0, sum = 0;
  for (int k = 0; k < 3; ++k) {
    const double nearest = std::abs(std::clamp(0.0, cell.low[k], cell.high[k]));
    square += nearest * nearest, sum += nearest;
  }
  return kind_ == Swept::capsule ? square > 1 + 1e-9 : sum > 1 + 1e-9;
}

void BranchAndBound::cut(LengthPolytope& polytope, std::uint32_t plane, const RotationCell& cell) const {
  const ForcePlane& p = pool_[plane];
  polytope.cut(p.alpha, p.beta, p.gamma, range_over(p, cell).least);
}

LengthPolytope BranchAndBound::polytope_of(const Cell& cell) const {
  // A rectangle need not be longer than the points reach, nor a ball larger than the best volume.
  const double r = std::cbrt(volume_ * 3 / (4 * std::numbers::pi)) * (1 + 1e-12);
  const double length = 2 * reach_ * (1 + 1e-12);
  LengthPolytope polytope(kind_, {length, length, r});
  if (options_.least_radius > 0) polytope.cut(0, 0, 1, options_.least_radius);
  if (is_needle()) {
    polytope.cut(1, 0, 2, least_lean(cell, 1));
    polytope.cut(0, 1, 2, least_lean(cell, 0));
  }
  for (const std::uint32_t plane : cell.planes) cut(polytope, plane, cell.rotations);
  return polytope;
}

// Two points far apart, when the others are near the line through them.
void BranchAndBound::look_for_needle() {
  constexpr double k_thin = 0.003;
  DoubleBox box;
  for (const Double3& p : points_) box.grow(into(best_.frame, p));
  const Double3 e = box.extent();
  const int along = e.x >= e.y && e.x >= e.z ? 0 : e.y >= e.z ? 1 : 2;
  if (std::max(e[(along + 1) % 3], e[(along + 2) % 3]) > k_thin * e[along]) return;
  const auto less = [&](const Double3& p, const Double3& q) {
    return dot(p, best_.frame[along]) < dot(q, best_.frame[along]);
  };
  const auto [low, high] = std::minmax_element(points_.begin(), points_.end(), less);
  needle_ = *high - *low;
}

// How far the needle reaches across one side of the rectangle, at least, in the frames of the cell: across it
// a lozenge is as wide as its other side and twice the radius. Forces at the needle's ends would tell the
// same, but only once the cell is so small that they know the way that it leans.
double BranchAndBound::least_lean(const Cell& cell, int side) const {
  constexpr double k_rounding = 1e-14;
  const double size = length(needle_);
  double along = 0;
  for (const double sign : {-1.0, 1.0}) {
    ForcePlane plane;
    plane.moment[side] = needle_ * (sign / size);
    along = std::max(along, -range_over(plane, cell.rotations).least);
  }
  return size * std::sqrt(std::max(0.0, (1 - along) * (1 + along) - k_rounding));
}

void BranchAndBound::push(Cell cell) {
  if (outside(cell.rotations)) return;
  cell.bound = std::max(cell.bound, polytope_of(cell).least_volume());
  if (cell.bound >= target()) {
    closed_ = std::min(closed_, cell.bound);
    return;
  }
  cell.id = cells_++;
  open_.push(std::move(cell));
}

void BranchAndBound::separate_from(const Cell& cell, const Axes& frame, const SweptLengths& lengths,
                                   SeparationState& state) {
  std::vector<Double3> local;
  DoubleBox box;
  for (const std::uint32_t i : cell.working) local.push_back(into(frame, points_[i])), box.grow(local.back());
  const Double3 size = box.extent();
  const double r = best_.rectangle.r;
  Separation problem;
  problem.from = lengths;
  problem.along = {size.x / 2 + r, kind_ == Swept::lozenge ? size.y / 2 + r : 0, r};
  // g = (h + c + h x c) / (1 - h.c) for a turn h from the cell's centre c, to first order in h.
  const Double3 c = cell.rotations.centre();
  problem.half = (cell.rotations.high - cell.rotations.low) * 0.5;
  for (int k = 0; k < 3; ++k) {
    Double3 unit;
    unit[k] = 1;
    problem.rows[k] = unit - cross(unit, c) + c * c[k];
  }
  const Double3 middle = box.centre();
  const auto holds = [&](double s) {
    const double a = (lengths.a + s * problem.along.a) / 2, b = (lengths.b + s * problem.along.b) / 2;
    const SweptRectangle rectangle{middle.x - a, middle.x + a, middle.y - b,
                                   middle.y + b, middle.z,     lengths.r + s * problem.along.r};
    return std::all_of(local.begin(), local.end(), [&](const Double3& q) {
      const Double3 e = offset_from(rectangle, q);
      return dot(e, e) < rectangle.r * rectangle.r;
    });
  };
  state.s = 1.0 / 16;
  while (!holds(state.s) && state.s < 1e30) state.s *= 2;
  state.s *= 1.25;
  ++separations_;
  separate(kind_, local, problem, {std::min(1.0, state.s), std::clamp(options_.gap / 20, 1e-7, 2e-3)}, state);
}

bool BranchAndBound::add_missed(const Axes& frame, const SeparationState& state,
                                std::vector<std::uint32_t>& working) const {
  const double limit = state.rectangle.r * (1 + k_sticks_out);
  std::array<std::pair<double, std::uint32_t>, 4> worst;  // a quadrant of the rectangle each
  worst.fill({limit * limit, 0});
  bool found = false;
  const double mid_a = (state.rectangle.a0 + state.rectangle.a1) / 2;
  const double mid_b = (state.rectangle.b0 + state.rectangle.b1) / 2;
  for (std::uint32_t i = 0; i < points_.size(); ++i) {
    const Double3 q = linearly_turned(into(frame, points_[i]), state.turn);
    const Double3 e = offset_from(state.rectangle, q);
    auto& w = worst[(q.x > mid_a) | ((kind_ == Swept::lozenge ? q.y > mid_b : q.z > state.rectangle.h) << 1)];
    if (dot(e, e) > w.first) w = {dot(e, e), i}, found = true;
  }
  for (const auto& [square, i] : worst) {
    if (square > limit * limit) working.push_back(i);
  }
  return found;
}

void BranchAndBound::search(const Cell& cell, const Axes& start) {
  if (cell.depth > k_search_depth) return;
  if (descend_around(kind_, points_, start, {0.05, 2}).volume() > k_promising * volume_) return;
  const SweptFit fit = descend_around(kind_, points_, start);
  if (fit.volume() < volume_) best_ = fit, volume_ = fit.volume();
}

void BranchAndBound::process(Cell cell) {
  LengthPolytope polytope = polytope_of(cell);
  const Axes frame = orthonormal(turned(cell.rotations.frame, cell.rotations.centre()));
  for (int round = 0; round < k_most_rounds && !spent(); ++round) {
    cell.bound = std::max(cell.bound, polytope.least_volume());
    if (cell.bound >= target()) {
      closed_ = std::min(closed_, cell.bound);
      return;
    }
    const SweptLengths least = polytope.least();
    SeparationState state;
    separate_from(cell, frame, least, state);
    pool_.push_back(force_plane(points_, cell.working, state.forces));
    const auto plane = static_cast<std::uint32_t>(pool_.size() - 1);
    cell.planes.push_back(plane);
    cut(polytope, plane, cell.rotations);
    const double lacking = target() - cell.bound, progress = polytope.least_volume() - cell.bound;
    std::vector<std::uint32_t> missed;
    if (add_missed(frame, state, missed)) {
      // Forces that press are kept, the others make room.
      if (cell.working.size() + missed.size() > k_most_working) {
        std::vector<std::uint32_t> pressing;
        for (std::size_t i = 0; i < cell.working.size(); ++i) {
          if (length(state.forces[i]) > 1e-3) pressing.push_back(cell.working[i]);
        }
        cell.working = pressing;
      }
      cell.working.insert(cell.working.end(), missed.begin(), missed.end());
      continue;
    }
    if (swept_volume(state.rectangle.lengths()) < target()) {
      search(cell, turned(frame, state.turn));
      break;
    }
    if (progress < k_least_progress * lacking) break;
  }
  cell.bound = std::max(cell.bound, polytope.least_volume());
  if (cell.bound >= target()) {
    closed_ = std::min(closed_, cell.bound);
    return;
  }
  if (spent()) return open_.push(std::move(cell));
  halve(cell, polytope);
}

// How far each coordinate of the cell turns the points about an axis at the root of the cells: turns about a
// needle are as short as it is thin.
Double3 BranchAndBound::swings_of(const Cell& cell) const {
  constexpr double k_wide = 0.15;  // so wide that the polynomials of a cell tell little
  DoubleBox box;
  for (const std::uint32_t i : cell.working) box.grow(into(cell.rotations.frame, points_[i]));
  const Double3 e = box.extent(), half = (cell.rotations.high - cell.rotations.low) * 0.5;
  const double longest = std::max({e.x, e.y, e.z});
  const auto swing = [&](int k) {
    const double reach = half[k] > k_wide ? longest : std::max(e[(k + 1) % 3], e[(k + 2) % 3]);
    return half[k] * reach;
  };
  return {swing(0), swing(1), swing(2)};
}

// The coordinate to halve: that over which the newest plane falls most, of those over which a turn moves the
// points far: by what is of second order, which is what a separation misses, each way measured by what the
// volume has there. (The plane alone would never choose a turn that is so free that no force resists it; the
// motion alone does not know which turns matter.)
int BranchAndBound::axis_to_halve(const Cell& cell) const {
  const Axes frame = turned(cell.rotations.frame, cell.rotations.centre());
  DoubleBox box;
  for (const std::uint32_t i : cell.working) box.grow(into(frame, points_[i]));
  const Double3 e = box.extent(), half = (cell.rotations.high - cell.rotations.low) * 0.5;
  const double r = best_.rectangle.r;
  const Double3 moves{half.x * half.x * (e.y / r + e.z / (e.y + r)),
                      half.y * half.y * (e.x / r + e.z / (e.x + r)),
                      half.z * half.z * (e.x / (kind_ == Swept::capsule ? r : e.y + r) + e.y / (e.x + r))};
  const Double3 drop = range_over(pool_[cell.planes.back()], cell.rotations).drop;
  const Double3 swings = is_needle() ? swings_of(cell) : Double3{};
  const double widest = std::max({swings.x, swings.y, swings.z});
  const auto may = [&](int k) { return swings[k] >= widest * k_swings_far; };
  double most = 0;
  for (int k = 0; k < 3; ++k) {
    if (may(k)) most = std::max(most, moves[k]);
  }
  int axis = -1;
  for (int k = 0; k < 3; ++k) {
    if (may(k) && moves[k] >= most * k_moves_far && (axis < 0 || drop[k] > drop[axis])) axis = k;
  }
  return axis;
}

void BranchAndBound::halve(const Cell& cell, const LengthPolytope& polytope) {
  Cell child = cell;
  child.depth++;
  child.planes.clear();
  for (std::size_t i = 0; i < cell.planes.size(); ++i) {
    if (polytope.supports(static_cast<int>(i) + own_cuts())) child.planes.push_back(cell.planes[i]);
  }
  const int axis = axis_to_halve(cell);
  const double middle = cell.rotations.centre()[axis];
  Cell other = child;
  child.rotations.high[axis] = middle, other.rotations.low[axis] = middle;
  push(std::move(child)), push(std::move(other));
}

bool BranchAndBound::spent() const {
  return separations_ >= options_.max_separations || options_.deadline.has_passed();
}

SweptBound BranchAndBound::run() {
  plant();
  while (!open_.empty() && !spent() && open_.top().bound < target()) {
    Cell cell = open_.top();
    open_.pop();
    process(std::move(cell));
  }
  const double open = open_.empty() ? k_infinity : open_.top().bound;
  return {std::min({open, closed_, volume_}), separations_, cells_};
}

}  // namespace

SweptBound bound_swept(Swept kind, std::span<const Double3> points, const SweptBoundOptions& options,
                       SweptFit& best) {
  return BranchAndBound(kind, points, options, best).run();
}

}  // namespace copse
