#include "lib/analysis/ecosystem/pixel_distance.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace copse {
namespace {

constexpr double k_infinite = std::numeric_limits<double>::infinity();
constexpr std::uint32_t k_free = 0xffffffff, k_here = 0xfffffffe;

// The lower envelope of parabolas (x - i)^2 step^2 + f[i]: min over i, for every x.
class Envelope {
 public:
  void transform(const std::vector<double>& f, double step, std::vector<double>& out) {
    const std::size_t n = f.size();
    out.assign(n, k_infinite);
    at_.assign(n, 0);
    border_.assign(n + 1, 0);
    if (!find(f, step * step)) return;
    std::size_t j = 0;
    for (std::size_t q = 0; q < n; ++q) {
      while (border_[j + 1] < static_cast<double>(q)) ++j;
      const double d = (static_cast<double>(q) - static_cast<double>(at_[j])) * step;
      out[q] = d * d + f[at_[j]];
    }
  }

 private:
  // Which parabola is the lowest up to which border; false when there is none.
  bool find(const std::vector<double>& f, double s2) {
    std::size_t k = 0;
    bool any = false;
    for (std::size_t q = 0; q < f.size(); ++q) {
      if (f[q] == k_infinite) continue;
      if (!any) {
        any = true;
        at_[0] = q;
        border_[0] = -k_infinite;
        border_[1] = k_infinite;
        continue;
      }
      double cut = 0;
      while (true) {
        const auto p = static_cast<double>(at_[k]), x = static_cast<double>(q);
        cut = ((f[q] - f[at_[k]]) / s2 + x * x - p * p) / (2 * (x - p));
        if (cut > border_[k] || k == 0) break;
        --k;
      }
      if (cut > border_[k]) border_[++k] = cut;
      at_[k] = q;
      border_[k + 1] = k_infinite;
    }
    return any;
  }

  std::vector<std::size_t> at_;
  std::vector<double> border_;
};

std::vector<float> middle_to_middle(const ValueMap& map, double side_x, double side_z) {
  std::vector<double> squares(map.values.size()), line, out;
  for (std::size_t i = 0; i < squares.size(); ++i) squares[i] = map.values[i] >= 0.5f ? 0 : k_infinite;
  Envelope envelope;
  line.resize(map.height);
  for (std::uint32_t c = 0; c < map.width; ++c) {
    for (std::uint32_t r = 0; r < map.height; ++r) line[r] = squares[std::size_t{r} * map.width + c];
    envelope.transform(line, side_z, out);
    for (std::uint32_t r = 0; r < map.height; ++r) squares[std::size_t{r} * map.width + c] = out[r];
  }
  std::vector<float> result(map.values.size());
  for (std::uint32_t r = 0; r < map.height; ++r) {
    const auto row = squares.begin() + static_cast<std::ptrdiff_t>(std::size_t{r} * map.width);
    line.assign(row, row + map.width);
    envelope.transform(line, side_x, out);
    for (std::uint32_t c = 0; c < map.width; ++c)
      result[std::size_t{r} * map.width + c] = static_cast<float>(std::sqrt(out[c]));
  }
  return result;
}

std::vector<std::uint32_t> nearest_in_rows(const ValueMap& map) {
  std::vector<std::uint32_t> out(map.values.size(), k_free);
  for (std::uint32_t r = 0; r < map.height; ++r) {
    const auto marked = [&](std::uint32_t c) { return map.values[std::size_t{r} * map.width + c] >= 0.5f; };
    std::uint32_t* row = out.data() + std::size_t{r} * map.width;
    std::uint32_t left = k_free;
    for (std::uint32_t c = 0; c < map.width; ++c) {
      if (marked(c)) left = c;
      if (left != k_free) row[c] = left == c ? k_here : 2 * (c - left - 1);
    }
    std::uint32_t right = k_free;
    for (std::uint32_t c = map.width; c-- > 0;) {
      if (marked(c)) right = c;
      // As far to both sides: the left one, and the right one is at most half a pixel nearer (see exact()).
      if (right != k_free && right != c && 2 * (right - c - 1) + 1 < row[c]) row[c] = 2 * (right - c - 1) + 1;
    }
  }
  return out;
}

}  // namespace

// The pixel that holds a place, and the way from its lower corner, in metres.
struct PixelDistance::Place {
  std::uint32_t column = 0, row = 0;
  double x = 0, z = 0;
};

PixelDistance::PixelDistance(const ValueMap& map, const PlantedArea& area)
    : area_(area), width_(map.width), height_(map.height) {
  if (map.values.empty()) return;
  side_x_ = area.width() / map.width;
  side_z_ = area.depth() / map.height;
  middles_ = middle_to_middle(map, side_x_, side_z_);
  in_row_ = nearest_in_rows(map);
}

PixelDistance::Place PixelDistance::place_of(double x, double z) const {
  const double u = std::clamp(x, area_.x0, area_.x1) - area_.x0,
               v = std::clamp(z, area_.z0, area_.z1) - area_.z0;
  Place p;
  p.column = std::min(static_cast<std::uint32_t>(u / side_x_), width_ - 1);
  p.row = std::min(static_cast<std::uint32_t>(v / side_z_), height_ - 1);
  p.x = std::clamp(u - p.column * side_x_, 0.0, side_x_);
  p.z = std::clamp(v - p.row * side_z_, 0.0, side_z_);
  return p;
}

double PixelDistance::exact(const Place& p) const {
  double best = k_infinite;
  const auto take_row = [&](std::uint32_t row, double dz) {
    const std::uint32_t n = in_row_[std::size_t{row} * width_ + p.column];
    if (n == k_free) return;
    double dx = 0;
    if (n != k_here) {
      // A pixel of as many between may wait on the other side: no farther than this one by a pixel, no nearer
      // than by what the place is off the middle. Looked up where it would be.
      const std::uint32_t between = n / 2;
      const bool right = n % 2 == 1;
      dx = between * side_x_ + (right ? side_x_ - p.x : p.x);
      const std::uint64_t mirror = std::uint64_t{p.column} + between + 1;
      if (!right && mirror < width_ && in_row_[std::size_t{row} * width_ + mirror] == k_here)
        dx = std::min(dx, between * side_x_ + side_x_ - p.x);
    }
    best = std::min(best, dx * dx + dz * dz);
  };
  take_row(p.row, 0);
  for (std::uint32_t k = 1; k < height_; ++k) {
    const double above = (k - 1) * side_z_ + p.z, below = (k - 1) * side_z_ + side_z_ - p.z;
    if (std::min(above, below) * std::min(above, below) >= best) break;
    if (k <= p.row) take_row(p.row - k, above);
    if (p.row + k < height_) take_row(p.row + k, below);
  }
  return std::sqrt(best);
}

double PixelDistance::at(double x, double z) const {
  if (middles_.empty()) return k_infinite;
  const Place p = place_of(x, z);
  return std::isinf(middles_[std::size_t{p.row} * width_ + p.column]) ? k_infinite : exact(p);
}

bool PixelDistance::is_within(double x, double z, double least, double most) const {
  if (middles_.empty()) return k_infinite >= least && k_infinite <= most;
  const Place p = place_of(x, z);
  const auto middle = static_cast<double>(middles_[std::size_t{p.row} * width_ + p.column]);
  if (std::isinf(middle)) return middle >= least && middle <= most;
  // From the place to the middle of its pixel, and from that of the marked one to its nearest point, it is at
  // most half a diagonal each; and a float's rounding.
  const double off = std::sqrt(side_x_ * side_x_ + side_z_ * side_z_) + 1e-6 * middle;
  if (middle - off >= least && middle + off <= most) return true;
  if (middle + off < least || middle - off > most) return false;
  const double d = exact(p);
  return d >= least && d <= most;
}

}  // namespace copse
