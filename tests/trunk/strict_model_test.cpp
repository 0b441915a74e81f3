#include "lib/analysis/trunk/strict_model.h"

#include "tests/trunk/strict_models.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

using Model = StrictModelMesh;

std::vector<std::string> rules(const StrictModel& model) {
  std::vector<std::string> out;
  for (const Breach& b : model.breaches) out.push_back(b.rule.substr(0, b.rule.find(':')));
  return out;
}

TEST(StrictModel, ReadsAModelThatObeysTheRules) {
  const StrictModel s = sound_model().read();
  EXPECT_EQ(rules(s), std::vector<std::string>{});
  EXPECT_EQ(s.ring_size, 5u);
  EXPECT_EQ(s.parent, (std::vector<std::uint32_t>{k_none, 0, 1, 1}));
  EXPECT_EQ(s.first_vertex, (std::vector<std::uint32_t>{0, 5, 10, 15, 20}));
}

TEST(StrictModel, ReadsStripsOfTwoVertices) {
  Model m;
  for (int i = 0; i < 3; ++i) {
    m.mesh.positions.push_back({0, i - 0.5, 0});
    m.mesh.positions.push_back({1, i - 0.5, 0});
  }
  for (std::uint32_t i = 0; i < 4; i += 2) m.triangle(i, i + 1, i + 2), m.triangle(i + 1, i + 3, i + 2);
  const StrictModel s = m.read();
  EXPECT_EQ(rules(s), std::vector<std::string>{});
  EXPECT_EQ(s.ring_size, 2u);
  EXPECT_EQ(s.parent.size(), 3u);
}

TEST(StrictModel, NamesARingOfAnotherSizeWithItsVertex) {
  Model m = sound_model();
  const auto extra = m.ring({0, 8, 0}, 0.4, 4);
  m.band(10, extra, 4);  // the top ring is vertices 10 to 14
  m.triangle(14, extra, 13), m.triangle(14, 10, extra);
  const StrictModel s = m.read();
  ASSERT_EQ(rules(s), std::vector<std::string>{"4.5"});
  EXPECT_EQ(s.breaches[0].elements, std::vector<std::uint32_t>{extra});
  EXPECT_EQ(to_text(s.breaches[0]),
            "rule 4.5: every radius has k vertices: radii of another number of vertices than the first root, "
            "with the "
            "vertex: 1 (vertex " +
                std::to_string(extra) + ")");
}

TEST(StrictModel, TakesTwoBuriedRingsForOneRootThatDiffersFromTheOthers) {
  Model m = sound_model();
  const auto a = m.ring({30, -3, 0}, 1, 5), b = m.ring({30, -2, 0}, 1, 5), c = m.ring({30, 2, 0}, 1, 5);
  m.band(a, b, 5), m.band(b, c, 5);
  EXPECT_EQ(rules(m.read()), std::vector<std::string>{"4.6"});
}

TEST(StrictModel, NamesATrunkAboveTheGround) {
  Model m = sound_model();
  for (Double3& p : m.mesh.positions) p.y += 2;
  const StrictModel s = m.read();
  ASSERT_EQ(rules(s), std::vector<std::string>{"4.6"});
  EXPECT_EQ(s.breaches[0].elements.size(), 20u);
}

TEST(StrictModel, NamesFreeTubesAndRadiiWithTwoParents) {
  Model m = sound_model();
  const auto a = m.ring({9, 3, 0}, 1, 5), b = m.ring({12, 4, 0}, 1, 5);
  m.band(a, b, 5);
  EXPECT_EQ(rules(m.read()), std::vector<std::string>{"4.1"});
  Model two = sound_model();
  const auto shared = two.ring({2, 9, 0}, 0.3, 5);
  two.band(10, shared, 5), two.band(15, shared, 5);
  EXPECT_EQ(rules(two.read()), std::vector<std::string>{"4.4"});
}

TEST(StrictModel, WhatNoRootReachesHidesNoOtherBreach) {
  Model m = sound_model();
  const auto a = m.ring({9, 3, 0}, 1, 4), b = m.ring({9, 4, 0}, 1, 4), c = m.ring({9, 5, 0}, 1, 4);
  m.band(a, b, 4), m.band(b, c, 4);
  const auto d = m.ring({19, 4, 0}, 1, 5), e = m.ring({19, 3, 0}, 1, 5);  // from the top, as thick as others
  m.band(d, e, 5);
  const StrictModel s = m.read();
  ASSERT_EQ(rules(s), (std::vector<std::string>{"4.5", "4.1"}));
  EXPECT_EQ(s.breaches[0].elements, (std::vector<std::uint32_t>{a, b, c}));
  EXPECT_EQ(s.breaches[1].elements.size(), 22u);
}

TEST(StrictModel, NamesACylinderWithAHole) {
  Model m = sound_model();
  m.mesh.triangles.erase(m.mesh.triangles.begin() + 13);  // of the band that ends in the ring of vertex 10
  m.mesh.texcoord_triangles.pop_back(), m.mesh.part_of.pop_back(), m.leaf_of.erase(m.leaf_of.begin());
  const StrictModel s = m.read();
  ASSERT_EQ(rules(s), std::vector<std::string>{"4.1"});
  EXPECT_EQ(s.breaches[0].elements, std::vector<std::uint32_t>{10});
}

TEST(StrictModel, NamesLeavesWithoutATrunk) {
  Model m;
  m.leaf(0), m.leaf(9);
  const StrictModel s = m.read();
  ASSERT_EQ(rules(s), std::vector<std::string>{"2"});
  EXPECT_EQ(to_text(s.breaches[0]),
            "rule 2: leaves and a trunk: triangles, all of them leaves: 2 (triangle 0-1)");
}

TEST(StrictModel, NamesLeavesThatTouchAndFacesOfFourCorners) {
  Model m = sound_model();
  m.leaf(20);  // in the same place as the first
  EXPECT_EQ(rules(m.read()), std::vector<std::string>{"3.1"});
  Model quad = sound_model();
  for (std::uint32_t t = 0; t < quad.mesh.triangles.size(); ++t) quad.mesh.face_of.push_back(t / 2);
  const StrictModel s = quad.read();
  ASSERT_EQ(rules(s), std::vector<std::string>{"1"});
  EXPECT_EQ(s.breaches[0].elements.size(), quad.mesh.triangles.size() / 2);
}

TEST(StrictModel, NamesMissingMaterialsAndTextures) {
  Model m = sound_model();
  m.mesh.materials[0].texture = k_none;
  EXPECT_EQ(rules(m.read()), (std::vector<std::string>{"3.3", "4.7"}));
  m.mesh.parts[0].material = k_none;
  EXPECT_EQ(rules(m.read()), (std::vector<std::string>{"3.2", "3.3", "4.7", "4.7"}));
}

TEST(StrictModel, OfAnEmptyMeshHasNoBreach) {
  EXPECT_TRUE(read_strict_model({}, {}, {}).breaches.empty());
}

TEST(StrictModel, FollowsAVineOfAHundredThousandSegments) {
  const StrictModel s = vine_model(100'000).read();
  EXPECT_EQ(s.parent.size(), 100001u);
  EXPECT_TRUE(s.breaches.empty());
}

}  // namespace
}  // namespace copse
