#include "lib/analysis/volumes/fit_volumes.h"

#include "lib/analysis/boxes/kdop.h"
#include "lib/analysis/boxes/minimal_box.h"
#include "lib/analysis/boxes/oriented_boxes.h"
#include "lib/analysis/round/bounding_spheres.h"
#include "lib/analysis/round/cylinders.h"
#include "lib/analysis/round/ellipsoids.h"
#include "lib/analysis/swept/capsule.h"
#include "lib/analysis/swept/lozenge.h"
#include "lib/analysis/swept/minimal_capsule.h"
#include "lib/analysis/swept/minimal_lozenge.h"
#include "lib/analysis/volumes/bounded_fit.h"
#include "lib/analysis/volumes/certify.h"
#include "lib/analysis/volumes/enclose.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <ctime>
#include <limits>
#include <type_traits>

namespace copse {
namespace {

// Of this thread: what another program does meanwhile is no time of a fit's.
double now() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// Roundings of a volume and of its bound may cross; more than that is an error, which is not hidden.
double not_above(double v, double limit, const VolumeMeasures& of, const PointFrame& frame) {
  constexpr double k_relative = 1e-9, k_of_thickness = 1e-13;
  const double room = k_relative * limit + k_of_thickness * frame.scale * of.surface;
  return v > limit && v <= limit + room ? limit : v;
}

}  // namespace

struct VolumeFitter::Prepared {
  std::span<const Double3> points;
  std::span<const std::array<std::uint32_t, 3>> triangles;
  PointCloud cloud;
  mutable std::optional<ConvexHull> convex;  // once a method needs it
  mutable std::vector<Double3> corners;      // of the hull, as the caller gave them
  mutable double hull_seconds = 0;
  mutable std::optional<Capsule<double>> capsule;   // the least one, once it is known
  mutable std::vector<std::uint32_t> ball_support;  // of the minimal sphere, among the points
  // What the methods that are no searches for the least gave, by entry: each is asked for several times.
  mutable std::vector<std::optional<BoundedFit<Volume<double>>>> cheap;

  const ConvexHull& hull(const Deadline& deadline = {}) const {
    if (convex) return *convex;
    const double start = now();
    HullOptions options;
    options.deadline = deadline;
    convex = convex_hull(cloud, options);
    for (const std::uint32_t i : convex->indices) corners.push_back(points[i]);
    hull_seconds = now() - start;
    return *convex;
  }
};

namespace {

// What FitQuality::exact proves.
constexpr double k_box_gap = 0.01, k_capsule_gap = 0.02, k_lozenge_gap = 0.1, k_cylinder_gap = 0.01;

// The most work for one proof: about a second. The reference models need a tenth of it.
constexpr std::size_t k_most_separations = 6000, k_most_cells = 100'000;

using Prepared = VolumeFitter::Prepared;
using Fit = BoundedFit<Volume<double>>;  // in cloud coordinates

struct Entry {
  FitMethod method;
  Fit (*fit)(const Prepared&, const FitOptions&);
};

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

Fit ball_of(const Prepared& p, const FitOptions&) {
  SupportedSphere ball = smallest_sphere(p.cloud);
  p.ball_support = std::move(ball.support);
  return bounded(std::move(ball.fit));
}

// How far a proof is driven: not at all, to the gap of the kind, or as far as the time allows.
template <class Options>
Options limits(const FitOptions& how, double gap) {
  Options options;
  const bool prove = how.quality == FitQuality::exact || how.deadline.is_set();
  options.gap = prove ? gap : std::numeric_limits<double>::infinity();
  options.deadline = how.deadline;
  if (!how.deadline.is_set()) {  // a tree has thousands of parts: what so much work does not prove is told
                                 // (exact_gap)
    if constexpr (requires { options.max_separations; }) options.max_separations = k_most_separations;
    if constexpr (requires { options.max_cells; }) options.max_cells = k_most_cells;
  }
  return options;
}

Fit least_box(const Prepared& p, const FitOptions& how) {
  return bounded(minimal_box(p.hull(), limits<MinimalBoxOptions>(how, k_box_gap)));
}
Fit projected_circle(const Prepared& p, const FitOptions& how);
BoundedFit<Capsule<double>> capsule_with(const Prepared& p, const SweptBoundOptions& options) {
  // One start among many: most of the time is the search's own.
  const Fit circle = projected_circle(p, {FitQuality::balanced, options.deadline.share(4)});
  return minimal_capsule(p.hull(), std::get<Capsule<double>>(circle.volume), options);
}
// The lozenge starts from the capsule, which no lozenge need be worse than: from that of the same quality,
// whose proof may have found a smaller one.
Fit least_lozenge(const Prepared& p, const FitOptions& how) {
  if (!p.capsule) {
    auto options = limits<SweptBoundOptions>(how, k_capsule_gap);
    if (how.deadline.is_set()) options.gap = std::numeric_limits<double>::infinity();
    options.deadline = how.deadline.share(3);
    p.capsule = capsule_with(p, options).volume;
  }
  return bounded(minimal_lozenge(p.hull(), *p.capsule, limits<SweptBoundOptions>(how, k_lozenge_gap)));
}
Fit least_capsule(const Prepared& p, const FitOptions& how) {
  BoundedFit<Capsule<double>> fit = capsule_with(p, limits<SweptBoundOptions>(how, k_capsule_gap));
  p.capsule = fit.volume;
  return bounded(std::move(fit));
}
Fit least_cylinder(const Prepared& p, const FitOptions& how) {
  return bounded(minimal_cylinder(p.hull(), limits<MinimalCylinderOptions>(how, k_cylinder_gap)));
}

Fit least_ellipsoid(const Prepared& p, const FitOptions& how) {
  MinimalEllipsoidOptions options;
  options.deadline = how.deadline;
  return bounded(minimal_ellipsoid(p.hull(), options));
}

// The surface's own triangles where there are some, else the vertices alone.
Fit surface_box_of(const Prepared& p, const FitOptions&) {
  return plain(p.triangles.empty() ? gaussian_box(p.cloud) : surface_box(p.cloud, p.triangles));
}

// So that no oriented box is larger than the one along the axes.
OrientedBox<double> upright_box(const PointCloud& cloud) {
  constexpr std::array<Double3, 3> k_axes{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
  return {cloud.box.min * 0.5 + cloud.box.max * 0.5, k_axes, cloud.box.extent() * 0.5};
}

const std::vector<Entry>& entries() {
  using P = const Prepared&;
  using O = const FitOptions&;
  using K = VolumeKind;
  static const std::vector<Entry> k_entries{
      {{K::aabb, "exact", true, true}, box_of},
      {{K::sphere, "box", true, false}, [](P p, O) { return plain(box_sphere(p.cloud)); }},
      {{K::sphere, "mean", true, false}, [](P p, O) { return plain(mean_sphere(p.cloud)); }},
      {{K::sphere, "ritter", true, false}, [](P p, O) { return plain(extremal_sphere(p.cloud)); }},
      {{K::sphere, "minimal", true, true}, ball_of},
      {{K::obb, "axis-aligned", true, false}, [](P p, O) { return plain(upright_box(p.cloud)); }},
      {{K::obb, "gaussian", true, false}, [](P p, O) { return plain(gaussian_box(p.cloud)); }},
      {{K::obb, "surface", true, false}, surface_box_of},
      {{K::obb, "hull", true, false, true}, [](P p, O) { return plain(hull_surface_box(p.hull())); }},
      {{K::obb, "minimal", false, true, true}, least_box},
      {{K::capsule, "least-squares", true, false},
       [](P p, O) { return plain(least_squares_capsule(p.cloud.points)); }},
      {{K::capsule, "projected-circle", false, false, true},
       [](P p, O how) { return plain(projected_circle_capsule(p.hull().vertices, how.deadline)); }},
      {{K::capsule, "minimal", false, true, true}, least_capsule},
      {{K::cylinder, "line-fit", true, false}, [](P p, O) { return plain(line_fit_cylinder(p.cloud)); }},
      {{K::cylinder, "recentred", true, false}, [](P p, O) { return plain(recentred_cylinder(p.cloud)); }},
      {{K::cylinder, "minimal", false, true, true}, least_cylinder},
      {{K::lozenge, "gaussian", true, false}, [](P p, O) { return plain(gaussian_lozenge(p.cloud.points)); }},
      {{K::lozenge, "minimal", false, true, true}, least_lozenge},
      {{K::ellipsoid, "axis-aligned", true, false},
       [](P p, O) { return plain(axis_aligned_ellipsoid(p.cloud)); }},
      {{K::ellipsoid, "gaussian", true, false}, [](P p, O) { return plain(gaussian_ellipsoid(p.cloud)); }},
      {{K::ellipsoid, "minimal", false, true, true}, least_ellipsoid},
      {{K::kdop, "14", true, false}, nullptr},
      {{K::kdop, "18", true, false}, nullptr},
      {{K::kdop, "26", true, true}, nullptr},
  };
  return k_entries;
}

std::optional<int> planes_of(std::string_view name) {
  int k = 0;
  const auto [end, error] = std::from_chars(name.data(), name.data() + name.size(), k);
  if (error != std::errc() || end != name.data() + name.size() || k < 6 || k > k_most_planes || k % 2 != 0)
    return std::nullopt;
  return k;
}

// Unique for its directions: nothing is searched. Its own volume is its bound, less what its facets' corners
// lose to rounding.
Fit slabs_of(const Prepared& p, int k) {
  Kdop<double> volume = fit_kdop(p.cloud.points, kdop_normals(k));
  const VolumeMeasures m = measures_of(volume);
  const double lost = 1e-13 * length(p.cloud.box.extent()) * m.surface;
  return {volume, std::max(0.0, m.volume * (1 - 1e-9) - lost)};
}

// In the cloud: nothing that holds the hull is smaller, of whatever kind.
double bound_of_hull(const Prepared& p) {
  return p.hull().least_volume * (1 - 1e-9);
}

bool is_cheap(const FitMethod& method) {
  return method.quick || !method.least;
}

Fit fit_entry(std::size_t index, const Prepared& p, const FitOptions& how) {
  const Entry& entry = entries()[index];
  if (!is_cheap(entry.method)) return entry.fit(p, how);
  p.cheap.resize(entries().size());
  if (!p.cheap[index]) p.cheap[index] = entry.fit(p, how);
  return *p.cheap[index];
}

std::size_t index_of(VolumeKind kind, std::string_view name) {
  std::size_t index = 0;
  while (!(entries()[index].method.kind == kind && entries()[index].method.name == name)) ++index;
  return index;
}

Fit projected_circle(const Prepared& p, const FitOptions& how) {
  return fit_entry(index_of(VolumeKind::capsule, "projected-circle"), p, how);
}

Fit fit_by(const FitMethod& method, const Prepared& p, const FitOptions& how) {
  if (method.kind == VolumeKind::kdop) return slabs_of(p, planes_of(method.name).value_or(26));
  return fit_entry(index_of(method.kind, method.name), p, how);
}

// A ball or a capsule as the type that is to hold it; none where it is not one of that. Stored ones keep
// their numbers: none where float32 cannot hold the edge.
template <class T>
struct AsCapsule {
  std::optional<Volume<T>> operator()(const BoundingSphere<T>& v) const {
    return Capsule<T>{v.centre, v.centre, v.radius};
  }
  std::optional<Volume<T>> operator()(const Capsule<T>& v) const { return v; }
  std::optional<Volume<T>> operator()(const auto&) const { return std::nullopt; }
};
template <class T>
struct AsLozenge {
  std::optional<Volume<T>> operator()(const BoundingSphere<T>& v) const {
    return Lozenge<T>{v.centre, {}, {}, v.radius};
  }
  std::optional<Volume<T>> operator()(const Capsule<T>& v) const {
    const Vec3<T> edge = v.b - v.a;
    if constexpr (std::is_same_v<T, float>) {
      if (to_double(edge) != to_double(v.b) - to_double(v.a)) return std::nullopt;
    }
    return Lozenge<T>{v.a, edge, {}, v.radius};
  }
  std::optional<Volume<T>> operator()(const Lozenge<T>& v) const { return v; }
  std::optional<Volume<T>> operator()(const auto&) const { return std::nullopt; }
};

template <class T>
std::optional<Volume<T>> as_kind(const Volume<T>& v, VolumeKind wanted) {
  if (wanted == VolumeKind::capsule) return std::visit(AsCapsule<T>{}, v);
  if (wanted == VolumeKind::lozenge) return std::visit(AsLozenge<T>{}, v);
  return kind_of(v) == wanted ? std::optional(v) : std::nullopt;
}

// What a method must not be worse than, each in its own type: of kinds that are cases of its own what is as
// quick, and of a search the cheaper methods of its kind.
std::vector<Volume<double>> cheaper_fits(const FitMethod& method, const Prepared& p, const FitOptions& how) {
  std::vector<Volume<double>> out;
  if (method.quick && (method.kind == VolumeKind::capsule || method.kind == VolumeKind::lozenge)) {
    out.push_back(fit_entry(index_of(VolumeKind::sphere, "minimal"), p, how).volume);
    if (method.kind == VolumeKind::lozenge)
      out.push_back(fit_entry(index_of(VolumeKind::capsule, "least-squares"), p, how).volume);
  }
  if (!method.least || method.kind == VolumeKind::kdop) return out;
  for (std::size_t i = 0; i < entries().size(); ++i) {
    const Entry& e = entries()[i];
    if (e.method == method) break;
    const bool known = e.method.kind == VolumeKind::capsule && e.method.least && p.capsule.has_value();
    const bool ball = e.method.kind == VolumeKind::sphere && e.method.least;
    const bool capsule = e.method.kind == VolumeKind::capsule && (known || !e.method.least);
    const bool wider = (method.kind == VolumeKind::capsule && ball) ||
                       (method.kind == VolumeKind::lozenge && (ball || capsule));
    if (e.method.kind != method.kind && !wider) continue;
    out.push_back(known ? Volume<double>(*p.capsule) : fit_entry(i, p, how).volume);
  }
  return out;
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

double exact_gap(VolumeKind kind) {
  switch (kind) {
    case VolumeKind::obb:
      return k_box_gap;
    case VolumeKind::capsule:
      return k_capsule_gap;
    case VolumeKind::cylinder:
      return k_cylinder_gap;
    case VolumeKind::lozenge:
      return k_lozenge_gap;
    case VolumeKind::aabb:
    case VolumeKind::sphere:
    case VolumeKind::ellipsoid:
    case VolumeKind::kdop:
      break;
  }
  return std::numeric_limits<double>::infinity();
}

std::optional<FitMethod> kdop_method(std::string_view k) {
  if (!planes_of(k)) return std::nullopt;
  return FitMethod{VolumeKind::kdop, std::string(k), true, false};
}

Result<VolumeFitter> VolumeFitter::make(std::span<const Double3> points,
                                        std::span<const std::array<std::uint32_t, 3>> triangles) {
  auto cloud = make_point_cloud(points);
  if (!cloud) return std::unexpected(cloud.error());
  auto prepared = std::make_shared<Prepared>();
  prepared->points = points, prepared->triangles = triangles;
  prepared->cloud = std::move(*cloud);
  return VolumeFitter(std::move(prepared));
}

const PointCloud& VolumeFitter::cloud() const {
  return prepared_->cloud;
}
const ConvexHull& VolumeFitter::hull(const Deadline& deadline) const {
  return prepared_->hull(deadline);
}
bool VolumeFitter::has_hull() const {
  return prepared_->convex.has_value();
}
double VolumeFitter::hull_seconds() const {
  return prepared_->hull_seconds;
}

std::optional<FittedVolume> VolumeFitter::fit(const FitMethod& method, const FitOptions& options) const {
  const Prepared& p = *prepared_;
  if (method.on_hull) p.hull(options.deadline.share(2));
  const double start = now();
  const Fit fit = fit_by(method, p, options);
  const double fitted = now();
  // By the method alone: what is stored must not depend on what else was asked for.
  const bool by_corners = method.on_hull && p.hull().loss == 0;
  const std::span<const Double3> corners = by_corners ? std::span<const Double3>(p.corners) : p.points;
  const PointFrame& frame = p.cloud.frame;
  FittedVolume out;
  out.method = method;
  bool held = false;
  const auto keep_if_less = [&](const Volume<float>& stored, bool certified) {
    const VolumeMeasures measures = measures_of(to_double(stored));
    if (held && !(certified && measures.volume < out.measures.volume)) return;
    held = true;
    out.volume = stored, out.certified = certified, out.measures = measures;
  };
  const auto keep_enclosed = [&](const Volume<double>& v) {
    if (const auto enclosed = enclose(v, p.points, corners))
      keep_if_less(enclosed->volume, enclosed->certified);
  };
  keep_enclosed(placed(fit.volume, frame));
  // Rounding outward can turn the order, most where there is no thickness. Far larger ones need no rounding.
  constexpr double k_unit = 0x1p-23;
  const double worth = method.quick ? 1 : 2;  // quick methods are not to take twice the time
  const double reach = length(frame.origin) + 2 * frame.scale;
  for (const Volume<double>& cheaper : cheaper_fits(method, p, options)) {
    const Volume<double> v = placed(cheaper, frame);
    const VolumeMeasures before = measures_of(v);
    if (held && before.volume > worth * out.measures.volume + k_unit * reach * before.surface) continue;
    keep_enclosed(*as_kind(v, method.kind));
    if (kind_of(v) == method.kind) continue;
    // As it is stored in its own type it has other numbers, which round otherwise.
    const auto stored = enclose(v, p.points, corners);
    if (!stored) continue;
    if (const auto same = as_kind(stored->volume, method.kind))
      keep_if_less(*same, certify(*same, p.points).holds());
    else
      keep_enclosed(*as_kind(to_double(stored->volume), method.kind));
  }
  if (!held) return std::nullopt;
  if (method.kind == VolumeKind::sphere && method.least) {
    for (const std::uint32_t i : p.ball_support) out.support.push_back(p.points[i]);
    std::sort(out.support.begin(), out.support.end(), lexicographically_less);
  }
  // A whisker below, so that the roundings of the bound itself cannot put it above the truth.
  const double bound = std::max(fit.lower_bound * (1 - 1e-12), method.on_hull ? bound_of_hull(p) : 0);
  // What was rounded outward may have been drawn in, too, or be a cheaper fit.
  out.fitted = std::min(frame.volume_out(measures_of(fit.volume).volume), out.measures.volume);
  out.lower_bound = not_above(frame.volume_out(bound), out.fitted, out.measures, frame);
  out.seconds = fitted - start;
  out.certify_seconds = now() - fitted;
  return out;
}

void VolumeFitter::share_lower_bounds(std::span<FittedVolume> volumes) const {
  const PointFrame& frame = prepared_->cloud.frame;
  const double hull = has_hull() ? frame.volume_out(bound_of_hull(*prepared_)) : 0;
  for (FittedVolume& a : volumes) {
    const auto raise = [&](double bound) {
      a.lower_bound = std::max(a.lower_bound, not_above(bound, a.fitted, a.measures, frame));
    };
    raise(hull);
    for (const FittedVolume& b : volumes) {
      if (a.method.kind == b.method.kind && a.method.kind != VolumeKind::kdop) raise(b.lower_bound);
    }
  }
}

}  // namespace copse
