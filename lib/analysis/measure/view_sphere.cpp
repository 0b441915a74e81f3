#include "lib/analysis/measure/view_sphere.h"

#include <cmath>
#include <map>
#include <numbers>

namespace copse {
namespace {

ViewSphere icosahedron() {
  const double g = std::numbers::phi;
  ViewSphere s;
  for (const double a : {-1.0, 1.0}) {
    for (const double b : {-g, g}) {
      s.directions.push_back({0, a, b});
      s.directions.push_back({a, b, 0});
      s.directions.push_back({b, 0, a});
    }
  }
  // Corners two apart are neighbours (edge length 2): every triple of neighbours is a face.
  const auto near = [&](int i, int j) { return distance(s.directions[i], s.directions[j]) < 2.1; };
  for (std::uint32_t i = 0; i < 12; ++i)
    for (std::uint32_t j = i + 1; j < 12; ++j)
      for (std::uint32_t k = j + 1; k < 12; ++k) {
        if (!near(i, j) || !near(j, k) || !near(i, k)) continue;
        const bool out = dot(cross(s.directions[j] - s.directions[i], s.directions[k] - s.directions[i]),
                             s.directions[i]) > 0;
        s.triangles.push_back(out ? Triangle{i, j, k} : Triangle{i, k, j});
      }
  for (Double3& d : s.directions) d = normalized(d);
  return s;
}

void subdivide(ViewSphere& s) {
  std::map<std::array<std::uint32_t, 2>, std::uint32_t> middles;
  const auto middle = [&](std::uint32_t a, std::uint32_t b) {
    const auto [at, fresh] = middles.try_emplace({std::min(a, b), std::max(a, b)},
                                                 static_cast<std::uint32_t>(s.directions.size()));
    if (fresh) s.directions.push_back(normalized(s.directions[a] + s.directions[b]));
    return at->second;
  };
  std::vector<Triangle> finer;
  for (const auto& [a, b, c] : s.triangles) {
    const std::uint32_t ab = middle(a, b), bc = middle(b, c), ca = middle(c, a);
    finer.insert(finer.end(), {Triangle{a, ab, ca}, {ab, b, bc}, {ca, bc, c}, {ab, bc, ca}});
  }
  s.triangles = std::move(finer);
}

}  // namespace

ViewSphere view_sphere(int subdivisions) {
  ViewSphere s = icosahedron();
  for (int i = 0; i < subdivisions; ++i) subdivide(s);
  return s;
}

int subdivisions_for(int views) {
  int n = 0;
  while (n < 6 && 10 * (1 << (2 * n)) + 2 < views) ++n;
  return n;
}

OrthographicView view_of_sphere(const Double3& centre, double radius, const Double3& toward, int size) {
  OrthographicView view;
  view.toward = normalized(toward, {0, 0, 1});
  const Double3 up = std::abs(view.toward.y) < 0.999 ? Double3{0, 1, 0} : Double3{0, 0, 1};
  view.right = normalized(cross(up, view.toward));
  view.up = cross(view.toward, view.right);
  view.centre = centre;
  view.pixel = radius > 0 ? 2 * radius / size : 1;
  view.width = view.height = size;
  return view;
}

}  // namespace copse
