#include "lib/formats/random.h"
#include "tools/treegrow/art.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace copse::grow {
namespace {

// A point of a bark: how high it stands (0 deep, 1 high) and its colour, as a factor on the species'.
struct Spot {
  double height = 0.5;
  Double3 colour{1, 1, 1};
};

double unit(std::uint64_t bits) {
  return static_cast<double>(bits >> 11) * 0x1p-53;
}

// u, v in [0, 1): round the stem and along it.
using Rule = Spot (*)(double u, double v, const Noise& noise);

// Long ridges between dark, winding furrows.
Spot furrowed(double u, double v, const Noise& n) {
  const double sway = 0.35 * n.cloud(u * 4, v * 4, 4, 4, 3);
  const Noise::Cell c = n.cell(u * 9 + sway, v * 3.0 + 0.6 * n.smooth(u * 7, v * 5, 7, 5), 9, 3);
  const double fine = n.cloud(u * 28, v * 10, 28, 10, 4);
  const double ridge = ramp(0.02, 0.34, c.border + 0.05 * fine);
  Spot s;
  s.height = 0.1 + 0.72 * ridge + 0.2 * fine;
  const double lichen = ramp(0.35, 0.75, n.cloud(u * 6 + 3, v * 6, 6, 6, 3)) * ridge;
  s.colour = Double3{1, 1, 1} * (0.42 + 0.55 * ridge + 0.28 * fine + 0.16 * (unit(c.name) - 0.5));
  s.colour = mix(s.colour, {0.95, 1.18, 0.95}, 0.45 * lichen);
  return s;
}

// White, with dark dashes across and black, rough diamonds.
Spot birch(double u, double v, const Noise& n) {
  const double warp = 0.06 * n.cloud(u * 5, v * 5, 5, 5, 2);
  const double rows = n.smooth(u * 7, (v + warp * 0.2) * 90, 7, 90);
  const double spread = n.cloud(u * 3, v * 8, 3, 8, 2);
  const double dash = ramp(0.42, 0.62, rows + 0.25 * spread);
  const Noise::Cell c = n.cell(u * 3, v * 3 + 0.15 * n.smooth(u * 6, v * 6, 6, 6), 3, 3);
  const double rough = n.cloud(u * 22, v * 22, 22, 22, 3);
  const double scar = unit(c.name) > 0.62 ? 1 - ramp(0.10, 0.30, c.nearest + 0.11 * rough) : 0;
  const double film = n.cloud(u * 4, v * 30, 4, 30, 3);
  Spot s;
  s.height = 0.6 - 0.25 * dash - 0.4 * scar + 0.08 * film;
  s.colour = mix(Double3{1, 1, 1} * (0.94 + 0.08 * film), {1.0, 0.86, 0.76},
                 0.35 * ramp(0.2, 0.8, n.cloud(u * 3, v * 5, 3, 5, 2)));
  s.colour = mix(s.colour, {0.16, 0.14, 0.13}, 0.75 * dash);
  s.colour = mix(s.colour, Double3{0.07, 0.06, 0.055} * (1 + 0.6 * rough), std::min(1.0, 1.2 * scar));
  return s;
}

// Plates that flake off, each with its own shade.
Spot scaly(double u, double v, const Noise& n) {
  const double sway = 0.3 * n.cloud(u * 8, v * 8, 8, 8, 2);
  const Noise::Cell c = n.cell(u * 9 + sway, v * 6 + sway, 9, 6);
  const Noise::Cell flake = Noise(77).cell(u * 22 + 2 * sway, v * 13, 22, 13);
  const double plate = ramp(0.0, 0.16, c.border), chip = ramp(0.0, 0.2, flake.border);
  const double fine = n.cloud(u * 40, v * 24, 40, 24, 3);
  Spot s;
  s.height = 0.15 + 0.5 * plate + 0.22 * chip + 0.12 * fine;
  const double shade = 0.4 + 0.5 * plate + 0.14 * chip + 0.2 * fine + 0.3 * (unit(c.name) - 0.5);
  s.colour = mix(Double3{1, 1, 1}, {1.2, 0.95, 0.8}, unit(flake.name)) * shade;
  return s;
}

// Rings of old leaf bases, with fibres.
Spot palm(double u, double v, const Noise& n) {
  const double wave =
      v * 8 + 0.4 + 0.22 * n.smooth(u * 4, v * 4, 4, 4) + 0.06 * n.smooth(u * 14, v * 8, 14, 8);
  const double in_ring = wave - std::floor(wave);
  const double edge = ramp(0.0, 0.12, in_ring) * (1 - 0.55 * ramp(0.55, 1.0, in_ring));
  const double fibre = n.cloud(u * 46, v * 6, 46, 6, 3);
  const double crack = ramp(0.45, 0.7, n.smooth(u * 17, v * 3, 17, 3));
  Spot s;
  s.height = 0.15 + 0.7 * edge + 0.18 * fibre - 0.2 * crack;
  s.colour = Double3{1, 0.98, 0.95} * (0.45 + 0.6 * edge + 0.22 * fibre - 0.25 * crack);
  return s;
}

// Deep ridges that cross and part.
Spot ridged(double u, double v, const Noise& n) {
  const double bend = 0.5 * n.cloud(u * 3, v * 3, 3, 3, 3);
  const double a = 1 - std::abs(n.smooth(u * 10 + bend, v * 4 + v * 1, 10, 5));
  const double b = 1 - std::abs(Noise(5).smooth(u * 13 - bend, v * 6, 13, 6));
  const double fine = n.cloud(u * 36, v * 14, 36, 14, 3);
  const double ridge = ramp(0.62, 1.0, std::max(a, 0.96 * b));
  Spot s;
  s.height = 0.1 + 0.75 * ridge + 0.16 * fine;
  s.colour = Double3{1, 1, 0.97} * (0.42 + 0.62 * ridge + 0.25 * fine);
  return s;
}

// Thin and dull, with rows of small pale pores.
Spot smooth(double u, double v, const Noise& n) {
  const double cloud = n.cloud(u * 4, v * 7, 4, 7, 5);
  const Noise::Cell c = n.cell(u * 12, v * 26, 12, 26);
  const double pore = unit(c.name) > 0.6 ? 1 - ramp(0.14, 0.3, c.nearest) : 0;
  const double rows = ramp(0.3, 0.7, n.smooth(u * 3, v * 24, 3, 24));
  Spot s;
  s.height = 0.5 + 0.2 * cloud + 0.2 * pore - 0.08 * rows;
  s.colour = mix(Double3{1, 1, 1} * (0.85 + 0.3 * cloud - 0.16 * rows), {1.6, 1.45, 1.3}, 0.55 * pore);
  return s;
}

// Bare grey wood: long streaks and cracks along the grain.
Spot weathered(double u, double v, const Noise& n) {
  const double grain_u = u * 24 + 1.4 * n.cloud(u * 3, v * 2, 3, 2, 3);
  const double grain = n.cloud(grain_u, v * 2, 24, 2, 4, 0.6);
  const double crack =
      ramp(0.56, 0.74, 1 - std::abs(n.smooth(grain_u * 0.5, v * 2, 12, 2)) - 0.18 + 0.1 * grain);
  const double thin = ramp(0.86, 0.97, 1 - std::abs(Noise(9).smooth(u * 16 + 0.7 * grain, v * 2, 16, 2)));
  const double stain = n.cloud(u * 2, v * 3, 2, 3, 3);
  Spot s;
  s.height = 0.55 + 0.22 * grain - 0.35 * crack * thin - 0.2 * thin;
  s.colour = mix(Double3{1, 1, 1}, {0.86, 0.74, 0.62}, ramp(0.0, 0.8, stain)) *
             (0.92 + 0.3 * grain - 0.55 * thin - 0.25 * crack * thin);
  return s;
}

Rule rule_of(BarkArt art) {
  switch (art) {
    case BarkArt::furrowed:
      return furrowed;
    case BarkArt::birch:
      return birch;
    case BarkArt::scaly:
      return scaly;
    case BarkArt::palm:
      return palm;
    case BarkArt::ridged:
      return ridged;
    case BarkArt::smooth:
      return smooth;
    case BarkArt::weathered:
      return weathered;
    case BarkArt::grass:
      return smooth;
  }
  return smooth;
}

}  // namespace

Canvas paint_bark(BarkArt art, const Float3& colour, int size, std::uint64_t seed) {
  const Noise noise(Random::mix(seed + static_cast<std::uint64_t>(art) * 31));
  const Rule rule = rule_of(art);
  const auto n = static_cast<std::size_t>(size);
  std::vector<Spot> spots(n * n);
  for (std::size_t y = 0; y < n; ++y)
    for (std::size_t x = 0; x < n; ++x)
      spots[y * n + x] =
          rule((static_cast<double>(x) + 0.5) / size, (static_cast<double>(y) + 0.5) / size, noise);
  // Light from above and the left brings the relief out; it is soft, so that real light can play on it.
  Canvas canvas(size);
  const double strength = size / 90.0;
  for (std::size_t y = 0; y < n; ++y) {
    for (std::size_t x = 0; x < n; ++x) {
      const double dx = spots[y * n + (x + 1) % n].height - spots[y * n + (x + n - 1) % n].height;
      const double dy = spots[(y + 1) % n * n + x].height - spots[(y + n - 1) % n * n + x].height;
      const Double3 facing = normalized(Double3{-dx * strength, -dy * strength, 1});
      const double light = 0.55 + 0.5 * dot(facing, normalized(Double3{-0.45, 0.55, 0.8}));
      const Double3 c = spots[y * n + x].colour;
      canvas.set(static_cast<int>(x), static_cast<int>(y),
                 {std::max(0.0, c.x * colour.x * light), std::max(0.0, c.y * colour.y * light),
                  std::max(0.0, c.z * colour.z * light)});
    }
  }
  return canvas;
}

}  // namespace copse::grow
