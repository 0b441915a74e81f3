#include "lib/analysis/boxes/box_search.h"

#include "lib/analysis/boxes/minimal_rectangle.h"
#include "lib/analysis/hull/principal_axes.h"

#include <algorithm>
#include <cmath>

namespace copse {
namespace {

constexpr int k_rotations = 256;                // of the fixed set of starts
constexpr int k_facets = 12;                    // the largest, each a start
constexpr std::size_t k_kept = 24;              // starts that are descended from
constexpr std::size_t k_ends = 3;               // of them are descended to the end
constexpr double k_apart = 0.05;                // rad; starts nearer to each other than this are one
constexpr double k_gain = 1e-12;                // relative; less is rounding
constexpr double k_zone = 0.41421356237309515;  // tan(pi / 8): half the side of the zone of rotations

// Axes of a cube are the same after any of its 24 rotations; every frame is one of them turned by a Rodrigues
// vector in this zone: |x|, |y|, |z| <= tan(pi / 8), |x| + |y| + |z| <= 1.
bool in_zone(const Double3& v) {
  return std::abs(v.x) + std::abs(v.y) + std::abs(v.z) <= 1;
}

// How far two frames are apart, as sets of lines: the largest angle between an axis and the nearest of the
// other's.
double angle_between(const Axes& a, const Axes& b) {
  double worst = 1;
  for (const Double3& u : a) {
    double nearest = 0;
    for (const Double3& v : b) nearest = std::max(nearest, std::abs(dot(u, v)));
    worst = std::min(worst, nearest);
  }
  return std::acos(std::min(1.0, worst));
}

class Simplex {
 public:
  Simplex(const VertexWidths& widths, const FrameVolume& start, double step)
      : widths_(widths), base_(start.axes), points_{{{{}, start.volume}}} {
    std::array<double, 3> w;
    for (int i = 0; i < 3; ++i) w[i] = widths.along(start.axes[i]);
    for (int i = 0; i < 3; ++i) {
      // Turning about axis i adds to the smaller of the two other widths about the angle times the larger.
      const double j = w[(i + 1) % 3], k = w[(i + 2) % 3];
      const double ratio = std::max(j, k) > 0 ? std::min(j, k) / std::max(j, k) : 1;
      scale_[i] = std::max(ratio, 1e-14);
    }
    for (int i = 0; i < 3; ++i) {
      Double3 at;
      at[i] = step * (i == 1 ? -1 : 1);
      points_[i + 1] = evaluate(at);
    }
  }

  void run(int evaluations) {
    evaluations_ = 4;
    while (evaluations_ < evaluations) {
      std::stable_sort(points_.begin(), points_.end(),
                       [](const Point& a, const Point& b) { return a.value < b.value; });
      if (points_[3].value - points_[0].value <= k_gain * points_[0].value && spread() < 1e-6) break;
      if (spread() < 1e-11) break;
      step();
    }
  }

  FrameVolume best() const {
    const Point& p = *std::min_element(points_.begin(), points_.end(),
                                       [](const Point& a, const Point& b) { return a.value < b.value; });
    return {frame(p.at), p.value};
  }

 private:
  struct Point {
    Double3 at;
    double value = 0;
  };

  Axes frame(const Double3& at) const {
    return rotated(base_, {at.x * scale_[0], at.y * scale_[1], at.z * scale_[2]});
  }
  Point evaluate(const Double3& at) {
    ++evaluations_;
    return {at, widths_.volume(frame(at))};
  }
  double spread() const {
    double s = 0;
    for (int i = 1; i < 4; ++i) s = std::max(s, distance(points_[i].at, points_[0].at));
    return s;
  }
  void step() {
    const Double3 middle = (points_[0].at + points_[1].at + points_[2].at) / 3;
    const auto towards = [&](double t) { return evaluate(middle + (points_[3].at - middle) * t); };
    const Point reflected = towards(-1);
    if (reflected.value < points_[0].value) {
      const Point expanded = towards(-2);
      points_[3] = expanded.value < reflected.value ? expanded : reflected;
    } else if (reflected.value < points_[2].value) {
      points_[3] = reflected;
    } else {
      const Point contracted = reflected.value < points_[3].value ? towards(-0.5) : towards(0.5);
      if (contracted.value < std::min(reflected.value, points_[3].value)) {
        points_[3] = contracted;
      } else {
        for (int i = 1; i < 4; ++i) points_[i] = evaluate((points_[i].at + points_[0].at) / 2);
      }
    }
  }

  const VertexWidths& widths_;
  Axes base_;
  std::array<double, 3> scale_{};
  std::array<Point, 4> points_;
  int evaluations_ = 0;
};

void add_facets(const ConvexHull& hull, std::vector<Axes>& starts) {
  struct Facet {
    double area;
    Double3 normal;
  };
  std::vector<Facet> facets;
  for (const auto& f : hull.faces) {
    const Double3& a = hull.vertices[f[0]];
    const Double3 n = cross(hull.vertices[f[1]] - a, hull.vertices[f[2]] - a);
    facets.push_back({length(n), n});
  }
  const std::size_t kept = std::min<std::size_t>(facets.size(), k_facets);
  std::stable_sort(facets.begin(), facets.end(),
                   [](const Facet& a, const Facet& b) { return a.area > b.area; });
  for (std::size_t i = 0; i < kept; ++i) {
    if (!(facets[i].area > 0)) continue;
    const Double3 n = normalized(facets[i].normal);
    starts.push_back(turned_to_rectangle(hull.vertices, axes_along(n, any_normal(n)), 0));
  }
}

// Additive recurrence of the plastic number's powers: evenly spread for any count.
void add_rotations(const Axes& base, std::vector<Axes>& starts) {
  constexpr double k_plastic = 1.2207440846057596;  // x^4 = x + 1
  Double3 t{0.5, 0.5, 0.5};
  for (int i = 0; i < k_rotations; ++i) {
    double power = 1;
    for (int k = 0; k < 3; ++k) {
      power /= k_plastic;
      t[k] += power;
      t[k] -= std::floor(t[k]);
    }
    const Double3 v = (t * 2 - Double3{1, 1, 1}) * k_zone;
    if (in_zone(v)) starts.push_back(rotated(base, v));
  }
}

std::vector<FrameVolume> starts_for(const ConvexHull& hull, const VertexWidths& widths,
                                    const Deadline& deadline) {
  std::vector<Axes> starts{k_world_axes, hull.axes, principal_axes(hull.vertices).axes,
                           principal_axes(hull.vertices, hull.faces).axes};
  for (std::size_t i = 0; i < 4 && !deadline.has_passed(); ++i) {
    for (int k = 0; k < 3; ++k) starts.push_back(turned_to_rectangle(hull.vertices, starts[i], k));
  }
  if (!deadline.has_passed()) add_facets(hull, starts);
  if (!deadline.has_passed()) add_rotations(hull.axes, starts);
  std::vector<FrameVolume> valued;
  for (const Axes& a : starts) {
    if (valued.size() >= 4 && deadline.has_passed()) break;
    valued.push_back({a, widths.volume(a)});
  }
  std::stable_sort(valued.begin(), valued.end(),
                   [](const FrameVolume& a, const FrameVolume& b) { return a.volume < b.volume; });
  return valued;
}

// The first `count` of sorted frames that are not near an earlier one.
std::vector<FrameVolume> spread_out(const std::vector<FrameVolume>& sorted, std::size_t count) {
  std::vector<FrameVolume> kept;
  for (const FrameVolume& f : sorted) {
    if (kept.size() == count) break;
    const bool near = std::any_of(kept.begin(), kept.end(), [&](const FrameVolume& k) {
      return angle_between(k.axes, f.axes) < k_apart;
    });
    if (!near) kept.push_back(f);
  }
  return kept;
}

}  // namespace

Axes turned_to_rectangle(std::span<const Double3> vertices, const Axes& axes, int i) {
  const Double3 &n = axes[i], &u = axes[(i + 1) % 3], &v = axes[(i + 2) % 3];
  std::vector<Double2> flat;
  flat.reserve(vertices.size());
  for (const Double3& p : vertices) flat.push_back({dot(p, u), dot(p, v)});
  const Double2 along = minimal_rectangle(hull_of_plane(flat)).along;
  Axes turned;
  turned[i] = n;
  turned[(i + 1) % 3] = u * along.x + v * along.y;
  turned[(i + 2) % 3] = v * along.x - u * along.y;
  return turned;
}

FrameVolume simplex_descent(const VertexWidths& widths, const FrameVolume& start, double step,
                            int evaluations) {
  Simplex simplex(widths, start, step);
  simplex.run(evaluations);
  return simplex.best();
}

FrameVolume descend(std::span<const Double3> vertices, const VertexWidths& widths, const FrameVolume& start) {
  FrameVolume best = start;
  for (int round = 0; round < 20; ++round) {
    const double before = best.volume;
    for (int i = 0; i < 3; ++i) {
      const Axes turned = turned_to_rectangle(vertices, best.axes, i);
      const double volume = widths.volume(turned);
      if (volume < best.volume) best = {turned, volume};
    }
    const FrameVolume lower = simplex_descent(widths, best, round % 2 == 0 ? 0.1 : 0.005, 200);
    if (lower.volume < best.volume) best = lower;
    if (round % 2 == 1 && !(best.volume < before * (1 - 1e-9))) break;
  }
  return best;
}

FrameVolume search_box(const ConvexHull& hull, const VertexWidths& widths, const Deadline& deadline) {
  const FrameVolume world{k_world_axes, widths.volume(k_world_axes)};
  std::vector<FrameVolume> ends;
  for (const FrameVolume& start : spread_out(starts_for(hull, widths, deadline), k_kept)) {
    ends.push_back(deadline.has_passed() ? start : simplex_descent(widths, start, 0.25, 80));
  }
  std::stable_sort(ends.begin(), ends.end(),
                   [](const FrameVolume& a, const FrameVolume& b) { return a.volume < b.volume; });
  FrameVolume best = world;
  for (const FrameVolume& end : spread_out(ends, k_ends)) {
    const FrameVolume low = deadline.has_passed() ? end : descend(hull.vertices, widths, end);
    // The world's axes, when they are as good, are exact.
    if (low.volume < best.volume * (1 - k_gain)) best = low;
  }
  return best;
}

}  // namespace copse
