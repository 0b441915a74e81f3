#include "lib/analysis/lod/leaf_shape.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

namespace copse {
namespace {

struct Point {
  double x, y;
};

// Of unit area, centred, with the same second moments along both axes.
constexpr double k_t = 0.8773826753016615;  // radius of an equilateral triangle of area 1
constexpr std::array<Point, 3> k_triangle{
    {{k_t, 0}, {-k_t / 2, 0.7598356856515924}, {-k_t / 2, -0.7598356856515924}}};
constexpr int k_rounds = 6;      // of the search: more gain a thousandth of the picture
constexpr double k_good = 0.04;  // of a cost: there is nothing to gain below it

constexpr std::array<Point, 4> k_square{{{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}};

struct Frame {
  Double3 u, v, n;
};

struct Candidate {
  Frame frame;
  double stretch = 1;  // length over width
  Double3 centre;
  double cost = std::numeric_limits<double>::infinity();
};

Frame turned(const Frame& f, int quarter) {
  switch (quarter) {
    case 1:
      return {f.v, -f.u, f.n};
    case 2:
      return {-f.u, -f.v, f.n};
    case 3:
      return {-f.v, f.u, f.n};
    default:
      return f;
  }
}

// The axes of the spread within the plane across n.
Frame in_plane(const Symmetric3& spread, const Double3& n) {
  const Double3 any = std::abs(n.x) < 0.6 ? Double3{1, 0, 0} : Double3{0, 1, 0};
  const Double3 p = normalized(cross(n, any)), q = cross(n, p);
  const double pp = spread.along(p), qq = spread.along(q);
  const double pq = (spread.along(p + q) - pp - qq) / 2;
  const double angle = 0.5 * std::atan2(2 * pq, pp - qq), c = std::cos(angle), s = std::sin(angle);
  const Double3 u = p * c + q * s;
  return {u, cross(n, u), n};
}

class Chooser {
 public:
  Chooser(const Patch& patch, const CrownField* field, const Double3& offset, const ShapeOptions& options)
      : patch_(patch),
        field_(field),
        near_(field),
        offset_(offset),
        options_(options),
        centre_(patch.centre()),
        spread_(patch.covariance()),
        cut_(options.card ? std::span<const Point>(k_square) : k_triangle) {}

  LeafShape choose() {
    const Eigen3 spread = eigen(spread_), facing = eigen(patch_.facing);
    size_ = std::sqrt(options_.largest > 0 ? std::min(patch_.area, options_.largest) : patch_.area);
    if (field_ != nullptr && size_ < field_->cell()) near_ = nullptr;
    if (field_ != nullptr) per_reach_ = 1 / (k_reach * k_reach * field_->cross_section());
    seen_ = patch_.opaque > 0 ? patch_.visible / patch_.opaque : 1;
    try_plane(facing.vectors[0]);
    try_plane(spread.vectors[2]);
    if (near_ != nullptr && options_.search && best_.cost > k_good && size_ > 2 * field_->cell()) {
      try_plane(facing.vectors[1]);
      try_plane(spread.vectors[0]), try_plane(spread.vectors[1]);
      search();
    }
    return finish();
  }

 private:
  static constexpr double k_reach =
      0.3;  // of the crown's size: a leaf that reaches so far out is wrong, however large
  static constexpr double k_margin = 0.018;  // of the crown's width, out of its hull
  void try_plane(const Double3& n) {
    Candidate c;
    c.centre = centre_;
    const Frame frame = in_plane(spread_, n);
    const double along = spread_.along(frame.u), across = spread_.along(frame.v);
    const double natural = across > 0 ? std::sqrt(along / across) : options_.slimmest;
    c.stretch = std::clamp(natural, 1.0, options_.slimmest);
    const int turns = options_.card || options_.textured ? 1 : 4;
    for (int q = 0; q < turns; ++q) {
      c.frame = turned(frame, q);
      const double kept = c.stretch;
      if (q % 2 == 1) c.stretch = 1 / kept;
      consider(c);
      c.stretch = kept;
    }
  }

  void consider(Candidate c) {
    c.cost = cost(c);
    if (c.cost < best_.cost) best_ = c;
  }

  // Compass search: moves, turns and stretches by steps that halve while nothing is gained.
  void search() {
    double step = 1;
    for (int round = 0; round < k_rounds && step > 0.1; ++round) {
      const double before = best_.cost;
      for (int way = 0; way < 14; ++way) consider(varied(best_, way / 2, way % 2 ? -step : step));
      if (best_.cost > 0.98 * before) step /= 2;
      if (best_.cost < k_good) return;
    }
  }

  Candidate varied(Candidate c, int what, double step) const {
    Frame& f = c.frame;
    const auto turn = [&](Double3& a, Double3& b) {
      const double cosine = std::cos(0.6 * step), sine = std::sin(0.6 * step);
      const Double3 old = a;
      a = old * cosine + b * sine, b = b * cosine - old * sine;
    };
    switch (what) {
      case 0:
        turn(f.u, f.v);
        break;
      case 1:
        turn(f.v, f.n);
        break;
      case 2:
        turn(f.n, f.u);
        break;
      case 3:
        c.stretch = std::clamp(c.stretch * std::exp(0.6 * step), 1 / options_.slimmest, options_.slimmest);
        break;
      default:
        c.centre[what - 4] += 0.4 * step * size_;
    }
    return c;
  }

  Double3 at(const Candidate& c, const Point& p) const {
    const double size = size_, length = std::sqrt(c.stretch);
    return c.centre + c.frame.u * (p.x * size * length) + c.frame.v * (p.y * size / length);
  }

  double cost(const Candidate& c) const {
    const Double3 moved = c.centre - centre_;
    const double area = size_ * size_;
    if (!(area > 0)) return 0;
    const double faces = patch_.facing.along(c.frame.n) / patch_.area;
    // Inside, where no one sees it, it may lie anywhere and any way.
    double cost = seen_ * (options_.moving * dot(moved, moved) / area + options_.turning * (1 - faces));
    if (near_ == nullptr) return cost;
    // Corners and the middles of edges reach farthest; the points between them and the centre stand for the
    // rest.
    double empty = 0, open = 0;
    const auto n = static_cast<double>(cut_.size());
    for (std::size_t i = 0; i < cut_.size(); ++i) {
      const Point &p = cut_[i], &q = cut_[(i + 1) % cut_.size()];
      const Point m{(p.x + q.x) / 2, (p.y + q.y) / 2};
      const Double3 corner = at(c, p) + offset_, middle = at(c, m) + offset_;
      const auto outer = near_->at(corner), edge = near_->at(middle);
      const auto inner = near_->at(at(c, {0.5 * p.x, 0.5 * p.y}) + offset_);
      empty += double(outer.emptiness) * outer.emptiness + double(edge.emptiness) * edge.emptiness;
      open += outer.openness + 2 * edge.openness + 3 * inner.openness;
    }
    const double more = open / (6 * n) - patch_.open / patch_.area;
    return cost + options_.openness * more * more +
           options_.emptiness * empty / (2 * n) * (1 / area + per_reach_);
  }

  LeafShape finish() {
    LeafShape out;
    if (options_.textured) align_with_texture();
    for (std::size_t i = 0; i < cut_.size(); ++i) out.corners[i] = at(best_, cut_[i]) + offset_;
    if (field_ != nullptr) stay_in_hull(out);
    if (!options_.card) out.corners[3] = out.corners[0];
    out.normal = best_.frame.n;
    // A flat set's spread across its plane is 0 up to rounding, which may be below it.
    const double across = std::max(spread_.along(best_.frame.n), 0.0);
    out.displacement = std::sqrt(std::max(best_.cost, 0.0) * size_ * size_ + across);
    return out;
  }

  void stay_in_hull(LeafShape& shape) const {
    bool out = false;
    for (std::size_t i = 0; i < cut_.size(); ++i) out = out || field_->at(shape.corners[i]).emptiness > 0;
    if (!out && size_ < 4 * field_->cell()) return;
    const auto corners = std::span(shape.corners).first(cut_.size());
    const Double3 back = field_->hull().way_back(corners, k_margin * field_->hull().width());
    for (Double3& c : corners) c += back;
  }

  // From corner 0 of a card to corner 3 its texture grows; the first corner of a triangle is the lowest of
  // its texture. Of the quarter turns the one that is nearest to that.
  void align_with_texture() {
    const auto along = [&](int q) {
      const Frame f = turned(best_.frame, q);
      return dot(options_.card ? f.v : -f.u, patch_.up);
    };
    int nearest = 0;
    for (int q = 1; q < 4; ++q)
      if (along(q) > along(nearest)) nearest = q;
    best_.frame = turned(best_.frame, nearest);
    if (nearest % 2 == 1) best_.stretch = 1 / best_.stretch;
  }

  const Patch& patch_;
  const CrownField* field_;
  const CrownField* near_;  // null for a leaf within one cell: the field cannot tell its candidates apart
  Double3 offset_;
  ShapeOptions options_;
  Double3 centre_;
  Symmetric3 spread_;
  std::span<const Point> cut_;
  double seen_ = 1, size_ = 1, per_reach_ = 0;
  Candidate best_;
};

}  // namespace

LeafShape leaf_shape(const Patch& patch, const CrownField* field, const Double3& offset,
                     const ShapeOptions& options) {
  return Chooser(patch, field, offset, options).choose();
}

}  // namespace copse
