#include "lib/analysis/surface/hull_relaxation.h"

#include <cmath>
#include <cstdint>
#include <span>
#include <utility>

#include <gtest/gtest.h>

namespace copse {
namespace {

// Two unit squares, one above the other, joined corner by corner; the upper one twice as large.
const std::vector<Double3> k_squares{{1, 0, 1},  {-1, 0, 1},  {-1, 0, -1}, {1, 0, -1}, {2, 3, 2},
                                     {-2, 3, 2}, {-2, 3, -2}, {2, 3, -2},  {0, 9, 0}};

Lists edges(bool with_leaning_one) {
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  const auto join = [&](std::uint32_t a, std::uint32_t b) {
    pairs.emplace_back(a, b), pairs.emplace_back(b, a);
  };
  for (std::uint32_t i = 0; i < 4; ++i) {
    join(i, (i + 1) % 4);
    join(4 + i, 4 + (i + 1) % 4);
    join(i, 4 + i);
  }
  if (with_leaning_one) join(0, 8), join(5, 8);
  return make_lists(pairs, 9);
}

// How much of the factor counts: half for the squares, all for the point beside them.
const std::vector<double> k_weights{0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 0.5, 1};

std::vector<Double3> relaxed(const Lists& neighbours, double factor) {
  std::vector<Double3> out = k_squares;
  for (std::size_t v = 0; v < out.size(); ++v) {
    if (neighbours[v].empty()) continue;
    Double3 sum = k_squares[v];
    for (const std::uint32_t n : neighbours[v]) sum += k_squares[n];
    const Double3 mean = sum / static_cast<double>(neighbours[v].size() + 1);
    out[v] += (mean - k_squares[v]) * (factor * k_weights[v]);
  }
  return out;
}

std::size_t squares(const std::vector<Double3>& p) {
  std::size_t count = 0;
  for (const std::size_t at : {std::size_t{0}, std::size_t{4}}) {
    const std::span<const Double3> s = std::span(p).subspan(at, 4);
    count += length(s[0] + s[2] - s[1] - s[3]) < 1e-6 &&
             std::abs(distance(s[0], s[2]) - distance(s[1], s[3])) < 1e-6;
  }
  return count;
}

TEST(HullRelaxation, FindsTheFactorAndTheSquares) {
  const Lists neighbours = edges(true);
  for (const double factor : {0.05, 0.2, 0.5, 1.0}) {
    std::vector<Double3> p = relaxed(neighbours, factor);
    ASSERT_LT(squares(p), 2u);
    EXPECT_NEAR(undo_hull_relaxation(p, neighbours, k_weights, squares, 1), factor, 1e-12);
    for (std::size_t v = 0; v < p.size(); ++v) EXPECT_LT(distance(p[v], k_squares[v]), 1e-6) << v;
  }
}

TEST(HullRelaxation, IsUndoneByAFactorThatIsKnown) {
  const Lists neighbours = edges(true);
  const std::vector<Double3> p = before_hull_relaxation(relaxed(neighbours, 0.4), neighbours, k_weights, 0.4);
  for (std::size_t v = 0; v < p.size(); ++v) EXPECT_LT(distance(p[v], k_squares[v]), 1e-6) << v;
}

// Two vertices that both became their mean may have been anywhere.
TEST(HullRelaxation, HasNothingWhereItIsNotTold) {
  const Lists pair = make_lists({{0, 1}, {1, 0}}, 2);
  EXPECT_TRUE(before_hull_relaxation({{0, 0, 0}, {1, 0, 0}}, pair, std::vector<double>{1, 1}, 1).empty());
}

TEST(HullRelaxation, LeavesAloneWhatWasNotMoved) {
  std::vector<Double3> p = k_squares;
  EXPECT_EQ(undo_hull_relaxation(p, edges(true), k_weights, squares, 1), 0);
  EXPECT_EQ(p, k_squares);
}

TEST(HullRelaxation, LeavesAloneWhatNoFactorMends) {
  std::vector<Double3> p = relaxed(edges(true), 0.3);
  p[0].x += 0.1;
  p[5].y += 0.1;
  const std::vector<Double3> before = p;
  EXPECT_EQ(undo_hull_relaxation(p, edges(true), k_weights, squares, 1), 0);
  EXPECT_EQ(p, before);
}

TEST(HullRelaxation, AsksForAsManyAsItIsTold) {
  std::vector<Double3> p = relaxed(edges(true), 0.2);
  EXPECT_EQ(undo_hull_relaxation(p, edges(true), k_weights, squares, 3), 0);
}

}  // namespace
}  // namespace copse
