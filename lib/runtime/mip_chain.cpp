#include "lib/runtime/mip_chain.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace copse {

namespace {

// Linear light, colour premultiplied by alpha: what may be averaged.
struct Texel {
  float r = 0, g = 0, b = 0, a = 0;
};

struct Level {
  int width = 0, height = 0;
  std::vector<Texel> texels;
};

float to_linear(float s) {
  return s <= 0.04045f ? s / 12.92f : std::pow((s + 0.055f) / 1.055f, 2.4f);
}

const std::array<float, 256>& linear_of_byte() {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> t{};
    for (std::size_t i = 0; i < t.size(); ++i) t[i] = to_linear(static_cast<float>(i) / 255);
    return t;
  }();
  return table;
}

// The nearest byte: of two neighbours that whose half is met. A table says where to begin to look.
class SrgbBytes {
 public:
  SrgbBytes() {
    for (std::size_t b = 1; b < from_.size(); ++b) from_[b] = to_linear((static_cast<float>(b) - 0.5f) / 255);
    std::size_t byte = 0;
    for (std::size_t i = 0; i < first_.size(); ++i) {
      while (byte < 255 && from_[byte + 1] <= static_cast<float>(i) / k_steps) ++byte;
      first_[i] = static_cast<std::uint8_t>(byte);
    }
  }
  std::uint8_t of(float linear) const {
    const float l = std::clamp(linear, 0.0f, 1.0f);
    std::size_t byte = first_[static_cast<std::size_t>(l * k_steps)];
    while (byte < 255 && from_[byte + 1] <= l) ++byte;
    return static_cast<std::uint8_t>(byte);
  }

 private:
  static constexpr float k_steps = 4096;
  std::array<float, 256> from_{};
  std::array<std::uint8_t, 4097> first_{};
};

std::uint8_t to_srgb_byte(float linear) {
  static const SrgbBytes bytes;
  return bytes.of(linear);
}

Level decode(std::span<const std::uint8_t> rgba, int width, int height) {
  const std::array<float, 256>& linear = linear_of_byte();
  Level level{width, height, std::vector<Texel>(rgba.size() / 4)};
  for (std::size_t i = 0; i < level.texels.size(); ++i) {
    const std::uint8_t* p = &rgba[4 * i];
    const float a = static_cast<float>(p[3]) / 255;
    level.texels[i] = {linear[p[0]] * a, linear[p[1]] * a, linear[p[2]] * a, a};
  }
  return level;
}

// The source texels that one target texel covers along one axis, with their shares (they sum to 1).
struct Footprint {
  int first = 0;
  int count = 0;
  std::array<float, 4> share{};
};

std::vector<Footprint> footprints(int source, int target) {
  std::vector<Footprint> all(static_cast<std::size_t>(target));
  const double ratio = static_cast<double>(source) / target;
  for (int i = 0; i < target; ++i) {
    Footprint& f = all[static_cast<std::size_t>(i)];
    const double from = i * ratio, to = (i + 1) * ratio;
    f.first = static_cast<int>(std::floor(from));
    for (int s = f.first; s < source && s < to && f.count < 4; ++s) {
      const double overlap = std::min<double>(to, s + 1) - std::max<double>(from, s);
      f.share[static_cast<std::size_t>(f.count++)] = static_cast<float>(overlap / ratio);
    }
  }
  return all;
}

Level halve(const Level& source) {
  Level target{std::max(1, source.width / 2), std::max(1, source.height / 2), {}};
  const std::vector<Footprint> across = footprints(source.width, target.width);
  const std::vector<Footprint> down = footprints(source.height, target.height);
  target.texels.reserve(across.size() * down.size());
  for (const Footprint& fy : down) {
    for (const Footprint& fx : across) {
      Texel sum;
      for (int y = 0; y < fy.count; ++y) {
        const std::size_t row =
            static_cast<std::size_t>(fy.first + y) * static_cast<std::size_t>(source.width);
        for (int x = 0; x < fx.count; ++x) {
          const Texel& t = source.texels[row + static_cast<std::size_t>(fx.first + x)];
          const float w = fy.share[static_cast<std::size_t>(y)] * fx.share[static_cast<std::size_t>(x)];
          sum.r += w * t.r, sum.g += w * t.g, sum.b += w * t.b, sum.a += w * t.a;
        }
      }
      target.texels.push_back(sum);
    }
  }
  return target;
}

// What a filter that repeats the texture reads between texels, some k_least_samples places or more of a
// level, evenly: of a texel the four quarters' middles in turn where there are many, all of a finer grid
// else.
class AlphaSamples {
 public:
  AlphaSamples(int width, int height) : width_(width), height_(height) {
    const double texels = static_cast<double>(width) * height;
    grid_ = texels >= k_least_samples ? 1 : static_cast<int>(std::ceil(std::sqrt(k_least_samples / texels)));
  }

  // The share of the surface that passes the test when alpha(texel) is each texel's.
  template <class Alpha>
  double share(const Alpha& alpha, float cutoff) const {
    std::size_t passing = 0;
    for (int y = 0; y < height_; ++y)
      for (int x = 0; x < width_; ++x) passing += passing_in(x, y, alpha, cutoff);
    return static_cast<double>(passing) / (static_cast<double>(width_) * height_ * grid_ * grid_);
  }

 private:
  static constexpr double k_least_samples = 4096;

  template <class Alpha>
  std::size_t passing_in(int x, int y, const Alpha& alpha, float cutoff) const {
    std::size_t passing = 0;
    for (int j = 0; j < grid_; ++j)
      for (int i = 0; i < grid_; ++i) {
        const float u = grid_ == 1 ? (x % 2 ? 0.25f : -0.25f) : (float(i) + 0.5f) / float(grid_) - 0.5f;
        const float v = grid_ == 1 ? (y % 2 ? 0.25f : -0.25f) : (float(j) + 0.5f) / float(grid_) - 0.5f;
        const int across = (x + (u < 0 ? width_ - 1 : 1)) % width_;
        const int down = (y + (v < 0 ? height_ - 1 : 1)) % height_;
        const float wu = std::abs(u), wv = std::abs(v);
        const float here = alpha(at(x, y)) * (1 - wu) + alpha(at(across, y)) * wu;
        const float there = alpha(at(x, down)) * (1 - wu) + alpha(at(across, down)) * wu;
        passing += here * (1 - wv) + there * wv >= cutoff;
      }
    return passing;
  }
  std::size_t at(int x, int y) const {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(x);
  }

  int width_, height_, grid_ = 1;
};

double scaled_share(const Level& level, float cutoff, float scale) {
  return AlphaSamples(level.width, level.height)
      .share([&](std::size_t i) { return std::min(1.0f, scale * level.texels[i].a); }, cutoff);
}

// What alpha is to be multiplied by so that `share` of the level passes the test, as nearly as can be.
float alpha_scale(const Level& level, float cutoff, double share) {
  constexpr float k_most = 255;  // what is less than a byte's step is nothing
  constexpr int k_halvings = 14;
  float low = 0, high = 1;
  while (high < k_most && scaled_share(level, cutoff, high) < share) low = high, high *= 2;
  for (int i = 0; i < k_halvings; ++i) {
    const float middle = 0.5f * (low + high);
    (scaled_share(level, cutoff, middle) < share ? low : high) = middle;
  }
  const auto off = [&](float scale) { return std::abs(scaled_share(level, cutoff, scale) - share); };
  return off(low) < off(high) ? low : high;
}

std::uint8_t alpha_byte(float a) {
  return static_cast<std::uint8_t>(std::lround(std::clamp(a, 0.0f, 1.0f) * 255));
}

// Rounded so that what passes the test as float passes as a byte.
std::uint8_t tested_alpha_byte(float a, float cutoff) {
  const std::uint8_t byte = alpha_byte(a);
  return a >= cutoff && static_cast<float>(byte) / 255 < cutoff && byte < 255
             ? static_cast<std::uint8_t>(byte + 1)
             : byte;
}

// Straight sRGB colour; texels without alpha take the colour of the next smaller level. `source`: of the
// largest level, whose texels with alpha stay as they are, to the byte.
MipLevel encode(const Level& level, const MipLevel* smaller, float cutoff, float scale,
                std::span<const std::uint8_t> source) {
  MipLevel out{level.width, level.height, std::vector<std::uint8_t>(level.texels.size() * 4)};
  for (std::size_t i = 0; i < level.texels.size(); ++i) {
    const Texel& t = level.texels[i];
    std::uint8_t* p = &out.rgba[4 * i];
    if (!source.empty() && source[4 * i + 3] > 0) {
      std::copy_n(&source[4 * i], 4, p);
      continue;
    }
    if (t.a > 0) {
      p[0] = to_srgb_byte(t.r / t.a), p[1] = to_srgb_byte(t.g / t.a), p[2] = to_srgb_byte(t.b / t.a);
    } else if (smaller) {
      const int x = static_cast<int>(i % static_cast<std::size_t>(level.width));
      const int y = static_cast<int>(i / static_cast<std::size_t>(level.width));
      const int sx = std::min(x / 2, smaller->width - 1), sy = std::min(y / 2, smaller->height - 1);
      std::copy_n(&smaller->rgba[4 * static_cast<std::size_t>(sy * smaller->width + sx)], 3, p);
    }
    p[3] = tested_alpha_byte(t.a * scale, cutoff);
  }
  return out;
}

}  // namespace

std::vector<MipLevel> mip_chain(std::span<const std::uint8_t> rgba, int width, int height,
                                float alpha_cutoff) {
  std::vector<Level> levels{decode(rgba, width, height)};
  while (levels.back().width > 1 || levels.back().height > 1) levels.push_back(halve(levels.back()));
  const double share = scaled_share(levels.front(), alpha_cutoff, 1);
  std::vector<MipLevel> chain(levels.size());
  for (std::size_t i = levels.size(); i-- > 0;) {
    const bool tested = alpha_cutoff > 0 && i > 0;
    const float scale = tested ? alpha_scale(levels[i], alpha_cutoff, share) : 1;
    chain[i] = encode(levels[i], i + 1 < levels.size() ? &chain[i + 1] : nullptr, tested ? alpha_cutoff : 0,
                      scale, i == 0 ? rgba : std::span<const std::uint8_t>());
  }
  if (alpha_cutoff <= 0) return chain;
  // What a few texels cannot hold is better read from the level before, which shimmers but is right on
  // average.
  const auto fails = [&](const MipLevel& level) {
    return std::abs(alpha_coverage(level, alpha_cutoff) - share) > k_coverage_tolerance * share;
  };
  chain.erase(std::find_if(chain.begin() + 1, chain.end(), fails), chain.end());
  return chain;
}

double alpha_coverage(const MipLevel& level, float alpha_cutoff) {
  if (alpha_cutoff <= 0 || level.rgba.empty()) return 1;
  return AlphaSamples(level.width, level.height)
      .share([&](std::size_t i) { return static_cast<float>(level.rgba[4 * i + 3]) / 255; }, alpha_cutoff);
}

}  // namespace copse
