// motion_envelope: points round everywhere that moving points can come to, so that a volume fitted to them
// never needs an update while the part moves.
//
// Source: digest 002, section 3.6 (the dissertation's section 3.8.2, motion envelopes), which leaves open how
// an envelope is computed.
#pragma once

#include "lib/formats/tree/tree.h"
#include "lib/formats/vec.h"

#include <span>
#include <vector>

namespace copse {

// Round the balls of these radii about the points: of each ball the corners of an icosahedron that it touches
// from inside (the point itself where the radius is 0). Any convex volume of these contains the balls. The
// corners stick out by a quarter of the radius.
std::vector<Double3> ball_envelope(std::span<const Double3> points, std::span<const double> radii);

// A revolute joint: what turns about the line through `origin` along `axis` by angles of from .. to
// (radians).
struct Joint {
  Double3 origin, axis{0, 1, 0};
  double from = 0, to = 0;
};

// Round the arcs that the points go through: the points at `steps` + 1 angles (more where those would be more
// than a radian apart), moved outward from the axis so that the chords between them enclose the arcs (by the
// sagitta, rho (1 / cos(angle / 2) - 1)). A whole turn has its ends in common.
std::vector<Double3> joint_envelope(std::span<const Double3> points, const Joint& joint, int steps = 32);

// How far each vertex of a tree can be from its place at rest when the direction of every link of its
// hierarchy (from a radius to its parent), and of what hangs on a radius (vertex vectors, leaves), is turned
// by at most `angle` radians: the sum of the chords along the chain. Trunk vertices as trunk_vertices() gives
// them, then the leaves'; a leaf vertex hangs on the terminal radius of its group (of several the one that
// moves most). A tree without a hierarchy does not move: all 0. O(vertices).
std::vector<double> sway_reach(const Tree& tree, double angle);

}  // namespace copse
