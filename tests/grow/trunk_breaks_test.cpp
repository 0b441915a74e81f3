// Each way to break the trunk does what its name says.
#include "tests/grow/mesh_facts.h"

#include <algorithm>
#include <limits>
#include <set>

#include <gtest/gtest.h>

namespace copse::grow {
namespace {

std::size_t stems(const Grown& tree) {
  return tree.truth.branches.size();
}
std::size_t roots(const Grown& tree) {
  return static_cast<std::size_t>(std::count_if(tree.truth.rings.begin(), tree.truth.rings.end(),
                                                [](const auto& r) { return r.parent == k_none; }));
}
std::size_t trunk_pieces(const Grown& tree) {
  return pieces(trunk_triangles(tree.mesh));
}

// Of a branch's first ring: how far it is from the parent's middle line, and how thick the parent is there.
struct Start {
  double distance = 0, parent_radius = 0, radius = 0;
};
Start start_of(const Truth& truth, const TruthBranch& branch) {
  const TruthRing& a = truth.rings[branch.attach[0]];
  const TruthRing& b = truth.rings[branch.attach[1]];
  const TruthRing& first = truth.rings[branch.first];
  const Double3 ab = b.centre - a.centre;
  const double t = std::clamp(dot(first.centre - a.centre, ab) / std::max(dot(ab, ab), 1e-300), 0.0, 1.0);
  return {distance(first.centre, a.centre + ab * t), (a.diameter * (1 - t) + b.diameter * t) / 2,
          first.diameter / 2};
}

// Nearest vertices of the mesh to a ring's circle: how far each of k is from it, at most.
std::vector<double> off_circle(const Mesh& mesh, const TruthRing& ring) {
  std::vector<double> off;
  for (const Double3& p : mesh.positions)
    off.push_back(std::abs(distance(p, ring.centre) - ring.diameter / 2));
  std::sort(off.begin(), off.end());
  return off;
}

TEST(TrunkBreaks, StrictTrunksAreOnePieceATree) {
  EXPECT_EQ(trunk_pieces(small_tree("oak", "none")), 1u);
  const Grown bush = small_tree("bush", "none");
  EXPECT_EQ(trunk_pieces(bush), roots(bush));
}

TEST(TrunkBreaks, FreeTubesAreAPieceEachAndStartOnTheParentsMiddleLine) {
  for (const char* species : {"oak", "spruce", "bush"}) {
    const Grown tree = small_tree(species, "free-tubes");
    EXPECT_EQ(trunk_pieces(tree), stems(tree));
    for (const TruthBranch& b : tree.truth.branches)
      if (b.parent != k_none) {
        EXPECT_LT(start_of(tree.truth, b).distance, 1e-6 * tree.truth.height);
      }
  }
}

TEST(TrunkBreaks, LaidAgainstTubesAreAPieceEachAndStartAtTheParentsSurface) {
  for (const char* species : {"birch", "spruce"}) {
    const Grown tree = small_tree(species, "laid-against");
    EXPECT_EQ(trunk_pieces(tree), stems(tree));
    for (const TruthBranch& b : tree.truth.branches) {
      if (b.parent == k_none) continue;
      const Start start = start_of(tree.truth, b);
      EXPECT_GE(start.distance, 0.93 * start.parent_radius);  // at a bend, the next segment may be nearer
      EXPECT_LE(start.distance, 1.01 * start.parent_radius + 1.01 * start.radius);
    }
  }
}

// A surface that is one piece, whose only open edges are its roots and tips, and no edge of which joins more
// than two triangles.
void expect_one_surface(const Grown& tree, const char* name) {
  const auto triangles = trunk_triangles(tree.mesh);
  EXPECT_EQ(pieces(triangles), roots(tree)) << name;
  std::size_t open = 0, wanted = 0;
  for (const auto& [edge, uses] : edges(triangles)) {
    EXPECT_LE(uses, 2) << name;
    open += uses == 1;
  }
  for (const TruthBranch& b : tree.truth.branches) wanted += b.k * (b.parent == k_none ? 2 : 1);
  EXPECT_EQ(open, wanted) << name;
}

TEST(TrunkBreaks, WeldedForksAreOneSurfaceWithVerticesThatNoRingOwns) {
  for (const char* list : {"welded-forks", "welded-forks,vary-k"}) {
    const Grown tree = small_tree("oak", list, 20000);
    expect_one_surface(tree, list);
    std::size_t in_rings = 0;
    for (const TruthBranch& b : tree.truth.branches) in_rings += b.rings * b.k;
    const auto triangles = trunk_triangles(tree.mesh);
    std::set<std::uint32_t> used;
    for (const Triangle& t : triangles) used.insert(t.begin(), t.end());
    std::size_t saddles = 0;
    for (const TruthBranch& b : tree.truth.branches) saddles += b.parent == k_none ? 0 : b.k / 2 - 1;
    EXPECT_EQ(used.size(), in_rings + saddles);
  }
}

TEST(TrunkBreaks, ExtrudedBranchesAreCutIntoTwoRingsOfOneSurface) {
  for (const char* list : {"extruded", "extruded,vary-k", "extruded-faces", "inset-faces,vary-k"}) {
    const Grown tree = small_tree("oak", list, 25000);
    expect_one_surface(tree, list);
    for (const TruthBranch& b : tree.truth.branches)
      if (b.parent != k_none) {
        EXPECT_EQ(b.attach[1], b.attach[0] + 1);
        EXPECT_EQ(tree.truth.rings[b.first].parent, b.attach[0]);
      }
  }
}

TEST(TrunkBreaks, OpenEndsAreOpenAndCapsCloseThem) {
  const Grown open = small_tree("birch", "free-tubes,open-ends");
  std::size_t wanted = 0;
  for (const TruthBranch& b : open.truth.branches) wanted += 2 * b.k;
  EXPECT_EQ(open_edges(trunk_triangles(open.mesh)), wanted);
  for (const char* list :
       {"free-tubes,capped-fan", "free-tubes,capped-ngon", "capped-fan", "extruded,capped-fan"})
    EXPECT_EQ(open_edges(trunk_triangles(small_tree("birch", list).mesh)), 0u) << list;
}

TEST(TrunkBreaks, CapsOfOnePolygonAreOneFace) {
  const Grown tree = small_tree("birch", "free-tubes,capped-ngon", 0);
  std::map<std::uint32_t, std::size_t> size;
  for (const std::uint32_t face : tree.mesh.face_of) ++size[face];
  const std::size_t k = tree.truth.branches[0].k;
  ASSERT_GT(k, 4u);
  EXPECT_EQ(std::count_if(size.begin(), size.end(), [&](const auto& f) { return f.second == k - 2; }),
            static_cast<std::ptrdiff_t>(2 * stems(tree)));
}

TEST(TrunkBreaks, PointedAndCollapsedTipsAreInTheTruthAsPoints) {
  for (const char* list : {"pointed", "collapsed-rings", "free-tubes,seams,collapsed-rings"}) {
    const Grown tree = small_tree("willow", list);
    std::size_t tips = 0;
    const Welded all = welded(tree.mesh, tree.mesh.triangles);
    for (std::size_t i = 0; i < tree.truth.rings.size(); ++i) {
      const TruthRing& ring = tree.truth.rings[i];
      if (!ring.tip) continue;
      ++tips;
      EXPECT_EQ(ring.diameter, 0);
      EXPECT_EQ(ring.parent, i - 1);
      EXPECT_TRUE(std::find(all.positions.begin(), all.positions.end(), ring.centre) != all.positions.end());
    }
    EXPECT_EQ(tips, stems(tree)) << list;
  }
}

TEST(TrunkBreaks, CollapsedTipsHaveAllTheirVertices) {
  const Grown tree = small_tree("willow", "collapsed-rings");
  const TruthBranch& first = tree.truth.branches[0];
  const Double3 tip = tree.truth.rings[first.first + first.rings - 1].centre;
  EXPECT_EQ(std::count(tree.mesh.positions.begin(), tree.mesh.positions.end(), tip),
            static_cast<std::ptrdiff_t>(first.k));
}

TEST(TrunkBreaks, SeamsDoubleOneVertexOfEachRing) {
  const Grown tree = small_tree("birch", "seams");
  std::set<std::uint32_t> used;
  for (const Triangle& t : trunk_triangles(tree.mesh)) used.insert(t.begin(), t.end());
  const std::size_t rings = tree.truth.rings.size(), k = tree.truth.branches[0].k;
  EXPECT_EQ(used.size(), rings * (k + 1));
  EXPECT_EQ(welded(tree.mesh, trunk_triangles(tree.mesh)).positions.size(), rings * k);
}

TEST(TrunkBreaks, LooseSeamsAreApartButNotFar) {
  const Grown tree = small_tree("birch", "seams,loose-seams");
  const Welded trunk = welded(tree.mesh, trunk_triangles(tree.mesh));
  const std::size_t rings = tree.truth.rings.size(), k = tree.truth.branches[0].k;
  EXPECT_GT(trunk.positions.size(), rings * k + rings * 9 / 10);  // a few fall back by rounding
  // Every twin has its original within a millionth of the height and a step of rounding.
  std::vector<Double3> p = trunk.positions;
  std::sort(p.begin(), p.end(), [](const Double3& a, const Double3& b) { return a.x < b.x; });
  std::size_t near = 0;
  const double reach = 1.2e-6 * tree.truth.height;
  for (std::size_t i = 0; i < p.size(); ++i)
    for (std::size_t j = i + 1; j < p.size() && p[j].x - p[i].x < reach; ++j)
      near += distance(p[i], p[j]) < reach;
  EXPECT_GE(near, trunk.positions.size() - rings * k);
}

TEST(TrunkBreaks, KVariesOnlyWhenAskedTo) {
  const auto sizes = [](const char* list) {
    std::map<std::uint32_t, std::set<std::uint32_t>> by_level;
    for (const TruthBranch& b : small_tree("oak", list, 20000).truth.branches) by_level[b.level].insert(b.k);
    return by_level;
  };
  auto strict = sizes("none"), varied = sizes("vary-k"), huge = sizes("vary-k,huge-rings");
  std::set<std::uint32_t> all;
  for (std::uint32_t level = 0; level < 4; ++level) {
    all.insert(strict[level].begin(), strict[level].end());
    EXPECT_EQ(varied[level].size(), 1u);
    if (level > 0) {
      EXPECT_LT(*varied[level].begin(), *varied[level - 1].begin());
    }
  }
  EXPECT_EQ(all.size(), 1u);
  EXPECT_GE(*huge[0].begin(), 96u);
  EXPECT_LT(*huge[1].begin(), 20u);
}

TEST(TrunkBreaks, RoughRingsAreNeitherRoundNorFlat) {
  const Grown smooth = small_tree("birch", "none"), rough = small_tree("birch", "rough");
  const auto worst = [](const Grown& tree) {
    const std::size_t k = tree.truth.branches[0].k;
    double sum = 0;
    std::size_t rings = 0;
    for (std::size_t r = 2; r < tree.truth.rings.size(); r += 20, ++rings)
      sum += off_circle(tree.mesh, tree.truth.rings[r])[k - 1] / tree.truth.rings[r].diameter;
    return sum / static_cast<double>(rings);
  };
  EXPECT_LT(worst(smooth), 1e-3);
  EXPECT_GT(worst(rough), 1e-2);
}

TEST(TrunkBreaks, TubesEndToEndAreSeveralPiecesThatTouch) {
  const Grown tree = small_tree("oak", "end-to-end");
  const auto triangles = trunk_triangles(tree.mesh);
  EXPECT_GT(pieces(triangles), 2u);
  EXPECT_EQ(pieces(welded(tree.mesh, triangles).triangles), 1u);
}

TEST(TrunkBreaks, TurnedTubesEndToEndTouchNowhereAndTheirRingsCoincide) {
  const Grown tree = small_tree("oak", "end-to-end-turned");
  const auto triangles = trunk_triangles(tree.mesh);
  const std::size_t parts = pieces(triangles);
  EXPECT_GT(parts, 2u);
  EXPECT_EQ(pieces(welded(tree.mesh, triangles).triangles), parts);
  std::size_t same = 0;
  for (const TruthRing& ring : tree.truth.rings) {
    if (ring.same_as == k_none) continue;
    ++same;
    EXPECT_EQ(ring.parent, ring.same_as);
    EXPECT_LT(distance(ring.centre, tree.truth.rings[ring.same_as].centre), 1e-6 * tree.truth.height);
    EXPECT_NEAR(ring.diameter, tree.truth.rings[ring.same_as].diameter, 1e-6 * tree.truth.height);
  }
  EXPECT_EQ(same + 1, parts);
}

}  // namespace
}  // namespace copse::grow
