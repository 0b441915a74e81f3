#include "lib/formats/import/xyz.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

Result<std::vector<Double3>> read(const std::string& text) {
  return read_xyz({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()}, "points.xyz");
}

TEST(Xyz, PointsComeInDoubleAsWritten) {
  const auto points = read("0.1 0.2 0.3\n1e-160\t-2  +3.5e200\n");
  ASSERT_TRUE(points) << points.error().what;
  EXPECT_EQ(*points, (std::vector<Double3>{{0.1, 0.2, 0.3}, {1e-160, -2, 3.5e200}}));
}

TEST(Xyz, CommentsEmptyLinesCommasAndMoreColumnsAreRead) {
  const auto points = read("# x y z r g b\r\n\r\n  // no\r\n1,2,3,255,0,0\r\n4; 5; 6\r\n   \t\r\n7 8 9 red");
  ASSERT_TRUE(points) << points.error().what;
  EXPECT_EQ(*points, (std::vector<Double3>{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}}));
  EXPECT_TRUE(read("")->empty());
}

TEST(Xyz, WhatIsNoPointIsRefusedWithItsLine) {
  const std::pair<const char*, const char*> wrong[] = {
      {"1 2 3\n1 2\n", "line 2: 2 numbers"},  {"1 2 3\n\n# c\n1 b 3", "line 4: is no number: 'b'"},
      {"1 2 nan", "line 1: is not finite"},   {"inf 2 3", "line 1: is not finite"},
      {"1 2 1e999", "line 1: is not finite"}, {"12\ncomment\nC 0 0 0", "line 1: 1 numbers"}};
  for (const auto& [text, says] : wrong) {
    const auto points = read(text);
    ASSERT_FALSE(points) << text;
    EXPECT_EQ(points.error().file, "points.xyz");
    EXPECT_NE(points.error().what.find(says), std::string::npos) << points.error().what;
  }
}

}  // namespace
}  // namespace copse
