#include "lib/analysis/lod/leaf_occlusion.h"

#include "lib/formats/random.h"

#include <algorithm>
#include <deque>

#include <gtest/gtest.h>
#include <tbb/global_control.h>

namespace copse {
namespace {

// Leaves that stay where they are while others are added.
class Crown {
 public:
  // Two triangles across an axis.
  void square(const Double3& centre, double half, int axis) {
    Double3 u{}, v{};
    u[(axis + 1) % 3] = half, v[(axis + 2) % 3] = half;
    auto& corners = corners_.emplace_back();
    for (const Double3& p : {centre - u - v, centre + u - v, centre + u + v, centre - u + v})
      corners.push_back({to_float(p), {}, {}});
    leaves_.push_back({corners, k_two, nullptr});
  }
  // Six squares round a place.
  void box(const Double3& centre, double half) {
    for (int axis = 0; axis < 3; ++axis)
      for (const double side : {-half, half}) {
        Double3 c = centre;
        c[axis] += side;
        square(c, half, axis);
      }
  }
  void drop(std::size_t leaf) { leaves_[leaf].mask = &k_nothing; }

  Occlusion run(const OcclusionOptions& options) const {
    return leaves_by_occlusion(leaves_, {}, 4, DoubleBox{{-2, -2, -2}, {2, 2, 2}}, options);
  }
  std::size_t size() const { return leaves_.size(); }

 private:
  static constexpr std::array<std::array<std::uint32_t, 3>, 2> k_two{{{0, 1, 2}, {0, 2, 3}}};
  inline static const AlphaMask k_nothing{1, 1, {0}};
  std::deque<std::vector<SpectrumVertex>> corners_;
  std::vector<ViewedLeaf> leaves_;
};

Crown cloud(std::uint32_t leaves, double half) {
  Crown crown;
  Random draw(7);
  const auto at = [&] { return draw.uniform(-1.5, 1.5); };
  for (std::uint32_t l = 0; l < leaves; ++l) crown.square({at(), at(), at()}, half, int(l % 3));
  return crown;
}

TEST(LeafOcclusion, WhatABoxHidesGoesAndTheBoxStays) {
  Crown crown;
  for (int i = 0; i < 30; ++i) crown.square({0.02 * i - 0.3, 0, 0}, 0.3, i % 3);
  crown.box({}, 1);
  const Occlusion o = crown.run({.samples = 200, .least = 12});
  ASSERT_EQ(o.gone.size(), 30u);
  for (const std::uint32_t leaf : o.gone) EXPECT_LT(leaf, 30u);
}

TEST(LeafOcclusion, EndsWithTheTrianglesAndBeforeTheCoverageThatWasAskedFor) {
  const Crown crown = cloud(400, 0.2);
  EXPECT_EQ(crown.run({.coverage = 0, .least = 300}).gone.size(), 250u);
  EXPECT_EQ(crown.run({.coverage = 0}).gone.size(), 400u);
  EXPECT_TRUE(crown.run({.coverage = 0, .least = 801}).gone.empty());
  const std::size_t strict = crown.run({.coverage = 0.99}).gone.size(),
                    lax = crown.run({.coverage = 0.9}).gone.size();
  EXPECT_LT(strict, lax);
  EXPECT_LT(lax, 400u);
}

// Leaves that were not drawn while they were chosen among say what coverage is left.
TEST(LeafOcclusion, KeepsTheCoverageFromSidesThatHadNoSay) {
  const Crown crown = cloud(3000, 0.1);
  const Occlusion o = crown.run({.coverage = 0.98});
  Crown left = cloud(3000, 0.1);
  for (const std::uint32_t g : o.gone) left.drop(g);
  const auto seen = [](const Crown& c) {
    return c.run({.views = 40, .samples = 400, .least = 1u << 20}).seen;
  };
  EXPECT_NEAR(seen(left) / seen(crown), 0.98, 0.015);
}

TEST(LeafOcclusion, CountsWhatIsCoveredAndWhatIsSeen) {
  Crown one;
  one.square({}, 1, 1);
  const Occlusion alone = one.run({.samples = 4000, .least = 2});
  EXPECT_NEAR(alone.covered, 4000, 600);
  EXPECT_DOUBLE_EQ(alone.seen, alone.covered);
  Crown two = one;
  two.square({}, 1, 1);
  const Occlusion both = two.run({.samples = 4000, .least = 4});
  EXPECT_NEAR(both.seen, 0.5 * both.covered, 1);
}

// Pictures are at least 16 pixels wide, but not of so many: 25 pixels a leaf and view would be kept in lists.
TEST(LeafOcclusion, ManyLeavesAsLargeAsTheCrownDoNotTakeMoreThanTheMostSamples) {
  constexpr std::uint32_t k_leaves = 30'000;
  const Crown crown = cloud(k_leaves, 1.5);
  const Occlusion o = crown.run({.coverage = 0.98, .least = 2 * k_leaves - 20});
  EXPECT_LT(o.covered, 1 << 24);
  EXPECT_GT(o.covered, 36.0 * k_leaves) << "no fewer than were asked for";
  EXPECT_EQ(o.gone.size(), 10u);
}

TEST(LeafOcclusion, WhatIsKnownBesideDecidesAmongEquals) {
  Crown crown;
  for (int i = 0; i < 4; ++i) crown.square({}, 1, 0);
  const std::vector<float> prior{3, 1, 2, 0};
  const Occlusion o = crown.run({.coverage = 0.5, .prior = prior});
  ASSERT_EQ(o.gone.size(), 3u);
  EXPECT_EQ(o.gone[0], 1u)
      << "3 shows behind, 0 in front; of the two that no one sees the one that costs less";
}

TEST(LeafOcclusion, DoesNotDependOnTheNumberOfThreads) {
  const Crown crown = cloud(500, 0.2);
  const Occlusion many = crown.run({.coverage = 0.9});
  tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  const Occlusion single = crown.run({.coverage = 0.9});
  ASSERT_EQ(many.gone.size(), single.gone.size());
  for (std::size_t i = 0; i < many.gone.size(); ++i) EXPECT_EQ(many.gone[i], single.gone[i]);
}

TEST(LeafOcclusion, DegenerateLeavesAreNoOnesLoss) {
  Crown crown;
  crown.square({}, 0, 0), crown.square({}, 1e-30, 1), crown.square({1e30, 0, 0}, 1e20, 2);
  EXPECT_EQ(crown.run({}).gone.size(), 3u);
  EXPECT_TRUE(Crown{}.run({}).gone.empty());
}

}  // namespace
}  // namespace copse
