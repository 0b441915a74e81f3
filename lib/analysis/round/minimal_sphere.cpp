#include "lib/analysis/round/minimal_sphere.h"

#include <bit>
#include <limits>
#include <vector>

namespace copse {
namespace {

// A squared distance in double is off by at most 6 roundings of 2^-53: three differences (twice each, for
// they are squared), a product and two sums.
constexpr double k_squared_error = 8 * 0x1p-53;
// The farthest member counts as inside up to this much of the radius.
constexpr double k_inside = 1 + 2e-15;
// Steps that neither enlarge the ball nor bring the farthest member nearer, before rounding is taken to rule.
constexpr int k_idle_steps = 32;
constexpr double k_smallest_square = 1e-280;  // below it squares have lost digits to underflow

double squared(const Double3& a) {
  return dot(a, a);
}

// The point w nearest to the origin with w . a[i] = right[i] for i < n <= 3; false when the a[i] are
// dependent.
bool solve(const std::array<Double3, 3>& a, const std::array<double, 3>& right, int n, Double3& w) {
  const Double3 normal = cross(a[0], a[1]);
  if (n == 1) {
    w = a[0] * (right[0] / squared(a[0]));
  } else if (n == 2) {
    w = cross(a[1] * right[0] - a[0] * right[1], normal) / squared(normal);
  } else {
    w = (cross(a[1], a[2]) * right[0] + cross(a[2], a[0]) * right[1] + normal * right[2]) / dot(normal, a[2]);
  }
  return is_finite(w);
}

// The centre, relative to that of `p`, of a ball that p and n <= 3 others touch from inside.
bool touching_centre(const Sphere& p, const std::array<Sphere, 3>& others, int n, Double3& centre) {
  centre = {};
  if (n == 0) return true;
  // |c| = s and |c - a_i| = s + d_i, where s + p.radius is the radius sought: so a_i . c = e_i - s d_i.
  std::array<Double3, 3> a;
  std::array<double, 3> d{}, e{};
  bool points = true;
  for (int i = 0; i < n; ++i) {
    a[i] = others[i].centre - p.centre;
    d[i] = p.radius - others[i].radius;
    e[i] = (squared(a[i]) - d[i] * d[i]) / 2;
    points &= d[i] == 0;
  }
  Double3 u, v;
  if (!solve(a, e, n, u)) return false;
  if (points) {
    centre = u;
    return true;
  }
  if (!solve(a, d, n, v)) return false;
  // c = u - s v, |c| = s
  const double q = 1 - squared(v), half = dot(u, v);
  const double root = std::sqrt(half * half + q * squared(u));
  const double s = squared(u) / (half + root);
  centre = u - v * s;
  return is_finite(centre);
}

struct Frame {  // brings points near the origin and to a size of about 1; the scale is a power of two
  Double3 origin;
  double scale = 1;
  Double3 in(const Double3& p) const { return (p - origin) * scale; }
  Double3 out(const Double3& q) const { return q / scale + origin; }
};

struct Farthest {
  std::size_t member = 0;
  double distance = -1;
};

// --- points: squares are compared ------------------------------------------------------------------------

Farthest farthest_from(const Double3& centre, std::span<const Double3> points, const Frame& frame) {
  Farthest found;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double d = squared(frame.in(points[i]) - centre);
    if (d > found.distance) found = {i, d};
  }
  found.distance = std::sqrt(std::max(0.0, found.distance));
  return found;
}
// --- balls -----------------------------------------------------------------------------------------------

Sphere as_ball(const Sphere& b, const Frame& frame) {
  return {frame.in(b.centre), b.radius * frame.scale};
}
Farthest farthest_from(const Double3& centre, std::span<const Sphere> balls, const Frame& frame) {
  Farthest found;
  for (std::size_t i = 0; i < balls.size(); ++i) {
    const Sphere b = as_ball(balls[i], frame);
    const double d = std::sqrt(squared(b.centre - centre)) + b.radius;
    if (d > found.distance) found = {i, d};
  }
  return found;
}
void grow(DoubleBox& box, const Sphere& b) {
  const Double3 r{b.radius, b.radius, b.radius};
  box.grow(b.centre - r), box.grow(b.centre + r);
}

Frame frame_of(const DoubleBox& box) {
  // Halves first: the box of points near the largest double must not overflow.
  const Double3 half = box.max * 0.5 - box.min * 0.5;
  const double reach = std::max({half.x, half.y, half.z});
  Frame frame{box.min + half, 1};
  if (reach > 0) frame.scale = std::ldexp(1.0, std::clamp(-std::ilogb(reach), -1000, 1000));
  return frame;
}

Sphere minimal_sphere_of(std::span<const Sphere> members) {
  if (members.empty()) return {};
  DoubleBox box;
  for (const Sphere& m : members) grow(box, m);
  const Frame frame = frame_of(box);
  SupportBall ball;
  ball.include(as_ball(members[farthest_from({}, members, frame).member], frame));
  PivotLoop loop;
  for (;;) {
    const Farthest farthest = farthest_from(ball.centre(), members, frame);
    if (!loop.should_include(ball, farthest.distance)) break;
    ball.include(as_ball(members[farthest.member], frame));
  }
  Sphere sphere{frame.out(loop.best().centre), 0};
  // From the centre as it was rounded, not as it was found.
  const Frame about{sphere.centre, frame.scale};
  sphere.radius = farthest_from({}, members, about).distance / frame.scale;
  return sphere;
}

bool less(const Double3& a, const Double3& b) {
  return a.x != b.x ? a.x < b.x : a.y != b.y ? a.y < b.y : a.z < b.z;
}

// The loop over points. With c and r the support's ball and R the farthest point's distance from c, the
// minimal ball's centre is within sqrt(R^2 - r^2) of c, so points nearer than r less that are inside it and
// are left out of all later passes.
template <class InFrame>
class PointLoop {
 public:
  PointLoop(std::span<const Double3> points, const InFrame& frame) : points_(points), frame_(frame) {}

  Sphere run() {
    double farthest = pass({});
    ball.include({at_, 0});
    Double3 centre;
    for (;;) {
      // How far any point can be from the new centre bounds R before the pass that finds it.
      const double reach = farthest + distance(centre, ball.centre());
      const double shift = std::sqrt(std::max(0.0, reach * reach - ball.radius() * ball.radius()));
      centre = ball.centre();
      const double inside = ball.radius() - shift * (1 + 1e-9) - 1e-9 * reach;
      const bool narrows = inside > k_worth * ball.radius() && count() > 64;
      farthest = narrows ? pass_and_narrow(centre, inside) : pass(centre);
      if (!loop_.should_include(ball, farthest)) break;
      ball.include({at_, 0});
    }
    return loop_.best();
  }

  SupportBall ball;

 private:
  // Nearer to the surface than this, few points are left, and it pays to keep them apart.
  static constexpr double k_worth = 0.75;

  template <class Visit>
  void visit_all(Visit&& visit) const {
    if (narrowed_) {
      for (const Double3& q : kept_) visit(q);
    } else {
      for (const Double3& p : points_) visit(frame_.in(p));
    }
  }

  // The distance of the farthest point, which becomes at_; of equals the first in lexicographic order, so
  // that nothing depends on the order of the points.
  double pass(const Double3& centre) {
    double most = -1;
    Double3 at;
    visit_all([&](const Double3& q) {
      const double d = squared(q - centre);
      if (d >= most && (d > most || less(q, at))) most = d, at = q;
    });
    at_ = at;
    return std::sqrt(std::max(0.0, most));
  }

  // And keeps what is farther than `inside` for the passes to come, if that is not too much.
  double pass_and_narrow(const Double3& centre, double inside) {
    const std::size_t limit = count() / 4;
    const double threshold = inside * inside;
    found_.clear();
    found_.reserve(limit + 1);
    double most = -1;
    Double3 at;
    visit_all([&](const Double3& q) {
      const double d = squared(q - centre);
      if (!(d > threshold)) return;
      if (d >= most && (d > most || less(q, at))) most = d, at = q;
      if (found_.size() <= limit) found_.push_back(q);
    });
    if (most < 0) return pass(centre);
    at_ = at;
    if (found_.size() <= limit) kept_.swap(found_), narrowed_ = true;
    return std::sqrt(most);
  }

  std::size_t count() const { return narrowed_ ? kept_.size() : points_.size(); }

  std::span<const Double3> points_;
  InFrame frame_;
  PivotLoop loop_;
  std::vector<Double3> kept_, found_;
  bool narrowed_ = false;
  Double3 at_;
};

struct NoFrame {
  Double3 in(const Double3& p) const { return p; }
};

// As seen from the centre as it is rounded when it leaves the frame, not as it was found.
Sphere placed(const Sphere& ball, std::span<const Double3> points, const Frame& frame) {
  const Double3 centre = frame.out(ball.centre);
  return {centre, farthest_from({}, points, {centre, frame.scale}).distance / frame.scale};
}
Sphere placed(const Sphere& ball, std::span<const Double3>, const NoFrame&) {
  return ball;
}

// The first of the points at each place of the support.
template <class InFrame>
std::vector<std::uint32_t> indices_of(std::span<const Sphere> support, std::span<const Double3> points,
                                      const InFrame& in) {
  std::array<double, 4> x;
  for (std::size_t k = 0; k < x.size(); ++k) x[k] = support[std::min(k, support.size() - 1)].centre.x;
  std::vector<std::uint32_t> found;
  for (std::uint32_t i = 0; i < points.size() && found.size() < support.size(); ++i) {
    const Double3 q = in.in(points[i]);
    if (q.x != x[0] && q.x != x[1] && q.x != x[2] && q.x != x[3]) continue;
    const bool holds =
        std::any_of(support.begin(), support.end(), [&](const Sphere& s) { return s.centre == q; });
    const bool met =
        std::any_of(found.begin(), found.end(), [&](std::uint32_t k) { return in.in(points[k]) == q; });
    if (holds && !met) found.push_back(i);
  }
  return found;
}

template <class InFrame>
MinimalSphere minimal_in(std::span<const Double3> points, const InFrame& in, double scale) {
  PointLoop<InFrame> loop(points, in);
  MinimalSphere found;
  found.sphere = placed(loop.run(), points, in);
  found.lower_radius = loop.ball.radius() / scale;
  found.support = indices_of(loop.ball.support(), points, in);
  return found;
}

// Points that are of a size of about 1 already, as a cloud's are.
bool needs_no_frame(const Frame& frame) {
  return frame.scale >= 0x1p-2 && frame.scale <= 0x1p2 && length(frame.origin) <= 4;
}

}  // namespace

void SupportBall::include(const Sphere& b) {
  std::array<Sphere, 4> best_support;
  Sphere best{b.centre, std::numeric_limits<double>::infinity()};
  int best_size = 0;
  for (unsigned subset = 0; subset < (1u << size_); ++subset) {
    if (std::popcount(subset) > 3) continue;
    std::array<Sphere, 3> others;
    int n = 0;
    for (int i = 0; i < size_; ++i) {
      if (subset >> i & 1) others[n++] = support_[i];
    }
    Double3 offset;
    if (!touching_centre(b, others, n, offset)) continue;
    const Double3 centre = b.centre + offset;
    double farthest = distance(centre, b.centre) + b.radius;
    for (int i = 0; i < size_; ++i) {
      farthest = std::max(farthest, distance(support_[i].centre, centre) + support_[i].radius);
    }
    if (!(farthest < best.radius)) continue;
    best = {centre, farthest};
    std::copy_n(others.begin(), n, best_support.begin());
    best_support[n] = b;
    best_size = n + 1;
  }
  if (best_size == 0) return;  // every candidate overflowed: the ball stays as it is
  ball_ = best;
  support_ = best_support;
  size_ = best_size;
}

bool PivotLoop::should_include(const SupportBall& ball, double farthest) {
  const bool nearer = best_.radius < 0 || farthest < best_.radius;
  const bool grown = ball.radius() > radius_ * (1 + 1e-13);
  if (nearer) best_ = {ball.centre(), farthest};
  radius_ = std::max(radius_, ball.radius());
  if (farthest <= ball.radius() * k_inside) return false;
  idle_ = nearer || grown ? 0 : idle_ + 1;
  return idle_ < k_idle_steps;
}

MinimalSphere minimal_sphere_and_support(std::span<const Double3> points) {
  DoubleBox box;
  for (const Double3& p : points) box.grow(p);
  return minimal_sphere_and_support(points, box);
}

MinimalSphere minimal_sphere_and_support(std::span<const Double3> points, const DoubleBox& box) {
  if (points.empty()) return {};
  const Frame frame = frame_of(box);
  if (needs_no_frame(frame)) return minimal_in(points, NoFrame{}, 1);
  return minimal_in(points, frame, frame.scale);
}

Sphere minimal_sphere(std::span<const Double3> points) {
  return minimal_sphere_and_support(points).sphere;
}

Sphere minimal_sphere(std::span<const Sphere> balls) {
  return minimal_sphere_of(balls);
}

Double3 rounded_to_float(const Double3& p) {
  volatile float x = static_cast<float>(p.x), y = static_cast<float>(p.y), z = static_cast<float>(p.z);
  return {x, y, z};
}

void EnclosingRadius::add(const StoredSphere& s) {
  EnclosingRadius centre(to_float(centre_));  // its coordinates are float32 numbers
  centre.add(to_double(s.centre));
  // Both terms are float32 numbers and their sum, rounded up once, is no less than the exact one.
  const double sum = double{centre.radius()} + s.radius;
  ball_ = std::max(ball_, std::nextafter(sum, std::numeric_limits<double>::infinity()));
}

float EnclosingRadius::radius() const {
  float radius = ball_ > 0 ? round_up(ball_) : 0;
  if (reach_ == 0) return radius;
  const double wanted = squared_ < k_smallest_square ? 4 * reach_ * reach_ : squared_ * (1 + k_squared_error);
  // 2 > sqrt(3): where squares underflow the largest difference alone bounds the distance.
  radius = std::max(radius, round_up(squared_ < k_smallest_square ? 2 * reach_ : std::sqrt(wanted)));
  while (static_cast<double>(radius) * radius < wanted) {
    radius = std::nextafter(radius, std::numeric_limits<float>::infinity());
  }
  return radius;
}

StoredSphere stored_minimal_sphere(std::span<const Double3> points) {
  const Float3 centre = to_float(minimal_sphere(points).centre);
  EnclosingRadius radius(centre);
  for (const Double3& p : points) radius.add(p);
  return {centre, radius.radius()};
}

StoredSphere stored_minimal_sphere(std::span<const StoredSphere> spheres) {
  std::vector<Sphere> balls;
  for (const StoredSphere& s : spheres) balls.push_back({to_double(s.centre), s.radius});
  const Float3 centre = to_float(minimal_sphere(balls).centre);
  EnclosingRadius radius(centre);
  for (const StoredSphere& s : spheres) radius.add(s);
  return {centre, radius.radius()};
}

bool encloses(const StoredSphere& sphere, const Double3& p) {
  EnclosingRadius needed(sphere.centre);
  needed.add(p);
  return needed.radius() <= sphere.radius;
}

}  // namespace copse
