#include "lib/analysis/volumes/minimal_sphere.h"

#include <bit>
#include <limits>

namespace copse {
namespace {

// A squared distance in double is off by at most 6 roundings of 2^-53: three differences (twice each, for
// they are squared), a product and two sums.
constexpr double k_squared_error = 8 * 0x1p-53;
// The farthest point counts as inside up to this much of the squared radius.
constexpr double k_inside = 1 + 4e-15;
// Steps that neither enlarge the ball nor bring the farthest point nearer, before rounding is taken to rule.
constexpr int k_idle_steps = 32;
constexpr double k_smallest_square = 1e-280;  // below it squares have lost digits to underflow

double squared(const Double3& a) {
  return dot(a, a);
}

// The centre of the smallest sphere through the origin and `n` <= 3 points; false when they are dependent.
bool circumcentre(const std::array<Double3, 3>& a, int n, Double3& centre) {
  if (n == 0) {
    centre = {};
    return true;
  }
  if (n == 1) {
    centre = a[0] * 0.5;
    return true;
  }
  const Double3 normal = cross(a[0], a[1]);
  if (n == 2) {
    const double denominator = 2 * squared(normal);
    if (!(denominator > 0)) return false;
    centre = cross(a[1] * squared(a[0]) - a[0] * squared(a[1]), normal) / denominator;
  } else {
    const double denominator = 2 * dot(normal, a[2]);
    if (denominator == 0) return false;
    centre =
        (cross(a[1], a[2]) * squared(a[0]) + cross(a[2], a[0]) * squared(a[1]) + normal * squared(a[2])) /
        denominator;
  }
  return is_finite(centre);
}

struct Frame {  // brings points near the origin and to a size of about 1; the scale is a power of two
  Double3 origin;
  double scale = 1;
  Double3 in(const Double3& p) const { return (p - origin) * scale; }
  Double3 out(const Double3& q) const { return q / scale + origin; }
};

Frame frame_of(std::span<const Double3> points) {
  DoubleBox box;
  for (const Double3& p : points) box.grow(p);
  // Halves first: the box of points near the largest double must not overflow.
  const Double3 half = box.max * 0.5 - box.min * 0.5;
  const double reach = std::max({half.x, half.y, half.z});
  Frame frame{box.min + half, 1};
  if (reach > 0) frame.scale = std::ldexp(1.0, std::clamp(-std::ilogb(reach), -1000, 1000));
  return frame;
}

struct Farthest {
  std::size_t point = 0;
  double squared = -1;
};

Farthest farthest_from(const Double3& centre, std::span<const Double3> points, const Frame& frame) {
  Farthest found;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double d = squared(frame.in(points[i]) - centre);
    if (d > found.squared) found = {i, d};
  }
  return found;
}

}  // namespace

void SupportBall::include(const Double3& p) {
  std::array<Double3, 4> best_support;
  Double3 best_centre = p;
  int best_size = 0;
  double best = std::numeric_limits<double>::infinity();
  for (unsigned subset = 0; subset < (1u << size_); ++subset) {
    const int chosen = std::popcount(subset);
    if (chosen > 3) continue;
    std::array<Double3, 3> from_p;
    std::array<Double3, 4> support;
    int n = 0;
    for (int i = 0; i < size_; ++i) {
      if (!(subset >> i & 1)) continue;
      support[n] = support_[i];
      from_p[n++] = support_[i] - p;
    }
    Double3 offset;
    if (!circumcentre(from_p, n, offset)) continue;
    const Double3 centre = p + offset;
    double farthest = squared(centre - p);
    for (int i = 0; i < size_; ++i) farthest = std::max(farthest, squared(support_[i] - centre));
    if (!(farthest < best)) continue;
    best = farthest;
    best_centre = centre;
    support[n] = p;
    best_support = support;
    best_size = n + 1;
  }
  if (best_size == 0) return;  // every candidate overflowed: the ball stays as it is
  centre_ = best_centre;
  squared_radius_ = best;
  support_ = best_support;
  size_ = best_size;
}

bool PivotLoop::should_include(const SupportBall& ball, double farthest_squared) {
  const bool nearer = best_squared_ < 0 || farthest_squared < best_squared_;
  const bool grown = ball.squared_radius() > radius_squared_ * (1 + 1e-13);
  if (nearer) {
    best_centre_ = ball.centre();
    best_squared_ = farthest_squared;
  }
  radius_squared_ = std::max(radius_squared_, ball.squared_radius());
  if (farthest_squared <= ball.squared_radius() * k_inside) return false;
  idle_ = nearer || grown ? 0 : idle_ + 1;
  return idle_ < k_idle_steps;
}

Sphere minimal_sphere(std::span<const Double3> points) {
  if (points.empty()) return {};
  const Frame frame = frame_of(points);
  SupportBall ball;
  ball.include(frame.in(points[farthest_from({}, points, frame).point]));
  PivotLoop loop;
  for (;;) {
    const Farthest farthest = farthest_from(ball.centre(), points, frame);
    if (!loop.should_include(ball, farthest.squared)) break;
    ball.include(frame.in(points[farthest.point]));
  }
  Sphere sphere{frame.out(loop.best_centre()), 0};
  // From the centre as it was rounded, not as it was found.
  const Frame about{sphere.centre, frame.scale};
  sphere.radius = std::sqrt(std::max(0.0, farthest_from({}, points, about).squared)) / frame.scale;
  return sphere;
}

float EnclosingRadius::radius() const {
  if (reach_ == 0) return 0;
  const double wanted = squared_ < k_smallest_square ? 4 * reach_ * reach_ : squared_ * (1 + k_squared_error);
  // 2 > sqrt(3): where squares underflow the largest difference alone bounds the distance.
  float radius = round_up(squared_ < k_smallest_square ? 2 * reach_ : std::sqrt(wanted));
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

bool encloses(const StoredSphere& sphere, const Double3& p) {
  EnclosingRadius needed(sphere.centre);
  needed.add(p);
  return needed.radius() <= sphere.radius;
}

}  // namespace copse
