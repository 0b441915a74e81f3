#include "lib/analysis/trunk/attach.h"

#include "tests/trunk/limb_maker.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

struct Attached {
  explicit Attached(Limbs& limbs) : segments(limbs), ground(limbs, segments, {}) {
    bases = choose_bases(limbs, segments, ground);
    attachments = attach(limbs, segments, ground, bases);
  }
  // The limb that a limb grows from.
  std::uint32_t parent(const Limbs& limbs, std::uint32_t limb) const {
    return attachments[limb].ring == k_none ? k_none : limbs.limb[attachments[limb].ring];
  }
  LimbSegments segments;
  Ground ground;
  std::vector<std::uint32_t> bases;
  std::vector<Attachment> attachments;
};

TEST(Attach, HangsABranchOnTheNearerRingOfTheSegmentThatItStartsIn) {
  Limbs limbs;
  add_limb(limbs, {0, 0, 0}, {0, 1, 0}, {1, 0.9, 0.8, 0.7});
  add_limb(limbs, {0, 1.3, 0}, {1, 0.5, 0}, {0.4, 0.3, 0.2});
  add_limb(limbs, {0, 1.7, 0}, {-1, 0.5, 0}, {0.4, 0.3, 0.2});
  const Attached tree(limbs);
  EXPECT_EQ(tree.attachments[0].ring, k_none);
  EXPECT_EQ(tree.attachments[1].ring, 1u);
  EXPECT_EQ(tree.attachments[2].ring, 2u);
  EXPECT_LT(tree.attachments[1].gap, 0);
}

TEST(Attach, ReadsAHangingBranchFromItsThickEnd) {
  Limbs limbs;
  add_limb(limbs, {0, 0, 0}, {0, 1, 0}, {1, 0.9, 0.8, 0.7, 0.6});
  add_limb(limbs, {2, 0.1, 0}, {-0.5, 1, 0},
           {0.05, 0.1, 0.2, 0.3, 0.35});  // read from its tip, base at (0, 4.1)
  const Attached tree(limbs);
  EXPECT_EQ(tree.attachments[1].base, 9u);
  EXPECT_EQ(tree.attachments[1].ring, 4u);
}

TEST(Attach, PrefersTheParentThatFitsTheHabitOfTheFileWhereTwigsCross) {
  // Every branch starts exactly on its parent's axis; one of them inside a crossing branch as well.
  Limbs limbs;
  add_limb(limbs, {0, 0, 0}, {0, 1, 0}, std::vector<double>(12, 0.5));
  for (int i = 1; i < 8; ++i) add_limb(limbs, {0, 1.0 * i + 0.4, 0}, {0, 0.3, 1}, {0.3, 0.2, 0.1});
  add_limb(limbs, {-3, 9.45, 0.02}, {1, 0, 0}, {0.45, 0.4, 0.35, 0.3, 0.25, 0.2});  // passes the trunk
  add_limb(limbs, {0, 9.4, 0}, {0, 0.3, 1}, {0.3, 0.2, 0.1});
  const Attached tree(limbs);
  EXPECT_EQ(tree.parent(limbs, 9), 0u);
}

TEST(Attach, PrefersTheTrueParentOfTubesThatAreLaidAgainstIt) {
  // Bases lie a radius beside their parent's axis; the last one lies nearer to the axis of a branch that
  // crosses.
  Limbs limbs;
  add_limb(limbs, {0, 0, 0}, {0, 1, 0}, std::vector<double>(12, 0.5));
  for (int i = 1; i < 9; ++i) add_limb(limbs, {0.25, 1.0 * i, 0}, {1, 0.2, 0}, {0.2, 0.15, 0.1});
  add_limb(limbs, {0.3, 10, -1}, {0, 0, 0.7}, {0.3, 0.28, 0.26, 0.24});
  add_limb(limbs, {0.25, 10, 0}, {1, 0.2, 0}, {0.2, 0.15, 0.1});
  const Attached tree(limbs);
  EXPECT_EQ(tree.parent(limbs, 10), 0u);
}

TEST(Attach, BelievesTheHabitOfTheFileMoreThanTheTaperOfARoughTwig) {
  // Bases lie half a radius beside the trunk's axis. The last twig does so with its thinner end, by 2 %, and
  // dips into the axis of a bough with the other.
  Limbs limbs;
  add_limb(limbs, {0, 0, 0}, {0, 1, 0}, std::vector<double>(12, 0.5));
  for (int i = 1; i < 8; ++i) add_limb(limbs, {0.125, 1.0 * i + 0.4, 0}, {1, 0, 0}, {0.3, 0.3, 0.3, 0.3});
  add_limb(limbs, {0.125, 8.4, 0}, {1, -1, 0}, {0.294, 0.3});
  const Attached tree(limbs);
  EXPECT_EQ(tree.parent(limbs, 8), 0u);
  EXPECT_EQ(tree.attachments[8].base, 12u + 7 * 4);
}

TEST(Attach, HangsSiblingsOfOneStartOnTheirParentAndNotOnEachOther) {
  Limbs limbs;
  add_limb(limbs, {0, 0, 0}, {0, 1, 0}, {1, 0.9, 0.8, 0.7});
  for (const double x : {-1.0, 0.0, 1.0}) add_limb(limbs, {0, 2.9, 0}, {x, 1, 0.2}, {0.6, 0.4, 0.2});
  const Attached tree(limbs);
  for (std::uint32_t limb = 1; limb < 4; ++limb) EXPECT_EQ(tree.parent(limbs, limb), 0u);
}

TEST(Attach, MakesRootsOfTreesThatStandApart) {
  Limbs limbs;
  for (const double x : {0.0, 4.0, 9.0}) {
    add_limb(limbs, {x, 0.1 * x, 0}, {0, 1, 0}, {0.5, 0.4, 0.3, 0.2});
    add_limb(limbs, {x, 0.1 * x + 2, 0}, {1, 0.4, 0}, {0.2, 0.1, 0.05});
  }
  const Attached tree(limbs);
  for (std::uint32_t limb = 0; limb < 6; ++limb) {
    EXPECT_EQ(tree.parent(limbs, limb), limb % 2 == 0 ? k_none : limb - 1);
  }
}

TEST(Attach, BridgesAGapThatIsSmallForTheLimbButNotALargeOne) {
  Limbs limbs;
  add_limb(limbs, {0, 0, 0}, {0, 1, 0}, {1, 1, 1, 1, 1, 1, 0.9});
  add_limb(limbs, {0.75, 3, 0}, {1, 0.2, 0},
           {0.05, 0.04, 0.03, 0.02});  // a quarter of a metre off, three long
  add_limb(limbs, {1.5, 5, 0}, {1, 0.2, 0}, {0.05, 0.04, 0.03, 0.02});
  const Attached tree(limbs);
  EXPECT_EQ(tree.parent(limbs, 1), 0u);
  EXPECT_EQ(tree.parent(limbs, 2), k_none);
}

TEST(Attach, NeverMakesACycleWhereEveryBaseLiesInEveryLimb) {
  Limbs limbs;
  for (int i = 0; i < 30; ++i) {
    add_limb(limbs, {0.01 * i, 0.013 * (i % 7), 0}, {0.1 * (i % 5) - 0.2, 0.3, 0.1 * (i % 3) - 0.1},
             {1, 1, 1, 1});
  }
  const Attached tree(limbs);
  int roots = 0;
  for (std::uint32_t limb = 0; limb < 30; ++limb) {
    std::uint32_t at = limb;
    int steps = 0;
    while (tree.parent(limbs, at) != k_none && steps++ <= 30) at = tree.parent(limbs, at);
    EXPECT_LE(steps, 30);
    roots += tree.parent(limbs, limb) == k_none;
  }
  EXPECT_GE(roots, 1);
}

}  // namespace
}  // namespace copse
