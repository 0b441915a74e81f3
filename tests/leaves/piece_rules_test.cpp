#include "lib/analysis/leaves/piece_rules.h"

#include "lib/analysis/surface/weld.h"
#include "tests/leaves/shapes.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace copse {
namespace {

using shapes::Builder;
using shapes::line;
using testing::HasSubstr;

// Kind and reason of every piece; all parts have one key unless their verdicts differ.
struct Ruled {
  std::vector<PartClass> kind;
  std::vector<std::string> reason;
};
Ruled rule(const Mesh& mesh, std::vector<PartVerdict> verdicts = {}) {
  if (verdicts.empty()) verdicts.resize(mesh.parts.size());
  std::vector<std::uint32_t> keys;
  for (std::uint32_t p = 0; p < mesh.parts.size(); ++p) keys.push_back(p);
  const std::vector<std::uint32_t> welded = weld(mesh.positions, 0.0);
  const PieceScan scan(mesh, welded, edge_pieces(mesh.triangles, welded, mesh.part_of, keys), verdicts);
  const PieceClasses classes = classify_pieces_by_rule(mesh, welded, scan, verdicts);
  Ruled out{classes.kind, {}};
  for (const std::uint32_t r : classes.reason) out.reason.push_back(classes.reasons[r]);
  return out;
}

TEST(PieceRules, TheGroundUnderATreeIsNoLeaf) {
  Builder b;
  b.card({0, 0, 0}, {3, 0, 0}, {0, 0, 3});
  b.tube(line({0, 0.1, 0}, {0, 4, 0}, 4), 0.2, 6);
  const Ruled r = rule(b.mesh);
  EXPECT_EQ(r.kind[0], PartClass::trunk);
  EXPECT_THAT(r.reason[0], HasSubstr("ground plate"));
  Builder alone;
  alone.card({0, 0, 0}, {3, 0, 0}, {0, 0, 3});
  EXPECT_EQ(rule(alone.mesh).kind[0], PartClass::leaf);
}

TEST(PieceRules, TiersRoundATrunkAreLeavesAlthoughTheyReachDown) {
  Builder b;
  b.tube(line({0, 0, 0}, {0, 5, 0}, 5), 0.2, 8);
  for (int i = 0; i < 3; ++i) b.ball({0, 2 + i * 1.2, 0}, 1.5 - i * 0.4, 0.5);
  const Ruled r = rule(b.mesh);
  EXPECT_THAT(r.kind,
              testing::ElementsAre(PartClass::trunk, PartClass::leaf, PartClass::leaf, PartClass::leaf));
}

TEST(PieceRules, OfAPileOnlyTheLowestNarrowBlobIsTrunk) {
  Builder b;
  b.ball({0, 0.5, 0}, 0.5);
  b.ball({0, 1.8, 0}, 0.9);
  b.ball({0, 3.2, 0}, 1.2);
  const Ruled r = rule(b.mesh);
  EXPECT_THAT(r.kind, testing::ElementsAre(PartClass::trunk, PartClass::leaf, PartClass::leaf));
  EXPECT_THAT(r.reason[0], HasSubstr("carries a wider one"));
}

TEST(PieceRules, AForestOfBlobTreesHasATrunkEach) {
  Builder b;
  for (int i = 0; i < 5; ++i) {
    b.ball({i * 4.0, 0.5, 0}, 0.5, 1, 5, 6);
    b.ball({i * 4.0, 2, 0}, 1.2);
  }
  const Ruled r = rule(b.mesh);
  for (std::size_t p = 0; p < 10; ++p) EXPECT_EQ(r.kind[p], p % 2 ? PartClass::leaf : PartClass::trunk) << p;
}

TEST(PieceRules, ColourTellsBlobsApart) {
  Builder b;
  b.part("", b.material("m1"));
  b.ball({0, 1, 0}, 1);
  b.part("", b.material("m2"));
  b.ball({5, 1, 0}, 1);
  b.mesh.materials[0].diffuse = {0.35f, 0.2f, 0.1f};
  b.mesh.materials[1].diffuse = {0.2f, 0.5f, 0.1f};
  const Ruled r = rule(b.mesh);
  EXPECT_THAT(r.kind, testing::ElementsAre(PartClass::trunk, PartClass::leaf));
}

TEST(PieceRules, ABlobThatIsAllThereIsIsTrunkUnlessItIsNamedLeaf) {
  Builder b;
  b.ball({0, 1, 0}, 1);
  EXPECT_EQ(rule(b.mesh).kind[0], PartClass::trunk);
  EXPECT_EQ(rule(b.mesh, {{NameClass::leaf, Binding::whole, "named"}}).kind[0], PartClass::leaf);
}

TEST(PieceRules, InAMeshThatIsAllBarkAFewSheetsAreBarkAndManyAreLeaves) {
  const PartVerdict bark{NameClass::trunk, Binding::whole, "material 'bark' says bark"};
  for (const int cards : {3, 20}) {
    Builder b;
    b.tube(line({0, 0, 0}, {0, 5, 0}, 5), 0.2, 8);
    for (int i = 0; i < cards; ++i) b.card({1, i * 0.25, 0}, {0.1, 0, 0}, {0, 0.1, 0});
    const Ruled r = rule(b.mesh, {bark});
    EXPECT_EQ(r.kind[1], cards == 3 ? PartClass::trunk : PartClass::leaf);
  }
}

// A frustum that stands on the ground, open at both ends.
void add_foot(Builder& b, double bottom, double top, double height, int sides) {
  const std::size_t first = b.mesh.positions.size();
  b.tube(line({0, 0, 0}, {0, height, 0}, 2), top, sides);
  for (std::size_t i = first; i < b.mesh.positions.size(); ++i) {
    Double3& p = b.mesh.positions[i];
    if (p.y == 0) p = p * (bottom / top);
  }
}

TEST(PieceRules, AFootThatIsCutOffIsTrunkWhereAStemGoesOnFromIt) {
  for (const double flare : {1.5, 2.5, 4.0}) {  // a blob, a blob, a sheet
    Builder b;
    add_foot(b, 0.1 * flare, 0.1, 0.3, 6);
    b.ball({0, 4, 0}, 1);
    EXPECT_EQ(rule(b.mesh).kind[0], PartClass::leaf) << flare;
    b.tube(line({0, 0.3, 0}, {0, 4, 0}, 4), 0.1, 9);
    const Ruled r = rule(b.mesh);
    EXPECT_THAT(r.kind, testing::ElementsAre(PartClass::trunk, PartClass::leaf, PartClass::trunk)) << flare;
    EXPECT_THAT(r.reason[0], HasSubstr("end to end"));
  }
}

TEST(PieceRules, AChainOfLumpsIsTrunkWhenItIsLong) {
  Builder b;
  for (int i = 0; i < 4; ++i) b.tube(line({0, i * 0.5, 0}, {0, i * 0.5 + 0.5, 0}, 2), 0.3, 6 + i);
  const Ruled all = rule(b.mesh);
  EXPECT_THAT(all.kind, testing::Each(PartClass::trunk));
  Builder two;
  for (int i = 0; i < 2; ++i) two.tube(line({0, i * 0.3, 0}, {0, i * 0.3 + 0.3, 0}, 2), 0.3, 6 + i);
  EXPECT_THAT(rule(two.mesh).kind, testing::Each(PartClass::leaf));
}

// Strips of two quads, each of which stands at one of `feet`.
Builder blades(const std::vector<Double3>& feet, const Double3& lean) {
  Builder b;
  for (std::size_t i = 0; i < feet.size(); ++i) {
    const double turn = static_cast<double>(i);
    const Double3 side{0.02 * std::cos(turn), 0, 0.02 * std::sin(turn)};
    const Double3 out{lean.x * std::cos(turn), lean.y, lean.x * std::sin(turn)};
    std::uint32_t left = b.point(feet[i] - side), right = b.point(feet[i] + side);
    for (int s = 1; s <= 2; ++s) {
      const Double3 bend = out * s + Double3{0, 0, 0.01 * s * s};
      const std::uint32_t l = b.point(feet[i] - side + bend), r = b.point(feet[i] + side + bend);
      b.triangle(left, right, r), b.triangle(left, r, l);
      left = l, right = r;
    }
  }
  return b;
}

TEST(PieceRules, ManyStripsThatStandAllOverTheGroundAreBladesWhateverTheGroundsHeight) {
  for (const double ground : {-3.0, 0.0, 0.5, 100.0}) {
    std::vector<Double3> meadow, hanging;
    for (int i = 0; i < 12; ++i) meadow.push_back({0.3 * (i % 4), ground, 0.3 * static_cast<double>(i / 4)});
    EXPECT_THAT(rule(blades(meadow, {0.05, 0.2, 0}).mesh).kind, testing::Each(PartClass::trunk)) << ground;
    if (ground <= 0) continue;
    for (int i = 0; i < 12; ++i) hanging.push_back({0.3 * (i % 4), ground + 0.1 * i, 0});
    EXPECT_THAT(rule(blades(hanging, {0.05, 0.2, 0}).mesh).kind, testing::Each(PartClass::leaf)) << ground;
    const std::vector<Double3> fern(12, {0, ground, 0});
    EXPECT_THAT(rule(blades(fern, {0.3, 0.2, 0}).mesh).kind, testing::Each(PartClass::leaf)) << ground;
    const std::vector<Double3> few(meadow.begin(), meadow.begin() + 6);
    EXPECT_THAT(rule(blades(few, {0.05, 0.2, 0}).mesh).kind, testing::Each(PartClass::leaf)) << ground;
  }
}

TEST(PieceRules, ReasonsAreSharedNotRepeated) {
  Builder b;
  for (int i = 0; i < 1000; ++i) b.card({i * 3.0, 0, 0}, {1, 0, 0}, {0, 1, 0});
  std::vector<PartVerdict> verdicts(1);
  const std::vector<std::uint32_t> welded = weld(b.mesh.positions, 0.0), keys{0};
  const PieceScan scan(b.mesh, welded, edge_pieces(b.mesh.triangles, welded, b.mesh.part_of, keys), verdicts);
  EXPECT_THAT(classify_pieces_by_rule(b.mesh, welded, scan, verdicts).reasons,
              testing::ElementsAre("a flat card of 2 triangles, one of 1000 alike"));
}

}  // namespace
}  // namespace copse
