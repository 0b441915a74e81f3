#include "lib/analysis/rings/axis.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(MeetingPoint, OfLinesThatCrossIsTheirCrossing) {
  const AxisLine lines[] = {{{0, -1, 0}, {0, 1, 0}, 1}, {{1, 0, 0}, {1, 0, 0}, 1}, {{0, 1, 0}, {0, 1, 0}, 1}};
  EXPECT_LT(distance(meeting_point(lines), {0, 0, 0}), 0.05);
}

TEST(MeetingPoint, OfParallelLinesLiesBetweenTheirPoints) {
  const AxisLine lines[] = {{{0, 0, 0}, {0, 1, 0}, 1}, {{2, 0, 0}, {0, 1, 0}, 1}};
  EXPECT_LT(distance(meeting_point(lines), {1, 0, 0}), 1e-12);
}

TEST(MeetingPoint, OfLinesThatMeetFarAwayIsTheMiddleOfTheirPoints) {
  const AxisLine lines[] = {{{0, 0, 0}, normalized(Double3{0.4, 1, 0}), 1}, {{1, 0, 0}, {0, 1, 0}, 1}};
  EXPECT_LT(distance(meeting_point(lines), {0.5, 0, 0}), 1e-12);
}

TEST(MeetingPoint, IsFiniteWithoutWeightOrDirection) {
  const AxisLine weightless[] = {{{3, 4, 5}, {0, 1, 0}, 0}};
  EXPECT_EQ(meeting_point(weightless), (Double3{3, 4, 5}));
  const AxisLine still[] = {{{1, 0, 0}, {0, 0, 0}, 1}, {{3, 0, 0}, {0, 0, 0}, 1}};
  EXPECT_LT(distance(meeting_point(still), {2, 0, 0}), 1e-12);
  EXPECT_EQ(meeting_point({}), (Double3{0, 0, 0}));
}

TEST(NearestOnSegment, StaysWithinTheSegment) {
  const Double3 a{0, 0, 0}, b{2, 0, 0};
  EXPECT_DOUBLE_EQ(nearest_on_segment(a, b, {0.5, 3, 0}), 0.25);
  EXPECT_EQ(nearest_on_segment(a, b, {-5, 1, 0}), 0);
  EXPECT_EQ(nearest_on_segment(a, b, {5, 1, 0}), 1);
  EXPECT_EQ(nearest_on_segment(a, a, {5, 1, 0}), 0);
}

}  // namespace
}  // namespace copse
