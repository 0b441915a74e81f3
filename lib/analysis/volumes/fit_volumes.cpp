#include "lib/analysis/volumes/fit_volumes.h"

#include "lib/analysis/volumes/bounded_fit.h"
#include "lib/analysis/volumes/capsule.h"
#include "lib/analysis/volumes/certify.h"
#include "lib/analysis/volumes/enclose.h"
#include "lib/analysis/volumes/lozenge.h"
#include "lib/analysis/volumes/minimal_box.h"
#include "lib/analysis/volumes/minimal_capsule.h"
#include "lib/analysis/volumes/minimal_lozenge.h"
#include "lib/analysis/volumes/minimal_sphere.h"
#include "lib/analysis/volumes/oriented_boxes.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace copse {
namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

}  // namespace

struct VolumeFitter::Prepared {
  std::span<const Double3> points;
  std::span<const std::array<std::uint32_t, 3>> triangles;
  PointCloud cloud;
  ConvexHull hull;
  std::vector<Double3> corners;  // of the hull, as the caller gave them
  double hull_seconds = 0;
};

namespace {

constexpr double k_exact_gap = 0.01;  // what FitQuality::exact proves

using Prepared = VolumeFitter::Prepared;
using Fit = BoundedFit<Volume<double>>;  // in cloud coordinates

// A fit without a bound.
template <class V>
Fit plain(V volume) {
  return {std::move(volume), 0};
}
template <class V>
Fit bounded(BoundedFit<V> fit) {
  return {std::move(fit.volume), fit.lower_bound};
}

Fit box_of(const Prepared& p, const FitOptions&) {
  const Double3 e = p.cloud.box.extent();
  return {p.cloud.box, e.x * e.y * e.z};
}

double ball_volume(double radius) {
  return 4 * std::numbers::pi / 3 * radius * radius * radius;
}

Fit minimal_ball(const Prepared& p, const FitOptions&) {
  const Sphere s = minimal_sphere(p.hull.boundary);
  return {BoundingSphere<double>{s.centre, s.radius}, ball_volume(s.radius * (1 - 1e-12))};
}

struct Entry {
  FitMethod method;
  Fit (*fit)(const Prepared&, const FitOptions&);
};

Fit least_box(const Prepared& p, const FitOptions& o) {
  MinimalBoxOptions options;
  if (o.quality == FitQuality::exact) options.gap = k_exact_gap;
  if (o.seconds > 0) options.seconds = o.seconds;
  return bounded(minimal_box(p.hull, options));
}

Fit least_capsule(const Prepared& p, const FitOptions&) {
  return bounded(minimal_capsule(p.hull.vertices));
}
Fit least_lozenge(const Prepared& p, const FitOptions&) {
  return bounded(minimal_lozenge(p.hull.vertices));
}

// The surface's own triangles where there are some, else the vertices alone.
Fit surface_box_of(const Prepared& p, const FitOptions&) {
  return plain(p.triangles.empty() ? gaussian_box(p.cloud) : surface_box(p.cloud, p.triangles));
}

const std::vector<Entry>& entries() {
  using P = const Prepared&;
  using O = const FitOptions&;
  using K = VolumeKind;
  static const std::vector<Entry> k_entries{
      {{K::aabb, "exact", true}, box_of},
      {{K::sphere, "minimal", true}, minimal_ball},
      {{K::obb, "gaussian", false}, [](P p, O) { return plain(gaussian_box(p.cloud)); }},
      {{K::obb, "surface", false}, surface_box_of},
      {{K::obb, "hull", false}, [](P p, O) { return plain(hull_surface_box(p.hull)); }},
      {{K::obb, "minimal", true}, least_box},
      {{K::capsule, "least-squares", false},
       [](P p, O) { return plain(least_squares_capsule(p.cloud.points)); }},
      {{K::capsule, "projected-circle", false},
       [](P p, O) { return plain(projected_circle_capsule(p.hull.vertices)); }},
      {{K::capsule, "minimal", true}, least_capsule},
      {{K::lozenge, "gaussian", false}, [](P p, O) { return plain(gaussian_lozenge(p.cloud.points)); }},
      {{K::lozenge, "minimal", true}, least_lozenge},
  };
  return k_entries;
}

}  // namespace

std::span<const FitMethod> fit_methods() {
  static const std::vector<FitMethod> k_methods = [] {
    std::vector<FitMethod> out;
    for (const Entry& e : entries()) out.push_back(e.method);
    return out;
  }();
  return k_methods;
}

Result<VolumeFitter> VolumeFitter::make(std::span<const Double3> points,
                                        std::span<const std::array<std::uint32_t, 3>> triangles) {
  const double start = now();
  auto cloud = make_point_cloud(points);
  if (!cloud) return std::unexpected(cloud.error());
  auto prepared = std::make_shared<Prepared>();
  prepared->points = points, prepared->triangles = triangles;
  prepared->cloud = std::move(*cloud);
  prepared->hull = convex_hull(prepared->cloud);
  for (const std::uint32_t i : prepared->hull.indices) prepared->corners.push_back(points[i]);
  prepared->hull_seconds = now() - start;
  return VolumeFitter(std::move(prepared));
}

const ConvexHull& VolumeFitter::hull() const {
  return prepared_->hull;
}
double VolumeFitter::hull_seconds() const {
  return prepared_->hull_seconds;
}

std::optional<FittedVolume> VolumeFitter::fit(const FitMethod& method, const FitOptions& options) const {
  const Prepared& p = *prepared_;
  const auto entry = std::find_if(entries().begin(), entries().end(), [&](const Entry& e) {
    return e.method.kind == method.kind && e.method.name == method.name;
  });
  if (entry == entries().end()) return std::nullopt;
  const double start = now();
  const Fit fit = entry->fit(p, options);
  const double fitted = now();
  auto enclosed = enclose(placed(fit.volume, p.hull.frame), p.points,
                          p.hull.loss == 0 ? std::span<const Double3>(p.corners) : p.points);
  if (!enclosed) return std::nullopt;
  FittedVolume out;
  out.method = entry->method;
  out.volume = std::move(enclosed->volume);
  out.certified = enclosed->certified;
  out.measures = measures_of(to_double(out.volume));
  // A whisker below, so that the roundings of the bound itself cannot put it above the truth.
  // The hull's volume is a bound for every kind.
  const double bound = std::max(fit.lower_bound * (1 - 1e-12), p.hull.volume * (1 - 1e-9));
  out.lower_bound = std::min(p.hull.frame.volume_out(bound), out.measures.volume);
  out.seconds = fitted - start;
  out.certify_seconds = now() - fitted;
  return out;
}

void share_lower_bounds(std::span<FittedVolume> of_one_set) {
  for (FittedVolume& a : of_one_set) {
    for (const FittedVolume& b : of_one_set) {
      if (a.method.kind == b.method.kind && a.method.kind != VolumeKind::kdop)
        a.lower_bound = std::max(a.lower_bound, b.lower_bound);
    }
  }
}

}  // namespace copse
