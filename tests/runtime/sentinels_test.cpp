#include "lib/runtime/sentinels.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

// 0 above 1 (above 2 and 3) and 4.
const std::vector<VolumeNode> k_nodes{{5, k_none, 0}, {4, k_none, 0}, {3, 0, 0}, {4, 1, 0}, {5, 2, 0}};

std::vector<bool> stale(const Sentinels& s) {
  std::vector<bool> out;
  for (std::uint32_t i = 0; i < k_nodes.size(); ++i) out.push_back(s.is_stale(i));
  return out;
}

TEST(Sentinels, APartThatLeavesMakesAllAboveItStaleAndNothingElse) {
  Sentinels s(k_nodes);
  EXPECT_EQ(stale(s), (std::vector<bool>{false, false, false, false, false}));
  s.leave(3);
  EXPECT_EQ(stale(s), (std::vector<bool>{true, true, false, true, false}));
  s.come_back(3);
  EXPECT_EQ(stale(s), (std::vector<bool>{false, false, false, false, false}));
}

TEST(Sentinels, WhatIsAboveTwoPartsWaitsForBoth) {
  Sentinels s(k_nodes);
  s.leave(2), s.leave(3), s.leave(3);
  s.come_back(2);
  EXPECT_TRUE(s.is_stale(1));
  s.come_back(3), s.come_back(3);
  EXPECT_FALSE(s.is_stale(0));
  s.leave(4);
  EXPECT_EQ(stale(s), (std::vector<bool>{true, false, false, false, true}));
}

}  // namespace
}  // namespace copse
