#include "lib/analysis/round/ellipsoids.h"

#include "lib/analysis/hull/principal_axes.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace copse {
namespace {

constexpr double k_flat = 0x1p-46;    // of the size: thinner is the rounding of a flat cloud
constexpr double k_rounding = 1e-11;  // relative, of the bound

double volume_of(const Ellipsoid<double>& e) {
  return 4 * std::numbers::pi / 3 * e.semi_axes.x * e.semi_axes.y * e.semi_axes.z;
}

// Scaled about its centre until the farthest point is on it. Axes of length 0 stay so.
void grow(Ellipsoid<double>& e, std::span<const Double3> points) {
  double farthest = 0;
  for (const Double3& p : points) {
    double sum = 0;
    for (int i = 0; i < 3; ++i) {
      const double c = dot(e.axes[i], p - e.centre);
      if (e.semi_axes[i] > 0) sum += c / e.semi_axes[i] * (c / e.semi_axes[i]);
    }
    farthest = std::max(farthest, sum);
  }
  e.semi_axes *= std::sqrt(farthest);
}

// The minimal ellipsoid of points of dimension d, by weights. Coordinates are scaled to the cloud's extents,
// so that thin clouds are as well conditioned as round ones; volumes ratios do not change by that.
class Weights {
 public:
  Weights(const std::vector<Double3>& points, int dimension)
      : points_(points), d_(dimension), weight_(points.size(), 0.0), distance_(points.size(), 0.0) {
    start();
    refresh();
  }

  // Steps until the ellipsoid of the weights, grown to hold all points, has at most (1 + gap) times the
  // bound.
  void run(const MinimalEllipsoidOptions& options) {
    const double wanted = std::pow(1 + options.gap, 2.0 / d_);
    for (int step = 1; step <= options.max_steps; ++step) {
      if (step % 16 == 1 && options.deadline.has_passed()) break;
      std::size_t far = 0, near = points_.size();
      for (std::size_t i = 0; i < points_.size(); ++i) {
        if (distance_[i] > distance_[far]) far = i;
        if (weight_[i] > 0 && (near == points_.size() || distance_[i] < distance_[near])) near = i;
      }
      if (distance_[far] <= d_ * wanted) break;
      const bool away = d_ - distance_[near] > distance_[far] - d_;
      keep_if_least(distance_[far]);
      if (!move(away ? near : far)) break;
      if (step % 50 == 0) refresh();
    }
    refresh();
    keep_if_least(*std::ranges::max_element(distance_));
    if (!std::isfinite(least_)) least_mean_ = mean_, least_covariance_ = covariance_;
  }

  // Of the shape that has been least, grown to hold all points: steps that raise the bound can make it
  // larger.
  Double3 centre() const { return least_mean_; }
  const std::array<double, 6>& covariance() const { return least_covariance_; }
  // Of the last weights, whose bound is the highest: of the covariance.
  double determinant() const { return determinant_; }

 private:
  void keep_if_least(double farthest) {
    const double size = determinant_ * std::pow(farthest, d_);  // its volume squared, but for a factor
    if (!(size > 0 && size < least_)) return;
    least_ = size, least_mean_ = mean_, least_covariance_ = covariance_;
  }

  void start() {  // extreme along the axes, and along the directions that these leave
    Axes done{};
    for (int k = 0; k < d_; ++k) {
      Double3 direction;
      direction[k] = 1;
      for (int j = 0; j < k; ++j) direction = direction - done[j] * dot(direction, done[j]);
      std::size_t low = 0, high = 0;
      for (std::size_t i = 0; i < points_.size(); ++i) {
        if (dot(points_[i], direction) < dot(points_[low], direction)) low = i;
        if (dot(points_[i], direction) > dot(points_[high], direction)) high = i;
      }
      weight_[low] = weight_[high] = 1;
      Double3 along = points_[high] - points_[low];
      for (int j = 0; j < k; ++j) along = along - done[j] * dot(along, done[j]);
      done[k] = normalized(along, direction);
    }
    double sum = 0;
    for (const double w : weight_) sum += w;
    for (double& w : weight_) w /= sum;
  }

  void refresh() {  // mean, covariance, inverse and all squared distances, from the weights
    double sum = 0;
    mean_ = {};
    for (std::size_t i = 0; i < points_.size(); ++i) mean_ += points_[i] * weight_[i], sum += weight_[i];
    mean_ = mean_ / sum;
    covariance_ = {};
    for (std::size_t i = 0; i < points_.size(); ++i) {
      weight_[i] /= sum;
      if (weight_[i] == 0) continue;
      const Double3 d = points_[i] - mean_;
      covariance_[0] += weight_[i] * d.x * d.x, covariance_[1] += weight_[i] * d.x * d.y;
      covariance_[2] += weight_[i] * d.x * d.z, covariance_[3] += weight_[i] * d.y * d.y;
      covariance_[4] += weight_[i] * d.y * d.z, covariance_[5] += weight_[i] * d.z * d.z;
    }
    invert();
    for (std::size_t i = 0; i < points_.size(); ++i)
      distance_[i] = form(points_[i] - mean_, points_[i] - mean_);
  }

  void invert() {
    const auto& m = covariance_;
    // Dimensions that are not there get a unit, which the coordinates (0) never meet.
    const double yy = d_ < 2 ? 1 : m[3], zz = d_ < 3 ? 1 : m[5];
    const Double3 a{m[0], m[1], m[2]}, b{m[1], yy, m[4]}, c{m[2], m[4], zz};
    const Double3 bc = cross(b, c), ca = cross(c, a), ab = cross(a, b);
    determinant_ = dot(a, bc);
    inverse_ = {bc / determinant_, ca / determinant_, ab / determinant_};
  }

  double form(const Double3& u, const Double3& v) const {
    return u.x * dot(inverse_[0], v) + u.y * dot(inverse_[1], v) + u.z * dot(inverse_[2], v);
  }

  // The best step along the weight of point k: up, or down as far as 0.
  bool move(std::size_t k) {
    const double q = distance_[k] + 1, n = d_ + 1;  // in the lifted space (x, 1) everything is centred
    double beta = (q - n) / (n * (q - 1));
    const double all = weight_[k] < 1 ? -weight_[k] / (1 - weight_[k]) : -1;
    const bool drop = !(beta > all);
    if (drop) beta = all;
    if (!std::isfinite(beta) || beta == 0) return false;
    // The inverse of (1 - beta) M + beta q q^T, by Sherman and Morrison, shows in the distances alone.
    const Double3 offset = points_[k] - mean_;
    const Double3 g{dot(inverse_[0], offset), dot(inverse_[1], offset), dot(inverse_[2], offset)};
    const double factor = beta / (1 - beta + beta * q);
    for (std::size_t i = 0; i < points_.size(); ++i) {
      const double lifted = 1 + dot(points_[i] - mean_, g);
      distance_[i] = (distance_[i] + 1 - factor * lifted * lifted) / (1 - beta) - 1;
    }
    for (double& w : weight_) w *= 1 - beta;
    weight_[k] = drop ? 0 : weight_[k] + beta;  // exactly 0, or it would be dropped again and again
    mean_ = mean_ + offset * beta;
    const double s = beta * (1 - beta);
    auto& m = covariance_;
    for (double& c : m) c *= 1 - beta;
    m[0] += s * offset.x * offset.x, m[1] += s * offset.x * offset.y, m[2] += s * offset.x * offset.z;
    m[3] += s * offset.y * offset.y, m[4] += s * offset.y * offset.z, m[5] += s * offset.z * offset.z;
    invert();
    return true;
  }

  const std::vector<Double3>& points_;
  int d_;
  std::vector<double> weight_, distance_;  // distance: squared, in the metric of the covariance
  Double3 mean_;
  std::array<double, 6> covariance_{};
  Axes inverse_{};
  double determinant_ = 0, least_ = std::numeric_limits<double>::infinity();
  Double3 least_mean_;
  std::array<double, 6> least_covariance_{};
};

}  // namespace

Ellipsoid<double> axis_aligned_ellipsoid(const PointCloud& cloud) {
  Ellipsoid<double> e{cloud.box.centre(), k_world_axes, cloud.box.extent() * 0.5};
  grow(e, cloud.points);
  return e;
}

Ellipsoid<double> gaussian_ellipsoid(const PointCloud& cloud) {
  const PrincipalAxes spread = principal_axes(cloud.points);
  // A deviation that is rounding says nothing of the thickness: measure that.
  Double3 reach;
  for (const Double3& p : cloud.points) {
    for (int i = 0; i < 3; ++i) reach[i] = std::max(reach[i], std::abs(dot(spread.axes[i], p - spread.mean)));
  }
  Ellipsoid<double> e{spread.mean, spread.axes, {}};
  for (int i = 0; i < 3; ++i) {
    const double deviation = std::sqrt(spread.variances[i]);
    e.semi_axes[i] = reach[i] < k_flat * reach.x ? 0 : std::clamp(deviation, 0.05 * reach[i], reach[i]);
  }
  grow(e, cloud.points);
  return e;
}

BoundedFit<Ellipsoid<double>> minimal_ellipsoid(const ConvexHull& hull,
                                                const MinimalEllipsoidOptions& options) {
  const Double3 origin = hull.vertices[0];
  if (hull.dimension == 0) return {{origin, k_world_axes, {}}, 0};
  DoubleBox box;  // of the coordinates along the hull's axes
  std::vector<Double3> points;
  for (const Double3& p : hull.vertices) {
    const Double3 d = p - origin;
    Double3 q;
    for (int i = 0; i < hull.dimension; ++i) q[i] = dot(d, hull.axes[i]);
    points.push_back(q);
    box.grow(q);
  }
  Double3 scale = box.extent() * 0.5;
  for (int i = hull.dimension; i < 3; ++i) scale[i] = 1;
  for (Double3& p : points) p = {p.x / scale.x, p.y / scale.y, p.z / scale.z};
  Weights weights(points, hull.dimension);
  weights.run(options);

  const Double3 c = weights.centre();
  std::array<double, 6> m = weights.covariance();
  double bound = 0;
  if (hull.dimension == 3) {
    bound = 4 * std::numbers::pi / 3 * std::sqrt(std::max(0.0, 27 * weights.determinant())) * scale.x *
            scale.y * scale.z;
  }
  m[0] *= scale.x * scale.x, m[1] *= scale.x * scale.y, m[2] *= scale.x * scale.z;
  m[3] *= scale.y * scale.y, m[4] *= scale.y * scale.z, m[5] *= scale.z * scale.z;
  const Eigen3 e = eigen_of(m);
  Ellipsoid<double> best;
  best.centre = origin;
  for (int i = 0; i < hull.dimension; ++i) best.centre += hull.axes[i] * (c[i] * scale[i]);
  for (int i = 0; i < 3; ++i) {
    best.axes[i] = hull.axes[0] * e.axes[i].x + hull.axes[1] * e.axes[i].y + hull.axes[2] * e.axes[i].z;
    best.semi_axes[i] = i < hull.dimension ? std::sqrt(std::max(0.0, e.values[i]) * hull.dimension) : 0;
  }
  grow(best, hull.boundary);
  return {best, std::min(bound * (1 - k_rounding), volume_of(best))};
}

}  // namespace copse
