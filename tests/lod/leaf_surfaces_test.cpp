#include "lib/analysis/lod/leaf_surfaces.h"

#include "lib/analysis/lod/leaf_collapse.h"
#include "lib/analysis/measure/lod_quality.h"
#include "tests/lod/leafy_tree.h"

#include <algorithm>
#include <map>

#include <gtest/gtest.h>

namespace copse {
namespace {

struct Ball {
  Double3 centre;
  double radius = 1;
  int divisions = 3;  // icosahedron's triangles in four, so many times
};

// Icospheres, each a leaf; `split`: every triangle has vertices of its own, as flat shading leaves them.
struct LumpyTree {
  std::vector<Ball> balls{{{0, 2, 0}, 1, 3}};
  bool split = false;
  std::uint32_t cards = 0;

  Tree make() const {
    Tree tree;
    std::vector<Float3> vertices, centres;
    std::vector<CornerTriangle> triangles;
    std::vector<std::uint32_t> first{0};
    for (const Ball& b : balls)
      add(b, vertices, triangles), centres.push_back(to_float(b.centre)),
          first.push_back(static_cast<std::uint32_t>(triangles.size()));
    for (std::uint32_t c = 0; c < cards; ++c) {
      const Double3 at{3 + 0.3 * c, 2, 0};
      LeafyTree::add_card(at, {0.1, 0, 0}, {0, 0.1, 0}, vertices, triangles);
      centres.push_back(to_float(at)), first.push_back(static_cast<std::uint32_t>(triangles.size()));
    }
    LeafyTree{.groups = 1}.finish(tree, std::move(vertices), std::move(triangles), std::move(centres));
    tree.header.leaf_factor = 0, tree.leaves.first_triangle = std::move(first);
    return tree;
  }

  void add(const Ball& ball, std::vector<Float3>& vertices, std::vector<CornerTriangle>& triangles) const {
    const double g = 0.5 * (1 + std::sqrt(5.0));
    std::vector<Double3> p{{-1, g, 0},  {1, g, 0},  {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                           {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {-g, 0, 1}};
    for (Double3& v : p) v = normalized(v);
    std::vector<std::array<std::uint32_t, 3>> faces{
        {0, 11, 5},  {0, 5, 1},  {0, 1, 7},  {0, 7, 10}, {0, 10, 11}, {1, 5, 9}, {5, 11, 4},
        {11, 10, 2}, {10, 7, 6}, {7, 1, 8},  {3, 9, 4},  {3, 4, 2},   {3, 2, 6}, {3, 6, 8},
        {3, 8, 9},   {4, 9, 5},  {2, 4, 11}, {6, 2, 10}, {8, 6, 7},   {9, 8, 1}};
    for (int d = 0; d < ball.divisions; ++d) {
      std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> middle;
      const auto between = [&](std::uint32_t a, std::uint32_t b) {
        const auto [at, fresh] = middle.try_emplace(std::minmax(a, b), static_cast<std::uint32_t>(p.size()));
        if (fresh) p.push_back(normalized(p[a] + p[b]));
        return at->second;
      };
      std::vector<std::array<std::uint32_t, 3>> next;
      for (const auto& [a, b, c] : faces) {
        const std::uint32_t x = between(a, b), y = between(b, c), z = between(c, a);
        next.insert(next.end(), {{a, x, z}, {b, y, x}, {c, z, y}, {x, y, z}});
      }
      faces = std::move(next);
    }
    const auto base = static_cast<std::uint32_t>(vertices.size());
    if (!split)
      for (const Double3& v : p) vertices.push_back(to_float(ball.centre + v * ball.radius));
    for (const auto& f : faces) {
      CornerTriangle t;
      for (int c = 0; c < 3; ++c) {
        t.vertex[c] = split ? static_cast<std::uint32_t>(vertices.size()) : base + f[c];
        if (split) vertices.push_back(to_float(ball.centre + p[f[c]] * ball.radius));
      }
      triangles.push_back(t);
    }
  }
};

std::vector<Ball> crown(int divisions) {
  std::vector<Ball> out;
  Random draw(7);
  for (int i = 0; i < 12; ++i)
    out.push_back(
        {{draw.uniform(-2, 2), draw.uniform(2, 5), draw.uniform(-2, 2)}, draw.uniform(0.5, 1), divisions});
  return out;
}

std::uint32_t step_with(const Spectrum& s, std::size_t triangles) {
  std::uint32_t n = 0;
  while (n < s.steps() && s.counts[n] > triangles) ++n;
  return n;
}

TEST(LeafSurfaces, ABallKeepsItsOutlineItsAreaAndItsHullAtATenth) {
  for (const bool split : {false, true}) {
    for (const CollapseQuality quality : {CollapseQuality::fast, CollapseQuality::balanced}) {
      const Spectrum s = collapse_spectrum(LumpyTree{.split = split}.make(), {}, {.quality = quality});
      const LodJudge judge(drawn_state(s, 0), {}, {.views = 12, .image_size = 64, .mask_size = 128});
      const LodQuality q = judge.measure(drawn_state(s, step_with(s, 128)));
      EXPECT_GT(q.iou, 0.96) << split;
      EXPECT_NEAR(q.area_ratio, 1, 0.02) << split;
      EXPECT_NEAR(q.coverage_ratio, 1, 0.03) << split;
      EXPECT_LE(q.hull_growth, 0.03) << split;
    }
  }
}

TEST(LeafSurfaces, ItIsToldWhichLeavesLostEdges) {
  CollapsedLumps told;
  collapse_spectrum(LumpyTree{.balls = crown(1), .cards = 5}.make(), {}, {.quality = CollapseQuality::fast},
                    &told);
  EXPECT_EQ(told.lumps, 12u);
  EXPECT_EQ(told.triangles, 12u * 80);
  EXPECT_GT(told.share, 0.5);
  EXPECT_LT(told.share, 1);
  EXPECT_LT(told.left, told.triangles);
  EXPECT_GT(told.left, 0u);
}

TEST(LeafSurfaces, ACrownOfBallsKeepsItsOutlineAtATenth) {
  const Spectrum s = collapse_spectrum(LumpyTree{.balls = crown(2)}.make());
  ASSERT_EQ(s.counts[0], 12u * 320);
  const LodJudge judge(drawn_state(s, 0), {}, {.views = 12, .image_size = 64, .mask_size = 128});
  const LodQuality q = judge.measure(drawn_state(s, step_with(s, 384)));
  EXPECT_GT(q.iou, 0.93);
  EXPECT_NEAR(q.area_ratio, 1, 0.02);
  EXPECT_NEAR(q.coverage_ratio, 1, 0.05);
  EXPECT_LE(q.hull_growth, 0.03);
}

TEST(LeafSurfaces, CountsAreWhatIsDrawnAndTheLastStepIsWhatIsLeft) {
  const LeafPieces pieces = leaf_pieces(LumpyTree{.balls = crown(1), .cards = 5}.make());
  const auto lumps = collapse_surfaces(pieces);
  ASSERT_TRUE(lumps);
  const Spectrum& s = lumps->spectrum;
  EXPECT_EQ(s.method, LodMethod::collapse);
  const double full = area(drawn_state(s, 0));
  for (std::uint32_t n = 0; n <= s.steps(); n += 7) {
    EXPECT_EQ(drawn_state(s, n).triangles.size(), s.counts[n]);
    EXPECT_NEAR(area(drawn_state(s, n)) / full, 1, 0.02) << n;
  }
  EXPECT_LT(s.counts[s.steps()], 12u * 20) << "triangles of 12 x 80";
  EXPECT_EQ(lumps->left.part.triangles.size(), s.counts[s.steps()]);
  EXPECT_EQ(lumps->left.triangles.size(), s.counts[s.steps()]);
}

TEST(LeafSurfaces, CardsBesideLumpsStayUntilTheLumpsAreDone) {
  const LeafPieces pieces = leaf_pieces(LumpyTree{.cards = 5}.make());
  const auto lumps = collapse_surfaces(pieces);
  ASSERT_TRUE(lumps);
  const auto& list = lumps->left.list;
  EXPECT_EQ(std::count_if(list.begin(), list.end(), [](const LeafPiece& p) { return p.last - p.first == 2; }),
            5);
}

TEST(LeafSurfaces, JoinedIsTheOneAndThenTheOther) {
  const Tree tree = LumpyTree{.balls = crown(1)}.make();
  const auto lumps = collapse_surfaces(leaf_pieces(tree));
  ASSERT_TRUE(lumps);
  const Spectrum& first = lumps->spectrum;
  const Spectrum s = collapse_spectrum(tree);
  ASSERT_GT(s.steps(), first.steps());
  EXPECT_GT(s.errors[1], 0) << "of a ball even the first edge";
  for (std::uint32_t n = 0; n <= s.steps(); n += 3) {
    EXPECT_EQ(drawn_state(s, n).triangles.size(), s.counts[n]);
    if (n > 0) {
      EXPECT_GE(s.errors[n], s.errors[n - 1]);
      EXPECT_LE(s.counts[n], s.counts[n - 1]);
    }
    if (n <= first.steps()) {
      EXPECT_NEAR(area(drawn_state(s, n)), area(drawn_state(first, n)), 1e-9);
    }
  }
  EXPECT_EQ(s.counts[s.steps()], 1u);
}

TEST(LeafSurfaces, CardsAndTrianglesAreNoLumps) {
  EXPECT_FALSE(collapse_surfaces(leaf_pieces(LeafyTree{}.make())));
  EXPECT_FALSE(collapse_surfaces(leaf_pieces(Tree{})));
}

TEST(LeafSurfaces, LumpsOfNoSizeOrOfAnySizeGiveFiniteStates) {
  for (const double size : {0.0, 1e-18, 1e12}) {
    const Spectrum s = collapse_spectrum(LumpyTree{.balls = {{{0, 0, 0}, size, 1}}}.make());
    EXPECT_EQ(s.counts[0], 80u);
    for (const SpectrumVertex& v : s.vertices) EXPECT_TRUE(is_finite(v.position)) << size;
  }
}

}  // namespace
}  // namespace copse
