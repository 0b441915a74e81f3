// An ecosystem in the shape in which a real-time program wants it: a terrain, materials, types of trees, and
// their instances in blocks that are drawn, culled and streamed as one. Digest 000, sections 2 and 3.3.
// ecosystem_file.h stores and loads it; docs/formats.md gives the bytes.
//
// Metres, right-handed, +Y up. Double positions are absolute; float boxes are relative to Ecosystem::origin.
#pragma once

#include "lib/formats/array.h"
#include "lib/formats/material.h"
#include "lib/formats/tree/tree.h"
#include "lib/formats/vec.h"
#include "lib/formats/volumes/volume.h"

#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace copse {

// A grid of vertices, row after row. Cell (column, row) has the corners a, b = a + 1, c = a + columns and
// d = c + 1, and the triangles (a, c, d) and (a, d, b): seen from above, with x to the right and z down,
// counter-clockwise.
struct Terrain {
  std::uint32_t columns = 0, rows = 0;  // vertices; both 0 (no terrain) or both at least 2
  Double3 origin{};                     // added to every position
  // Regular: vertex (column, row) is at (column * spacing_x, heights[..], row * spacing_z).
  double spacing_x = 0, spacing_z = 0;
  Array<float> heights;
  Array<Float3> points;  // otherwise: every vertex; `heights` is then empty
  std::uint32_t material = k_none;
  float texture_size = 1;  // metres that one repetition of its texture covers, > 0

  bool regular() const { return points.empty(); }
  std::size_t vertex_count() const { return std::size_t{columns} * rows; }
  Double3 vertex(std::uint32_t column, std::uint32_t row) const {
    const std::size_t i = std::size_t{row} * columns + column;
    if (!regular()) return origin + to_double(points[i]);
    return origin + Double3{column * spacing_x, static_cast<double>(heights[i]), row * spacing_z};
  }
};

// A kind of tree. Its mesh is in a file of its own, or packed into the ecosystem's.
struct TreeType {
  std::string name{};
  std::string uri{};                   // of the tree's file, relative to the ecosystem's; empty when packed
  Array<std::uint8_t> packed{};        // the tree's file, whole; empty when by reference
  std::uint64_t hash = 0;              // XXH3-64 of the tree's file
  FloatBox bounds{};                   // of the tree, relative to where it stands; empty when it has nothing
  std::uint32_t instances = 0;         // in all blocks
  float scale_min = 1, scale_max = 1;  // of its instances, > 0
  float view_range = 0;                // instances farther away are not drawn; 0: no limit
  // Each holds the whole tree at rest (wherever it sways), in the coordinates of `bounds`: what an instance's
  // box is made of, with `bounds` (instance_bounds.h). Not from every tree: bvfit fits them. No k-DOPs.
  std::vector<Volume<float>> volumes{}, envelopes{};
};

using Quaternion = std::array<double, 4>;  // x, y, z, w; length 1

// An instance as it is meant, before it is packed and after it is unpacked: a point p of the tree is at
// position + rotate(rotation, p * scale).
struct Instance {
  Double3 position{};
  Quaternion rotation{0, 0, 0, 1};
  double scale = 1;
  std::uint32_t type = 0;
  std::uint32_t trunk_material = k_none;  // into the ecosystem's materials; none: the tree's own
  std::uint32_t leaf_material = k_none;
  std::uint32_t motion = 0;                         // which of the player's motions; 0: it stands still
  std::array<std::uint8_t, 3> tint{255, 255, 255};  // sRGB; multiplies its colours
  // Of one that is yet to be stored: its foot stands on the ground, its axis is the ground's normal, whatever
  // the rounding of x and z makes of them. Not in files.
  bool on_ground = false, along_normal = false;
};

inline constexpr std::uint32_t k_position_bits = 21, k_axis_bits = 22, k_head_bits = 20;
inline constexpr std::uint8_t k_own_material = 255;

// An instance in 24 bytes; what it means is said by its block (instance_codec.h).
struct PackedInstance {
  std::uint64_t position = 0;  // x, y, z: 21 bits each from the lowest, in steps from the block's origin
  std::uint64_t rotation = 0;  // where +Y goes, octahedral, 2 x 22 bits from the lowest; 20 bits of head
  std::uint16_t scale = 0;     // of 65535, between the type's scale_min and scale_max
  std::array<std::uint8_t, 3> tint{};
  std::uint8_t trunk_material = k_own_material, leaf_material = k_own_material;
  std::uint8_t motion = 0;
  friend bool operator==(const PackedInstance&, const PackedInstance&) = default;
};
static_assert(sizeof(PackedInstance) == 24);

// The same in 48 bytes, rounded to float32 and no more.
struct ExactInstance {
  Float3 position{};  // relative to the block's origin
  std::array<float, 4> rotation{0, 0, 0, 1};
  float scale = 1;
  std::uint32_t trunk_material = k_none, leaf_material = k_none;
  std::uint32_t motion = 0;
  std::array<std::uint8_t, 4> tint{};  // the fourth is 0
  friend bool operator==(const ExactInstance&, const ExactInstance&) = default;
};
static_assert(sizeof(ExactInstance) == 48);

// Instances of one type that stand together: one draw call, one box to cull, one piece to stream.
struct InstanceBlock {
  std::uint32_t type = 0;
  std::uint32_t first = 0, count = 0;  // its instances; blocks follow one another without a gap
  std::uint32_t reserved0 = 0;
  Double3 origin{};   // absolute; every packed position counts from here
  Float3 step{};      // of packed positions: powers of two, so that unpacking is exact; 0 when exact
  FloatBox bounds{};  // of its instances' trees, rounded outward, relative to the ecosystem's origin
  std::uint32_t reserved1 = 0;
  friend bool operator==(const InstanceBlock&, const InstanceBlock&) = default;
};
static_assert(sizeof(InstanceBlock) == 80);

// A node of the box hierarchy: a quadtree over the planted area of depth Ecosystem::depth, level after level
// from the root. Level l has 4^l nodes in the order of the Hilbert curve, so that the children of node i of a
// level are nodes 4 i to 4 i + 3 of the next, and the blocks below a node are contiguous. A block belongs to
// the leaf that owns the points where its instances are planted; boxes hold whole trees and overlap.
struct QuadNode {
  FloatBox bounds{};                               // empty: invalid, nothing is planted below
  std::uint32_t first_block = 0, block_count = 0;  // all blocks below
  friend bool operator==(const QuadNode&, const QuadNode&) = default;
};
static_assert(sizeof(QuadNode) == 32);

// A node of another hierarchy over the blocks, depth first from node 0: what is below node i is i + 1 .. skip
// - 1.
struct BlockNode {
  FloatBox bounds{};             // of all blocks below
  std::uint32_t skip = 0;        // the next node that is not below this one
  std::uint32_t block = k_none;  // of a bottom node, none inside
  friend bool operator==(const BlockNode&, const BlockNode&) = default;
};
static_assert(sizeof(BlockNode) == 32);

inline constexpr std::uint32_t k_max_quad_depth = 10;

// Where level `level` of a box hierarchy begins; for level = depth + 1, how many nodes there are.
constexpr std::uint32_t first_quad_node(std::uint32_t level) {
  return ((std::uint32_t{1} << (2 * level)) - 1) / 3;
}

struct Ecosystem {
  Double3 origin{};   // of the float boxes
  FloatBox bounds{};  // of terrain and instances; empty when there is nothing
  Terrain terrain;
  std::vector<Material> materials;
  std::vector<Texture> textures;
  std::vector<TreeType> types;
  std::array<double, 4> area{};  // that the box hierarchy divides: x0, z0, x1, z1
  std::uint32_t depth = 0;       // of the box hierarchy
  Array<InstanceBlock> blocks;
  Array<std::uint64_t> block_hashes;  // XXH3-64 of the stored instances of each block; empty: not known
  Array<PackedInstance> packed;       // either these ...
  Array<ExactInstance> exact;         // ... or these
  Array<QuadNode> boxes;              // first_quad_node(depth + 1) nodes; empty when there are no blocks
  Array<BlockNode> kd_tree, rtree;    // over the blocks that have a box; each may be empty
  // How far what is stored may lie from what was meant: at most.
  float position_error = 0;  // m
  float rotation_error = 0;  // radians
  float scale_error = 0;     // relative
  std::uint64_t seed = 0;
  std::string provenance;  // JSON: tool, version, options, source files and their hashes

  std::size_t instance_count() const { return packed.size() + exact.size(); }
};

}  // namespace copse
