#include "lib/analysis/trunk/strict_model.h"

#include "lib/analysis/surface/weld.h"

#include <cmath>
#include <numbers>

#include <gtest/gtest.h>

namespace copse {
namespace {

// A model that obeys every rule: a trunk of rings joined by bands, one leaf.
struct Model {
  Mesh mesh;
  std::vector<std::uint32_t> leaf_of;

  Model() {
    mesh.parts = {{"", "", 0}};
    mesh.materials.resize(1);
    mesh.materials[0].texture = 0;
    mesh.textures.resize(1);
    mesh.texcoords = {{0, 0}};
  }
  std::uint32_t ring(const Double3& centre, double radius, int k) {
    const auto first = static_cast<std::uint32_t>(mesh.positions.size());
    for (int i = 0; i < k; ++i) {
      const double a = 2 * std::numbers::pi * i / k;
      mesh.positions.push_back(centre + Double3{radius * std::cos(a), 0, radius * std::sin(a)});
    }
    return first;
  }
  void triangle(std::uint32_t a, std::uint32_t b, std::uint32_t c, std::uint32_t leaf = k_none) {
    mesh.triangles.push_back({a, b, c});
    mesh.texcoord_triangles.push_back({0, 0, 0});
    mesh.part_of.push_back(0);
    leaf_of.push_back(leaf);
  }
  void band(std::uint32_t a, std::uint32_t b, std::uint32_t k) {
    for (std::uint32_t i = 0; i < k; ++i) {
      const std::uint32_t j = (i + 1) % k;
      triangle(a + i, b + i, a + j), triangle(a + j, b + i, b + j);
    }
  }
  void leaf(double x) {
    const auto v = static_cast<std::uint32_t>(mesh.positions.size());
    for (const Double3& d : {Double3{0, 0, 0}, {1, 0, 0}, {0, 1, 0}})
      mesh.positions.push_back(d + Double3{x, 9, 0});
    triangle(v, v + 1, v + 2, 0);
  }
  StrictModel read() const {
    const std::vector<std::uint32_t> welded = weld(mesh.positions, 1e-9);
    return read_strict_model(mesh, welded, leaf_of);
  }
};

Model sound_model(int k = 5) {
  Model m;
  const auto n = static_cast<std::uint32_t>(k);
  const auto root = m.ring({0, -1, 0}, 1, k), middle = m.ring({0, 2, 0}, 0.9, k),
             top = m.ring({0, 5, 0}, 0.5, k), side = m.ring({3, 3, 0}, 0.4, k);
  m.band(root, middle, n), m.band(middle, top, n), m.band(middle, side, n);
  m.leaf(20);
  return m;
}

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
  EXPECT_EQ(s.breaches[0].count, 20u);
  EXPECT_EQ(s.breaches[0].elements.size(), k_breach_elements);
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

TEST(StrictModel, NamesLeavesThatTouchAndFacesOfFourCorners) {
  Model m = sound_model();
  m.leaf(20);  // in the same place as the first
  EXPECT_EQ(rules(m.read()), std::vector<std::string>{"3.1"});
  Model quad = sound_model();
  for (std::uint32_t t = 0; t < quad.mesh.triangles.size(); ++t) quad.mesh.face_of.push_back(t / 2);
  const StrictModel s = quad.read();
  ASSERT_EQ(rules(s), std::vector<std::string>{"1"});
  EXPECT_EQ(s.breaches[0].count, quad.mesh.triangles.size() / 2);
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
  Model m;
  std::uint32_t last = m.ring({0, -1, 0}, 1, 3);
  for (int i = 0; i < 100000; ++i) {
    const auto next = m.ring({0, double(i), 0}, 1, 3);
    m.band(last, next, 3);
    last = next;
  }
  const StrictModel s = m.read();
  EXPECT_EQ(s.parent.size(), 100001u);
  EXPECT_TRUE(s.breaches.empty());
}

}  // namespace
}  // namespace copse
