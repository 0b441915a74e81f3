// fit_volumes: every method by its name, from points to a certified volume in float32.
//
// One fitter prepares a set of points once for all methods that are asked of it: the frame, and the hull when
// a method first needs it. What a method gives is rounded outward and proven on all points (enclose.h), so
// every result contains them as stored.
//
// Source: digest 002, section 4, and its checklist; the methods are in headers of their own.
#pragma once

#include "lib/analysis/hull/convex_hull.h"
#include "lib/analysis/hull/deadline.h"
#include "lib/analysis/volumes/volume_measures.h"
#include "lib/formats/result.h"
#include "lib/formats/volumes/volume_numbers.h"

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace copse {

enum class FitQuality {
  fast,      // closed forms and principal axes
  balanced,  // a global search for the least volume
  exact,     // the search, and a lower bound that proves how near it comes
};

struct FitMethod {
  VolumeKind kind = VolumeKind::aabb;
  std::string name;      // of this kind: "minimal"; of a k-DOP its k
  bool quick = false;    // closed form or principal axes: constant time a point
  bool least = false;    // the one of its kind that gives the least volume
  bool on_hull = false;  // needs the convex hull, whose time is not in the fit's; the others go by all points
  friend bool operator==(const FitMethod&, const FitMethod&) = default;
};

// All of them, by kind, the cheapest first.
std::span<const FitMethod> fit_methods();

// The method of a k-DOP with any even k from 6 to k_most_planes.
inline constexpr int k_most_planes = 512;
std::optional<FitMethod> kdop_method(std::string_view k);

// What FitQuality::exact proves of the searches: the volume is at most (1 + gap) times the least. Infinite
// for types whose least volume is known as it is (and then proven to rounding).
double exact_gap(VolumeKind kind);

struct FitOptions {
  FitQuality quality = FitQuality::balanced;
  // Searches end at this time, with the best they have, and go on to a proof when there is time left. Even
  // when it has passed every method gives a volume, and that it contains the points is always proven. Without
  // one the limits are those of the searches themselves, which do not depend on the machine.
  Deadline deadline = {};
};

struct FittedVolume {
  FitMethod method;
  Volume<float> volume;
  VolumeMeasures measures;  // of the volume as stored
  // Interior volume of the fit in double, before it was rounded outward to float32; at most that of
  // `measures`. What is above lower_bound is the fit's gap, what `measures` has more is float32's.
  double fitted = 0;
  double lower_bound = 0;  // of the interior volume of any volume of this kind round the points; 0: unknown
  bool certified = false;
  std::vector<Double3> support;  // of the minimal sphere: the points that hold it, in lexicographic order
  double seconds = 0;            // of CPU time, for the fit alone; the hull is shared
  double certify_seconds = 0;    // for rounding it outward and proving it
};

class VolumeFitter {
 public:
  // `triangles` (indices into points) are for the method that weighs the surface; without them it falls back
  // on the vertices. The span of points must outlive the fitter. Refused: no points, coordinates that are not
  // finite or that float32 cannot hold.
  static Result<VolumeFitter> make(std::span<const Double3> points,
                                   std::span<const std::array<std::uint32_t, 3>> triangles = {});

  const PointCloud& cloud() const;

  // Built when it is first asked for, by this or by a method that needs it; with the deadline of that time.
  const ConvexHull& hull(const Deadline& deadline = {}) const;
  bool has_hull() const;
  double hull_seconds() const;  // that it took; 0: it was not needed

  // None when float32 cannot hold the volume (a ball round points near 3.4e38).
  std::optional<FittedVolume> fit(const FitMethod& method, const FitOptions& options = {}) const;

  // A bound proven for one volume of a kind holds for all of that kind round the same points, and the volume
  // of a hull that was built for all kinds: gives each the best.
  void share_lower_bounds(std::span<FittedVolume> volumes) const;

  struct Prepared;

 private:
  explicit VolumeFitter(std::shared_ptr<Prepared> prepared) : prepared_(std::move(prepared)) {}
  std::shared_ptr<Prepared> prepared_;
};

}  // namespace copse
