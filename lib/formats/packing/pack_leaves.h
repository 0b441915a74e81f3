// The leaves of a packed tree (tree_pack.h): shapes and frames. Leaves that are one shape, turned, moved and
// scaled, are stored as the shape, once, and three corners' worth of frame each; what does not fit the shape
// within a tolerance is stored corner by corner on the grid.
#pragma once

#include "lib/formats/packing/pack_trunk.h"
#include "lib/formats/packing/range_coder.h"
#include "lib/formats/tree/tree.h"
#include "lib/formats/tree/tree_header.h"

#include <cstdint>
#include <string>
#include <vector>

namespace copse {

enum Carries : std::uint8_t { has_normal = 1, has_texcoord = 2 };

// How triangles and corners hang together; many leaves have the same.
struct LeafPattern {
  std::vector<std::array<std::uint32_t, 3>> vertices, wedges;  // by first use, from 0 on
  std::uint32_t vertex_count = 0;
  std::vector<std::uint32_t> vertex_of;             // wedge -> vertex
  std::vector<std::uint8_t> carries;                // wedge -> has_normal, has_texcoord
  bool has_normals = false, has_texcoords = false;  // any of them
  friend bool operator==(const LeafPattern&, const LeafPattern&) = default;
};

// How the normals of a shape are made.
enum class LeafNormals : std::uint8_t {
  given = 0,        // every one as it is
  fixed = 1,        // turn with the leaf
  from_point = 2,   // away from a point: near + scale x far, in the leaf's frame
  from_centre = 3,  // away from a point of the leaf's group
};

struct PackedLeaf {
  std::uint32_t shape = 0;
  std::uint32_t material = 0;        // one above the tree's index, 0 for none
  std::vector<Grid3> vertices = {};  // on the grid; of a framed leaf only the first two count
  std::uint32_t limb = k_none;  // the radius at the end of the limb on which its anchor sits (leaf_anchor.h)
  std::uint32_t along = 0;      // and where
  bool framed = false;          // the other vertices follow from the shape
  bool half = false;            // its turn round its first edge: (1 - t^2, 2 t) / (1 + t^2), or opposite
  std::int64_t turn = 0;        // t in units of 1 / turn_units
  bool shaded = false;          // normals follow from the shape
  std::vector<Octahedral> normals = {};  // of wedges, otherwise
  bool mapped = false;                   // texture coordinates are the shape's
  std::vector<Grid2> texcoords = {};
};

struct PackedShape {
  std::uint32_t pattern = 0;
  bool framed = false;                // otherwise leaves of this shape are stored vertex by vertex
  std::vector<Grid3> places = {};     // from vertex 2 on, in the frame of the first edge, its length 2^16
  bool anchored = false;              // a point of its frame sits on a limb
  Grid3 anchor{};                     // as places
  std::vector<Grid2> texcoords = {};  // of wedges
  LeafNormals normals = LeafNormals::given;
  std::vector<Octahedral> fixed = {};  // of wedges, in the frame
  Grid3 near{}, far{};                 // of from_point: steps; 2^-16 of the first edge
};

struct PackedLeaves {
  std::vector<LeafPattern> patterns;
  std::vector<PackedShape> shapes;
  std::vector<PackedLeaf> list;  // group after group
  std::vector<std::uint32_t> group_sizes;
  std::vector<Grid3> normal_centres;  // of groups, where a shape says from_centre
  double largest_error = 0;           // of plan_leaves: steps
};

// Codes them, or fills them by what is coded. What is wrong with what is decoded, empty when nothing is.
std::string code_leaves(RangeCoder& coder, PackedLeaves& leaves, const PackedTrunk& trunk, const Head& head);

// The leaves of `tree`, but for what follows from them and the groups' centres.
std::string build_leaves(const PackedLeaves& leaves, const PackGrid& grid, const Head& head, Tree& tree);

}  // namespace copse
