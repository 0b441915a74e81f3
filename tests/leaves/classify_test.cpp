#include "lib/analysis/leaves/classify.h"

#include "lib/analysis/surface/weld.h"
#include "lib/formats/import/import.h"
#include "lib/formats/random.h"
#include "tests/leaves/shapes.h"

#include <chrono>
#include <numeric>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace copse {
namespace {

using shapes::Builder;
using shapes::line;
using testing::HasSubstr;

// Every triangle in exactly one component, leaf numbers in order, counts right, a reason for each.
void expect_sound(const Mesh& mesh, const Classification& c, const std::string& what) {
  ASSERT_EQ(c.component_of.size(), mesh.triangles.size()) << what;
  ASSERT_EQ(c.leaf_of.size(), mesh.triangles.size()) << what;
  std::vector<std::uint32_t> triangles(c.components.size(), 0);
  std::uint32_t next_component = 0, next_leaf = 0;
  std::uint64_t trunk = 0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const std::uint32_t component = c.component_of[t];
    ASSERT_LE(component, next_component) << what;
    if (component == next_component) {
      ASSERT_EQ(c.components[component].part, mesh.part_of[t]) << what;
      ++next_component;
    }
    ++triangles[component];
    const bool leaf = c.components[component].kind == PartClass::leaf;
    ASSERT_EQ(leaf, c.leaf_of[t] != k_none) << what;
    trunk += !leaf;
    if (!leaf) continue;
    ASSERT_LE(c.leaf_of[t], next_leaf) << what;
    next_leaf += c.leaf_of[t] == next_leaf;
  }
  EXPECT_EQ(next_component, c.components.size()) << what;
  EXPECT_EQ(next_leaf, c.leaf_count) << what;
  EXPECT_EQ(trunk, c.trunk_triangles) << what;
  EXPECT_EQ(mesh.triangles.size() - trunk, c.leaf_triangles) << what;
  for (std::size_t i = 0; i < c.components.size(); ++i) {
    ASSERT_EQ(triangles[i], c.components[i].triangles) << what;
    ASSERT_FALSE(c.components[i].reason.empty()) << what;
  }
}

Classification classified(const Mesh& mesh, const ClassifyOptions& options = {}) {
  Result<Classification> result = classify(mesh, options);
  EXPECT_TRUE(result.has_value());
  if (!result) return {};
  expect_sound(mesh, *result, "");
  return std::move(*result);
}

// --- real trees --------------------------------------------------------------------------------------------

struct Known {
  const char* file;
  std::uint64_t trunk, leaf;  // triangles
  std::uint32_t leaves;
  bool z_up = false;
  bool parts_touch =
      false;  // without materials trunk and crown are one surface: nothing could tell them apart
};
// Leaves: ../shared/trees/truth where it says; otherwise counted by hand on the pieces.
const std::vector<Known> k_known{
    {"ez_oak_small_ideal.obj", 5604, 900, 900},
    {"ez_ash_medium.obj.gz", 9120, 10880, 2720},
    {"eztree_oak_medium.obj.gz", 3166, 10640, 2660},
    {"sap_quaking_aspen.obj", 3792, 882, 441, true},
    {"sap_callistemon_quads.obj.gz", 14616, 10428, 2607, true},
    {"pt_fork_small.obj", 4020, 896, 224},
    {"dv_oak_skin.obj.gz", 139638, 900, 900},
    {"arbaro_lombardy_poplar.obj.gz", 15017, 48696, 8116},
    {"quaternius_oak_1.obj", 4312, 1899, 950},
    {"quaternius_oak_1.glb", 4312, 1899, 950},
    {"quaternius_pine_5.obj", 465, 1093, 53},
    {"quaternius_pine_5.glb", 465, 1093, 53},
    {"quaternius_dead_1.obj", 6106, 0, 0},
    {"quaternius_fern.obj", 0, 288, 9},
    {"shapespark_tree_1.obj", 222, 424, 53},
    {"kaykit_tree_dead_large.obj", 256, 0, 0},
    {"kaykit_tree_pine_orange_large.obj", 48, 270, 4},
    {"kenney_tree_detailed_fall.obj", 122, 280, 3, false, true},
    {"kenney_tree_oak_fall.obj", 132, 64, 1, false, true},
    {"kenney_tree_oak_fall.glb", 132, 64, 1, false, true},
    {"kenney_grass-trees-tall.obj", 62, 410, 10},  // five trunks and the ground; two blobs a tree
};

Mesh load(const Known& known) {
  Result<Import> import = import_mesh(shapes::k_trees / known.file);
  if (!import) {
    ADD_FAILURE() << known.file << ": " << import.error().what;
    return {};
  }
  if (known.z_up) orient(import->mesh, UpAxis::z, 1);
  return std::move(import->mesh);
}

void expect_known(const Known& known, const Mesh& mesh, const char* how) {
  const Result<Classification> c = classify(mesh);
  ASSERT_TRUE(c.has_value());
  const std::string what = std::string(known.file) + how;
  expect_sound(mesh, *c, what);
  EXPECT_EQ(c->trunk_triangles, known.trunk) << what;
  EXPECT_EQ(c->leaf_triangles, known.leaf) << what;
  EXPECT_EQ(c->leaf_count, known.leaves) << what;
}

TEST(Classify, SaysOfRealTreesWhatAPersonWould) {
  if (!shapes::have_trees()) return;
  for (const Known& known : k_known) expect_known(known, load(known), "");
}

TEST(Classify, NeedsNoNames) {
  if (!shapes::have_trees()) return;
  for (const Known& known : k_known) {
    Mesh mesh = load(known);
    for (Part& part : mesh.parts) part.object = part.group = "";
    for (Material& material : mesh.materials) material.name.clear();
    expect_known(known, mesh, ", without names");
    if (known.parts_touch) continue;
    for (Part& part : mesh.parts) part.material = k_none;
    expect_known(known, mesh, ", without names and materials");
  }
}

TEST(Classify, SaysTheSameOfAMeshThatTheCallerWelded) {
  if (!shapes::have_trees()) return;
  for (const Known& known : k_known) {
    const Mesh mesh = load(known);
    const auto welded = weld(mesh.positions, weld_tolerances(mesh.positions, mesh.triangles));
    const Result<Classification> c = classify(mesh, welded);
    ASSERT_TRUE(c.has_value());
    expect_sound(mesh, *c, known.file);
    EXPECT_EQ(c->trunk_triangles, known.trunk) << known.file;
    // Two of pt_fork's cards lie so near each other that this weld makes them one.
    EXPECT_NEAR(c->leaf_count, known.leaves, known.file == std::string("pt_fork_small.obj") ? 1 : 0)
        << known.file;
  }
}

TEST(Classify, CountsCrossedCardsAsPiecesAndPairsAsLeaves) {
  if (!shapes::have_trees()) return;
  const Classification c = classified(load(k_known[1]));
  EXPECT_EQ(std::count_if(c.components.begin(), c.components.end(),
                          [](const Component& k) { return k.kind == PartClass::leaf; }),
            5440);
}

TEST(Classify, ScaleAndPlaceChangeNothing) {
  if (!shapes::have_trees()) return;
  for (const double scale : {1e-30, 1e-3, 1e30}) {
    for (const char* file : {"ez_oak_small_ideal.obj", "pt_fork_small.obj", "kenney_grass-trees-tall.obj"}) {
      const Known& known = *std::find_if(k_known.begin(), k_known.end(),
                                         [&](const Known& k) { return std::string(file) == k.file; });
      Mesh mesh = load(known);
      for (Part& part : mesh.parts) part.object = part.group = "";
      for (Double3& p : mesh.positions) p *= scale;
      expect_known(known, mesh, ", scaled");
      if (scale != 1e-3) continue;
      for (Double3& p : mesh.positions) p += Double3{1e4, -1e4, 1e4};
      expect_known(known, mesh, ", far away");
    }
  }
}

// --- every defined extreme ---------------------------------------------------------------------------------

TEST(Classify, AnEmptyMeshHasNothing) {
  const Classification c = classified({});
  EXPECT_EQ(c.components.size(), 0u);
  EXPECT_EQ(c.leaf_count, 0u);
}

TEST(Classify, ASingleTriangleIsALeaf) {
  Builder b;
  b.triangle({0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  const Classification c = classified(b.mesh);
  EXPECT_EQ(c.leaf_count, 1u);
  EXPECT_EQ(c.components[0].reason, "a single triangle");
}

TEST(Classify, TrianglesWithoutAreaGetAnAnswerToo) {
  Builder b;
  b.triangle({0, 0, 0}, {1, 0, 0}, {2, 0, 0});
  b.triangle({5, 5, 5}, {5, 5, 5}, {5, 5, 5});
  classified(b.mesh);
}

TEST(Classify, AnUnnamedTubeIsTrunkEvenWithASeamThatWasComputedTwice) {
  for (const double seam : {0.0, 1e-6}) {
    Builder b;
    b.tube(line({0, 0, 0}, {0, 2, 0}, 5), 0.05, 6, seam);
    const Classification c = classified(b.mesh);
    EXPECT_EQ(c.trunk_triangles, 48u) << seam;
    EXPECT_EQ(c.components.size(), 1u) << seam;
    EXPECT_THAT(std::string(c.components[0].reason), HasSubstr("stem"));
  }
}

TEST(Classify, LeavesThatMeetInAPointStayApart) {
  Builder b;
  for (int i = 0; i < 12; ++i) {
    const double a = i * 0.5;
    b.triangle({0, 3, 0}, {std::cos(a), 3.2, std::sin(a)}, {std::cos(a + 0.3), 3.1, std::sin(a + 0.3)});
  }
  EXPECT_EQ(classified(b.mesh).leaf_count, 12u);
}

TEST(Classify, ThreeCardsThatCrossInOneCentreAreOneLeaf) {
  Builder b;
  for (int leaf = 0; leaf < 10; ++leaf) {
    const Double3 centre{leaf * 3.0, 2, 0};
    for (int i = 0; i < 3; ++i) {
      const double a = i * std::numbers::pi / 3;
      b.card(centre, {std::cos(a), 0, std::sin(a)}, {0, 1, 0});
    }
  }
  const Classification c = classified(b.mesh);
  EXPECT_EQ(c.leaf_count, 10u);
  EXPECT_EQ(c.components.size(), 30u);
}

TEST(Classify, CardsThatCrossByChanceStayLeavesOfTheirOwn) {
  Builder b;
  for (int leaf = 0; leaf < 20; ++leaf) b.card({leaf * 3.0, 2, 0}, {1, 0, 0}, {0, 1, 0});
  b.card({0, 2, 0}, {0, 0, 1}, {0, 1, 0});
  EXPECT_EQ(classified(b.mesh).leaf_count, 21u);
}

TEST(Classify, SolidNeedlesAreLeavesWhenThereAreNoOthers) {
  Builder b;
  b.tube(line({0, 0, 0}, {0, 10, 0}, 8), 0.2, 8);
  Random random(1);
  for (int i = 0; i < 300; ++i) {
    const Double3 foot{0.2, random.uniform(2, 10), 0};
    b.tube({foot, foot + Double3{0.15, random.around(0, 0.05), random.around(0, 0.1)}}, 0.004, 3);
  }
  const Classification c = classified(b.mesh);
  EXPECT_EQ(c.leaf_count, 300u);
  EXPECT_EQ(c.trunk_triangles, 112u);
}

TEST(Classify, ASlenderCrownOnANarrowTrunkIsACrown) {
  Builder b;
  b.tube(line({0, 0, 0}, {0, 1.2, 0}, 2), 0.15, 8);
  b.ball({0, 4, 0}, 1, 3.2);  // a cypress
  const Classification c = classified(b.mesh);
  EXPECT_EQ(c.trunk_triangles, 16u);
  EXPECT_EQ(c.leaf_count, 1u);
  EXPECT_THAT(std::string(c.components[1].reason), HasSubstr("slender crown"));
}

TEST(Classify, AStubbyTrunkUnderAWiderCrownIsTrunk) {
  Builder b;
  b.ball({0, 0.5, 0}, 0.5);
  b.ball({0, 2, 0}, 1.2);
  const Classification c = classified(b.mesh);
  EXPECT_EQ(c.components[0].kind, PartClass::trunk);
  EXPECT_EQ(c.components[1].kind, PartClass::leaf);
}

TEST(Classify, ALumpUnderCardsIsTheTrunk) {
  Builder b;
  b.ball({0, 1, 0}, 1);
  for (int i = 0; i < 20; ++i) b.card({i * 0.13, 3, 0.5}, {0.1, 0, 0}, {0, 0.1, 0.05});
  const Classification c = classified(b.mesh);
  EXPECT_EQ(c.components[0].kind, PartClass::trunk);
  EXPECT_EQ(c.leaf_count, 20u);
}

TEST(Classify, DoubledFrondsAreLeavesAndDoubledTubesTrunk) {
  Builder b;
  for (int i = 0; i < 10; ++i) {  // fronds bent by 60 degrees, every triangle twice, once reversed
    const std::size_t before = b.mesh.triangles.size();
    const double x = i;
    b.card({x, 3, 0}, {0.2, 0, 0}, {0, 0.2, 0});
    const std::uint32_t top = b.mesh.triangles[before][2], left = b.mesh.triangles[before + 1][2];
    const std::uint32_t tip_a = b.point({x + 0.2, 3.3, 0.17}), tip_b = b.point({x - 0.2, 3.3, 0.17});
    b.triangle(left, top, tip_a), b.triangle(left, tip_a, tip_b);
    for (std::size_t t = before, end = b.mesh.triangles.size(); t < end; ++t) {
      const Triangle front = b.mesh.triangles[t];
      b.triangle(front[2], front[1], front[0]);
    }
  }
  const std::size_t before = b.mesh.triangles.size();
  b.tube(line({0, 0, 0}, {0, 3, 0}, 4), 0.1, 6);
  for (std::size_t t = before, end = b.mesh.triangles.size(); t < end; ++t) {
    const Triangle front = b.mesh.triangles[t];
    b.triangle(front[2], front[1], front[0]);
  }
  const Classification c = classified(b.mesh);
  EXPECT_EQ(c.leaf_count, 10u);
  EXPECT_EQ(c.trunk_triangles, 72u);
}

TEST(Classify, ACapOfAnotherMaterialBelongsToItsTube) {
  Builder b;
  const std::uint32_t side = b.material("m1"), cut = b.material("m2");
  b.part("", side);
  b.tube(line({0, 0, 0}, {0, 2, 0}, 4), 0.2, 6);
  b.part("", cut);
  const std::uint32_t last = static_cast<std::uint32_t>(b.mesh.positions.size()) - 7;
  for (std::uint32_t i = 1; i + 1 < 6; ++i) b.triangle(last, last + i, last + i + 1);
  const Classification c = classified(b.mesh);
  EXPECT_EQ(c.leaf_count, 0u);
  EXPECT_THAT(std::string(c.components.back().reason), HasSubstr("cap"));
}

// --- names and patterns ------------------------------------------------------------------------------------

Mesh named_tree() {
  Builder b;
  const std::uint32_t bark = b.material("Oak_Bark"), cards = b.material("cards_01");
  b.part("stem_object", bark);
  b.tube(line({0, 0, 0}, {0, 2, 0}, 4), 0.1, 6);
  b.part("leaf_object", cards, "crown");
  for (int i = 0; i < 9; ++i) b.card({i * 0.3, 2, 0}, {0.1, 0, 0}, {0, 0.1, 0});
  return b.mesh;
}

TEST(Classify, PatternsOfTheUserDecide) {
  const Mesh mesh = named_tree();
  EXPECT_EQ(classified(mesh).leaf_count, 9u);
  const Classification trunk = classified(mesh, {.trunk_patterns = {"*CARDS*"}, .leaf_patterns = {}});
  EXPECT_EQ(trunk.leaf_count, 0u);
  EXPECT_EQ(trunk.components.back().reason, "--trunk '*CARDS*' matches material 'cards_01'");
  const Classification leaf = classified(mesh, {.trunk_patterns = {}, .leaf_patterns = {"stem_*"}});
  EXPECT_EQ(leaf.trunk_triangles, 0u);
  EXPECT_EQ(classified(mesh, {.trunk_patterns = {"crown"}, .leaf_patterns = {}}).leaf_count, 0u);
}

TEST(Classify, APatternThatMatchesNothingIsAnErrorThatNamesTheNames) {
  const Result<Classification> c =
      classify(named_tree(), {.trunk_patterns = {"*bark"}, .leaf_patterns = {"leef*"}});
  ASSERT_FALSE(c.has_value());
  EXPECT_EQ(c.error().fault, Fault::usage);
  EXPECT_THAT(c.error().what, HasSubstr("--leaf 'leef*' matches no"));
  EXPECT_THAT(c.error().remedy, HasSubstr("'Oak_Bark', 'cards_01', 'crown'"));
}

TEST(Classify, APartThatBothListsClaimIsAnError) {
  const Result<Classification> c =
      classify(named_tree(), {.trunk_patterns = {"Oak*"}, .leaf_patterns = {"stem*"}});
  ASSERT_FALSE(c.has_value());
  EXPECT_EQ(c.error().fault, Fault::usage);
  EXPECT_THAT(c.error().what, HasSubstr("--trunk 'Oak*'"));
  EXPECT_THAT(c.error().what, HasSubstr("--leaf 'stem*'"));
}

TEST(Classify, ACardThatIsNamedBranchIsFoliageAndATubeIsNot) {
  Builder b;
  b.part("", b.material("branch-01"));
  b.tube(line({0, 0, 0}, {0, 2, 0}, 4), 0.1, 6);
  for (int i = 0; i < 3; ++i) b.card({i * 0.3, 2, 0}, {0.1, 0, 0}, {0, 0.1, 0});
  b.part("", b.material("leaf"));
  b.card({1, 2, 1}, {0.1, 0, 0}, {0, 0.1, 0});
  const Classification c = classified(b.mesh);
  EXPECT_EQ(c.trunk_triangles, 36u);
  EXPECT_EQ(c.leaf_count, 4u);
  EXPECT_EQ(c.components[0].reason,
            "material 'branch-01' says branch, and it is a stem of 36 triangles: long for its thickness");
  EXPECT_EQ(c.components[1].reason,
            "material 'branch-01' says branch, but it is a flat card of 2 triangles, one of 3 alike");
}

TEST(Classify, AMeshThatIsAllNamedLeavesMayStillHaveATrunk) {
  Builder b;
  b.part("palm", b.material("Leaves"));
  b.tube(line({0, 0, 0}, {0, 6, 0}, 9), 0.2, 8);
  for (int i = 0; i < 9; ++i)
    b.card({std::cos(i), 6, std::sin(i)}, {std::cos(i), 0.2, std::sin(i)}, {0.1, 0.1, 0});
  b.tube(line({1, 6, 0}, {1.5, 6.2, 0}, 3), 0.02, 4);  // a stalk
  const Classification c = classified(b.mesh);
  EXPECT_EQ(c.trunk_triangles, 128u);
}

// A tree of boughs, twigs and twelve cards.
void add_oak(Builder& b) {
  b.tube(line({0, 0, 0}, {0, 6, 0}, 9), 0.2, 8);
  for (int i = 0; i < 12; ++i) {
    const Double3 foot{0, 2 + 0.3 * i, 0}, tip = foot + Double3{std::cos(i), 0.4, std::sin(i)};
    b.tube(line(foot, tip, 5), 0.05, 6);
    b.tube(line((foot + tip) / 2.0, tip + Double3{0, 0.4, 0}, 3), 0.02, 4);
    b.card(tip, {0.1, 0, 0}, {0, 0.1, 0.02});
  }
}

TEST(Classify, ANameThatSaysLeafOfAWholeTreeTakesNoTrunkBesideAStone) {
  Builder b;
  b.part("LeafyOak");
  add_oak(b);
  const std::size_t alone = classified(b.mesh).trunk_triangles;
  ASSERT_GT(alone, 0u);
  b.part("Object.001");
  b.ball({2, 0.2, 0}, 0.3, 0.2);
  const Classification c = classified(b.mesh);
  EXPECT_EQ(c.trunk_triangles, alone);
  EXPECT_EQ(c.components[0].kind, PartClass::trunk);
}

TEST(Classify, ANameThatSaysLeafBindsWhereTheOtherPartIsTheTrunk) {
  Builder b;
  b.part("Leaves");
  for (int i = 0; i < 9; ++i)
    b.tube(line({0, 3 + 0.3 * i, 0}, {std::cos(i), 3.4 + 0.3 * i, std::sin(i)}, 5), 0.05, 6);
  b.part("Object.001");
  b.tube(line({0, 0, 0}, {0, 6, 0}, 9), 0.2, 8);
  const Classification c = classified(b.mesh);
  EXPECT_EQ(c.trunk_triangles, 128u);
}

TEST(Classify, AShortTubeThatIsThinByChanceIsATwigAmongTwigsOfAsManyTriangles) {
  for (const int twigs : {2, 3}) {
    Builder b;
    b.part("a");
    b.tube(line({0, 0, 0}, {0, 6, 0}, 9), 0.2, 8);
    for (int i = 0; i < twigs; ++i) b.tube(line({0.2, 3.0 + i, 0}, {1, 3.5 + i, 0}, 2), 0.02, 4);
    std::vector<std::uint32_t> low, high;
    for (const Double3& p : {Double3{0, 0, 0}, {0.2, 0, 0}, {0.2, 0, 0.02}, {0, 0, 0.02}}) {
      low.push_back(b.point(p + Double3{0.3, 5, 0}));
      high.push_back(b.point(p + Double3{0.3, 5.2, 0}));
    }
    for (std::size_t i = 0; i < 4; ++i) {
      const std::size_t n = (i + 1) % 4;
      b.triangle(low[i], low[n], high[n]), b.triangle(low[i], high[n], high[i]);
    }
    const Classification c = classified(b.mesh);
    EXPECT_EQ(c.components.back().kind, twigs == 3 ? PartClass::trunk : PartClass::leaf)
        << c.components.back().reason;
  }
}

TEST(Classify, BlobsOfOneMakeThatOverlapHighUpAreFoliage) {
  Builder b;
  b.part("a");
  b.tube(line({0, 0, 0}, {0, 6, 0}, 9), 0.2, 8);
  b.ball({0, 5, 0}, 0.5, 0.5);
  b.ball({0, 5.6, 0}, 0.8, 0.8);
  const Classification c = classified(b.mesh);
  EXPECT_EQ(c.trunk_triangles, 128u);
  EXPECT_EQ(c.leaf_count, 2u);
}

TEST(Classify, ANameThatAllBearTakesNoBoughFromItsTrunk) {
  Builder b;
  b.part("LeafyOak");
  add_oak(b);
  const Classification named = classified(b.mesh);
  b.mesh.parts.back().object = "tree";
  EXPECT_EQ(named.trunk_triangles, classified(b.mesh).trunk_triangles);
  EXPECT_EQ(named.leaf_count, 12u);
  EXPECT_EQ(
      named.components[1].reason,
      "object 'LeafyOak' says leafy, but it is a stem of 48 triangles: long for its thickness, one of 12 "
      "alike");
}

TEST(Classify, ACrownAsSlenderAsAStemIsNoBoughWhereItsNameSaysLeaf) {
  Builder b;
  b.part("Foliage_Cypress");
  b.tube(line({0, 0, 0}, {0, 2.4, 0}, 2), 0.15, 8);
  b.ball({0, 5, 0}, 1, 3.2);
  const Classification c = classified(b.mesh);
  EXPECT_EQ(c.trunk_triangles, 16u);
  EXPECT_EQ(c.leaf_count, 1u);
}

// Strips of three quads, `below` deep in the ground.
Builder grass_block(double below) {
  Builder b;
  b.part("grass");
  for (int blade = 0; blade < 6; ++blade) {
    const Double3 foot{blade * 0.3, -below, 0}, side{0.1, 0, 0.02 * blade};
    std::uint32_t left = b.point(foot - side), right = b.point(foot + side);
    for (int i = 1; i <= 3; ++i) {
      const Double3 bend{0, i * 0.3, i * i * 0.02};
      const std::uint32_t next_left = b.point(foot - side + bend), next_right = b.point(foot + side + bend);
      b.triangle(left, right, next_right), b.triangle(left, next_right, next_left);
      left = next_left, right = next_right;
    }
  }
  return b;
}

TEST(Classify, BladesOfGrassAreTrunkForTheyMoveFromTheirRoots) {
  const Classification named = classified(grass_block(0).mesh);
  EXPECT_EQ(named.trunk_triangles, 36u);
  EXPECT_EQ(named.components[0].reason,
            "object 'grass' says grass, and it is a blade of 6 triangles that stands on the ground, one of 6 "
            "alike");
  Mesh unnamed = grass_block(0.02).mesh;
  for (Part& part : unnamed.parts) part.object.clear();
  EXPECT_EQ(classified(unnamed).trunk_triangles, 36u);
  Mesh on_the_ground = grass_block(0).mesh;
  for (Part& part : on_the_ground.parts) part.object.clear();
  EXPECT_EQ(classified(on_the_ground).leaf_count, 6u);  // as good as a fern
}

TEST(Classify, ReasonsOutliveTheClassificationTheyCameFrom) {
  Classification copy;
  {
    const Classification original = classified(named_tree());
    copy = original;
  }
  EXPECT_EQ(copy.components[0].reason, "material 'Oak_Bark' says bark");
}

// --- speed -------------------------------------------------------------------------------------------------

TEST(Classify, IsLinear) {
  const auto seconds = [](int leaves) {
    Builder b;
    b.part("", b.material("leaf"));
    Random random(7);
    for (int i = 0; i < leaves; ++i) {
      b.card({random.around(0, 5), random.around(0, 5), random.around(0, 5)}, {random.around(0, 0.1), 0, 0.1},
             {0, 0.1, random.around(0, 0.1)});
    }
    b.part("", b.material("bark"));
    b.tube(line({0, 0, 0}, {0, 5, 0}, 9), 0.2, 8);
    const auto start = std::chrono::steady_clock::now();
    EXPECT_EQ(classify(b.mesh)->leaf_count, static_cast<std::uint32_t>(leaves));
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  const double small = seconds(20000), large = seconds(200000);
  std::printf("  classify: %.0f ns a triangle of 40 000, %.0f of 400 000\n", small / 40000 * 1e9,
              large / 400000 * 1e9);
  EXPECT_LT(large, 60 * small + 0.5);  // 10 when linear; 100 when quadratic
}

}  // namespace
}  // namespace copse
