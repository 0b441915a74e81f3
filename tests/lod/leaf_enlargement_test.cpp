#include "lib/analysis/lod/leaf_enlargement.h"

#include "lib/analysis/lod/foliage_pruning.h"
#include "lib/analysis/measure/view_sphere.h"
#include "lib/formats/random.h"
#include "tests/lod/leafy_tree.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace copse {
namespace {

struct Crown {
  explicit Crown(const LeafyTree& leafy, std::uint32_t cells = 32)
      : tree(leafy.make()),
        part(leaf_triangles(tree)),
        foliage(prune_foliage(tree, {}, {.cells = cells, .views = 12, .resolution = 16})) {}
  double leaf_area(std::uint32_t leaf) const {
    double sum = 0;
    for (std::size_t t = tree.first_triangle_of_leaf(leaf); t < tree.first_triangle_of_leaf(leaf + 1); ++t) {
      const auto& f = part.triangles[t];
      const Double3 a = to_double(part.vertices[f[0]].position);
      sum += 0.5 * length(cross(to_double(part.vertices[f[1]].position) - a,
                                to_double(part.vertices[f[2]].position) - a));
    }
    return sum;
  }
  double sum(const std::vector<double>& factors) const {
    double out = 0;
    for (std::size_t i = 0; i < factors.size(); ++i) out += factors[i] * leaf_area(foliage.order[i]);
    return out;
  }
  std::vector<double> factors(const std::vector<std::uint32_t>& shown) const {
    return LeafEnlargement(tree, part, foliage).factors(shown);
  }
  Tree tree;
  PartTriangles part;
  FoliageCells foliage;
};

std::vector<std::uint32_t> share_of(const Crown& crown, double share) {
  std::vector<std::uint32_t> shown;
  for (const FoliageCell& cell : crown.foliage.cells) shown.push_back(shown_leaves(cell.count, share));
  return shown;
}

TEST(LeafEnlargement, EqualLeavesOfACellGrowByTheRatioOfTheirNumbers) {
  const Crown crown(LeafyTree{.leaves = 64, .half = 0.01}, 1);
  const std::vector<double> factors = crown.factors({16});
  for (std::size_t i = 0; i < factors.size(); ++i) EXPECT_NEAR(factors[i], i < 16 ? 4 : 0, 1e-5) << i;
}

TEST(LeafEnlargement, WhereAllAreShownNoneGrowsAndWhereNoneIsNoneIs) {
  const Crown crown(LeafyTree{.half = 0.3});
  for (const double f : crown.factors(share_of(crown, 1))) EXPECT_EQ(f, 1);
  for (const double f : crown.factors(std::vector<std::uint32_t>(crown.foliage.cells.size(), 0)))
    EXPECT_EQ(f, 0);
}

TEST(LeafEnlargement, TheAreasAddUpWhicheverPrefixesAreShown) {
  Random random(5);
  for (const double half : {0.01, 0.05, 0.1}) {
    const Crown crown(LeafyTree{.leaves = 600, .half = half});
    const double full = crown.sum(std::vector<double>(600, 1.0));
    for (int k = 0; k < 20; ++k) {
      std::vector<std::uint32_t> shown;
      for (const FoliageCell& cell : crown.foliage.cells)
        shown.push_back(static_cast<std::uint32_t>(random.uniform() * (cell.count + 1)));
      const std::vector<double> factors = crown.factors(shown);
      EXPECT_NEAR(crown.sum(factors) / full, 1, 1e-9) << half;
      for (std::size_t c = 0; c < shown.size(); ++c)
        for (std::uint32_t i = 0; i < crown.foliage.cells[c].count; ++i) {
          const double f = factors[crown.foliage.cells[c].first + i];
          ASSERT_EQ(f > 0, i < shown[c]);
          ASSERT_TRUE(f == 0 || f >= 1) << f;
        }
    }
  }
}

TEST(LeafEnlargement, ACellThatCannotHoldItsAreaSharesItWithItsNeighbours) {
  const Crown crown(LeafyTree{.leaves = 600, .half = 0.1});
  auto shown = share_of(crown, 1);
  shown[3] = 0;
  const std::vector<double> factors = crown.factors(shown);
  EXPECT_NEAR(crown.sum(factors) / crown.sum(std::vector<double>(600, 1.0)), 1, 1e-9);
  std::size_t grown = 0;
  for (std::size_t c = 0; c < shown.size(); ++c) {
    const FoliageCell& cell = crown.foliage.cells[c];
    const bool grows = std::any_of(factors.begin() + cell.first, factors.begin() + cell.first + cell.count,
                                   [](double f) { return f > 1; });
    grown += grows;
    if (c / 8 != 0) {
      EXPECT_FALSE(grows) << c << " is far away";
    }
  }
  EXPECT_GE(grown, 1u);
}

TEST(LeafEnlargement, NothingReachesOutOfTheHullOrGrowsByMoreThanTheLargest) {
  Crown crown(LeafyTree{.leaves = 300, .half = 0.25});
  crown.foliage.parameters.largest_enlargement = 20;
  const std::vector<double> factors = crown.factors(share_of(crown, 0.02));
  const double full = crown.sum(std::vector<double>(300, 1.0));
  EXPECT_LT(crown.sum(factors), 0.99 * full) << "they do not fit";
  for (const double f : factors) EXPECT_LE(f, 20);
  for (const Double3& d : view_sphere(2).directions) {
    double before = -std::numeric_limits<double>::infinity(), after = before, behind = before;
    for (std::size_t i = 0; i < factors.size(); ++i) {
      const std::uint32_t l = crown.foliage.order[i];
      const Double3 c = to_double(crown.tree.leaves.centres[l]);
      for (std::size_t t = 2 * l; t < 2 * l + 2; ++t) {
        for (const std::uint32_t v : crown.part.triangles[t]) {
          const Double3 p = to_double(crown.part.vertices[v].position);
          before = std::max(before, dot(p, d)), behind = std::max(behind, -dot(p, d));
          if (factors[i] > 0) after = std::max(after, dot(c + (p - c) * std::sqrt(factors[i]), d));
        }
      }
    }
    EXPECT_LE(after - before, 0.0121 * 5) << "the crown is less than 5 m wide";
    EXPECT_LT(before + behind, 5);
  }
}

TEST(LeafEnlargement, LeavesWithoutAreaAreNoTrouble) {
  const Crown crown(LeafyTree{.leaves = 40, .half = 0}, 4);
  for (const double f : crown.factors(share_of(crown, 0.1))) EXPECT_TRUE(f == 0 || f == 1) << f;
  const Tree none;
  EXPECT_TRUE(LeafEnlargement(none, leaf_triangles(none), {}).factors({}).empty());
}

}  // namespace
}  // namespace copse
