#include "lib/analysis/surface/components.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

using Ids = std::vector<std::uint32_t>;

TEST(Components, AreNumberedByTheirFirstTriangle) {
  const std::vector<Triangle> t{{6, 7, 8}, {0, 1, 2}, {8, 9, 10}, {2, 3, 4}};
  const Components c = connected_components(t);
  EXPECT_EQ(c.count, 2u);
  EXPECT_EQ(c.of, (Ids{0, 1, 0, 1}));
}

TEST(Components, ConnectThroughWeldedVertices) {
  const std::vector<Triangle> t{{0, 1, 2}, {3, 4, 5}, {6, 7, 8}};
  EXPECT_EQ(connected_components(t).count, 3u);
  EXPECT_EQ(connected_components(t, Ids{0, 1, 2, 2, 4, 5, 6, 7, 8}).of, (Ids{0, 0, 1}));
}

TEST(Components, OfNothingAreNone) {
  EXPECT_EQ(connected_components({}).count, 0u);
}

TEST(Components, OfALongStripAreOneWithoutRecursion) {
  std::vector<Triangle> t;
  for (std::uint32_t i = 0; i < 300000; ++i) t.push_back({i, i + 1, i + 2});
  EXPECT_EQ(connected_components(t).count, 1u);
}

}  // namespace
}  // namespace copse
