// A tree in the shape in which a real-time program wants it: the parallel, sorted arrays of digest 000,
// sections 3.2 (.tree) and 4.1 (.stree), in memory. tree_file.h stores and loads it; docs/formats.md gives
// the bytes.
//
// Coordinates are float32 metres relative to Header::origin (double), right-handed, +Y up.
#pragma once

#include "lib/formats/array.h"
#include "lib/formats/material.h"
#include "lib/formats/vec.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace copse {

enum class TreeKind : std::uint32_t {
  still = 1,      // .tree: geometry and LOD order, no hierarchy
  sensitive = 2,  // .stree: able to move; vertices hang on a hierarchy of radii
};

enum class LeafOrder : std::uint32_t { group = 0, terminal = 1, random = 2 };  // erratum E10

// The corners of one triangle: indices into the vertices, normals and texture coordinates of its section.
// k_none where a corner has no normal or no texture coordinate.
struct CornerTriangle {
  std::array<std::uint32_t, 3> vertex{};
  std::array<std::uint32_t, 3> normal{k_none, k_none, k_none};
  std::array<std::uint32_t, 3> texcoord{k_none, k_none, k_none};
  friend bool operator==(const CornerTriangle&, const CornerTriangle&) = default;
};
static_assert(sizeof(CornerTriangle) == 36);

// A node of the trunk's hierarchy: a ring of vertices ("radius" in the thesis; not a length).
struct Radius {
  enum Flags : std::uint32_t {
    terminal = 1,  // no child radii; child_count is 0 or 1 and first_child then names a leaf group
    joint = 2,     // no surface joins it to its parent (a free tube's first ring): no segment ends here
  };
  Float3 centre{};         // absolute for a root, otherwise the vector from the parent
  float diameter = 0;      // mean diameter, 2/k sum |v - c|
  float outer_radius = 0;  // max |v - c| over its vertices, rounded up (erratum E25)
  float distance = 0;      // to the parent's centre; 0 for a root
  std::uint32_t first_child = k_none;
  std::uint32_t child_count = 0;
  std::uint32_t flags = 0;
  friend bool operator==(const Radius&, const Radius&) = default;
};
static_assert(sizeof(Radius) == 36);

struct LeafGroup {
  Float3 centre{};      // of a sphere that encloses the group's triangles, as float32, relative to the origin
  float radius = 0;     // rounded up
  float mean_area = 0;  // of its leaves, alpha coverage counted (erratum E11)
  std::uint32_t first = 0;  // its leaves are order[first .. first + count)
  std::uint32_t count = 0;
  friend bool operator==(const LeafGroup&, const LeafGroup&) = default;
};
static_assert(sizeof(LeafGroup) == 28);

// A node of the hierarchy of bounding spheres over the leaf groups, in depth-first order: node 0 is the root,
// and `skip` is the index of the next node that is not below this one (so a failed test jumps there).
struct GroupNode {
  Float3 centre{};
  float radius = 0;
  std::uint32_t skip = 0;
  std::uint32_t group = k_none;  // the leaf group of a bottom node, k_none inside
  friend bool operator==(const GroupNode&, const GroupNode&) = default;
};
static_assert(sizeof(GroupNode) == 24);

struct TreeHeader {
  TreeKind kind = TreeKind::still;
  Double3 origin{};              // add it to every stored position; 0 unless the tree is far from the origin
  FloatBox bounds{};             // the whole tree, rounded outward; empty when there is nothing
  FloatBox trunk_bounds{};       // the trunk alone
  Float3 area_density_centre{};  // of the trunk: sum A_i c_i / sum A_i over its triangles
  float mean_trunk_area = 0;     // of a trunk triangle
  float mean_leaf_area = 0;      // of a leaf, alpha coverage counted
  std::uint32_t roots = 0;       // the first `roots` radii are the roots
  std::uint32_t ring_size = 0;   // k when all radii have k vertices, otherwise 0
  std::uint32_t segment_factor = 0;  // triangles a segment when constant, otherwise 0
  std::uint32_t leaf_factor = 0;     // triangles a leaf when constant, otherwise 0
  std::uint32_t unexplained = 0;     // trunk triangles that no generalized cylinder explains
  LeafOrder leaf_order = LeafOrder::group;
  bool monotone = false;  // every child's diameter <= its parent's
  friend bool operator==(const TreeHeader&, const TreeHeader&) = default;
};

// All arrays of one entry a segment are parallel and sorted by ascending diameter, ties by child radius.
// A segment is the generalized cylinder between a radius and its parent; joints have none.
struct Trunk {
  Array<CornerTriangle> triangles;            // segment after segment
  Array<std::uint32_t> first_triangle;        // segments + 1 offsets; empty when segment_factor is constant
  Array<std::array<std::uint32_t, 2>> lines;  // parent, child: into line_vertices (.tree) or radii (.stree)
  Array<float> diameters;                     // the larger of the two radii's
  Array<double> accumulated_lengths;          // of segments 0..i
  Array<std::uint32_t> materials;             // one a triangle; empty when all use `material`
  std::uint32_t material = k_none;
  Array<Float3> vertices;       // .tree only; of an .stree they are rebuilt from the hierarchy
  Array<Float3> line_vertices;  // .tree only
  Array<Float3> normals;
  Array<Float2> texcoords;
};

struct Leaves {
  Array<CornerTriangle> triangles;      // leaf after leaf
  Array<std::uint32_t> first_triangle;  // leaves + 1 offsets; empty when leaf_factor is constant
  Array<Float3> centres;                // one a leaf: mean of its distinct vertices
  Array<std::uint32_t> materials;       // one a leaf; empty when all use `material`
  std::uint32_t material = k_none;
  Array<Float3> vertices;
  Array<Float3> normals;
  Array<Float2> texcoords;
  Array<LeafGroup> groups;
  Array<std::uint32_t> order;  // a permutation of the leaves, group after group, each in Header::leaf_order
  Array<GroupNode> group_hierarchy;
};

// Breadth first: roots first, children contiguous, every child after its parent.
struct RadiusHierarchy {
  Array<Radius> radii;
  Array<std::uint32_t> first_vector;  // radii + 1 offsets into vectors; empty when ring_size is constant
  Array<Float3> vectors;  // centre -> vertex; trunk vertex i is vector i, put on its radius's centre
};

struct Tree {
  TreeHeader header;
  std::vector<Material> materials;
  std::vector<Texture> textures;
  Trunk trunk;
  Leaves leaves;
  RadiusHierarchy hierarchy;  // .stree only
  std::string provenance;     // JSON: tool, version, options, source file and its hash

  // Taken from whichever per-segment (per-leaf) array is there: each of them may have been left out.
  std::size_t segment_count() const;
  std::size_t leaf_count() const;
  std::size_t radius_count() const { return hierarchy.radii.size(); }
  // Where the run of each begins; for index = count, where the last one ends. All 0 when there is nothing to
  // divide: what was left out reads as empty runs.
  std::size_t first_vector_of(std::size_t radius) const {
    return offset(header.ring_size, hierarchy.first_vector, radius);
  }
  std::size_t first_triangle_of_segment(std::size_t segment) const {
    return offset(header.segment_factor, trunk.first_triangle, segment);
  }
  std::size_t first_triangle_of_leaf(std::size_t leaf) const {
    return offset(header.leaf_factor, leaves.first_triangle, leaf);
  }

 private:
  static std::size_t offset(std::uint32_t constant, const Array<std::uint32_t>& offsets, std::size_t i) {
    if (constant != 0) return i * constant;
    return offsets.empty() ? 0 : offsets[i];
  }
};

// The centres of all radii relative to the origin, accumulated from the vectors in one forward pass, in
// double.
std::vector<Double3> absolute_centres(const Tree& tree);

// The parent of every radius, k_none for a root.
std::vector<std::uint32_t> parents(const Tree& tree);

// The trunk's vertices at rest: stored ones of a .tree, rebuilt from the hierarchy for an .stree.
std::vector<Float3> trunk_vertices(const Tree& tree);

}  // namespace copse
