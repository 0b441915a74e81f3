#include "lib/formats/random.h"
#include "tools/treegrow/art.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

namespace copse::grow {
namespace {

constexpr double k_pi = std::numbers::pi;

struct Point {
  double x = 0, y = 0;
};

// A brush on a canvas: everything that is painted is a blade along an axis, with a half-width and a colour
// for each place on it.
class Brush {
 public:
  explicit Brush(Canvas& canvas) : canvas_(canvas) {}

  // `half(y)`: half-width at y in [0, 1] along the blade, in the canvas' unit; `colour(x, y)`: x in [-1, 1].
  template <class Half, class Colour>
  void blade(Point from, double angle, double length, double bend, const Half& half, const Colour& colour) {
    const int n = canvas_.size();
    double widest = 0;
    for (int i = 0; i <= 16; ++i) widest = std::max(widest, half(i / 16.0));
    const double reach = length + widest, s = std::sin(angle), c = std::cos(angle);
    const auto pixel = [n](double v) { return std::clamp(static_cast<int>(v * n), 0, n - 1); };
    for (int py = pixel(from.y - reach); py <= pixel(from.y + reach); ++py) {
      for (int px = pixel(from.x - reach); px <= pixel(from.x + reach); ++px) {
        const double dx = (px + 0.5) / n - from.x, dy = (py + 0.5) / n - from.y;
        const double y = (dx * s + dy * c) / length;
        if (y < 0 || y > 1) continue;
        const double x = dx * c - dy * s - bend * length * y * y;
        if (std::abs(x) > 1.1 * widest) continue;  // saves most of the outlines
        const double h = half(y);
        if (h <= 0 || std::abs(x) > h) continue;
        canvas_.over(px, py, colour(x / h, y), 1);
      }
    }
  }

  void twig(Point from, double angle, double length, double bend, double width, const Double3& colour) {
    blade(
        from, angle, length, bend, [&](double y) { return width * (1 - 0.7 * y); },
        [&](double x, double) { return colour * (1 - 0.35 * x); });
  }

 private:
  Canvas& canvas_;
};

// The point at y along a blade.
Point along(Point from, double angle, double length, double bend, double y) {
  const double s = std::sin(angle), c = std::cos(angle), x = bend * length * y * y, l = length * y;
  return {from.x + l * s + x * c, from.y + l * c - x * s};
}

struct Colours {
  Double3 leaf, tint;
  Double3 pick(Random& random) const {
    const double t = random.uniform() * random.uniform();
    return mix(leaf, tint, t) * random.uniform(0.78, 1.18);
  }
};

// How a leaf's surface looks: midrib, side veins, a darker half, an edge.
Double3 veined(const Double3& colour, double x, double y, int veins) {
  const double rib = 1 - ramp(0.02, 0.11, std::abs(x));
  const double phase = (y - 0.35 * std::abs(x)) * veins;
  const double vein =
      (1 - ramp(0.03, 0.16, std::abs(phase - std::round(phase)))) * (1 - ramp(0.6, 1.0, std::abs(x)));
  const double shade = (x > 0 ? 0.88 : 1.05) * (1 - 0.22 * ramp(0.6, 1.0, std::abs(x))) * (0.9 + 0.18 * y);
  return mix(colour * shade, colour * 1.45, std::min(0.75, 0.6 * rib + 0.3 * vein));
}

using Outline = double (*)(double y);  // half-width of a leaf of length 1

double oak_outline(double y) {
  const double body = 0.40 * std::pow(y, 0.85) * std::pow(std::max(0.0, 1 - y), 0.42) * 1.55;
  const double lobes = 0.5 + 0.5 * std::cos((y * 3.9 + 0.55) * 2 * k_pi);
  return body * (1 - 0.42 * lobes * (1 - 0.6 * y)) + 0.012;
}
double birch_outline(double y) {
  const double body = y < 0.28 ? std::pow(y / 0.28, 0.6) : std::pow((1 - y) / 0.72, 0.85);
  const double teeth = y * 13 - std::floor(y * 13);
  return 0.36 * body * (1 - 0.14 * teeth);
}
double round_outline(double y) {
  return 0.36 * std::pow(std::sin(k_pi * std::pow(y, 0.85)), 0.7);
}
double willow_outline(double y) {
  return 0.085 * std::pow(std::sin(k_pi * std::pow(y, 0.8)), 0.9);
}

// A leafy twig: leaves to both sides and one at the end, the far ones first.
struct Spray {
  Outline outline;
  int leaves;         // to the sides
  double leaf;        // length of one
  double spread;      // angle to the twig at its base
  double spread_top;  // and at its end
  int veins;
  double stalk;  // of a leaf, share of its length
};

void paint_spray(Canvas& canvas, const Spray& spray, const Colours& colours, bool triangular, Random random) {
  Brush brush(canvas);
  const double bend = random.around(0, 0.08), length = 0.70;
  const Point foot{0.5, 0};
  const Double3 wood{0.10, 0.07, 0.035};
  brush.twig(foot, 0, length, bend, 0.011, wood);
  const auto leaf = [&](Point at, double angle, double size) {
    const double droop = random.around(0, 0.12);
    const Double3 colour = colours.pick(random);
    brush.twig(at, angle, size * spray.stalk * 1.1, 0, 0.006, mix(wood, colour, 0.5));
    const Point base = along(at, angle, size * spray.stalk, 0, 1);
    brush.blade(
        base, angle, size, droop, [&](double y) { return size * spray.outline(y); },
        [&](double x, double y) { return veined(colour, x, y, spray.veins); });
  };
  std::vector<int> order(static_cast<std::size_t>(spray.leaves));
  for (int i = 0; i < spray.leaves; ++i) order[static_cast<std::size_t>(i)] = i;
  random.shuffle(std::span(order));
  for (const int i : order) {
    const double y = 0.1 + 0.86 * (i + random.uniform(0.2, 0.8)) / spray.leaves;
    const double side = i % 2 == 0 ? 1 : -1;
    const double angle = side * (mix(spray.spread, spray.spread_top, y) + random.around(0, 9)) * k_pi / 180;
    const Point at = along(foot, 0, length, bend, triangular ? 0.25 + 0.75 * y : y);
    double size = spray.leaf * random.uniform(0.82, 1.12) * (1.05 - 0.25 * y);
    const double room = triangular ? 0.5 * (at.y + 0.45 * size * std::cos(angle)) : 0.5;
    size = std::min(size, 0.97 * room / std::max(0.2, std::abs(std::sin(angle)) * (1 + spray.stalk)));
    leaf(at, angle, size);
  }
  leaf(along(foot, 0, length, bend, 0.96), random.around(0, 0.1),
       std::min(spray.leaf, (1 - length) * 0.98 / (1 + spray.stalk)));
}

// A flat shoot with side shoots, needles to both sides of each.
void paint_needles(Canvas& canvas, const Colours& colours, bool triangular, Random random) {
  Brush brush(canvas);
  const auto shoot = [&](Point foot, double angle, double length, double bend, double needle) {
    const int count = static_cast<int>(length * 150);
    for (int i = 0; i < count; ++i) {
      const double y = (i + random.uniform()) / count;
      const double side = i % 2 == 0 ? 1 : -1;
      const Point at = along(foot, angle, length, bend, y);
      const double size =
          needle * random.uniform(0.75, 1.1) * (1 - 0.35 * y * y) * std::min(1.0, 0.5 + 4 * y);
      const double turn = angle + side * (random.uniform(28, 62) - 18 * y) * k_pi / 180;
      const Double3 colour = colours.pick(random);
      brush.blade(
          at, turn, size, random.around(0, 0.15), [&](double t) { return 0.0062 * (1 - 0.75 * t * t); },
          [&](double x, double t) { return colour * ((0.8 + 0.45 * t) * (1 - 0.3 * x)); });
    }
    brush.twig(foot, angle, length * 0.97, bend, 0.007, {0.11, 0.065, 0.03});
  };
  const double bend = random.around(0, 0.06);
  const Point foot{0.5, 0.0};
  const int sides = 7;
  for (int i = 0; i < sides; ++i) {
    const double y = 0.08 + 0.66 * (i + random.uniform(0.3, 0.7)) / sides, side = i % 2 == 0 ? 1 : -1;
    const Point at = along(foot, 0, 0.9, bend, triangular ? 0.3 + 0.7 * y : y);
    const double angle = side * random.uniform(38, 50) * k_pi / 180;
    const double room = triangular ? 0.36 * at.y + 0.08 : 0.46 - 0.2 * y;
    shoot(at, angle, room / std::sin(std::abs(angle)) * 0.8, -side * 0.12, 0.085);
  }
  shoot(foot, 0, 0.9, bend, 0.1);
}

// Long needles in a tuft round the end of a shoot.
void paint_pine(Canvas& canvas, const Colours& colours, bool triangular, Random random) {
  Brush brush(canvas);
  const Point foot{0.5, 0};
  brush.twig(foot, 0, 0.45, 0, 0.014, {0.16, 0.09, 0.04});
  for (int i = 0; i < 190; ++i) {
    const double y = random.uniform(triangular ? 0.35 : 0.12, 0.48), side = i % 2 == 0 ? 1 : -1;
    const double angle = side * random.uniform(0, triangular ? 27 : 78) * (1.15 - y) * k_pi / 180;
    const double length = random.uniform(0.34, 0.5);
    const Double3 colour = colours.pick(random);
    brush.blade(
        {0.5, y}, angle, std::min(length, (0.98 - y) / std::max(0.3, std::cos(angle))),
        side * random.uniform(0, 0.18), [&](double t) { return 0.0062 * (1 - 0.7 * t * t); },
        [&](double x, double t) { return colour * ((0.7 + 0.55 * t) * (1 - 0.3 * x)); });
  }
}

// One leaflet of a frond, folded along its rib.
void paint_palm(Canvas& canvas, const Colours& colours, bool triangular, Random random) {
  Brush brush(canvas);
  const Double3 colour = colours.pick(random);
  const double dry = random.chance(0.35) ? random.uniform(0.05, 0.2) : 0;
  brush.blade(
      {0.5, 0}, 0, 1, 0,
      [&](double y) {
        return triangular ? 0.46 * y * ramp(0, 0.1, 1 - y)
                          : 0.46 * std::pow(std::sin(k_pi * std::pow(0.03 + 0.96 * y, 0.6)), 0.6);
      },
      [&](double x, double y) {
        const double fold = x > 0 ? 0.8 : 1.08, rib = 1 - ramp(0.05, 0.14, std::abs(x));
        const double line = 0.94 + 0.06 * std::cos(x * 40);
        const Double3 green = mix(colour * (fold * line * (0.85 + 0.25 * y)), colour * 1.6, 0.5 * rib);
        return mix(green, {0.30, 0.22, 0.10}, ramp(1 - dry, 1 - 0.4 * dry, y) * (dry > 0 ? 1 : 0));
      });
}

// Clusters of five-petalled flowers, a few bronze leaves behind them.
void paint_blossom(Canvas& canvas, const Colours& colours, bool triangular, Random random) {
  Brush brush(canvas);
  brush.twig({0.5, 0}, 0, 0.8, random.around(0, 0.06), 0.012, {0.07, 0.04, 0.03});
  const Colours bronze{{0.13, 0.16, 0.04}, {0.22, 0.10, 0.05}};
  for (int i = 0; i < 5; ++i) {
    const double y = 0.25 + 0.12 * i, side = i % 2 == 0 ? 1 : -1, size = triangular ? 0.14 : 0.2;
    const Double3 colour = bronze.pick(random);
    brush.blade(
        {0.5, y}, side * random.uniform(0.5, 1.0), size, 0, [&](double t) { return size * birch_outline(t); },
        [&](double x, double t) { return veined(colour, x, t, 7); });
  }
  const int flowers = 24;
  for (int i = 0; i < flowers; ++i) {
    const double y = 0.14 + 0.76 * (i + random.uniform()) / flowers;
    const double room = triangular ? 0.46 * y - 0.06 : 0.40;
    const Point at{0.5 + random.around(0, std::max(0.02, room)), y};
    const double petal = random.uniform(0.062, 0.085), turn = random.uniform(0, 2 * k_pi);
    const Double3 colour = colours.pick(random);
    for (int p = 0; p < 5; ++p)
      brush.blade(
          at, turn + p * 2 * k_pi / 5, petal, 0,
          [&](double t) {
            return petal * 0.46 * std::pow(std::sin(k_pi * std::pow(0.04 + 0.93 * t, 1.5)), 0.7);
          },
          [&](double x, double t) {
            const Double3 heart{colour.x * 0.8, colour.y * 0.35, colour.z * 0.5};
            return mix(heart, colour * (1.04 - 0.12 * x * x), ramp(0.0, 0.5, t));
          });
    for (int p = 0; p < 6; ++p)
      brush.blade(
          at, turn + p * 1.05, petal * 0.34, 0, [](double) { return 0.0028; },
          [](double, double t) {
            return t > 0.7 ? Double3{0.75, 0.55, 0.12} : Double3{0.62, 0.4, 0.3};
          });
  }
}

// Blades from the ground up, some seed heads among them.
void paint_grass(Canvas& canvas, const Colours& colours, Random random) {
  Brush brush(canvas);
  const int blades = 46;
  for (int i = 0; i < blades; ++i) {
    const double depth = static_cast<double>(i) / blades;  // later ones stand in front
    const double x = random.uniform(0.09, 0.91), tall = random.uniform(0.5, 0.99) * (1 - 0.3 * depth);
    const double lean = random.around(0, 0.20) + 0.12 * (0.5 - x), bend = random.around(0, 0.22) - lean * 0.3;
    const double width = random.uniform(0.009, 0.017);
    const Double3 colour = colours.pick(random) * (0.72 + 0.4 * depth);
    const bool seeds = random.chance(0.12);
    brush.blade(
        {x, 0}, lean, tall, bend,
        [&](double y) {
          if (seeds && y > 0.78)
            return 0.5 * width + 0.012 * std::sin((y - 0.78) / 0.22 * k_pi) * (0.7 + 0.3 * std::cos(y * 130));
          return width * (seeds ? 0.35 : 1 - y * y);
        },
        [&](double u, double y) {
          const Double3 green = colour * ((0.45 + 0.75 * y) * (u > 0 ? 0.85 : 1.08));
          return seeds ? mix(green, {0.42, 0.33, 0.16}, ramp(0.6, 0.85, y)) : green;
        });
  }
}

void paint_quarter(Canvas& canvas, const Foliage& leaves, const Colours& colours, bool triangular,
                   const Random& random) {
  switch (leaves.art) {
    case LeafArt::none:
      break;
    case LeafArt::oak:
      return paint_spray(canvas, {oak_outline, 9, 0.44, 72, 38, 7, 0.10}, colours, triangular, random);
    case LeafArt::birch:
      return paint_spray(canvas, {birch_outline, 15, 0.27, 66, 36, 8, 0.28}, colours, triangular, random);
    case LeafArt::round:
      return paint_spray(canvas, {round_outline, 13, 0.29, 66, 36, 6, 0.14}, colours, triangular, random);
    case LeafArt::willow:
      return paint_spray(canvas, {willow_outline, 18, 0.48, 38, 22, 14, 0.05}, colours, triangular, random);
    case LeafArt::needles:
      return paint_needles(canvas, colours, triangular, random);
    case LeafArt::pine:
      return paint_pine(canvas, colours, triangular, random);
    case LeafArt::palm:
      return paint_palm(canvas, colours, triangular, random);
    case LeafArt::blossom:
      return paint_blossom(canvas, colours, triangular, random);
    case LeafArt::grass:
      return paint_grass(canvas, colours, random);
  }
}

}  // namespace

Canvas paint_leaves(const Foliage& leaves, bool triangular, int size, std::uint64_t seed) {
  const Colours colours{to_double(leaves.colour), to_double(leaves.tint)};
  const Random random = Random(seed).fork(static_cast<std::uint64_t>(leaves.art));
  if (leaves.art == LeafArt::grass) {
    Canvas canvas(2 * size);
    paint_quarter(canvas, leaves, colours, triangular, random);
    return canvas.halved();
  }
  Canvas all(size);
  for (int quarter = 0; quarter < 4; ++quarter) {
    Canvas canvas(size);  // twice as fine as it will be
    paint_quarter(canvas, leaves, colours, triangular, random.fork(static_cast<std::uint64_t>(quarter)));
    all.put_quarter(quarter, canvas.halved());
  }
  return all;
}

std::vector<Image> paint(const Order& order, std::size_t materials, int size) {
  std::vector<Image> images;
  if (materials == 0 || order.breaks.has(Break::no_uvs)) return images;
  const Species& s = order.species;
  const bool triangular = leaf_form(order.breaks).triangles == 1;
  if (s.grass.blades > 0) {
    images.push_back(paint_leaves(s.leaves, false, size, order.seed).image(true));
    return images;
  }
  images.push_back(paint_bark(s.bark, s.bark_colour, size, order.seed).image(false));
  // A tree whose triangles all went into its trunk has no leaves and no material for them.
  const bool may_have_leaves = materials > 1 || order.breaks.has(Break::one_material);
  const bool leaves = s.leaves.art != LeafArt::none && !order.breaks.has(Break::blobs);
  if (!leaves || !may_have_leaves) return images;
  Image leaf = paint_leaves(s.leaves, triangular, size, order.seed).image(true);
  if (order.breaks.has(Break::one_material)) {
    images[0] = beside(images[0], leaf);
  } else {
    images.push_back(std::move(leaf));
  }
  return images;
}

}  // namespace copse::grow
