#include "lib/analysis/swept/capsule.h"

#include "lib/analysis/hull/principal_axes.h"
#include "lib/analysis/swept/swept_search.h"

#include <algorithm>
#include <vector>

namespace copse {
namespace {

class FromSegment {
 public:
  explicit FromSegment(const Capsule<double>& c) : a_(c.a), d_(c.b - c.a), square_(dot(d_, d_)) {}
  double squared(const Double3& p) const {
    const Double3 q = p - a_;
    const double s = square_ > 0 ? std::clamp(dot(q, d_) / square_, 0.0, 1.0) : 0;
    const Double3 rest = q - d_ * s;
    return dot(rest, rest);
  }

 private:
  Double3 a_, d_;
  double square_;
};

}  // namespace

double interior_volume(const Capsule<double>& c) {
  return swept_volume({distance(c.a, c.b), 0, c.radius});
}

double distance_from_segment(const Capsule<double>& c, const Double3& p) {
  return std::sqrt(FromSegment(c).squared(p));
}

Capsule<double> enclosing(Capsule<double> c, std::span<const Double3> points) {
  const FromSegment from(c);
  double square = 0;
  for (const Double3& p : points) square = std::max(square, from.squared(p));
  c.radius = std::sqrt(square);
  return c;
}

Capsule<double> capsule_on_line(std::span<const Double3> points, const Double3& on_line,
                                const Double3& direction) {
  struct Place {
    double height, square;  // along the line; of the distance from it
  };
  const Double3 w = normalized(direction);
  std::vector<Place> places;
  places.reserve(points.size());
  double square = 0, reach = 0;
  for (const Double3& p : points) {
    const Double3 q = p - on_line, across = cross(q, w);
    places.push_back({dot(q, w), dot(across, across)});
    square = std::max(square, places.back().square), reach = std::max(reach, std::abs(places.back().height));
  }
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Place& p : places) {
    if (p.height >= low && p.height <= high) continue;  // it reaches neither end
    const double half = std::sqrt(std::max(0.0, square - p.square));
    low = std::min(low, p.height + half), high = std::max(high, p.height - half);
  }
  if (high < low) low = high = (low + high) / 2;
  const Capsule<double> line{on_line + w * low, on_line + w * high, 0};
  // The radius is that of the inequality: of the points that may have the largest, but for rounding.
  const auto squared = [&](const Place& p) {
    const double beyond = p.height - std::clamp(p.height, low, high);
    return p.square + beyond * beyond;
  };
  double most = 0;
  for (const Place& p : places) most = std::max(most, squared(p));
  const double lost = (length(on_line) + reach + std::sqrt(most)) * 0x1p-40;
  const double least = std::max(0.0, std::sqrt(most) - lost);
  std::vector<Double3> outermost;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (squared(places[i]) >= least * least) outermost.push_back(points[i]);
  }
  return enclosing(line, outermost);
}

Capsule<double> least_squares_capsule(std::span<const Double3> points) {
  if (points.empty()) return {};
  const PrincipalAxes frame = principal_axes(points);
  return capsule_on_line(points, frame.mean, frame.axes[0]);
}

Capsule<double> projected_circle_capsule(std::span<const Double3> points, const Deadline& deadline) {
  if (points.empty()) return {};
  const SweptFit line = search_around(Swept::line, points, deadline);
  const SweptRectangle& s = line.rectangle;
  const Double3 middle = out_of(line.frame, {(s.a0 + s.a1) / 2, s.b0, s.h});
  return capsule_on_line(points, middle, line.frame[0]);
}

}  // namespace copse
