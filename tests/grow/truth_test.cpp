// The truth is in the mesh, whatever is broken.
#include "tools/treegrow/truth.h"

#include "tests/grow/mesh_facts.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <gtest/gtest.h>

namespace copse::grow {
namespace {

// Vertices by the cell of a grid that they lie in.
class Grid {
 public:
  Grid(const std::vector<Double3>& points, double cell) : points_(points), cell_(cell) {
    for (std::size_t i = 0; i < points.size(); ++i) cells_[key(points[i])].push_back(i);
  }
  // Distances from `centre` of the different places within `reach`.
  std::vector<double> distances(const Double3& centre, double reach) const {
    std::vector<std::array<double, 3>> places;
    const auto low = key(centre - Double3{reach, reach, reach}),
               high = key(centre + Double3{reach, reach, reach});
    for (auto x = low[0]; x <= high[0]; ++x)
      for (auto y = low[1]; y <= high[1]; ++y)
        for (auto z = low[2]; z <= high[2]; ++z)
          if (const auto cell = cells_.find({x, y, z}); cell != cells_.end())
            for (const std::size_t i : cell->second)
              places.push_back({points_[i].x, points_[i].y, points_[i].z});
    std::sort(places.begin(), places.end());
    places.erase(std::unique(places.begin(), places.end()), places.end());
    std::vector<double> result;
    for (const auto& p : places) result.push_back(distance({p[0], p[1], p[2]}, centre));
    return result;
  }

 private:
  using Key = std::array<std::int64_t, 3>;
  Key key(const Double3& p) const {
    return {std::llround(std::floor(p.x / cell_)), std::llround(std::floor(p.y / cell_)),
            std::llround(std::floor(p.z / cell_))};
  }
  const std::vector<Double3>& points_;
  double cell_;
  std::map<Key, std::vector<std::size_t>> cells_;
};

void expect_links(const Truth& truth) {
  for (std::size_t i = 0; i < truth.rings.size(); ++i) {
    const TruthRing& ring = truth.rings[i];
    ASSERT_LT(ring.branch, truth.branches.size());
    const TruthBranch& branch = truth.branches[ring.branch];
    EXPECT_GE(i, branch.first);
    EXPECT_LT(i, branch.first + branch.rings);
    if (ring.parent != k_none) {
      EXPECT_LT(ring.parent, i);
    }
    if (i > branch.first) {
      EXPECT_EQ(ring.parent, i - 1);
    }
  }
  std::size_t rings = 0;
  for (const TruthBranch& branch : truth.branches) {
    EXPECT_EQ(branch.first, rings);
    rings += branch.rings;
    const TruthRing& first = truth.rings[branch.first];
    EXPECT_EQ(first.parent == k_none, branch.parent == k_none);
    if (branch.parent == k_none) continue;
    for (const std::uint32_t at : branch.attach) EXPECT_EQ(truth.rings[at].branch, branch.parent);
    EXPECT_TRUE(first.parent == branch.attach[0] || first.parent == branch.attach[1]);
    EXPECT_FALSE(truth.branches[branch.parent].terminal);
  }
  EXPECT_EQ(rings, truth.rings.size());
}

// Every ring has its k vertices: on its circle or, where rings are not round, near it.
void expect_rings_in_mesh(const Grown& tree, double off, const std::string& name) {
  double widest = 0;
  for (const TruthRing& ring : tree.truth.rings) widest = std::max(widest, ring.diameter);
  const Grid grid(tree.mesh.positions, std::max(tree.truth.height / 60, widest / 4));
  std::size_t missing = 0;
  for (const TruthRing& ring : tree.truth.rings) {
    const double r = ring.diameter / 2, slack = std::max(off * r, 2e-6 * tree.truth.height);
    const auto near = grid.distances(ring.centre, r + slack);
    const auto on =
        std::count_if(near.begin(), near.end(), [&](double d) { return std::abs(d - r) <= slack; });
    missing += on < static_cast<std::ptrdiff_t>(ring.tip ? 1 : tree.truth.branches[ring.branch].k);
  }
  EXPECT_EQ(missing, 0u) << name;
}

class TruthOf : public testing::TestWithParam<std::string> {};

TEST_P(TruthOf, IsInTheMeshForEveryBreak) {
  std::vector<std::string> lists{"none", "artist"};
  for (const BreakInfo& info : break_table()) lists.emplace_back(info.name);
  for (const std::string& list : lists) {
    if (list == "huge-rings") continue;  // the same code, twelve times the vertices: checked elsewhere
    const Grown tree = small_tree(GetParam(), list, 2500);
    SCOPED_TRACE(GetParam() + " " + list);
    expect_links(tree.truth);
    const Species species = find_species(GetParam()).value();
    const double lobes = species.lobes > 0 ? 2 * species.lobe_depth : 0;
    const bool round = list != "rough" && list != "inset-faces";  // faces are no squares
    expect_rings_in_mesh(tree, std::max(1e-5, lobes) + (round ? 0 : 0.4), list);
    EXPECT_EQ(tree.truth.leaf_centres.size(), tree.truth.leaf_branch.size());
  }
}

INSTANTIATE_TEST_SUITE_P(Species, TruthOf, testing::ValuesIn(species_names()),
                         [](const auto& test) { return test.param; });

TEST(Truth, HoldsForCombinationsAndSeveralSeeds) {
  for (const std::uint64_t seed : {11, 12, 13}) {
    for (const char* list :
         {"artist,rough,end-to-end-turned,z-up,centimetres,shuffled,split-normals",
          "extruded,seams,vary-k,capped-ngon,crossed-cards,several-trees,duplicate-triangles",
          "welded-forks,end-to-end,seams,loose-seams,collapsed-rings,bent-cards,far-offset",
          "laid-against,pointed,vary-k,fronds,root-above-ground,degenerate-triangles,flipped"}) {
      const Grown tree = small_tree("cherry", list, 9000, seed);
      SCOPED_TRACE(list);
      expect_links(tree.truth);
      expect_rings_in_mesh(tree, 0.4, list);
    }
  }
}

TEST(Truth, HeightAndBoundsAreThoseOfTheMesh) {
  const Grown tree = small_tree("pine", "z-up,centimetres");
  const DoubleBox box = bounds(tree.mesh);
  EXPECT_EQ(tree.truth.bounds, box);
  EXPECT_EQ(tree.truth.height, box.extent().z);
}

TEST(Truth, JsonHasTheKeysOfTheFormat) {
  Grown tree = small_tree("palm", "pointed,end-to-end-turned");
  tree.truth.mesh = "a \"quoted\".obj";
  const std::string json = to_json(tree.truth);
  for (const char* key : {"\"name\":\"palm\"", "\"mesh\":\"a \\\"quoted\\\".obj\"", "\"up_axis\":\"y\"",
                          "\"height\":", "\"radii\":[{\"center\":[", "\"parent\":-1",
                          "\"branches\":[{\"id\":0,\"parent\":-1,\"level\":0", "\"attach\":null",
                          "\"same_as\":", "\"tip\":1", "\"leaf_groups\":[", "\"leaves\":{\"count\":"})
    EXPECT_NE(json.find(key), std::string::npos) << key;
  EXPECT_EQ(std::count(json.begin(), json.end(), '{'), std::count(json.begin(), json.end(), '}'));
}

}  // namespace
}  // namespace copse::grow
