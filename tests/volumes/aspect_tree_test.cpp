#include "lib/analysis/volumes/aspect_tree.h"

#include "lib/formats/random.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(AspectTree, RatiosAreOfSortedExtents) {
  const AspectRatios r = aspect_ratios({2, 12, 4});
  EXPECT_DOUBLE_EQ(r.ratio[1], 3);
  EXPECT_DOUBLE_EQ(r.ratio[2], 2);
  EXPECT_DOUBLE_EQ(r.ratio[0], 1.5);
  EXPECT_EQ(aspect_ratios({0, 0, 0}).ratio, (std::array<double, 3>{1, 1, 1}));
  EXPECT_DOUBLE_EQ(aspect_ratios({1, 1, 0}).ratio[2], 1e6);  // a plate: thin, not infinite
  EXPECT_DOUBLE_EQ(aspect_ratios({0, 5, 0}).ratio[1], 1e6);  // a line
}

TEST(AspectTree, TheSeedsTellsRodsPlatesAndBallsApart) {
  const AspectTree tree = AspectTree::seed();
  EXPECT_EQ(tree.choose(aspect_ratios({10, 1, 1})), VolumeKind::capsule);
  EXPECT_EQ(tree.choose(aspect_ratios({10, 10, 1})), VolumeKind::lozenge);
  EXPECT_EQ(tree.choose(aspect_ratios({1, 1, 1})), VolumeKind::sphere);
  EXPECT_EQ(AspectTree::parse("seed")->text(), tree.text());
}

TEST(AspectTree, TheDefaultTellsTubesPlatesAndWhatIsCompactApart) {
  const AspectTree tree;
  EXPECT_EQ(tree.choose(aspect_ratios({10, 1, 1})), VolumeKind::cylinder);
  EXPECT_EQ(tree.choose(aspect_ratios({10, 10, 1})), VolumeKind::obb);
  EXPECT_EQ(tree.choose(aspect_ratios({1.1, 1.05, 1})), VolumeKind::lozenge);
  EXPECT_EQ(tree.choose(aspect_ratios({2, 1.05, 1})), VolumeKind::obb);
  EXPECT_EQ(AspectTree::parse("default")->text(), tree.text());
}

TEST(AspectTree, TextComesBack) {
  for (const char* text :
       {"ratio1>2?capsule:(ratio3>2.5?lozenge:obb)", "sphere",
        "ratio2>1.5?(ratio3>2?(ratio1>1?obb:lozenge):capsule):(ratio1>0.25?sphere:kdop)"}) {
    const auto tree = AspectTree::parse(text);
    ASSERT_TRUE(tree) << tree.error().what;
    EXPECT_EQ(tree->text(), text);
  }
  EXPECT_EQ(AspectTree::parse(AspectTree().text())->text(), AspectTree().text());
}

TEST(AspectTree, WhatIsNoTreeIsRefusedWithItsPlace) {
  const std::pair<const char*, const char*> wrong[] = {
      {"", "character 1"},
      {"ball", "character 1: a kind"},
      {"ratio4>2?obb:obb", "character 1"},
      {"ratio1<2?obb:obb", "character 7: '>'"},
      {"ratio1>x?obb:obb", "character 8: a number"},
      {"ratio1>2?obb", "':' is wanted"},
      {"ratio1>2?obb:sphere)", "nothing more"},
      {"ratio1>2?obb:(sphere", "')' is wanted"},
      {"((((((", "character 2"},
      {"ratio1>1?ratio1>1?ratio1>1?ratio1>1?obb:obb:obb:obb:obb", "more than three"}};
  for (const auto& [text, says] : wrong) {
    const auto tree = AspectTree::parse(text);
    ASSERT_FALSE(tree) << text;
    EXPECT_NE(tree.error().what.find(says), std::string::npos) << tree.error().what;
  }
}

TEST(AspectTree, KindsAreThoseThatItMayChoose) {
  EXPECT_EQ(AspectTree::parse("ratio1>2?capsule:(ratio3>2.5?lozenge:capsule)")->kinds(),
            (std::vector<VolumeKind>{VolumeKind::capsule, VolumeKind::lozenge}));
}

// Things whose smallest volume follows a tree of two comparisons.
std::vector<AspectSample> samples_of(const AspectTree& truth, int n) {
  Random random(1);
  std::vector<AspectSample> out;
  for (int i = 0; i < n; ++i) {
    const Double3 e{std::exp(random.around(0, 2)), std::exp(random.around(0, 2)),
                    std::exp(random.around(0, 2))};
    AspectSample s{aspect_ratios(e), {}};
    s.volume.fill(2);
    s.volume[static_cast<std::size_t>(truth.choose(s.ratios))] = 1;
    out.push_back(s);
  }
  return out;
}

TEST(AspectTree, TheTunerFindsTheTreeThatTheSamplesFollow) {
  const AspectTree truth = *AspectTree::parse("ratio1>2?capsule:(ratio3>1.5?lozenge:sphere)");
  const std::vector<AspectSample> samples = samples_of(truth, 400);
  const AspectTree tuned = tune_aspect_tree(samples);
  EXPECT_DOUBLE_EQ(agreement(tuned, samples).agree, 1) << tuned.text();
  EXPECT_LT(agreement(AspectTree(), samples).agree, 1);
  EXPECT_EQ(agreement(tuned, samples).excess, 0);
}

TEST(AspectTree, KindsThatAreNotWantedAreNotChosen) {
  std::vector<AspectSample> samples = samples_of(AspectTree(), 100);
  for (AspectSample& s : samples)
    s.volume[static_cast<std::size_t>(VolumeKind::capsule)] = std::numeric_limits<double>::infinity();
  for (const VolumeKind kind : tune_aspect_tree(samples).kinds()) EXPECT_NE(kind, VolumeKind::capsule);
}

TEST(AspectTree, OneSampleGivesALeaf) {
  const std::vector<AspectSample> one = samples_of(AspectTree(), 1);
  EXPECT_EQ(tune_aspect_tree(one).nodes[0].ratio, 0);
  EXPECT_EQ(agreement(tune_aspect_tree(one), one).agree, 1);
}

}  // namespace
}  // namespace copse
