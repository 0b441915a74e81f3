#include "lib/analysis/lod/foliage_pruning.h"

#include "lib/analysis/measure/drawn_mesh.h"
#include "tests/lod/leafy_tree.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <set>

#include <gtest/gtest.h>

namespace copse {
namespace {

const PruningOptions k_small{.cells = 16, .views = 12, .resolution = 32};

TEST(FoliagePruning, GivesSoundCells) {
  const Tree tree = LeafyTree{}.make();
  const FoliageCells f = prune_foliage(tree, {}, k_small);
  EXPECT_EQ(check_foliage_cells(f, 200), "");
  EXPECT_EQ(f.cells.size(), 16u);
  EXPECT_EQ(f.views.size(), 12u);
  EXPECT_EQ(f.parameters.leaves, hash_leaves(tree));
  EXPECT_GT(f.parameters.far, f.parameters.near);
}

TEST(FoliagePruning, OuterCellsAreSeenMoreThanInnerOnes) {
  const Tree tree = LeafyTree{.leaves = 3000, .half = 0.15}.make();
  const FoliageCells f = prune_foliage(tree, {}, {.cells = 128, .views = 12, .resolution = 64});
  double inner = 0, outer = 0, inners = 0, outers = 0;
  for (std::size_t c = 0; c < f.cells.size(); ++c) {
    const double r = length(to_double(f.cells[c].box.centre));
    double seen = 0;
    for (std::size_t v = 0; v < f.views.size(); ++v) seen += f.at(c, v).share() / 12;
    if (r < 1) inner += seen, ++inners;
    if (r > 1.5) outer += seen, ++outers;
  }
  EXPECT_GT(outer / outers, 3 * inner / inners);
}

TEST(FoliagePruning, EveryPrefixIsSpreadOverTheCell) {
  const Tree tree = LeafyTree{.leaves = 512, .groups = 1}.make();
  const FoliageCells f = prune_foliage(tree, {}, {.cells = 1, .views = 12, .resolution = 16});
  for (const std::uint32_t m : {16u, 64u, 256u}) {
    std::array<int, 8> octants{};
    for (std::uint32_t i = 0; i < m; ++i) {
      const Float3 c = tree.leaves.centres[f.order[i]];
      ++octants[(c.x > 0) + 2 * (c.y > 0) + 4 * (c.z > 0)];
    }
    for (const int n : octants) EXPECT_GE(n, int(m) / 32) << m;
  }
}

TEST(FoliagePruning, ShowsWhatAFractionSays) {
  EXPECT_EQ(shown_leaves(10, 1), 10u);
  EXPECT_EQ(shown_leaves(10, 0.5), 5u);
  EXPECT_EQ(shown_leaves(10, 0.51), 6u);
  EXPECT_EQ(shown_leaves(10, 0.3 - 1e-17), 3u);
  EXPECT_EQ(shown_leaves(10, 0), 1u);
  EXPECT_EQ(shown_leaves(10, -3), 1u);
  EXPECT_EQ(shown_leaves(10, 7), 10u);
  EXPECT_EQ(shown_leaves(10, std::numeric_limits<double>::quiet_NaN()), 10u);
  EXPECT_EQ(shown_leaves(0, 1), 0u);
}

TEST(FoliagePruning, AsASpectrumIsASequenceOfSubsetsThatKeepsTheArea) {
  const Tree tree = LeafyTree{.leaves = 400, .half = 0.02}.make();
  const FoliageCells f = prune_foliage(tree, {}, k_small);
  const Spectrum s = pruned_spectrum(tree, f);
  EXPECT_EQ(s.method, LodMethod::prune);
  EXPECT_EQ(s.counts[0], 800u);
  EXPECT_EQ(s.counts[s.steps()], 2u) << "one leaf";
  const double full = area(drawn_state(s, 0));
  std::set<std::array<float, 3>> before;
  for (std::uint32_t n = 0; n <= s.steps(); ++n) {
    const DrawnMesh state = drawn_state(s, n);
    EXPECT_EQ(state.triangles.size(), s.counts[n]);
    if (s.counts[n] > 100) {
      EXPECT_NEAR(area(state) / full, 1, 1e-4) << n;
    }
    // A leaf keeps its centre when it grows: the middle of its diagonal.
    std::set<std::array<float, 3>> now;
    for (std::size_t t = 0; t < state.triangles.size(); t += 2) {
      const Double3 c = (state.positions[state.triangles[t][0]] + state.positions[state.triangles[t][2]]) / 2;
      now.insert({std::round(float(c.x * 1e3)), std::round(float(c.y * 1e3)), std::round(float(c.z * 1e3))});
    }
    std::size_t lost = 0;
    for (const auto& c : now) lost += n > 0 && !before.contains(c);
    EXPECT_LE(lost, now.size() / 20) << "not a subset (but for rounding) at step " << n;
    before = now;
  }
}

TEST(FoliagePruning, ATenthAndAFiftiethOfTheLeavesHaveTheAreaOfAll) {
  for (const double half : {0.02, 0.05, 0.1}) {
    const Tree tree = LeafyTree{.leaves = 1000, .half = half}.make();
    const Spectrum s =
        pruned_spectrum(tree, prune_foliage(tree, {}, {.cells = 64, .views = 12, .resolution = 16}));
    const double full = area(drawn_state(s, 0));
    for (std::uint32_t n = 0; n <= s.steps(); ++n) {
      if (s.counts[n] < s.counts[0] / (half < 0.1 ? 50 : 10)) break;  // larger ones do not fit
      EXPECT_NEAR(area(drawn_state(s, n)) / full, 1, 1e-4) << half << ", " << s.counts[n];
    }
  }
}

TEST(FoliagePruning, FewerLeavesThanCellsAreLeftEvenlyOverTheCrown) {
  std::vector<FoliageCell> cells(64);
  for (std::uint32_t c = 0; c < 64; ++c) cells[c].first = 10 * c, cells[c].count = 10;
  std::vector<std::uint32_t> before(64, 10);
  for (double fraction = 1; fraction > 1e-4; fraction *= 0.9) {
    const std::vector<std::uint32_t> shown = shown_cells(cells, fraction);
    std::array<std::uint32_t, 4> quarters{};
    std::uint32_t total = 0;
    for (std::uint32_t c = 0; c < 64; ++c) {
      EXPECT_LE(shown[c], before[c]) << "a subset";
      quarters[c / 16] += shown[c], total += shown[c];
    }
    if (640 * fraction < 64) {
      EXPECT_EQ(total, std::max(1.0, std::ceil(640 * fraction - 1e-9)));
      const auto [least, most] = std::minmax_element(quarters.begin(), quarters.end());
      EXPECT_LE(*most - *least, 1u) << total;
    }
    before = shown;
  }
  EXPECT_EQ(std::accumulate(before.begin(), before.end(), 0u), 1u);
  EXPECT_TRUE(shown_cells({}, 0.5).empty());
}

TEST(FoliagePruning, IsTheSameForTheSameSeedAndAnotherForAnother) {
  const Tree tree = LeafyTree{}.make();
  PruningOptions other = k_small;
  other.seed = 1;
  const FoliageCells a = prune_foliage(tree, {}, k_small), b = prune_foliage(tree, {}, k_small),
                     c = prune_foliage(tree, {}, other);
  EXPECT_EQ(a.order.to_vector(), b.order.to_vector());
  EXPECT_EQ(a.visibility.to_vector(), b.visibility.to_vector());
  EXPECT_NE(a.order.to_vector(), c.order.to_vector());
}

TEST(FoliagePruning, OfNoLeavesIsEmpty) {
  const FoliageCells f = prune_foliage(Tree{}, {}, k_small);
  EXPECT_TRUE(f.cells.empty());
  EXPECT_EQ(check_foliage_cells(f, 0), "");
  EXPECT_TRUE(pruned_spectrum(Tree{}, f).elements.empty());
}

}  // namespace
}  // namespace copse
