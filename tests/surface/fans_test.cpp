#include "lib/analysis/surface/fans.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(Fans, ListTheTrianglesRoundEachVertex) {
  const Fans fans = make_fans(5, std::vector<Triangle>{{0, 1, 2}, {2, 1, 3}});
  EXPECT_EQ(fans.of(0).size(), 1u);
  EXPECT_EQ(std::vector(fans.of(1).begin(), fans.of(1).end()), (std::vector<std::uint32_t>{0, 1}));
  EXPECT_TRUE(fans.of(4).empty());
  EXPECT_TRUE(fans.repeated.empty());
}

TEST(Fans, LeaveRepeatedTrianglesOutWhateverTheirWindingAndNameTheFirst) {
  const std::vector<Triangle> t{{3, 1, 2}, {0, 1, 2}, {2, 1, 3}, {1, 2, 0}, {1, 2, 3}};
  const Fans fans = make_fans(4, t);
  EXPECT_EQ(fans.repeated, (std::vector<std::pair<std::uint32_t, std::uint32_t>>{{2, 0}, {3, 1}, {4, 0}}));
  EXPECT_EQ(std::vector(fans.of(1).begin(), fans.of(1).end()), (std::vector<std::uint32_t>{0, 1}));
}

TEST(Fans, OfNothingAreEmpty) {
  EXPECT_TRUE(make_fans(0, {}).triangle.empty());
}

}  // namespace
}  // namespace copse
