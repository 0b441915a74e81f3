#include "lib/analysis/surface/lists.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

std::vector<std::uint32_t> list(const Lists& lists, std::size_t owner) {
  const auto l = lists[owner];
  return {l.begin(), l.end()};
}

TEST(Lists, HoldEachOwnersItemsAscendingAndOnce) {
  const Lists lists = make_lists({{2, 5}, {0, 9}, {2, 1}, {2, 5}, {0, 9}}, 4);
  EXPECT_EQ(lists.count(), 4u);
  EXPECT_EQ(list(lists, 0), (std::vector<std::uint32_t>{9}));
  EXPECT_TRUE(list(lists, 1).empty());
  EXPECT_EQ(list(lists, 2), (std::vector<std::uint32_t>{1, 5}));
  EXPECT_TRUE(list(lists, 3).empty());
}

TEST(Lists, OfNobodyAreNone) {
  EXPECT_EQ(make_lists({}, 0).count(), 0u);
}

}  // namespace
}  // namespace copse
