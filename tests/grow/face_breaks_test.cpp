// Each way to break faces, names and the scene does what its name says.
#include "tests/grow/mesh_facts.h"

#include <algorithm>
#include <array>
#include <set>

#include <gtest/gtest.h>

namespace copse::grow {
namespace {

using Corners = std::array<std::array<double, 3>, 3>;

// A triangle by the places of its corners, whichever comes first; with `winding` also by its side.
Corners key(const Mesh& mesh, const Triangle& t, bool winding) {
  Corners c;
  for (std::size_t i = 0; i < 3; ++i) {
    const Double3 p = mesh.positions[t[i]];
    c[i] = {p.x, p.y, p.z};
  }
  if (winding) {
    std::rotate(c.begin(), std::min_element(c.begin(), c.end()), c.end());
  } else {
    std::sort(c.begin(), c.end());
  }
  return c;
}

std::multiset<Corners> keys(const Mesh& mesh, bool winding) {
  std::multiset<Corners> all;
  for (const Triangle& t : mesh.triangles) all.insert(key(mesh, t, winding));
  return all;
}

TEST(FaceBreaks, QuadsAreFacesOfTwoTriangles) {
  const Grown tree = small_tree("birch", "quads,quad-cards");
  std::map<std::uint32_t, int> size;
  for (const std::uint32_t face : tree.mesh.face_of) ++size[face];
  const auto quads = static_cast<std::size_t>(
      std::count_if(size.begin(), size.end(), [](const auto& f) { return f.second == 2; }));
  EXPECT_GT(quads * 2, tree.mesh.triangles.size() * 9 / 10);  // joints of the same k are quads too
  const Grown plain = small_tree("birch", "quad-cards");
  EXPECT_EQ(std::set<std::uint32_t>(plain.mesh.face_of.begin(), plain.mesh.face_of.end()).size(),
            plain.mesh.triangles.size());
}

TEST(FaceBreaks, SplitNormalsGiveEachFaceItsOwnVerticesAndOneNormal) {
  const Grown tree = small_tree("birch", "split-normals,quads");
  std::map<std::uint32_t, std::set<std::uint32_t>> of_face;
  for (std::size_t t = 0; t < tree.mesh.triangles.size(); ++t)
    of_face[tree.mesh.face_of[t]].insert(tree.mesh.triangles[t].begin(), tree.mesh.triangles[t].end());
  std::size_t corners = 0;
  for (const auto& [face, vertices] : of_face) {
    corners += vertices.size();
    for (const std::uint32_t v : vertices)
      EXPECT_EQ(tree.mesh.normals[v], tree.mesh.normals[*vertices.begin()]);
  }
  EXPECT_EQ(corners, tree.mesh.positions.size()) << "a vertex belongs to two faces";
  EXPECT_EQ(keys(tree.mesh, true), keys(small_tree("birch", "quads").mesh, true))
      << "the surface is the same";
}

TEST(FaceBreaks, NormalsAndTextureCoordinatesCanBeMissing) {
  const Grown no_normals = small_tree("birch", "no-normals"), no_uvs = small_tree("birch", "no-uvs");
  EXPECT_TRUE(no_normals.mesh.normals.empty() && no_normals.mesh.normal_triangles.empty());
  EXPECT_FALSE(no_normals.mesh.texcoords.empty());
  EXPECT_TRUE(no_uvs.mesh.texcoords.empty() && no_uvs.mesh.texcoord_triangles.empty());
  EXPECT_FALSE(no_uvs.mesh.normals.empty());
}

TEST(FaceBreaks, ShufflingChangesTheOrderAndNothingElse) {
  const Grown plain = small_tree("birch", "artist"), shuffled = small_tree("birch", "artist,shuffled");
  EXPECT_EQ(keys(plain.mesh, true), keys(shuffled.mesh, true));
  EXPECT_NE(plain.mesh.triangles, shuffled.mesh.triangles);
  EXPECT_NE(plain.mesh.positions, shuffled.mesh.positions);
  EXPECT_NE(plain.mesh.part_of, shuffled.mesh.part_of);
}

TEST(FaceBreaks, HalfOfTheFacesAreFlipped) {
  const Grown plain = small_tree("birch", "quads"), flipped = small_tree("birch", "quads,flipped");
  EXPECT_EQ(keys(plain.mesh, false), keys(flipped.mesh, false));
  std::size_t turned = 0;
  const auto right = keys(plain.mesh, true);
  for (const Triangle& t : flipped.mesh.triangles) turned += right.count(key(flipped.mesh, t, true)) == 0;
  EXPECT_NEAR(static_cast<double>(turned) / static_cast<double>(plain.mesh.triangles.size()), 0.5, 0.05);
}

TEST(FaceBreaks, OneTriangleInFiftyIsThereTwice) {
  const Grown tree = small_tree("birch", "duplicate-triangles");
  const auto all = keys(tree.mesh, true);
  const std::set<Corners> once(all.begin(), all.end());
  EXPECT_EQ(all.size() - once.size(), once.size() / 50);
}

TEST(FaceBreaks, OneTriangleInFiftyMoreIsDegenerate) {
  const Grown tree = small_tree("birch", "degenerate-triangles");
  std::size_t flat = 0, equal = 0;
  for (const Triangle& t : tree.mesh.triangles) {
    const auto& p = tree.mesh.positions;
    flat += cross(p[t[1]] - p[t[0]], p[t[2]] - p[t[0]]) == Double3{};
    equal += t[0] == t[1] || t[1] == t[2] || t[2] == t[0];
  }
  const std::size_t clean = tree.mesh.triangles.size() * 50 / 51;
  EXPECT_NEAR(static_cast<double>(flat), static_cast<double>(clean) / 50, 1.5);
  EXPECT_NEAR(static_cast<double>(equal), static_cast<double>(flat) / 2, 1.0);
}

TEST(FaceBreaks, StrayVerticesAreNamedByNoFace) {
  const Grown tree = small_tree("birch", "stray-vertices");
  std::set<std::uint32_t> used;
  for (const Triangle& t : tree.mesh.triangles) used.insert(t.begin(), t.end());
  EXPECT_EQ(tree.mesh.positions.size() - used.size(), used.size() / 50);
}

TEST(NameBreaks, NamesAreMissingNeutralOrOne) {
  const Mesh named = small_tree("birch", "artist").mesh, none = small_tree("birch", "no-names").mesh,
             neutral = small_tree("birch", "neutral-names").mesh,
             one = small_tree("birch", "one-material").mesh, leafy = small_tree("birch", "leafy-name").mesh;
  ASSERT_EQ(named.materials.size(), 2u);
  EXPECT_EQ(named.materials[0].name, "bark_birch");
  EXPECT_EQ(named.materials[1].name, "leaf_birch");
  EXPECT_TRUE(none.materials.empty());
  for (const Part& part : none.parts) EXPECT_EQ(part, Part{});
  ASSERT_EQ(neutral.materials.size(), 2u);
  EXPECT_EQ(neutral.materials[1].name, "Material.002");
  EXPECT_EQ(neutral.parts[0].object, "Object.001");
  ASSERT_EQ(one.materials.size(), 1u);
  for (const std::uint32_t part : one.part_of) EXPECT_EQ(one.parts[part], one.parts[0]);
  ASSERT_EQ(leafy.materials.size(), 2u);
  for (const Part& part : leafy.parts) EXPECT_EQ(part.object, "Leafy_birch");
}

TEST(NameBreaks, OneMaterialKeepsBarkInTheLeftHalfOfItsTexture) {
  const Grown tree = small_tree("birch", "one-material");
  for (std::size_t t = 0; t < tree.mesh.triangles.size(); ++t) {
    const bool leaf = tree.mesh.part_of[t] == 1;
    for (const std::uint32_t c : tree.mesh.texcoord_triangles[t]) {
      const float u = tree.mesh.texcoords[c].x;
      EXPECT_TRUE(leaf ? u >= 0.5f && u <= 1 : u >= 0 && u <= 0.5f) << u;
    }
  }
}

DoubleBox box_of(const char* list) {
  return bounds(small_tree("birch", list).mesh);
}

TEST(SceneBreaks, SeveralTreesHaveARootEach) {
  const Grown trees = small_tree("birch", "several-trees", 20000);
  EXPECT_EQ(pieces(trunk_triangles(trees.mesh)), 3u);
  std::vector<Double3> roots;
  for (const TruthRing& ring : trees.truth.rings)
    if (ring.parent == k_none) roots.push_back(ring.centre);
  ASSERT_EQ(roots.size(), 3u);
  for (int i = 0; i < 3; ++i) EXPECT_GT(distance(roots[i], roots[(i + 1) % 3]), 0.5 * trees.truth.height);
}

TEST(SceneBreaks, ZUpIsARotationThatOrientUndoes) {
  const Grown y_up = small_tree("birch", "none"), z_up = small_tree("birch", "z-up");
  Mesh turned = z_up.mesh;
  orient(turned, UpAxis::z, 1);
  ASSERT_EQ(turned.positions.size(), y_up.mesh.positions.size());
  for (std::size_t i = 0; i < turned.positions.size(); ++i)
    EXPECT_LT(distance(turned.positions[i], y_up.mesh.positions[i]), 2e-6);
  EXPECT_TRUE(z_up.truth.z_up);
  EXPECT_NEAR(z_up.truth.height, y_up.truth.height, 1e-5);
}

TEST(SceneBreaks, CentimetresAreAHundredTimesAsMany) {
  EXPECT_NEAR(box_of("centimetres").extent().y, 100 * box_of("none").extent().y, 1e-3);
}

TEST(SceneBreaks, RootsStandWhereTheyAreSaidTo) {
  EXPECT_LT(box_of("none").min.y, -0.1);
  EXPECT_EQ(box_of("root-at-zero").min.y, 0);
  EXPECT_EQ(box_of("root-at-zero,rough").max.y > 1, true);
  const DoubleBox above = box_of("root-above-ground");
  EXPECT_NEAR(above.min.y / above.extent().y, 0.1, 0.01);
}

TEST(SceneBreaks, FarTreesKeepTheirShape) {
  const Grown near = small_tree("birch", "none"), far = small_tree("birch", "far-offset");
  const Double3 offset{1e7, 0, 2e7};
  for (std::size_t i = 0; i < near.mesh.positions.size(); ++i)
    EXPECT_LT(distance(far.mesh.positions[i] - offset, near.mesh.positions[i]), 1e-5);
  EXPECT_LT(distance(far.truth.rings[5].centre - offset, near.truth.rings[5].centre), 1e-5);
}

}  // namespace
}  // namespace copse::grow
