#include "lib/analysis/trunk/stray_roots.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

// A tree of its own of so many radii along a line.
std::uint32_t add_line(Hierarchy& h, const Double3& from, const Double3& step, int radii) {
  const auto root = static_cast<std::uint32_t>(h.radii.size());
  for (int i = 0; i < radii; ++i)
    h.radii.push_back({.centre = from + step * i,
                       .diameter = 0.1,
                       .parent = i == 0 ? k_none : static_cast<std::uint32_t>(h.radii.size() - 1)});
  return root;
}

// A trunk and a long bough on it.
void add_tree(Hierarchy& h, const Double3& foot) {
  const std::uint32_t root = add_line(h, foot, {0, 0.1, 0}, 100);
  const std::uint32_t bough = add_line(h, foot + Double3{0, 5, 0}, {0.1, 0.01, 0.1}, 40);
  h.radii[bough].parent = root + 50;
}

TEST(StrayRoots, AreSmallTreesThatBeginAmidALargeOneAboveItsFoot) {
  Hierarchy h;
  add_tree(h, {0, 0, 0});
  const std::uint32_t twig = add_line(h, {2, 5, 2}, {0, 0.1, 0}, 5);
  EXPECT_EQ(stray_roots(h), std::vector<std::uint32_t>{twig});
}

TEST(StrayRoots, AreNeitherSaplingsOnTheGroundNorWhatStandsAsideNorTreesOfLikeSize) {
  Hierarchy h;
  add_tree(h, {0, 0, 0});
  add_line(h, {1, 0.2, 1}, {0, 0.1, 0}, 5);  // a shoot beside the foot
  add_line(h, {-3, 5, 0}, {0, 0.1, 0}, 5);   // on a slope
  add_line(h, {2, 3, 2}, {0, 0.1, 0}, 50);   // too large to be a twig
  add_tree(h, {0.5, 2, 0.5});
  EXPECT_TRUE(stray_roots(h).empty());
  EXPECT_TRUE(stray_roots({}).empty());
}

TEST(StrayRoots, AreFoundInAForestWhateverTreeTheyAreAmid) {
  Hierarchy h;
  for (int i = 0; i < 300; ++i) add_tree(h, {20.0 * (i % 17), 0.0, 20.0 * i});
  std::vector<std::uint32_t> twigs;
  for (int i = 0; i < 300; i += 7)
    twigs.push_back(add_line(h, {20.0 * (i % 17) + 2, 5, 20.0 * i + 2}, {0, 0.1, 0}, 4));
  EXPECT_EQ(stray_roots(h), twigs);
}

}  // namespace
}  // namespace copse
