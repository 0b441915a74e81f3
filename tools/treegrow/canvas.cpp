#include "tools/treegrow/canvas.h"

#include "lib/formats/random.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <utility>

namespace copse::grow {
namespace {

// By table: of each of 65536 steps of linear light, the nearest of sRGB's 256.
std::uint8_t to_srgb(double linear) {
  static const std::vector<std::uint8_t> table = [] {
    std::vector<std::uint8_t> t(65536);
    for (std::size_t i = 0; i < t.size(); ++i) {
      const double c = static_cast<double>(i) / 65535;
      const double s = c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055;
      t[i] = static_cast<std::uint8_t>(std::lround(255 * s));
    }
    return t;
  }();
  return table[static_cast<std::size_t>(std::lround(65535 * std::clamp(linear, 0.0, 1.0)))];
}

double as_unit(std::uint64_t bits) {
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

}  // namespace

Canvas::Canvas(int size)
    : size_(size), pixels_(static_cast<std::size_t>(size) * static_cast<std::size_t>(size)) {}

void Canvas::over(int x, int y, const Double3& colour, double cover) {
  if (x < 0 || y < 0 || x >= size_ || y >= size_) return;
  Pixel& p = at(x, y);
  p.colour = p.colour * (1 - cover) + colour * cover;
  p.cover = p.cover * (1 - cover) + cover;
}

void Canvas::put_quarter(int quarter, const Canvas& other) {
  const int dx = quarter % 2 * other.size_, dy = quarter / 2 * other.size_;
  for (int y = 0; y < other.size_; ++y)
    for (int x = 0; x < other.size_; ++x) at(x + dx, y + dy) = other.at(x, y);
}

Canvas Canvas::halved() const {
  Canvas half(size_ / 2);
  for (int y = 0; y < half.size_; ++y) {
    for (int x = 0; x < half.size_; ++x) {
      Pixel& p = half.at(x, y);
      for (int i = 0; i < 4; ++i) {
        const Pixel& q = at(2 * x + i % 2, 2 * y + i / 2);
        p.colour += q.colour * 0.25;
        p.cover += q.cover * 0.25;
      }
    }
  }
  return half;
}

Image Canvas::image(bool with_alpha) const {
  // Coarser and coarser pictures, until one has colour where this one has none.
  std::vector<Canvas> coarser;
  for (const Canvas* c = this; with_alpha && c->size_ > 1; c = &coarser.back())
    coarser.push_back(c->halved());
  Image image{size_, size_, {}, with_alpha};
  image.rgba.reserve(pixels_.size() * 4);
  for (int y = size_ - 1; y >= 0; --y) {
    for (int x = 0; x < size_; ++x) {
      Pixel p = at(x, y);
      const double cover = p.cover;
      for (std::size_t i = 0; i < coarser.size() && p.cover < 1e-3; ++i)
        p = coarser[i].at(x >> (i + 1), y >> (i + 1));
      const Double3 colour = p.cover > 0 ? p.colour / p.cover : Double3{};
      for (int c = 0; c < 3; ++c) image.rgba.push_back(to_srgb(colour[c]));
      image.rgba.push_back(
          with_alpha ? static_cast<std::uint8_t>(std::lround(255 * std::clamp(cover, 0.0, 1.0))) : 255);
    }
  }
  return image;
}

Image beside(const Image& left, const Image& right) {
  Image both{left.width + right.width, left.height, {}, left.has_alpha || right.has_alpha};
  for (int y = 0; y < left.height; ++y)
    for (const Image* image : {&left, &right}) {
      const auto row = image->rgba.begin() + static_cast<std::ptrdiff_t>(y) * image->width * 4;
      both.rgba.insert(both.rgba.end(), row, row + static_cast<std::ptrdiff_t>(image->width) * 4);
    }
  return both;
}

std::uint64_t Noise::lattice(int x, int y, int px, int py) const {
  const auto wrap = [](int v, int p) { return static_cast<std::uint64_t>((v % p + p) % p); };
  return Random::mix(seed_ ^ Random::mix(wrap(x, px) * 0x9e3779b97f4a7c15u + wrap(y, py) + 1));
}

double Noise::smooth(double x, double y, int px, int py) const {
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  const double u = x - i, v = y - j;
  // Gradient noise: at each lattice point one of 64 slopes.
  static const std::vector<std::pair<double, double>> slopes = [] {
    std::vector<std::pair<double, double>> all;
    for (int k = 0; k < 64; ++k)
      all.emplace_back(std::cos(k * std::numbers::pi / 32), std::sin(k * std::numbers::pi / 32));
    return all;
  }();
  const auto slope = [&](int a, int b) {
    const auto& [c, s] = slopes[lattice(i + a, j + b, px, py) >> 58];
    return c * (u - a) + s * (v - b);
  };
  const auto fade = [](double t) { return t * t * t * (t * (t * 6 - 15) + 10); };
  return 1.5 * mix(mix(slope(0, 0), slope(1, 0), fade(u)), mix(slope(0, 1), slope(1, 1), fade(u)), fade(v));
}

double Noise::cloud(double x, double y, int px, int py, int octaves, double gain) const {
  double sum = 0, strength = 1, scale = 1;
  for (int o = 0; o < octaves; ++o) {
    const int s = 1 << o;
    sum += strength * Noise(seed_ + static_cast<std::uint64_t>(o) * 977).smooth(x * s, y * s, px * s, py * s);
    strength *= gain;
    scale += strength;
  }
  return sum / scale * 1.4;
}

Noise::Cell Noise::cell(double x, double y, int px, int py) const {
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  double first = std::numeric_limits<double>::infinity(), second = first;
  std::uint64_t name = 0;
  for (int b = -1; b <= 1; ++b) {
    for (int a = -1; a <= 1; ++a) {
      const std::uint64_t bits = lattice(i + a, j + b, px, py);
      const double dx = i + a + 0.1 + 0.8 * as_unit(bits) - x;
      const double dy = j + b + 0.1 + 0.8 * as_unit(Random::mix(bits)) - y;
      const double d = std::hypot(dx, dy);
      if (d < first) {
        second = first, first = d, name = bits;
      } else {
        second = std::min(second, d);
      }
    }
  }
  return {first, second - first, name};
}

}  // namespace copse::grow
