#include "lib/runtime/camera_path.h"

#include <algorithm>
#include <numbers>
#include <string>

namespace copse {

namespace {

// Cubic Hermite from a to b, s in [0, 1], tangents already scaled by the length of the interval.
template <class T>
T hermite(const T& a, const T& b, const T& ta, const T& tb, double s) {
  const double s2 = s * s, s3 = s2 * s;
  return a * (2 * s3 - 3 * s2 + 1) + ta * (s3 - 2 * s2 + s) + b * (3 * s2 - 2 * s3) + tb * (s3 - s2);
}

// The tangent at key i: of the parabola through it and its neighbours (of the chord at the ends).
template <class T, class Value>
T tangent(const std::vector<PathKey>& keys, std::size_t i, const Value& value) {
  const auto slope = [&](std::size_t a, std::size_t b) {
    return (value(keys[b].camera) - value(keys[a].camera)) * (1 / (keys[b].time - keys[a].time));
  };
  if (i == 0) return slope(0, 1);
  if (i + 1 == keys.size()) return slope(i - 1, i);
  const double before = keys[i].time - keys[i - 1].time, after = keys[i + 1].time - keys[i].time;
  return slope(i - 1, i) * (after / (before + after)) + slope(i, i + 1) * (before / (before + after));
}

constexpr double k_advance = 0.9;  // of the way to the target
constexpr double k_zigzag = std::numbers::pi / 4;

Camera turned(const Camera& camera, double angle) {
  Camera c = camera;
  const Double3 arm = camera.eye - camera.target;
  const double co = std::cos(angle), si = std::sin(angle);
  c.eye = camera.target + Double3{arm.x * co + arm.z * si, arm.y, arm.z * co - arm.x * si};
  return c;
}

}  // namespace

CameraPath CameraPath::still(const Camera& camera) {
  return {Kind::still, {{0, camera}}};
}

CameraPath CameraPath::orbit(const Camera& camera) {
  return {Kind::orbit, {{0, camera}}};
}

CameraPath CameraPath::linear(const Camera& camera) {
  return {Kind::linear, {{0, camera}}};
}

CameraPath CameraPath::zigzag(const Camera& camera) {
  return {Kind::zigzag, {{0, camera}}};
}

Result<CameraPath> CameraPath::through(std::vector<PathKey> keys) {
  if (keys.empty()) return refuse("", "the path has no keys", "give at least one");
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const std::string name = "key " + std::to_string(i);
    if (!is_valid(keys[i].camera)) {
      return refuse("", name + " has no line of sight",
                    "keep eye and target apart and finite, and fov between 0 and 180 degrees");
    }
    if (!std::isfinite(keys[i].time) || (i && !(keys[i].time > keys[i - 1].time))) {
      return refuse("", name + " is not later than the one before", "sort the keys by time");
    }
  }
  return CameraPath(Kind::keys, std::move(keys));
}

Camera CameraPath::at(double t) const {
  const Camera& first = keys_.front().camera;
  switch (kind_) {
    case Kind::still:
      return first;
    case Kind::orbit:
      return turned(first, 2 * std::numbers::pi * t);
    case Kind::zigzag:
      return on_leg(t);
    case Kind::linear: {
      Camera c = first;
      const Double3 step = (first.target - first.eye) * (k_advance * t);
      c.eye += step;
      c.target += step;
      return c;
    }
    case Kind::keys:
      return between_keys(t);
  }
  return first;
}

Camera CameraPath::on_leg(double t) const {
  const Camera& first = keys_.front().camera;
  const Double3 sight = first.target - first.eye;
  // Three legs, each longer than its share of the way by 1 / cos(45 degrees).
  const auto leg = [&](int i) {
    const Camera there = turned({.eye = sight, .target = {}}, i == 1 ? -k_zigzag : k_zigzag);
    return there.eye;
  };
  const int now = std::clamp(static_cast<int>(3 * t), 0, 2);
  const double stretch = k_advance / std::cos(k_zigzag);
  Camera c = first;
  for (int i = 0; i < now; ++i) c.eye += leg(i) * (stretch / 3);
  c.eye += leg(now) * (stretch * (t - now / 3.0));
  c.target = c.eye + leg(now);
  return c;
}

Camera CameraPath::between_keys(double t) const {
  if (keys_.size() == 1) return keys_.front().camera;
  const double time = keys_.front().time + t * (keys_.back().time - keys_.front().time);
  const auto after = std::upper_bound(keys_.begin() + 1, keys_.end() - 1, time,
                                      [](double value, const PathKey& key) { return value < key.time; });
  const auto b = static_cast<std::size_t>(after - keys_.begin()), a = b - 1;
  const double span = keys_[b].time - keys_[a].time;
  const double s = std::clamp((time - keys_[a].time) / span, 0.0, 1.0);
  const auto vector = [&](auto member) {
    const auto value = [&](const Camera& c) { return c.*member; };
    return hermite(value(keys_[a].camera), value(keys_[b].camera), tangent<Double3>(keys_, a, value) * span,
                   tangent<Double3>(keys_, b, value) * span, s);
  };
  Camera c = keys_[a].camera;
  c.eye = vector(&Camera::eye);
  c.target = vector(&Camera::target);
  c.up = vector(&Camera::up);
  // Linear, because a spline may overshoot out of (0, pi).
  c.fov = keys_[a].camera.fov * (1 - s) + keys_[b].camera.fov * s;
  return c;
}

double CameraPath::moment(std::size_t frame, std::size_t count) const {
  const std::size_t steps = closed() ? count : count - std::min<std::size_t>(count, 1);
  return steps ? static_cast<double>(frame) / static_cast<double>(steps) : 0;
}

}  // namespace copse
