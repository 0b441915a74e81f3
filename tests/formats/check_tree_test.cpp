// Each invariant is broken in a sound tree, and check_tree must name the section that was broken.
#include "lib/formats/tree/check_tree.h"

#include "lib/formats/tree_file/tree_file.h"
#include "tests/formats/tree_maker.h"

#include <functional>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace copse {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::SizeIs;

constexpr float k_nan = std::numeric_limits<float>::quiet_NaN();

Tree sensitive_tree() {
  return make_tree({.roots = 2, .radii = 20, .leaves = 12, .groups = 4, .segment = 3, .joints = 5}, 1);
}
Tree still_tree() {
  return make_tree(
      {.kind = TreeKind::still, .roots = 2, .radii = 20, .leaves = 12, .groups = 4, .segment = 3}, 2);
}

// Changes one element of a shared, read-only array.
template <class T, class Change>
void change(Array<T>& array, std::size_t i, Change&& how) {
  std::vector<T> copy = array.to_vector();
  how(copy.at(i));
  array = std::move(copy);
}

struct Breach {
  const char* name;
  const char* message;  // part of what check_tree says
  std::function<void(Tree&)> make;
};

std::size_t first_terminal(const Tree& tree) {
  std::size_t i = 0;
  while (!(tree.hierarchy.radii[i].flags & Radius::terminal)) ++i;
  return i;
}

const Breach k_sensitive[] = {
    {"OriginNan", "HEAD: the origin is not finite", [](Tree& t) { t.header.origin.x = k_nan; }},
    {"BoundsNan", "HEAD: neither a finite box", [](Tree& t) { t.header.bounds.min.y = k_nan; }},
    {"BoundsHalfEmpty", "HEAD: neither a finite box",
     [](Tree& t) { std::swap(t.header.trunk_bounds.min, t.header.trunk_bounds.max); }},
    {"TrunkBoxOutside", "HEAD: the trunk's box is not inside",
     [](Tree& t) { t.header.bounds.max.x = t.header.trunk_bounds.min.x; }},
    {"TrunkBoxTooSmall", "RVEC[",
     [](Tree& t) { t.header.trunk_bounds.max.x = std::nextafter(t.header.trunk_bounds.max.x, -100.f); }},
    {"BoxTooSmallForLeaves", "LVTX[",
     [](Tree& t) {
       t.header.bounds.max.x = t.header.trunk_bounds.max.x = -1;
       t.header.trunk_bounds = t.header.bounds;
     }},
    {"DensityNan", "HEAD: the area-density centre is not finite",
     [](Tree& t) { t.header.area_density_centre.z = k_nan; }},
    {"DensityWrong", "HEAD: the area-density centre is wrong",
     [](Tree& t) { t.header.area_density_centre.z += 0.01f; }},
    {"TrunkAreaNegative", "HEAD: not a finite number of 0 or more",
     [](Tree& t) { t.header.mean_trunk_area = -1; }},
    {"TrunkAreaZero", "HEAD: the mean area of the trunk's triangles is wrong",
     [](Tree& t) { t.header.mean_trunk_area = 0; }},
    {"TrunkAreaWrong", "HEAD: the mean area of the trunk's triangles is wrong",
     [](Tree& t) { t.header.mean_trunk_area *= 1.001f; }},
    {"LeafAreaWrong", "HEAD: the mean leaf area is wrong", [](Tree& t) { t.header.mean_leaf_area *= 2; }},
    {"LeafAreaInfinite", "HEAD: not a finite number",
     [](Tree& t) { t.header.mean_leaf_area = std::numeric_limits<float>::infinity(); }},
    {"TooManyUnexplained", "HEAD: more unexplained", [](Tree& t) { t.header.unexplained = 1000; }},
    {"TrunkMaterial", "HEAD: material index out of range", [](Tree& t) { t.trunk.material = 3; }},
    {"LeafMaterial", "HEAD: material index out of range", [](Tree& t) { t.leaves.material = 3; }},
    {"MaterialNan", "MATL[1]: not a finite number", [](Tree& t) { t.materials[1].shininess = k_nan; }},
    {"MaterialCoverage", "MATL[2]: alpha coverage above 1",
     [](Tree& t) { t.materials[2].alpha_coverage = 1.5f; }},
    {"MaterialTexture", "MATL[0]: texture index out of range", [](Tree& t) { t.materials[0].texture = 2; }},
    {"RootsTooMany", "HEAD: roots out of range", [](Tree& t) { t.header.roots = 21; }},
    {"RootsNone", "HEAD: roots out of range", [](Tree& t) { t.header.roots = 0; }},
    {"RootsWrong", "RADI[1]: children out of breadth-first order", [](Tree& t) { t.header.roots = 1; }},
    {"RadiusNan", "RADI[3]: not finite",
     [](Tree& t) { change(t.hierarchy.radii, 3, [](Radius& r) { r.centre.y = k_nan; }); }},
    {"RadiusNegative", "RADI[3]: not finite or negative",
     [](Tree& t) { change(t.hierarchy.radii, 3, [](Radius& r) { r.diameter = -1; }); }},
    {"RadiusFlags", "RADI[0]: unknown flags",
     [](Tree& t) { change(t.hierarchy.radii, 0, [](Radius& r) { r.flags |= 4; }); }},
    {"RadiusNoChildren", "RADI[0]: neither children nor terminal",
     [](Tree& t) { change(t.hierarchy.radii, 0, [](Radius& r) { r.flags = 0, r.child_count = 0; }); }},
    {"RadiusCycle", "RADI[0]: children out of breadth-first order",
     [](Tree& t) {
       change(t.hierarchy.radii, 0, [](Radius& r) { r.flags = 0, r.first_child = 0, r.child_count = 1; });
     }},
    {"RadiusTooManyChildren", "RADI[1]: children out of range",
     [](Tree& t) { change(t.hierarchy.radii, 1, [](Radius& r) { r.child_count = 0xfffffff0u; }); }},
    {"TerminalSeveralGroups", "a terminal radius with several groups",
     [](Tree& t) { change(t.hierarchy.radii, first_terminal(t), [](Radius& r) { r.child_count = 2; }); }},
    {"TerminalNamesGroup", "a terminal radius names a group",
     [](Tree& t) {
       change(t.hierarchy.radii, first_terminal(t), [](Radius& r) { r.child_count = 0, r.first_child = 0; });
     }},
    {"TerminalGroupOutOfRange", "leaf group out of range: 4 of 4",
     [](Tree& t) {
       change(t.hierarchy.radii, first_terminal(t), [](Radius& r) { r.child_count = 1, r.first_child = 4; });
     }},
    {"DistanceWrong", "RADI[5]: the distance",
     [](Tree& t) { change(t.hierarchy.radii, 5, [](Radius& r) { r.distance += 0.01f; }); }},
    {"RootDistance", "RADI[0]: the distance",
     [](Tree& t) { change(t.hierarchy.radii, 0, [](Radius& r) { r.distance = 1e-6f; }); }},
    {"Monotone", "HEAD: the flag monotone is wrong", [](Tree& t) { t.header.monotone = !t.header.monotone; }},
    {"OuterRadius", "RADI[7]: a vertex is farther away",
     [](Tree& t) { change(t.hierarchy.radii, 7, [](Radius& r) { r.outer_radius *= 0.999f; }); }},
    {"VectorNan", "RVEC[9]: not finite",
     [](Tree& t) { change(t.hierarchy.vectors, 9, [](Float3& v) { v.x = k_nan; }); }},
    {"RingOffsets", "RFIR[2]: out of order",
     [](Tree& t) { change(t.hierarchy.first_vector, 1, [](auto& v) { v = 1000000; }); }},
    {"TrunkVertexIndex", "TTRI[4]: vertex index out of range",
     [](Tree& t) {
       change(t.trunk.triangles, 4,
              [&](auto& c) { c.vertex[2] = static_cast<std::uint32_t>(t.hierarchy.vectors.size()); });
     }},
    {"TrunkVertexNone", "TTRI[4]: vertex index out of range",
     [](Tree& t) { change(t.trunk.triangles, 4, [](auto& c) { c.vertex[0] = k_none; }); }},
    {"TrunkNormalIndex", "TTRI[5]: normal index out of range: 9 of 9",
     [](Tree& t) { change(t.trunk.triangles, 5, [](auto& c) { c.normal[1] = 9; }); }},
    {"TrunkTexcoordIndex", "TTRI[6]: texture coordinate index out of range",
     [](Tree& t) { change(t.trunk.triangles, 6, [](auto& c) { c.texcoord[0] = k_none - 1; }); }},
    {"LineIndex", "TLIN[1]: index out of range",
     [](Tree& t) { change(t.trunk.lines, 1, [](auto& l) { l[1] = 20; }); }},
    {"LineNotParent", "TLIN[1]: a line that does not join",
     [](Tree& t) { change(t.trunk.lines, 1, [](auto& l) { std::swap(l[0], l[1]); }); }},
    {"LineTwice", "TLIN[2]: a second line",
     [](Tree& t) {
       const auto l = t.trunk.lines[1];
       change(t.trunk.lines, 2, [&](auto& m) { m = l; });
     }},
    {"LineMissing", "TLIN: a radius without its line",
     [](Tree& t) {
       const auto l = t.trunk.lines[1];
       change(t.trunk.lines, 2, [&](auto& m) { m = l; });
     }},
    {"LineToJoint", "a line that ends at a joint",
     [](Tree& t) {
       change(t.hierarchy.radii, t.trunk.lines[0][1], [](Radius& r) { r.flags |= Radius::joint; });
     }},
    {"DiameterNan", "TDIA[0]: not finite",
     [](Tree& t) { change(t.trunk.diameters, 0, [](float& d) { d = k_nan; }); }},
    {"DiameterOrder", "TDIA[1]: out of order",
     [](Tree& t) { change(t.trunk.diameters, 0, [](float& d) { d = 50; }); }},
    {"DiameterWrong", "TDIA[0]: not the larger diameter",
     [](Tree& t) { change(t.trunk.diameters, 0, [](float& d) { d *= 0.5f; }); }},
    {"DiameterNegative", "TDIA[0]: negative",
     [](Tree& t) { change(t.trunk.diameters, 0, [](float& d) { d = -1; }); }},
    {"LengthNan", "TACC[3]: not finite",
     [](Tree& t) { change(t.trunk.accumulated_lengths, 3, [](double& d) { d = k_nan; }); }},
    {"LengthOrder", "TACC[3]: out of order",
     [](Tree& t) { change(t.trunk.accumulated_lengths, 2, [](double& d) { d += 100; }); }},
    {"LengthWrong", "TACC[2]: does not grow by",
     [](Tree& t) { change(t.trunk.accumulated_lengths, 2, [](double& d) { d += 1e-4; }); }},
    {"TrunkMaterialIndex", "TMAT[2]: index out of range",
     [](Tree& t) { change(t.trunk.materials, 2, [](auto& m) { m = 3; }); }},
    {"TrunkNormal", "TNRM[1]: not finite",
     [](Tree& t) { change(t.trunk.normals, 1, [](auto& n) { n.z = k_nan; }); }},
    {"TrunkTexcoord", "TTEX[1]: not finite",
     [](Tree& t) { change(t.trunk.texcoords, 1, [](auto& n) { n.y = k_nan; }); }},
    {"LeafVertexIndex", "LTRI[0]: vertex index out of range",
     [](Tree& t) { change(t.leaves.triangles, 0, [](auto& c) { c.vertex[2] = 1000; }); }},
    {"LeafNormalIndex", "LTRI[0]: normal index out of range",
     [](Tree& t) { change(t.leaves.triangles, 0, [](auto& c) { c.normal[2] = 9; }); }},
    {"LeafOffsets", "LFIR[2]: out of order",
     [](Tree& t) { change(t.leaves.first_triangle, 1, [](auto& v) { v = 1000000; }); }},
    {"LeafCentreNan", "LCEN[3]: not finite",
     [](Tree& t) { change(t.leaves.centres, 3, [](auto& c) { c.x = k_nan; }); }},
    {"LeafCentreOutside", "LCEN[3]: the centre is outside",
     [](Tree& t) { change(t.leaves.centres, 3, [](auto& c) { c.x += 1; }); }},
    {"LeafMaterialIndex", "LMAT[2]: index out of range",
     [](Tree& t) { change(t.leaves.materials, 2, [](auto& m) { m = 3; }); }},
    {"LeafVertexNan", "LVTX[8]: not finite",
     [](Tree& t) { change(t.leaves.vertices, 8, [](auto& v) { v.y = k_nan; }); }},
    {"LeafNormal", "LNRM[1]: not finite",
     [](Tree& t) { change(t.leaves.normals, 1, [](auto& n) { n.z = k_nan; }); }},
    {"LeafTexcoord", "LTEX[1]: not finite",
     [](Tree& t) { change(t.leaves.texcoords, 1, [](auto& n) { n.y = k_nan; }); }},
    {"GroupFirst", "LGRP[1]: does not begin where",
     [](Tree& t) { change(t.leaves.groups, 1, [](auto& g) { ++g.first; }); }},
    {"GroupEmpty", "LGRP[1]: a group without leaves",
     [](Tree& t) { change(t.leaves.groups, 1, [](auto& g) { g.count = 0; }); }},
    {"GroupTooLarge", "LGRP: the groups do not hold every leaf once",
     [](Tree& t) { change(t.leaves.groups, 3, [](auto& g) { g.count = 0xffffffffu; }); }},
    {"GroupSphereNan", "LGRP[0]: the sphere is not finite",
     [](Tree& t) { change(t.leaves.groups, 0, [](auto& g) { g.radius = k_nan; }); }},
    {"GroupSphereTooSmall", "LGRP[2]: a leaf sticks out",
     [](Tree& t) { change(t.leaves.groups, 2, [](auto& g) { g.radius = std::nextafter(g.radius, 0.f); }); }},
    {"GroupAreaNegative", "LGRP[2]: the mean area is not finite",
     [](Tree& t) { change(t.leaves.groups, 2, [](auto& g) { g.mean_area = -1; }); }},
    {"GroupAreaWrong", "LGRP[2]: the mean area is wrong",
     [](Tree& t) { change(t.leaves.groups, 2, [](auto& g) { g.mean_area *= 1.01f; }); }},
    {"OrderOutOfRange", "LORD[5]: index out of range",
     [](Tree& t) { change(t.leaves.order, 5, [](auto& l) { l = 12; }); }},
    {"OrderTwice", "LORD[1]: a leaf that is there twice",
     [](Tree& t) {
       const auto l = t.leaves.order[0];
       change(t.leaves.order, 1, [&](auto& m) { m = l; });
     }},
    {"OrderWrong", "a leaf nearer to its group's centre",
     [](Tree& t) {
       auto o = t.leaves.order.to_vector();
       std::swap(o[0], o[2]);
       t.leaves.order = std::move(o);
     }},
    {"NodeNan", "LGHI[0]: the sphere is not finite",
     [](Tree& t) { change(t.leaves.group_hierarchy, 0, [](auto& n) { n.centre.x = k_nan; }); }},
    {"NodeTooSmall", "LGHI[0]: a node's sphere sticks out",
     [](Tree& t) { change(t.leaves.group_hierarchy, 0, [](auto& n) { n.radius *= 0.99f; }); }},
    {"BottomTooSmall", "LGHI[2]: a leaf group's sphere sticks out",
     [](Tree& t) { change(t.leaves.group_hierarchy, 2, [](auto& n) { n.radius *= 0.99f; }); }},
    {"NodeSkipBack", "LGHI[1]: skips to where it cannot",
     [](Tree& t) { change(t.leaves.group_hierarchy, 1, [](auto& n) { n.skip = 1; }); }},
    {"NodeSkipTooFar", "LGHI[1]: skips to where it cannot",
     [](Tree& t) { change(t.leaves.group_hierarchy, 1, [](auto& n) { n.skip = 8; }); }},
    {"NodeSecondRoot", "a second root",
     [](Tree& t) { change(t.leaves.group_hierarchy, 0, [](auto& n) { n.skip = 4; }); }},
    {"NodeGroupOutOfRange", "LGHI[2]: leaf group out of range",
     [](Tree& t) { change(t.leaves.group_hierarchy, 2, [](auto& n) { n.group = 4; }); }},
    {"NodeGroupTwice", "LGHI[3]: a leaf group that is there twice",
     [](Tree& t) { change(t.leaves.group_hierarchy, 3, [](auto& n) { n.group = 0; }); }},
    {"SegmentFactor", "TFIR: the constant does not fit", [](Tree& t) { t.header.segment_factor = 4; }},
    {"LinesShort", "TLIN: not parallel",
     [](Tree& t) {
       auto l = t.trunk.lines.to_vector();
       l.pop_back();
       t.trunk.lines = std::move(l);
     }},
    {"OrderShort", "LORD: not parallel",
     [](Tree& t) {
       auto o = t.leaves.order.to_vector();
       o.pop_back();
       t.leaves.order = std::move(o);
     }},
    {"OffsetsShort", "RFIR: not parallel",
     [](Tree& t) {
       auto o = t.hierarchy.first_vector.to_vector();
       o.pop_back();
       t.hierarchy.first_vector = std::move(o);
     }},
    {"OffsetsSpan", "LFIR: offsets do not span",
     [](Tree& t) { change(t.leaves.first_triangle, 0, [](auto& v) { v = 1; }); }},
    {"StoredVertices", "TVTX: an .stree carries no trunk vertices",
     [](Tree& t) { t.trunk.vertices = std::vector<Float3>(1); }},
    {"Kind", "HEAD: unknown kind",
     [](Tree& t) {
       t.header.kind = static_cast<TreeKind>(7);
       t.hierarchy = {};
     }},
};

const Breach k_still[] = {
    {"Hierarchy", "RADI: a .tree carries no hierarchy",
     [](Tree& t) { t.hierarchy.radii = std::vector<Radius>(1); }},
    {"VertexOutside", "TVTX[3]: a vertex is outside a box",
     [](Tree& t) { change(t.trunk.vertices, 3, [](auto& v) { v.x += 100; }); }},
    {"VertexNan", "TVTX[3]: not finite",
     [](Tree& t) { change(t.trunk.vertices, 3, [](auto& v) { v.x = k_nan; }); }},
    {"LineVertexNan", "TLVX[3]: not finite",
     [](Tree& t) { change(t.trunk.line_vertices, 3, [](auto& v) { v.x = k_nan; }); }},
    {"LineIndex", "TLIN[3]: index out of range",
     [](Tree& t) { change(t.trunk.lines, 3, [](auto& l) { l[0] = 20; }); }},
    {"LengthWrong", "TACC[2]: does not grow by",
     [](Tree& t) { change(t.trunk.accumulated_lengths, 2, [](double& d) { d += 1e-4; }); }},
};

class CheckTree : public testing::TestWithParam<Breach> {};
class CheckStillTree : public testing::TestWithParam<Breach> {};

void expect_refused(Tree tree, const Breach& breach) {
  ASSERT_THAT(check_tree(tree), IsEmpty());
  breach.make(tree);
  EXPECT_THAT(check_tree(tree), Contains(HasSubstr(breach.message)));
  // What the writer lets through (it checks sizes only), the reader refuses.
  const auto bytes = encode_tree(tree);
  if (!bytes) {
    EXPECT_EQ(bytes.error().fault, Fault::bug);
    return;
  }
  const auto file = TreeFile::from_bytes(*bytes, "broken");
  EXPECT_FALSE(file && file->load());
  if (!file) return;
  EXPECT_THAT(file->verify(), Contains(HasSubstr(breach.message)));
}

TEST_P(CheckTree, NamesWhatIsBroken) {
  expect_refused(sensitive_tree(), GetParam());
}
TEST_P(CheckStillTree, NamesWhatIsBroken) {
  expect_refused(still_tree(), GetParam());
}
std::string breach_name(const testing::TestParamInfo<Breach>& info) {
  return info.param.name;
}
void PrintTo(const Breach& breach, std::ostream* out) {  // NOLINT: GoogleTest's name
  *out << breach.name;
}
INSTANTIATE_TEST_SUITE_P(Breach, CheckTree, testing::ValuesIn(k_sensitive), breach_name);
INSTANTIATE_TEST_SUITE_P(Breach, CheckStillTree, testing::ValuesIn(k_still), breach_name);

TEST(CheckTreeOf, ListsEightFailuresOfAKindAndCountsTheRest) {
  Tree tree = sensitive_tree();
  auto triangles = tree.trunk.triangles.to_vector();
  for (auto& t : triangles) t.vertex = {k_none, k_none, k_none};
  tree.trunk.triangles = triangles;
  const auto lines = check_tree(tree);
  EXPECT_THAT(lines, SizeIs(Findings::k_listed + 1));
  EXPECT_THAT(lines, Contains("TTRI: vertex index out of range: " + std::to_string(3 * triangles.size()) +
                              " in all"));
}

TEST(CheckTreeOf, AnEmptyTreeIsSound) {
  Tree tree;
  EXPECT_THAT(check_tree(tree), IsEmpty());
  tree.header.kind = TreeKind::sensitive;
  EXPECT_THAT(check_tree(tree), IsEmpty());
}

TEST(CheckTreeOf, ATreeWhoseAreasFloatCannotHoldIsSound) {
  for (const float scale : {1e-30f, 1e30f}) {
    Tree tree = make_tree({.kind = TreeKind::still, .radii = 12, .leaves = 5, .groups = 2, .segment = 2}, 3);
    const auto scaled = [&](const Array<Float3>& points) {
      auto copy = points.to_vector();
      for (Float3& p : copy) p *= scale;
      return copy;
    };
    tree.trunk.vertices = scaled(tree.trunk.vertices);
    tree.leaves.vertices = scaled(tree.leaves.vertices);
    tree.leaves.centres = scaled(tree.leaves.centres);
    tree.trunk.line_vertices = scaled(tree.trunk.line_vertices);
    tree.leaves.groups = {}, tree.leaves.order = {}, tree.leaves.group_hierarchy = {};
    auto sums = tree.trunk.accumulated_lengths.to_vector();
    for (double& s : sums) s *= scale;
    tree.trunk.accumulated_lengths = sums;
    for (Float3* p : {&tree.header.bounds.min, &tree.header.bounds.max, &tree.header.trunk_bounds.min,
                      &tree.header.trunk_bounds.max, &tree.header.area_density_centre})
      *p *= scale;
    const float limit = scale < 1 ? 0 : std::numeric_limits<float>::max();
    tree.header.mean_trunk_area = tree.header.mean_leaf_area = limit;
    EXPECT_THAT(check_tree(tree), IsEmpty()) << scale;
    tree.header.mean_trunk_area = 1;
    EXPECT_THAT(check_tree(tree), SizeIs(1)) << scale;
  }
}

// A chain of radii as deep as it is long: nothing may recurse, nothing may be quadratic.
TEST(CheckTreeOf, AHundredThousandSegmentsInARow) {
  Tree tree;
  tree.header.kind = TreeKind::sensitive;
  tree.header.roots = 1;
  tree.header.monotone = true;
  const std::uint32_t n = 100001;
  std::vector<Radius> radii(
      n, Radius{.centre = {0, 0.25f, 0}, .diameter = 1, .distance = 0.25f, .child_count = 1});
  for (std::uint32_t i = 0; i < n; ++i) radii[i].first_child = i + 1;
  radii[0].distance = 0;
  radii[n - 1].child_count = 0, radii[n - 1].first_child = k_none, radii[n - 1].flags = Radius::terminal;
  tree.hierarchy.radii = radii;
  std::vector<std::array<std::uint32_t, 2>> lines(n - 1);
  std::vector<double> sums(n - 1);
  for (std::uint32_t i = 0; i + 1 < n; ++i) lines[i] = {i, i + 1}, sums[i] = 0.25 * (i + 1);
  tree.trunk.lines = lines;
  tree.trunk.accumulated_lengths = sums;
  tree.trunk.diameters = std::vector<float>(n - 1, 1.0f);
  EXPECT_THAT(check_tree(tree), IsEmpty());
}

}  // namespace
}  // namespace copse
