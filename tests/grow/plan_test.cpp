// Counts: what a plan promises is what the mesh has, and what was asked for is met.
#include "tests/grow/mesh_facts.h"
#include "tools/treegrow/grow.h"

#include <cmath>

#include <gtest/gtest.h>

namespace copse::grow {
namespace {

class PlanOf : public testing::TestWithParam<std::string> {};

TEST_P(PlanOf, CountsTrianglesBeforeThereAreAny) {
  std::vector<std::string> lists{"none", "artist", "extruded,vary-k,seams,capped-ngon,fronds,quads",
                                 "inset-faces,vary-k,seams,capped-ngon",
                                 "welded-forks,vary-k,collapsed-rings,end-to-end,crossed-cards"};
  for (const BreakInfo& info : break_table()) lists.emplace_back(info.name);
  for (const std::string& list : lists) {
    Order order = small_order(GetParam(), list, 2000);
    auto plan = make_plan(order);
    if (!plan) order.triangles = 0, plan = make_plan(order);
    ASSERT_TRUE(plan);
    const Grown grown = make_mesh(order, *plan);
    EXPECT_EQ(grown.mesh.triangles.size(), total_triangles(plan->layout, order.breaks)) << list;
    EXPECT_EQ(grown.truth.leaf_centres.size(), plan->layout.leaves) << list;
  }
}

TEST_P(PlanOf, MeetsTheTargetWithinTwoPercent) {
  for (const char* list : {"none", "artist"}) {
    for (const double triangles : {1500., 6000., 40000., 250000.}) {
      const Order order = small_order(GetParam(), list, static_cast<std::uint64_t>(triangles), 4);
      const auto plan = make_plan(order);
      ASSERT_TRUE(plan) << plan.error().what;
      const auto total = static_cast<double>(total_triangles(plan->layout, order.breaks));
      EXPECT_NEAR(total / triangles, 1, 0.02) << list << " " << triangles;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Species, PlanOf, testing::ValuesIn(species_names()),
                         [](const auto& test) { return test.param; });

TEST(Plan, SaysTheNearestNumberWhenATargetCannotBeMet) {
  const auto plan = make_plan(small_order("oak", "artist", 12));
  ASSERT_FALSE(plan);
  EXPECT_EQ(plan.error().fault, Fault::limit);
  EXPECT_NE(plan.error().what.find("the nearest oak has"), std::string::npos);
}

TEST(Plan, RefusesWhatWouldNotFitInMemory) {
  Order branches = small_order("oak", "none", 0);
  for (Level& level : branches.species.levels) level.branches = 1e5;
  Order forks = small_order("oak", "none", 0);
  forks.species.levels[0].splits = 100, forks.species.levels[0].nodes = 1000;
  Order segments = small_order("birch", "none", 0);
  for (Level& level : segments.species.levels) level.segments = 1e6;
  Order leaves = small_order("birch", "none", 0);
  leaves.species.leaves.count = 1e6;
  for (Order* order : {&branches, &forks, &segments, &leaves}) {
    order->most_nodes = 200'000;
    order->most_triangles = 2'000'000;
    const auto plan = make_plan(*order);
    ASSERT_FALSE(plan);
    EXPECT_EQ(plan.error().fault, Fault::refused);
  }
}

TEST(Plan, HeightScalesTheTree) {
  Order order = small_order("birch", "artist", 0);
  const double usual = make_plan(order)->skeleton.height;
  order.height = 10 * order.species.height;
  EXPECT_NEAR(make_plan(order)->skeleton.height / usual, 10, 1e-6);
}

TEST(Plan, RichTreesHaveMoreOfEverything) {
  const auto poor = make_plan(small_order("oak", "artist", 10000)),
             rich = make_plan(small_order("oak", "artist", 400000));
  EXPECT_GT(rich->skeleton.stems.size(), 2 * poor->skeleton.stems.size());
  EXPECT_GT(rich->layout.leaves, 10 * poor->layout.leaves);
  EXPECT_GT(rich->layout.stems[0].k, poor->layout.stems[0].k);
  EXPECT_LT(rich->layout.leaf_scale, poor->layout.leaf_scale) << "many leaves are small";
}

TEST(Grow, TheSameSeedGivesTheSameTreeAndAnotherSeedAnother) {
  for (const char* species : {"oak", "grass"}) {
    const Grown a = small_tree(species, "artist,rough,shuffled", 4000, 7),
                b = small_tree(species, "artist,rough,shuffled", 4000, 7),
                c = small_tree(species, "artist,rough,shuffled", 4000, 8);
    EXPECT_EQ(a.mesh.positions, b.mesh.positions);
    EXPECT_EQ(a.mesh.triangles, b.mesh.triangles);
    EXPECT_EQ(a.mesh.texcoords, b.mesh.texcoords);
    EXPECT_EQ(a.mesh.normals, b.mesh.normals);
    EXPECT_EQ(to_json(a.truth), to_json(b.truth));
    EXPECT_NE(a.mesh.positions, c.mesh.positions);
  }
}

TEST(Grow, BreaksDoNotChangeTheTreeThatIsBroken) {
  const auto strict = make_plan(small_order("oak", "none", 0)),
             broken = make_plan(small_order("oak", "artist,z-up", 0));
  ASSERT_EQ(strict->skeleton.stems.size(), broken->skeleton.stems.size());
  for (std::size_t i = 0; i < strict->skeleton.stems.size(); ++i)
    EXPECT_EQ(strict->skeleton.stems[i].nodes, broken->skeleton.stems[i].nodes);
}

TEST(Grow, NoBranchAndNoLeafComesBelowTheClearance) {
  for (const std::string& name : species_names()) {
    const Species species = find_species(name).value();
    const Skeleton skeleton = grow(species, {}, 3);
    for (const Stem& stem : skeleton.stems) {
      if (stem.level == 0) continue;
      for (const Double3& node : stem.nodes)
        EXPECT_GT(node.y, 0.8 * species.clearance * species.height) << name;
    }
  }
}

TEST(Grow, ABillboardOfGrassIsAHierarchyOfItsOwn) {
  const Grown grass = small_tree("grass", "none", 0);
  std::size_t roots = 0;
  for (const TruthRing& ring : grass.truth.rings) roots += ring.parent == k_none;
  EXPECT_EQ(roots, grass.truth.branches.size());
  EXPECT_EQ(roots, 120u);
  for (const TruthBranch& b : grass.truth.branches) {
    EXPECT_EQ(b.k, 2u);
    EXPECT_EQ(b.rings, grass.truth.branches[0].rings) << "motion of one is copied to the others";
  }
  for (const Float3& n : grass.mesh.normals) EXPECT_EQ(n, (Float3{0, 1, 0})) << "lit as the ground is";
}

}  // namespace
}  // namespace copse::grow
