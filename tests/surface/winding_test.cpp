#include "lib/analysis/surface/winding.h"

#include "lib/formats/random.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace copse {
namespace {

struct Tube {
  std::vector<Double3> positions;
  std::vector<Triangle> triangles;
  std::vector<std::uint32_t> piece;
};

// An open tube of six sides round an arc, wound outward.
Tube bent_tube(int rings, const Double3& at = {}) {
  Tube tube;
  for (int r = 0; r < rings; ++r) {
    const double turn = 4.0 * r / rings;
    const Double3 out{std::cos(turn), std::sin(turn), 0};
    for (int i = 0; i < 6; ++i) {
      const double a = i * std::acos(-1.0) / 3;
      tube.positions.push_back(at + out * (5 + 0.3 * std::cos(a)) + Double3{0, 0, 0.3 * std::sin(a)});
    }
  }
  for (std::uint32_t r = 0; r + 1 < static_cast<std::uint32_t>(rings); ++r) {
    for (std::uint32_t i = 0; i < 6; ++i) {
      const std::uint32_t a = 6 * r + i, b = 6 * r + (i + 1) % 6;
      tube.triangles.push_back({a, a + 6, b});
      tube.triangles.push_back({b, a + 6, b + 6});
    }
  }
  tube.piece.assign(tube.triangles.size(), 0);
  return tube;
}

std::vector<std::uint8_t> turned(const Tube& t) {
  return turned_triangles(t.positions, t.triangles, t.piece);
}

TEST(Winding, KeepsAnOpenBentTubeThatIsWoundOutward) {
  const Tube tube = bent_tube(30, {100, 2, -50});
  EXPECT_EQ(turned(tube), std::vector<std::uint8_t>(tube.triangles.size(), 0));
}

TEST(Winding, TurnsJustTheTrianglesThatWereTurned) {
  Tube tube = bent_tube(30);
  Random random(7);
  std::vector<std::uint8_t> flipped;
  for (Triangle& t : tube.triangles) {
    flipped.push_back(random.uniform() < 0.7);
    if (flipped.back() != 0) std::swap(t[1], t[2]);
  }
  EXPECT_EQ(turned(tube), flipped);
}

TEST(Winding, WindsEachPieceByItself) {
  Tube tube = bent_tube(5);
  const Tube other = bent_tube(5, {9, 9, 9});
  for (Triangle t : other.triangles) {
    for (std::uint32_t& v : t) v += 30;
    std::swap(t[0], t[1]);
    tube.triangles.push_back(t);
    tube.piece.push_back(1);
  }
  tube.positions.insert(tube.positions.end(), other.positions.begin(), other.positions.end());
  const std::vector<std::uint8_t> got = turned(tube);
  EXPECT_EQ(std::ranges::count(got, 1), 48);
  EXPECT_TRUE(std::all_of(got.begin() + 48, got.end(), [](std::uint8_t t) { return t == 1; }));
}

TEST(Winding, GoesByMostTrianglesOfAFlatSheet) {
  Tube sheet;
  sheet.positions = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}};
  sheet.triangles = {{0, 1, 4}, {1, 2, 4}, {3, 2, 4}, {3, 0, 4}};
  sheet.piece.assign(4, 0);
  EXPECT_EQ(turned(sheet), (std::vector<std::uint8_t>{0, 0, 1, 0}));
}

TEST(Winding, EndsForAMoebiusStripAndForNothing) {
  Tube strip;
  for (int i = 0; i < 8; ++i) {
    const double a = i * std::acos(-1.0) / 4, b = a / 2;
    for (const double side : {-0.3, 0.3})
      strip.positions.push_back({(1 + side * std::cos(b)) * std::cos(a),
                                 (1 + side * std::cos(b)) * std::sin(a), side * std::sin(b)});
  }
  for (std::uint32_t i = 0; i < 8; ++i) {
    const std::uint32_t a = 2 * i, b = 2 * i + 1, c = i < 7 ? a + 2 : 1, d = i < 7 ? b + 2 : 0;
    strip.triangles.push_back({a, b, c});
    strip.triangles.push_back({b, d, c});
  }
  strip.piece.assign(16, 0);
  EXPECT_EQ(turned(strip).size(), 16u);
  EXPECT_TRUE(turned_triangles({}, {}, {}).empty());
}

}  // namespace
}  // namespace copse
