// Every rule of digest 000, section 1.1, checked on the mesh alone, by the algorithm of its sections 1.2 and
// 1.3 written again here.
#include "tests/grow/mesh_facts.h"

#include <algorithm>
#include <map>
#include <set>

#include <gtest/gtest.h>

namespace copse::grow {
namespace {

using Ring = std::vector<std::uint32_t>;

struct Graph {
  std::vector<std::set<std::uint32_t>> neighbours;
  explicit Graph(const Welded& trunk) : neighbours(trunk.positions.size()) {
    for (const Triangle& t : trunk.triangles)
      for (int a = 0; a < 3; ++a)
        for (int b = 0; b < 3; ++b)
          if (t[a] != t[b]) neighbours[t[a]].insert(t[b]);
  }
  // Connected pieces of the graph among `vertices`.
  std::vector<Ring> pieces(const std::set<std::uint32_t>& vertices) const {
    std::vector<Ring> result;
    std::set<std::uint32_t> left = vertices;
    while (!left.empty()) {
      Ring piece{*left.begin()};
      left.erase(left.begin());
      for (std::size_t i = 0; i < piece.size(); ++i)
        for (const std::uint32_t n : neighbours[piece[i]])
          if (left.erase(n) > 0) piece.push_back(n);
      std::sort(piece.begin(), piece.end());
      result.push_back(piece);
    }
    return result;
  }
};

struct Found {
  Double3 centre;
  double diameter = 0;
  std::size_t parent = 0;
  bool root = false;
};

Found measure(const Welded& trunk, const Ring& ring) {
  Found f;
  for (const std::uint32_t v : ring) f.centre += trunk.positions[v] / static_cast<double>(ring.size());
  for (const std::uint32_t v : ring)
    f.diameter += 2 * distance(trunk.positions[v], f.centre) / static_cast<double>(ring.size());
  return f;
}

// The thesis' recursion with a queue; every breach of a rule is a failure.
std::vector<Found> read_rings(const Welded& trunk, std::size_t k) {
  const Graph graph(trunk);
  std::set<std::uint32_t> below;
  for (std::uint32_t v = 0; v < trunk.positions.size(); ++v)
    if (trunk.positions[v].y < 0) below.insert(v);
  std::vector<Ring> rings;
  std::vector<Found> found;
  std::vector<bool> inserted(trunk.positions.size());
  const auto insert = [&](const Ring& ring, std::size_t parent, bool root) {
    EXPECT_EQ(ring.size(), k) << "a radius does not have k vertices";
    for (const std::uint32_t v : ring) inserted[v] = true;
    rings.push_back(ring);
    found.push_back(measure(trunk, ring));
    found.back().parent = parent;
    found.back().root = root;
  };
  for (const Ring& root : graph.pieces(below)) insert(root, 0, true);
  for (std::size_t r = 0; r < rings.size(); ++r) {
    std::set<std::uint32_t> next;
    for (const std::uint32_t v : rings[r])
      for (const std::uint32_t n : graph.neighbours[v])
        if (!inserted[n]) next.insert(n);
    for (const Ring& child : graph.pieces(next)) {
      std::set<std::uint32_t> joined;  // vertices of the parent with an edge to the child
      for (const std::uint32_t v : child)
        for (const std::uint32_t n : graph.neighbours[v])
          if (std::binary_search(rings[r].begin(), rings[r].end(), n)) joined.insert(n);
      EXPECT_EQ(joined.size(), k) << "a cylinder does not use all of its parent radius";
      insert(child, r, false);
    }
  }
  EXPECT_EQ(std::count(inserted.begin(), inserted.end(), false), 0) << "vertices that no radius owns";
  return found;
}

void expect_same(const std::vector<Found>& found, const Truth& truth) {
  ASSERT_EQ(found.size(), truth.rings.size());
  std::map<std::array<double, 3>, std::size_t> by_centre;
  const auto key = [&](const Double3& c) {  // centres to a millionth of the height
    const double unit = truth.height * 1e-6;
    return std::array<double, 3>{std::round(c.x / unit), std::round(c.y / unit), std::round(c.z / unit)};
  };
  for (std::size_t i = 0; i < found.size(); ++i) by_centre[key(found[i].centre)] = i;
  ASSERT_EQ(by_centre.size(), found.size());
  std::vector<std::size_t> match(truth.rings.size());
  for (std::size_t i = 0; i < truth.rings.size(); ++i) {
    const auto at = by_centre.find(key(truth.rings[i].centre));
    ASSERT_NE(at, by_centre.end()) << "ring " << i << " is not in the mesh";
    match[i] = at->second;
    EXPECT_NEAR(found[match[i]].diameter, truth.rings[i].diameter, 1e-9 * truth.height);
  }
  for (std::size_t i = 0; i < truth.rings.size(); ++i) {
    const std::uint32_t parent = truth.rings[i].parent;
    EXPECT_EQ(found[match[i]].root, parent == k_none);
    if (parent != k_none) {
      EXPECT_EQ(found[match[i]].parent, match[parent]);
    }
  }
}

class StrictModel : public testing::TestWithParam<std::string> {};

TEST_P(StrictModel, TheTrunkIsReadByTheThesisAlgorithmAndIsTheTruth) {
  for (const std::uint64_t seed : {1, 2, 3}) {
    const Order order = small_order(GetParam(), "none", 5000, seed);
    const Grown tree = grow_mesh(order).value();
    const Welded trunk = welded(tree.mesh, trunk_triangles(tree.mesh));
    const std::size_t k = tree.truth.branches[0].k;
    for (const TruthBranch& branch : tree.truth.branches) EXPECT_EQ(branch.k, k);
    EXPECT_EQ(trunk.triangles.size(), trunk_triangles(tree.mesh).size());
    expect_same(read_rings(trunk, k), tree.truth);
  }
}

TEST_P(StrictModel, LeavesAreIsolatedTrianglesWithMaterialAndTexture) {
  const Grown tree = small_tree(GetParam(), "none");
  const auto leaves = leaf_triangles(tree.mesh);
  const Welded all = welded(tree.mesh, tree.mesh.triangles);
  std::vector<int> uses(all.positions.size());
  for (const Triangle& t : all.triangles)
    for (const std::uint32_t v : t) ++uses[v];
  for (std::size_t t = 0; t < all.triangles.size(); ++t) {
    const Part& part = tree.mesh.parts[tree.mesh.part_of[t]];
    EXPECT_NE(part.material, k_none);
    for (const std::uint32_t corner : tree.mesh.texcoord_triangles[t])
      EXPECT_LT(corner, tree.mesh.texcoords.size());
    if (!is_leaf(tree.mesh, t)) continue;
    for (const std::uint32_t v : all.triangles[t]) EXPECT_EQ(uses[v], 1) << "a leaf touches something";
  }
  EXPECT_EQ(leaves.size(), tree.truth.leaf_centres.size());
  EXPECT_EQ(tree.truth.leaf_triangles, leaves.size());
}

TEST_P(StrictModel, OnlyRootRingsLieBelowTheGround) {
  const Grown tree = small_tree(GetParam(), "none");
  std::size_t roots = 0, below = 0;
  for (const TruthRing& ring : tree.truth.rings) roots += ring.parent == k_none;
  const Welded all = welded(tree.mesh, tree.mesh.triangles);
  for (const Double3& p : all.positions) below += p.y < 0;
  EXPECT_EQ(below, roots * tree.truth.branches[0].k);
}

TEST_P(StrictModel, EveryTriangleHasAnArea) {
  const Grown tree = small_tree(GetParam(), "none");
  for (const Triangle& t : tree.mesh.triangles) {
    const auto& p = tree.mesh.positions;
    EXPECT_GT(length(cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]])), 0);
  }
}

INSTANTIATE_TEST_SUITE_P(Species, StrictModel, testing::ValuesIn(species_names()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace copse::grow
