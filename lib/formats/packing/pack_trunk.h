// The trunk of a packed tree (tree_pack.h): radii, rings, triangles and what their corners carry, as whole
// numbers on a grid, coded against what a tube looks like: a ring against the one that it grows from, a
// segment's triangles against the last segment of the same shape, normals against the surface, texture
// coordinates against the neighbouring corners.
#pragma once

#include "lib/formats/packing/octahedral.h"
#include "lib/formats/packing/range_coder.h"
#include "lib/formats/tree/tree.h"
#include "lib/formats/tree/tree_header.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <vector>

namespace copse {

using Grid3 = std::array<std::int64_t, 3>;
using Grid2 = std::array<std::int64_t, 2>;

// No coordinate is larger: sums of two are exact in float32.
inline constexpr std::int64_t k_grid_limit = std::int64_t{1} << 22;

// Offsets within the grid are below twice its limit. Forged ones are cut before the next is foretold from
// them.
inline std::int64_t grid_offset(std::int64_t x) {
  return std::clamp(x, -4 * k_grid_limit, 4 * k_grid_limit);
}

// Powers of two: a stored coordinate is a whole number times this, exactly.
struct PackGrid {
  std::int32_t position = 0, texcoord = 0;  // exponents
  double step() const;
  double texcoord_step() const;
};

inline constexpr std::int32_t k_least_exponent = -120, k_most_exponent = 100;
// The power of two that is nearest to size / 2^bits, by ratio, within these limits.
std::int32_t grid_exponent(double size, int bits);

// What a corner carries; of the parts that its tree has.
struct PackedWedge {
  Octahedral normal{};
  Grid2 texcoord{};
  bool has_normal = false, has_texcoord = false;
  friend bool operator==(const PackedWedge&, const PackedWedge&) = default;
};

struct PackedRadius {
  std::uint32_t children = 0;
  std::int64_t group = -1;  // of a terminal radius: its leaf group, -1 for none
  bool joint = false;
  Grid3 centre{};             // absolute
  std::uint32_t vectors = 0;  // of its ring
  std::int64_t diameter = 0;  // in quarter steps
};

// What normals are told from: the sum of the faces round a vertex, each by its area or its angle there; away
// from the centre of the ring; or the faces themselves.
enum class TrunkNormals : std::uint8_t { by_area, by_angle, radial, faces };

struct PackedTrunk {
  std::vector<PackedRadius> radii;  // breadth first
  std::vector<Grid3> vectors;       // from the centre
  // Segment after segment (segments_of); corners are vectors.
  std::vector<std::uint32_t> counts;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<std::array<PackedWedge, 3>> wedges;
  std::vector<std::uint32_t> materials;  // of triangles; one above the tree's material index, 0 for none
  TrunkNormals normals = TrunkNormals::by_area;
  double largest_error = 0;  // of plan_trunk: steps
};

// Of radii breadth first, the parent of each, or none.
std::vector<std::uint32_t> parents_of(const PackedTrunk& trunk, std::uint32_t roots);

// Of a tree that is no .tree and has all its sections. Triangles and segments come in the packed order.
PackedTrunk plan_trunk(const Tree& tree, const PackGrid& grid);

// Codes it, or fills it by what is coded; `head` says how much of everything there is. What is wrong with
// what is decoded, empty when nothing is.
std::string code_trunk(RangeCoder& coder, PackedTrunk& trunk, const Head& head);

// The trunk and the hierarchy of `tree`, but for what follows from them (derive_tree.h).
void build_trunk(const PackedTrunk& trunk, const PackGrid& grid, const Head& head, Tree& tree);

}  // namespace copse
