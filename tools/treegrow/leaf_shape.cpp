#include "tools/treegrow/leaves.h"

#include <cmath>
#include <map>
#include <numbers>
#include <utility>

namespace copse::grow {
namespace {

using Vertex = LeafShape::Vertex;

Vertex flat(double x, double y) {
  return {{x, y, 0}, {0, 0, 1}, {static_cast<float>(x + 0.5), static_cast<float>(y)}};
}

LeafShape triangle() {
  LeafShape s;
  s.vertices = {flat(0, 0), flat(0.5, 1), flat(-0.5, 1)};
  s.faces = {{0, 1, 2}};
  return s;
}

LeafShape card() {
  LeafShape s;
  s.vertices = {flat(-0.5, 0), flat(0.5, 0), flat(0.5, 1), flat(-0.5, 1)};
  s.faces = {{0, 1, 2, 3}};
  return s;
}

LeafShape crossed() {
  LeafShape s = card();
  for (const double x : {-0.5, 0.5, 0.5, -0.5}) {
    const double y = s.vertices.size() < 6 ? 0 : 1;
    s.vertices.push_back({{0, y, x}, {-1, 0, 0}, {static_cast<float>(x + 0.5), static_cast<float>(y)}});
  }
  s.faces.push_back({4, 5, 6, 7});
  s.components = 2;
  return s;
}

LeafShape two_sided() {
  LeafShape s = card();
  for (std::size_t i = 0; i < 4; ++i) {
    Vertex v = s.vertices[i];
    v.normal = -v.normal;
    s.vertices.push_back(v);
  }
  s.faces.push_back({7, 6, 5, 4});
  s.components = 2;
  return s;
}

// A sheet of columns x rows quads, bent by `height(x, y)` and as wide as `width(y)`.
template <class Height, class Width>
LeafShape sheet(int columns, int rows, Height height, Width width) {
  LeafShape s;
  for (int r = 0; r <= rows; ++r) {
    for (int c = 0; c <= columns; ++c) {
      const double u = static_cast<double>(c) / columns - 0.5, y = static_cast<double>(r) / rows;
      const double x = u * width(y), step = 1e-4;
      const double dx = (height(x + step, y) - height(x - step, y)) / (2 * step);
      const double dy = (height(x, y + step) - height(x, y - step)) / (2 * step);
      s.vertices.push_back({{x, y, height(x, y)},
                            normalized(Double3{-dx, -dy, 1}),
                            {static_cast<float>(u + 0.5), static_cast<float>(y)}});
    }
  }
  for (int r = 0; r < rows; ++r) {
    for (int c = 0; c < columns; ++c) {
      const auto v = static_cast<std::uint32_t>(r * (columns + 1) + c);
      const auto above = v + static_cast<std::uint32_t>(columns) + 1;
      s.faces.push_back({v, v + 1, above + 1, above});
    }
  }
  return s;
}

LeafShape disc() {
  LeafShape s;
  std::vector<std::uint32_t> ring;
  for (std::uint32_t i = 0; i < 8; ++i) {
    const double a = (i / 8.0 - 0.25) * 2 * std::numbers::pi;
    s.vertices.push_back(flat(0.5 * std::cos(a), 0.5 + 0.5 * std::sin(a)));
    ring.push_back(i);
  }
  s.faces = {ring};
  return s;
}

// An icosahedron with every face cut in four.
LeafShape blob() {
  const double g = std::numbers::phi;
  std::vector<Double3> p;
  for (const double a : {-1.0, 1.0})
    for (const double b : {-g, g}) p.push_back({0, a, b}), p.push_back({a, b, 0}), p.push_back({b, 0, a});
  for (Double3& v : p) v = normalized(v);
  std::vector<std::array<std::uint32_t, 3>> faces;
  const auto near = [&](std::size_t a, std::size_t b) {
    return dot(p[a], p[b]) > 0.4 && dot(p[a], p[b]) < 0.5;
  };
  for (std::uint32_t a = 0; a < 12; ++a)
    for (std::uint32_t b = a + 1; b < 12; ++b)
      for (std::uint32_t c = b + 1; c < 12; ++c)
        if (near(a, b) && near(b, c) && near(a, c)) {
          const bool out = dot(cross(p[b] - p[a], p[c] - p[a]), p[a]) > 0;
          faces.push_back(out ? std::array{a, b, c} : std::array{a, c, b});
        }
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [it, fresh] = middles.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(p.size()));
    if (fresh) p.push_back(normalized(p[a] + p[b]));
    return it->second;
  };
  LeafShape s;
  for (const auto& [a, b, c] : faces) {
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    s.faces.insert(s.faces.end(), {{a, ab, ca}, {b, bc, ab}, {c, ca, bc}, {ab, bc, ca}});
  }
  for (const Double3& v : p)
    s.vertices.push_back({{0.5 * v.x, 0.5 + 0.5 * v.y, 0.5 * v.z},
                          v,
                          {static_cast<float>(0.5 + 0.5 * v.x), static_cast<float>(0.5 + 0.5 * v.y)}});
  s.solid = true;
  return s;
}

}  // namespace

LeafShape leaf_shape(const Breaks& breaks) {
  const auto one = [](double) { return 1.0; };
  const auto cup = [](double x, double y) { return 0.5 * x * x - 0.35 * y * y; };
  const auto droop = [](double x, double y) { return -0.5 * std::abs(x) - 0.45 * y * y; };
  const auto blade = [](double y) { return 0.25 + 0.75 * std::sin(std::numbers::pi * (0.12 + 0.85 * y)); };
  if (breaks.has(Break::quad_cards) || breaks.has(Break::needles)) return card();
  if (breaks.has(Break::crossed_cards)) return crossed();
  if (breaks.has(Break::bent_cards)) return sheet(2, 2, cup, one);
  if (breaks.has(Break::two_sided_cards)) return two_sided();
  if (breaks.has(Break::discs)) return disc();
  if (breaks.has(Break::fronds)) return sheet(2, 6, droop, blade);
  if (breaks.has(Break::blobs)) return blob();
  return triangle();
}

}  // namespace copse::grow
