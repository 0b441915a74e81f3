// Little OBJ models for the tests of the tools.
#pragma once

#include <cmath>
#include <numbers>
#include <string>

namespace copse {

// A tapering trunk of `rings` rings of k vertices from y = -1 upwards, one unit apart, and `leaves` triangles
// round its top. It obeys the strict model: k is constant, the first ring is below the ground, leaves are
// isolated triangles.
inline std::string little_tree_obj(int k = 6, int rings = 5, int leaves = 4, const std::string& extra = "") {
  std::string obj = "mtllib none.mtl\nvt 0 0\nvt 1 0\nvt 0.5 1\no trunk\nusemtl bark\n";
  for (int r = 0; r < rings; ++r) {
    const double radius = 0.5 * (1.0 - 0.15 * r);
    for (int i = 0; i < k; ++i) {
      const double a = 2 * std::numbers::pi * i / k;
      obj += "v " + std::to_string(radius * std::cos(a)) + " " + std::to_string(r - 1) + " " +
             std::to_string(radius * std::sin(a)) + "\n";
    }
  }
  const auto corner = [](int v) { return std::to_string(v) + "/" + std::to_string(v % 3 + 1); };
  for (int r = 0; r + 1 < rings; ++r) {
    for (int i = 0; i < k; ++i) {
      const int a = 1 + r * k + i, b = 1 + r * k + (i + 1) % k;
      obj += "f " + corner(a) + " " + corner(a + k) + " " + corner(b) + "\n";
      obj += "f " + corner(b) + " " + corner(a + k) + " " + corner(b + k) + "\n";
    }
  }
  obj += "o leaves\nusemtl leaf\n";
  for (int i = 0; i < leaves; ++i) {
    const double a = 2 * std::numbers::pi * i / (leaves > 0 ? leaves : 1), x = 1.2 * std::cos(a),
                 z = 1.2 * std::sin(a);
    const double y = rings - 1.5;
    const auto v = [&](double dx, double dy) {
      obj += "v " + std::to_string(x + dx) + " " + std::to_string(y + dy) + " " + std::to_string(z) + "\n";
    };
    v(-0.2, 0), v(0.2, 0), v(0, 0.4);
    obj += "f -3/1 -2/2 -1/3\n";
  }
  return obj + extra;
}

inline std::string little_mtl() {
  return "newmtl bark\nKd 0.4 0.3 0.2\nnewmtl leaf\nKd 0.2 0.6 0.2\n";
}

}  // namespace copse
