#include "lib/analysis/leaves/piece_shape.h"

#include "lib/analysis/surface/weld.h"
#include "tests/leaves/shapes.h"

#include <numeric>

#include <gtest/gtest.h>

namespace copse {
namespace {

using shapes::Builder;
using shapes::line;

PieceShape shape(const Mesh& mesh) {
  const std::vector<std::uint32_t> welded = weld(mesh.positions, 0.0), key(mesh.parts.size(), 0);
  const Pieces pieces = edge_pieces(mesh.triangles, welded, mesh.part_of, key);
  EXPECT_EQ(pieces.count, 1u);
  std::vector<std::uint32_t> all(mesh.triangles.size());
  std::iota(all.begin(), all.end(), 0u);
  return shape_of(mesh, welded, pieces, all);
}

// A strip that bends by `turn` radians along its length.
Mesh frond(double turn, double width) {
  Builder b;
  constexpr int k_steps = 16;
  for (int i = 0; i < k_steps; ++i) {
    const auto at = [&](int k, double side) {
      const double a = turn * k / k_steps;
      return Double3{std::sin(a) / turn, (1 - std::cos(a)) / turn, side * width / 2};
    };
    b.triangle(at(i, -1), at(i + 1, -1), at(i + 1, 1)), b.triangle(at(i, -1), at(i + 1, 1), at(i, 1));
  }
  return b.mesh;
}

TEST(PieceShape, ACardIsAPlanarSheetWithAKnownBorder) {
  Builder b;
  b.card({1, 2, 3}, {1, 0, 0}, {0, 1, 0});
  const PieceShape s = shape(b.mesh);
  EXPECT_EQ(s.kind, ShapeKind::sheet);
  EXPECT_TRUE(s.planar);
  EXPECT_DOUBLE_EQ(s.border_ratio, 16);
  EXPECT_DOUBLE_EQ(s.area, 4);
  EXPECT_DOUBLE_EQ(s.size, std::sqrt(8.0));
}

TEST(PieceShape, BendingASheetDoesNotMakeItAStem) {
  for (const double turn : {0.1, 1.0, 2.0, 3.0}) {
    const PieceShape s = shape(frond(turn, 0.2));
    EXPECT_EQ(s.kind, ShapeKind::sheet) << turn;
    EXPECT_FALSE(s.planar) << turn;
    EXPECT_NEAR(s.border_ratio, 4 * 1.2 * 1.2 / 0.2, 0.2) << turn;
  }
}

TEST(PieceShape, ATubeIsAStemHoweverItEndsAndBends) {
  for (const int sides : {3, 4, 6, 12}) {
    Builder b;
    b.tube(line({0, 0, 0}, {0, 1, 0}, 4), 0.05, sides);
    EXPECT_EQ(shape(b.mesh).kind, ShapeKind::stem) << sides;
  }
  Builder bent;
  std::vector<Double3> arc;
  for (int i = 0; i <= 12; ++i) arc.push_back({std::cos(i * 0.25), std::sin(i * 0.25), 0});
  bent.tube(arc, 0.04, 6);
  EXPECT_EQ(shape(bent.mesh).kind, ShapeKind::stem);
}

TEST(PieceShape, AShortOpenTubeIsNoSheetAndAConeOfTheSameBorderIs) {
  Builder tube;
  tube.tube({{0, 0, 0}, {0, 1, 0}}, 0.35, 8);
  EXPECT_EQ(shape(tube.mesh).kind, ShapeKind::stem);
  Builder disc;  // a leaf disc of eight sides that is a flat cone
  for (int i = 0; i < 8; ++i) {
    const auto rim = [](int k) { return Double3{std::cos(k % 8 * 0.7854), 0, std::sin(k % 8 * 0.7854)}; };
    disc.triangle({0, 0.1, 0}, rim(i), rim(i + 1));
  }
  EXPECT_EQ(shape(disc.mesh).kind, ShapeKind::sheet);
}

TEST(PieceShape, ATreeInOneSurfaceIsAStemHoweverManyOpenTipsItHas) {
  shapes::Builder b;
  for (int i = 0; i < 100; ++i) {
    const double y = i;
    b.tube({{0, y, 0}, {0, y + 1, 0}}, 0.5, 6);
    b.tube({{0, y, 0}, {4, y + 2, 0}, {0, y + 8, 0}}, 0.5, 6);  // grows from the same ring
  }
  EXPECT_EQ(shape(b.mesh).kind, ShapeKind::stem);
}

TEST(PieceShape, ABallIsABlobAndAFlatOneAPlate) {
  Builder ball, plate;
  ball.ball({0, 0, 0}, 1);
  EXPECT_EQ(shape(ball.mesh).kind, ShapeKind::blob);
  EXPECT_LT(shape(ball.mesh).elongation, 1.2);
  plate.ball({0, 0, 0}, 1, 0.1);
  EXPECT_EQ(shape(plate.mesh).kind, ShapeKind::sheet);
  EXPECT_TRUE(shape(plate.mesh).solid);
}

TEST(PieceShape, ALayerLaidDoubleIsJudgedAsOne) {
  for (Mesh mesh : {frond(2.0, 0.2), [] {
                      Builder b;
                      b.tube(line({0, 0, 0}, {0, 1, 0}, 4), 0.05, 6);
                      return b.mesh;
                    }()}) {
    const PieceShape single = shape(mesh);
    for (std::size_t t = 0, end = mesh.triangles.size(); t < end; ++t) {
      mesh.triangles.push_back({mesh.triangles[t][2], mesh.triangles[t][1], mesh.triangles[t][0]});
      mesh.part_of.push_back(mesh.part_of[t]);
    }
    const PieceShape twice = shape(mesh);
    EXPECT_EQ(twice.border_ratio, 0);
    EXPECT_EQ(twice.kind, single.kind);
  }
}

TEST(PieceShape, DoesNotDependOnScaleOrPlace) {
  for (const double scale : {1e-100, 1e-30, 1.0, 1e30, 1e100}) {
    Builder b;
    b.tube(line({0, 0, 0}, {0, 1, 0}, 4), 0.05, 6);
    for (Double3& p : b.mesh.positions) p *= scale;
    const PieceShape s = shape(b.mesh);
    EXPECT_EQ(s.kind, ShapeKind::stem) << scale;
    EXPECT_NEAR(s.border_ratio, 1.2, 1e-9) << scale;
  }
}

TEST(PieceShape, WithoutAreaItIsASheetWithoutArea) {
  Builder b;
  b.triangle({0, 0, 0}, {1, 1, 1}, {2, 2, 2});
  const PieceShape s = shape(b.mesh);
  EXPECT_EQ(s.kind, ShapeKind::sheet);
  EXPECT_EQ(s.area, 0);
}

}  // namespace
}  // namespace copse
