#include "lib/analysis/measure/cylinder_error.h"

#include "lib/analysis/rings/ring_circles.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace copse {
namespace {

// Sums up samples without keeping them: the percentile is the upper border of its bin, at most 1.1 % high.
class Distribution {
 public:
  void add(double error, double weight) {
    total_ += weight, sum_ += weight * error, squares_ += weight * error * error;
    largest_ = std::max(largest_, error);
    bins_[bin(error)] += weight;
  }

  ErrorDistribution result() const {
    ErrorDistribution d;
    d.max = largest_;
    if (total_ <= 0) return d;
    d.mean = sum_ / total_;
    d.rms = std::sqrt(squares_ / total_);
    double below = 0;
    std::size_t i = 0;
    while (i + 1 < bins_.size() && (below += bins_[i]) < 0.95 * total_) ++i;
    d.p95 = std::min(largest_, upper(i));
    return d;
  }

 private:
  static constexpr int k_per_octave = 64, k_lowest = -60, k_highest = 40;
  static std::size_t bin(double error) {
    if (!(error > 0)) return 0;
    const double place = (std::log2(error) - k_lowest) * k_per_octave;
    return static_cast<std::size_t>(
        std::clamp(place + 1, 0.0, double{(k_highest - k_lowest) * k_per_octave}));
  }
  static double upper(std::size_t bin) {
    return bin == 0 ? 0 : std::exp2(static_cast<double>(bin) / k_per_octave + k_lowest);
  }

  std::vector<double> bins_ = std::vector<double>((k_highest - k_lowest) * k_per_octave + 1, 0.0);
  double total_ = 0, sum_ = 0, squares_ = 0, largest_ = 0;
};

// Along the axis and away from it.
struct Profile {
  double along = 0, away = 0;
};

double distance_to_edge(const Profile& p, const Profile& a, const Profile& b) {
  const double x = b.along - a.along, y = b.away - a.away, squared = x * x + y * y;
  const double t =
      squared > 0 ? std::clamp(((p.along - a.along) * x + (p.away - a.away) * y) / squared, 0.0, 1.0) : 0.0;
  return std::hypot(p.along - a.along - t * x, p.away - a.away - t * y);
}

// The frustum between two radii.
class Frustum {
 public:
  Frustum(const RadiusNode& parent, const RadiusNode& child)
      : base_(parent.centre),
        axis_(child.centre - parent.centre),
        length_(length(axis_)),
        base_radius_(parent.diameter / 2),
        top_radius_(child.diameter / 2) {
    if (length_ > 0) axis_ = axis_ / length_;
  }

  // Of a point from the surface: the side and the two discs.
  double distance_from(const Double3& p) const {
    const Profile at = profile(p), low{0, base_radius_}, high{length_, top_radius_};
    return std::min({distance_to_edge(at, low, high), distance_to_edge(at, {0, 0}, low),
                     distance_to_edge(at, {length_, 0}, high)});
  }
  // At the height of a point.
  double radius_at(const Double3& p) const {
    const double t = length_ > 0 ? std::clamp(profile(p).along / length_, 0.0, 1.0) : 0.0;
    return base_radius_ + t * (top_radius_ - base_radius_);
  }
  double larger_radius() const { return std::max(base_radius_, top_radius_); }

 private:
  Profile profile(const Double3& p) const {
    const Double3 d = p - base_;
    const double along = dot(d, axis_);
    return {along, length(d - axis_ * along)};
  }

  Double3 base_, axis_;
  double length_ = 0, base_radius_ = 0, top_radius_ = 0;
};

// A point of a triangle, by its corners' shares, and the share of the area that it stands for.
struct Sample {
  std::array<double, 3> corners;
  double weight;
};

// The corners first.
constexpr double k_half = 0.5, k_third = 1.0 / 3;
constexpr auto k_samples = std::to_array<Sample>({{{1, 0, 0}, 1.0 / 20},
                                                  {{0, 1, 0}, 1.0 / 20},
                                                  {{0, 0, 1}, 1.0 / 20},
                                                  {{k_half, k_half, 0}, 2.0 / 15},
                                                  {{0, k_half, k_half}, 2.0 / 15},
                                                  {{k_half, 0, k_half}, 2.0 / 15},
                                                  {{k_third, k_third, k_third}, 9.0 / 20}});

}  // namespace

CylinderError cylinder_error(const TrunkMesh& trunk, const Hierarchy& hierarchy, double height,
                             std::size_t every) {
  Distribution of_radius, of_height;
  double area_all = 0, area_explained = 0;
  std::size_t explained = 0, seen = 0;
  const RingCircles circles(hierarchy, trunk.positions.size());
  for (std::size_t i = 0; i < trunk.triangles.size(); i += every, ++seen) {
    const Triangle& t = trunk.triangles[i];
    const Double3 &a = trunk.positions[t[0]], &b = trunk.positions[t[1]], &c = trunk.positions[t[2]];
    const double area = 0.5 * length(cross(b - a, c - a));
    area_all += area;
    const std::uint32_t s = hierarchy.segment_of[i];
    if (s == k_none || hierarchy.radii[s].parent == k_none) continue;
    const RadiusNode &child = hierarchy.radii[s], &parent = hierarchy.radii[child.parent];
    const Frustum frustum(parent, child);
    const auto along = circles.along(t, s);
    double worst_corner = 0;
    for (std::size_t k = 0; k < k_samples.size(); ++k) {
      const auto& [of, weight] = k_samples[k];
      const Double3 p = a * of[0] + b * of[1] + c * of[2];
      double error = frustum.distance_from(p);
      if (along) {
        const double at = (*along)[0] * of[0] + (*along)[1] * of[1] + (*along)[2] * of[2];
        error = std::min(error, off_circle(p, parent, child, at));
      }
      if (k < 3) worst_corner = std::max(worst_corner, error);
      if (const double r = frustum.radius_at(p); r > 0) of_radius.add(error / r, area * weight);
      if (height > 0) of_height.add(error / height, area * weight);
    }
    if (worst_corner <= k_explained_within * frustum.larger_radius()) ++explained, area_explained += area;
  }
  CylinderError out;
  out.of_radius = of_radius.result();
  out.of_height = of_height.result();
  if (!trunk.triangles.empty()) {
    out.explained_triangles = static_cast<double>(explained) / static_cast<double>(seen);
    out.explained_area = area_all > 0 ? area_explained / area_all : out.explained_triangles;
  }
  return out;
}

}  // namespace copse
