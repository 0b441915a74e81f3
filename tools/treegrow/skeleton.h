// A grown tree before it has a surface: stems as curves with radii, and where leaves sit on them.
#pragma once

#include "lib/formats/random.h"
#include "lib/formats/vec.h"
#include "tools/treegrow/species.h"

#include <cstdint>
#include <vector>

namespace copse::grow {

enum class StemKind : std::uint8_t {
  root,  // leaves the ground
  side,  // leaves the side of its parent
  fork,  // an arm of a split: continues its parent from a node of it
};

// A stem is a smooth curve through `nodes`, node j at parameter j / (nodes - 1).
struct Stem {
  std::uint32_t parent = 0xffffffffu;
  std::uint32_t tree = 0;  // which of several trees
  StemKind kind = StemKind::root;
  std::uint8_t level = 0;
  double parent_at = 0;        // parameter on the parent
  double exit = 0;             // own parameter where it leaves its parent's body; 0 for roots and forks
  double length = 0;           // along the curve
  double radius = 0;           // that a whole stem would have at its base
  double from = 0, to = 1;     // the part of such a whole stem that this one is: forks start later,
                               // broken stems end early
  std::vector<Double3> nodes;  // at least 2
  std::vector<double> girth;   // factor on the radius at each node: forks make it smaller
  std::vector<double> splits;  // parameters at which arms leave, ascending
  std::uint32_t children = 0;  // stems whose parent this is
  double leaf_weight = 0;      // its share of the tree's leaves; 0: bears none
  Random random{0};            // for what is made of it later (leaves, roughness)
};

struct Skeleton {
  std::vector<Stem> stems;  // parents before children
  double height = 0;        // of the tallest stem's tip above the ground
  double root_depth = 0;    // of the root rings under the ground
  Double3 crown_centre;     // where shading normals lean away from
  double leaf_weight = 0;   // sum over the stems
  bool too_large = false;   // growth was given up: what is here is a part
  double twigs = 1;         // the factor on the last level's stems that it was grown with
};

// A point of a stem with its frame: `side` and `up` span the ring's plane, right-handed with `along`.
struct StemPoint {
  Double3 centre;
  Double3 along, side, up;
  double radius = 0;
};

// Position and direction at parameter t in [0, 1].
Double3 stem_position(const Stem& stem, double t);
Double3 stem_direction(const Stem& stem, double t);

// The radius at t: taper, flare of the foot and forks together.
double stem_radius(const Species& species, const Stem& stem, double t);

// Frames along a stem by parallel transport, at ascending parameters: they never twist about the stem.
std::vector<StemPoint> stem_points(const Species& species, const Stem& stem,
                                   const std::vector<double>& parameters);

}  // namespace copse::grow
