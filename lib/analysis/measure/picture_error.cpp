#include "lib/analysis/measure/picture_error.h"

#include <algorithm>
#include <cmath>

namespace copse {
namespace {

double to_srgb(double v) {
  v = std::clamp(v, 0.0, 1.0);
  return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1 / 2.4) - 0.055;
}

// Neighbours are often of one triangle, or of none.
class Coder {
 public:
  const Double3& operator()(const Float3& linear) {
    if (linear != last_) last_ = linear, coded_ = {to_srgb(linear.x), to_srgb(linear.y), to_srgb(linear.z)};
    return coded_;
  }

 private:
  Float3 last_{};
  Double3 coded_{};
};

struct Coded {
  std::vector<Double3> rgb;
  std::vector<double> luma;
};

Coded code(const Picture& p) {
  Coded out;
  out.rgb.reserve(p.colour.size()), out.luma.reserve(p.colour.size());
  Coder coder;
  for (const Float3& c : p.colour) {
    out.rgb.push_back(coder(c));
    const Double3& s = out.rgb.back();
    out.luma.push_back(0.2126 * s.x + 0.7152 * s.y + 0.0722 * s.z);
  }
  return out;
}

constexpr int k_window = 8, k_step = 4;

double window_similarity(const Coded& a, const Coded& b, int width, int x0, int y0, int w, int h) {
  double sa = 0, sb = 0, saa = 0, sbb = 0, sab = 0;
  for (int y = y0; y < y0 + h; ++y) {
    for (int x = x0; x < x0 + w; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * width + x;
      const double p = a.luma[i], q = b.luma[i];
      sa += p, sb += q, saa += p * p, sbb += q * q, sab += p * q;
    }
  }
  const double n = w * h, ma = sa / n, mb = sb / n;
  const double va = saa / n - ma * ma, vb = sbb / n - mb * mb, cov = sab / n - ma * mb;
  constexpr double c1 = 0.01 * 0.01, c2 = 0.03 * 0.03;
  return (2 * ma * mb + c1) * (2 * cov + c2) / ((ma * ma + mb * mb + c1) * (va + vb + c2));
}

double similarity(const Coded& a, const Coded& b, int width, int height) {
  const int w = std::min(k_window, width), h = std::min(k_window, height);
  double sum = 0;
  std::size_t windows = 0;
  for (int y = 0; y + h <= height; y += k_step)
    for (int x = 0; x + w <= width; x += k_step, ++windows) sum += window_similarity(a, b, width, x, y, w, h);
  return windows > 0 ? sum / static_cast<double>(windows) : 1;
}

}  // namespace

PictureError picture_error(const Picture& a, const Picture& b) {
  if (a.width != b.width || a.height != b.height) return {1, 0};
  if (a.colour.empty()) return {};
  const Coded p = code(a), q = code(b);
  double sum = 0;
  for (std::size_t i = 0; i < p.rgb.size(); ++i) {
    const Double3 d = p.rgb[i] - q.rgb[i];
    sum += dot(d, d);
  }
  return {std::sqrt(sum / (3.0 * static_cast<double>(p.rgb.size()))), similarity(p, q, a.width, a.height)};
}

double picture_rmse(const Picture& a, const Picture& b) {
  if (a.width != b.width || a.height != b.height) return 1;
  if (a.colour.empty()) return 0;
  double sum = 0;
  Coder p, q;
  for (std::size_t i = 0; i < a.colour.size(); ++i) {
    if (a.colour[i] == b.colour[i]) continue;
    const Double3 d = p(a.colour[i]) - q(b.colour[i]);
    sum += dot(d, d);
  }
  return std::sqrt(sum / (3.0 * static_cast<double>(a.colour.size())));
}

}  // namespace copse
