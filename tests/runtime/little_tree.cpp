#include "tests/runtime/little_tree.h"

namespace copse::testing {

namespace {

std::vector<Float3> ring(float diameter) {
  const float r = diameter / 2;
  return {{r, 0, 0}, {0, 0, -r}, {-r, 0, 0}, {0, 0, r}};
}

std::vector<CornerTriangle> tube(std::uint32_t lower, std::uint32_t upper) {
  std::vector<CornerTriangle> t;
  for (std::uint32_t i = 0; i < 4; ++i) {
    const std::uint32_t j = (i + 1) % 4;
    t.push_back({.vertex = {lower + i, lower + j, upper + j}});
    t.push_back({.vertex = {lower + i, upper + j, upper + i}});
  }
  return t;
}

// A square of side 0.5 that faces +Z, its lower left corner at `at`.
void add_leaf(Leaves& leaves, const Float3& at) {
  std::vector<Float3> vertices = leaves.vertices.to_vector();
  std::vector<Float2> texcoords = leaves.texcoords.to_vector();
  std::vector<CornerTriangle> triangles = leaves.triangles.to_vector();
  std::vector<Float3> centres = leaves.centres.to_vector();
  const auto v = static_cast<std::uint32_t>(vertices.size());
  for (const Float2& corner : {Float2{0, 0}, Float2{1, 0}, Float2{1, 1}, Float2{0, 1}}) {
    vertices.push_back(at + Float3{corner.x, corner.y, 0} * 0.5f);
    texcoords.push_back(corner);
  }
  triangles.push_back({.vertex = {v, v + 1, v + 2}, .texcoord = {v, v + 1, v + 2}});
  triangles.push_back({.vertex = {v, v + 2, v + 3}, .texcoord = {v, v + 2, v + 3}});
  centres.push_back(at + Float3{0.25f, 0.25f, 0});
  leaves.vertices = vertices;
  leaves.texcoords = texcoords;
  leaves.triangles = triangles;
  leaves.centres = centres;
}

}  // namespace

Tree little_stree() {
  Tree tree;
  tree.header.kind = TreeKind::sensitive;
  tree.header.roots = 1;
  tree.header.ring_size = 4;
  tree.header.segment_factor = 8;
  tree.header.leaf_factor = 2;
  tree.header.mean_leaf_area = 0.25f;
  tree.header.monotone = true;
  tree.materials = {Material{.name = "bark"}, Material{.name = "leaf", .double_sided = true}};
  tree.hierarchy.radii = std::vector<Radius>{
      {{0, 0, 0}, 0.4f, 0.2f, 0, 1, 1, 0},
      {{0, 1, 0}, 0.3f, 0.15f, 1, 2, 2, 0},
      {{0, 1, 0}, 0.2f, 0.1f, 1, 0, 1, Radius::terminal},
      {{1, 0, 0}, 0.1f, 0.05f, 1, k_none, 0, Radius::terminal | Radius::joint},
  };
  std::vector<Float3> vectors;
  for (const float d : {0.4f, 0.3f, 0.2f, 0.1f}) {
    for (const Float3& v : ring(d)) vectors.push_back(v);
  }
  tree.hierarchy.vectors = vectors;
  std::vector<CornerTriangle> triangles = tube(4, 8);
  for (const CornerTriangle& t : tube(0, 4)) triangles.push_back(t);
  tree.trunk.triangles = triangles;
  tree.trunk.lines = std::vector<std::array<std::uint32_t, 2>>{{1, 2}, {0, 1}};
  tree.trunk.diameters = std::vector<float>{0.3f, 0.4f};
  tree.trunk.accumulated_lengths = std::vector<double>{1, 2};
  tree.trunk.material = 0;
  add_leaf(tree.leaves, {0, 2, 0});
  add_leaf(tree.leaves, {-0.5f, 2, 0});
  tree.leaves.material = 1;
  tree.leaves.groups = std::vector<LeafGroup>{{{0, 2.25f, 0}, 0.6f, 0.25f, 0, 2}};
  tree.leaves.order = std::vector<std::uint32_t>{1, 0};
  tree.leaves.group_hierarchy = std::vector<GroupNode>{{{0, 2.25f, 0}, 0.6f, 1, 0}};
  return tree;
}

Tree little_tree() {
  Tree tree = little_stree();
  tree.trunk.vertices = trunk_vertices(tree);
  tree.trunk.line_vertices = std::vector<Float3>{{0, 0, 0}, {0, 1, 0}, {0, 2, 0}};
  tree.header.kind = TreeKind::still;
  tree.hierarchy = {};
  return tree;
}

}  // namespace copse::testing
