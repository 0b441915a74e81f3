#include "lib/analysis/hull/vertex_widths.h"

#include "tests/volumes/point_sets.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(VertexWidths, AreTheLargestLessTheLeastForAnyCount) {
  for (const int n : {1, 2, 7, 8, 9, 16, 1000}) {
    const auto points = random_cloud(n, n, {1, 2, 3});
    const VertexWidths widths(points);
    for (const Double3& axis : random_cloud(1, 20, {1, 1, 1})) {
      double low = 1e300, high = -1e300;
      for (const Double3& p : points) low = std::min(low, dot(axis, p)), high = std::max(high, dot(axis, p));
      EXPECT_EQ(widths.along(axis), high - low) << n;
    }
  }
}

}  // namespace
}  // namespace copse
