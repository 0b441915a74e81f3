#include "lib/runtime/block_culling.h"

#include "lib/formats/random.h"
#include "tests/formats/ecosystem_maker.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace copse {
namespace {

std::vector<std::uint32_t> seen(const Ecosystem& eco, const Camera& camera, CullCounts* counts = nullptr) {
  std::vector<std::uint32_t> visible;
  visible_blocks(eco, frustum_of(make_view(camera, 1.5, 0.1, 1000)), camera.eye, visible, counts);
  return visible;
}

TEST(BlockCulling, SeesWhatTestingEveryBlockSees) {
  const Ecosystem eco = little_ecosystem(false);
  Random random(1);
  std::size_t some = 0;
  for (int i = 0; i < 2000; ++i) {
    const auto point = [&] {
      return Double3{random.uniform(-10, 30), random.uniform(0, 10), random.uniform(-10, 30)};
    };
    const Camera camera{.eye = point(), .target = point(), .up = {0, 1, 0}, .fov = random.uniform(0.1, 1)};
    const Frustum frustum = frustum_of(make_view(camera, 1.5, 0.1, 1000));
    std::vector<std::uint32_t> flat;
    for (std::uint32_t b = 0; b < eco.blocks.size(); ++b) {
      const FloatBox& box = eco.blocks[b].bounds;
      if (classify(frustum, camera.eye, {eco.origin + to_double(box.min), eco.origin + to_double(box.max)}) !=
          Visibility::outside)
        flat.push_back(b);
    }
    EXPECT_EQ(seen(eco, camera), flat);
    some += !flat.empty() && flat.size() < eco.blocks.size();
  }
  EXPECT_GT(some, 300u);
}

TEST(BlockCulling, BelowANodeThatIsInsideNothingIsTested) {
  CullCounts counts;
  const Camera above{.eye = {10, 200, 10.01}, .target = {10, 0, 10}, .up = {0, 0, -1}, .fov = 1};
  EXPECT_EQ(seen(little_ecosystem(false), above, &counts).size(), 8u);
  EXPECT_EQ(counts.nodes_visited, 1u);
  EXPECT_EQ(counts.blocks_tested, 0u);
}

TEST(BlockCulling, AViewRangeEndsWhatIsSeen) {
  Ecosystem eco = little_ecosystem(true);
  const Camera above{.eye = {10, 200, 10.01}, .target = {10, 0, 10}, .up = {0, 0, -1}, .fov = 1};
  eco.types[1].view_range = 100;
  EXPECT_EQ(seen(eco, above).size(), 4u);
  eco.types[1].view_range = 300;
  EXPECT_EQ(seen(eco, above).size(), 8u);
}

TEST(BlockCulling, OfNothingNothingIsSeen) {
  EXPECT_TRUE(seen(Ecosystem{}, Camera{}).empty());
  Ecosystem eco = little_ecosystem(false);
  std::vector<QuadNode> nodes(5);  // all invalid
  eco.boxes = nodes;
  EXPECT_TRUE(seen(eco, Camera{.eye = {10, 5, 40}, .target = {10, 0, 10}}).empty());
}

TEST(BlockCulling, TheDistanceToABoxIsThatToItsNearestPoint) {
  const DoubleBox box{{0, 0, 0}, {2, 2, 2}};
  EXPECT_EQ(distance_to({1, 1, 1}, box), 0);
  EXPECT_EQ(distance_to({5, 6, 2}, box), 5);
}

}  // namespace
}  // namespace copse
