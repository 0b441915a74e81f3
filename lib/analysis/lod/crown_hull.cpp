#include "lib/analysis/lod/crown_hull.h"

#include "lib/analysis/measure/view_sphere.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace copse {
namespace {

// Of moves, each along one direction: a shape that fits is in after a few; one that does not fit is left.
constexpr int k_rounds = 8;
constexpr int k_subdivisions = 3;  // 642 directions, each with its opposite
constexpr int k_least_rows = 6, k_most_rows = 32;
constexpr float k_rounding = 1e-5f;  // widths: rows tell what is inside by more than this
constexpr float k_far = std::numeric_limits<float>::infinity();

// One of a direction and its opposite.
bool ahead(const Double3& d) {
  constexpr double k_zero = 1e-9;
  if (std::abs(d.z) > k_zero) return d.z > 0;
  return std::abs(d.y) > k_zero ? d.y > 0 : d.x > 0;
}

// One a pair of opposite directions.
const std::vector<Double3>& axes() {
  static const std::vector<Double3> all = [] {
    std::vector<Double3> some = view_sphere(k_subdivisions).directions;
    std::erase_if(some, [](const Double3& d) { return !ahead(d); });
    return some;
  }();
  return all;
}

template <class Four>
Four larger(const Four& a, const Four& b) {
  return a > b ? a : b;
}

template <class Four>
float largest_of(const Four& a) {
  return std::max({a[0], a[1], a[2], a[3]});
}

}  // namespace

CrownHull::CrownHull(std::span<const Double3> points, double reach) : reach_(reach) {
  if (points.empty()) return;
  low_ = points.front();
  for (const Double3& p : points)
    for (int a = 0; a < 3; ++a) low_[a] = std::min(low_[a], p[a]);
  measure(points);
  rows_a_side_ = std::clamp(static_cast<int>(std::cbrt(double(points.size()))), k_least_rows, k_most_rows);
  if (width_ > 0) measure_rows();
}

void CrownHull::measure(std::span<const Double3> points) {
  highest_.fill(Four{} + k_far), lowest_.fill(Four{} - k_far);
  std::array<std::vector<double>, 3> at;
  for (const Double3& p : points)
    for (int a = 0; a < 3; ++a) at[a].push_back(p[a] - low_[a]);
  std::array<double, k_axes> highest{}, lowest{};
  std::size_t axis = 0;
  for (const Double3& d : axes()) {
    double low = std::numeric_limits<double>::infinity(), high = -low;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double along = at[0][i] * d.x + at[1][i] * d.y + at[2][i] * d.z;
      low = along < low ? along : low, high = along > high ? along : high;
    }
    for (int a = 0; a < 3; ++a) axes_[a][axis / 4][axis % 4] = static_cast<float>(d[a]);
    highest[axis] = high, lowest[axis] = low, ++axis;
    width_ = std::max(width_, high - low);
  }
  const double scale = per_width();
  for (std::size_t k = 0; k < k_axes; ++k) {
    highest_[k / 4][k % 4] = static_cast<float>(highest[k] * scale);
    lowest_[k / 4][k % 4] = static_cast<float>(lowest[k] * scale);
  }
}

// Each half space cuts it.
CrownHull::Row CrownHull::row_at(float y, float z) const {
  const auto out = static_cast<float>(reach_) - k_rounding;
  Four first = Four{} - k_far, last = Four{} + k_far;
  for (std::size_t k = 0; k < k_fours; ++k) {
    const Four ax = axes_[0][k], off = y * axes_[1][k] + z * axes_[2][k];
    const Four high = highest_[k] + out - off, low = lowest_[k] - out - off;
    const Four per = 1 / ax;
    const Four one = high * per, other = low * per;
    const auto flat = (ax < 1e-6f) & (ax > -1e-6f), ahead = ax > 0;
    const auto outside = flat & ((high < 0) | (low > 0));
    const Four least = outside ? Four{} + k_far : flat ? first : ahead ? other : one;
    const Four most = flat ? last : ahead ? one : other;
    first = least > first ? least : first, last = most < last ? most : last;
  }
  return {largest_of(first), -largest_of(-last)};
}

void CrownHull::measure_rows() {
  // The coordinate axes are among the directions as good as; a row more on either side than the hull reaches.
  float high_y = 0, high_z = 0;
  for (std::size_t k = 0; k < k_axes; ++k) {
    high_y = std::max(high_y, highest_[k / 4][k % 4] * axes_[1][k / 4][k % 4]);
    high_z = std::max(high_z, highest_[k / 4][k % 4] * axes_[2][k / 4][k % 4]);
  }
  if (!(high_y > 0 && high_z > 0)) return;
  per_row_y_ = static_cast<float>(rows_a_side_) / high_y,
  per_row_z_ = static_cast<float>(rows_a_side_) / high_z;
  std::vector<Row> exact;
  for (int z = 0; z <= rows_a_side_; ++z)
    for (int y = 0; y <= rows_a_side_; ++y)
      exact.push_back(row_at(static_cast<float>(y) / per_row_y_, static_cast<float>(z) / per_row_z_));
  for (int z = 0; z < rows_a_side_; ++z)
    for (int y = 0; y < rows_a_side_; ++y) {
      const Row *a = &exact[std::size_t(z * (rows_a_side_ + 1) + y)], *b = a + rows_a_side_ + 1;
      rows_.push_back({std::max({a[0].first, a[1].first, b[0].first, b[1].first}),
                       std::min({a[0].last, a[1].last, b[0].last, b[1].last})});
    }
}

bool CrownHull::within_rows(std::span<const Double3> points) const {
  if (rows_.empty()) return false;
  const double scale = per_width();
  const auto size = static_cast<float>(rows_a_side_);
  for (const Double3& p : points) {
    const Float3 q = to_float((p - low_) * scale);
    const float y = q.y * per_row_y_, z = q.z * per_row_z_;
    if (!(y >= 0 && z >= 0 && y < size && z < size)) return false;
    const Row& row =
        rows_[static_cast<std::size_t>(static_cast<int>(z) * rows_a_side_ + static_cast<int>(y))];
    if (!(q.x >= row.first && q.x <= row.last)) return false;
  }
  return true;
}

bool CrownHull::fits(std::span<const Double3> points, double out) const {
  return !(width_ >= 0) || within_rows(points) || excess(points) <= out * width_;
}

std::optional<Double3> CrownHull::move_in(std::span<const Double3> points, double out, double target) const {
  if (!(width_ >= 0) || within_rows(points)) return Double3{};
  Reach reach;
  reach_of(points, reach);
  const auto is_in = [&] { return std::max(0.0, double(reach.most) / per_width()) <= out * width_; };
  if (is_in()) return Double3{};
  // What comes in at one end goes out at the other.
  Four widest = Four{} - k_far;
  for (std::size_t k = 0; k < k_fours; ++k) widest = larger(reach.along[k] + reach.against[k], widest);
  if (largest_of(widest) > 2.001 * out) return {};
  const Double3 moved = moved_back(reach, target * width_);
  return is_in() ? std::optional(moved) : std::nullopt;
}

void CrownHull::reach_of(std::span<const Double3> points, Reach& reach) const {
  reach.along.fill(Four{} - k_far), reach.against.fill(Four{} - k_far);
  const double scale = per_width();
  for (const Double3& p : points) {
    const Float3 q = to_float((p - low_) * scale);
    for (std::size_t k = 0; k < k_fours; ++k) {
      const Four at = q.x * axes_[0][k] + q.y * axes_[1][k] + q.z * axes_[2][k];
      reach.along[k] = larger(at - highest_[k], reach.along[k]);
      reach.against[k] = larger(lowest_[k] - at, reach.against[k]);
    }
  }
  find_most(reach);
}

void CrownHull::find_most(Reach& reach) {
  Four most = Four{} - k_far, other = most;
  for (std::size_t k = 0; k + 1 < k_fours; k += 2) {
    most = larger(larger(reach.along[k], reach.against[k]), most);
    other = larger(larger(reach.along[k + 1], reach.against[k + 1]), other);
  }
  if (k_fours % 2 == 1) most = larger(larger(reach.along.back(), reach.against.back()), most);
  reach.most = largest_of(larger(most, other)), reach.axis = 0, reach.sign = 1;
  for (std::size_t k = 0; k < k_fours; ++k) {
    const auto here = (reach.along[k] == reach.most) | (reach.against[k] == reach.most);
    if ((here[0] | here[1] | here[2] | here[3]) == 0) continue;
    std::size_t i = 0;
    while (here[i] == 0) ++i;
    reach.axis = 4 * k + i, reach.sign = reach.along[k][i] == reach.most ? 1.0f : -1.0f;
    return;
  }
}

Double3 CrownHull::way_back(std::span<const Double3> points, double margin) const {
  if (!(width_ >= 0) || (margin >= reach_ * width_ && within_rows(points))) return {};
  Reach reach;
  reach_of(points, reach);
  return moved_back(reach, margin);
}

Double3 CrownHull::moved_back(Reach& reach, double margin) const {
  Double3 moved{};
  for (int round = 0; round < k_rounds; ++round) {
    const double worst = reach.most * width_ - margin;
    if (!(worst > 0)) break;
    const std::size_t k = reach.axis / 4, i = reach.axis % 4;
    const Double3 axis{axes_[0][k][i], axes_[1][k][i], axes_[2][k][i]};
    const Double3 back = axis * (reach.sign * worst);
    moved -= back;
    const Float3 b = to_float(back * per_width());
    for (std::size_t d = 0; d < k_fours; ++d) {
      const Four by = b.x * axes_[0][d] + b.y * axes_[1][d] + b.z * axes_[2][d];
      reach.along[d] -= by, reach.against[d] += by;
    }
    find_most(reach);
  }
  return moved;
}

double CrownHull::excess(std::span<const Double3> points) const {
  if (!(width_ >= 0)) return 0;
  const double scale = per_width();
  Four most = Four{} - k_far;
  for (const Double3& p : points) {
    const Float3 q = to_float((p - low_) * scale);
    for (std::size_t k = 0; k < k_fours; ++k) {
      const Four at = q.x * axes_[0][k] + q.y * axes_[1][k] + q.z * axes_[2][k];
      most = larger(larger(at - highest_[k], lowest_[k] - at), most);
    }
  }
  return std::max(0.0, double(largest_of(most)) / scale);
}

}  // namespace copse
