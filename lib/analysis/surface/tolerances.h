// Every tolerance of the trunk analysis, in one place: name, value, unit, reason.
#pragma once

#include <cstddef>

namespace copse {

// welding

// Positions that a generator computed twice (seams: angle 0 and angle 2 pi) or that a file rounded twice
// differ by a few units of the last stored digit, never by a visible share of the edges that meet there.

// Share of the bounding box's diagonal. Files with four decimals of a ten metre tree round at 1e-5 of it.
inline constexpr double k_weld_of_diagonal = 1.0 / (1 << 16);
// Share of the shortest edge at the vertex. A ring of any k has edges of its own length between its vertices,
// so a sixteenth of an edge can never join two of them, however thin the twig.
inline constexpr double k_weld_of_edge = 1.0 / 16;
// Share of the coordinate's own size: four units in the last place of a float32. Edges that are shorter than
// this are rounding noise themselves and do not shrink the tolerance.
inline constexpr double k_weld_float_noise = 1.0 / (1 << 22);
// ... but never more than this share of the diagonal, for meshes far from the origin stored in more digits.
inline constexpr double k_weld_noise_of_diagonal = 1.0 / (1 << 23);

// spatial_order

// Share of the diagonal that lies on average between triangles that follow one another: random points of a
// tree have a quarter, limb after limb has a hundredth and less.
inline constexpr double k_scattered = 1.0 / 32;
// Triangles: fewer fit into a cache with all that is known about them.
inline constexpr std::size_t k_least_scattered = 16384;

// reading rings

// Triangles, as multiples of the surface's own, that attempts to read it may touch before it counts as no
// tree of rings. One true start is enough; a box has three readings, each found from both ends.
inline constexpr std::size_t k_ring_attempts = 64;
// Cosines of the angles between the normals of neighbouring triangles above which an edge is smooth and no
// rim of a lid: 30, 10, 3 and 1 degrees. A lid meets the side of a tube at about 90, of a sheared tube at
// less.
inline constexpr double k_lid_smooth_cosines[] = {0.8660254, 0.9848078, 0.9986295, 0.9998477};
// Axis length over mean diameter below which concentric rings are a flat sheet and no tube.
inline constexpr double k_flat_slenderness = 1e-3;
// Mean cosine between rungs and axis by which a strip may be read less squarely, if that makes it longer.
inline constexpr double k_about_square = 0.05;
// Radii between a ring's centre and the single vertex beyond it, up to which that vertex is the centre of a
// cap. Caps are flat, or pulled up a little; the point that a twig runs out into is as long as a segment.
inline constexpr double k_lid_height = 0.125;

// Share of the radius by which the corners and the edges of a regular polygon may differ: files round a twig
// of 5 mm at a thousandth, and nothing is as regular by chance.
inline constexpr double k_regular_ring = 1e-2;

// joining and attaching limbs

// Share of the radius by which two rings that are one may differ in centre and, of the diameter, in diameter.
// Files with six decimals round a twig of 5 mm at 2e-4 of its radius; segments are longer than a radius.
inline constexpr double k_join_tolerance = 1e-3;
// The same of the centres, where end rings face one another and are equally thick: the mean of a rough ring's
// vertices moves when the ring is turned by half a side.
inline constexpr double k_join_facing = 0.05;
// Cosine between the normals of rings that lie in one plane: 8 degrees.
inline constexpr double k_one_plane = 0.99;
// Ratio of the diameters of two ends that do not tell which is the base: tubes taper by more, rounding by
// less.
inline constexpr double k_like_thickness = 1.1;
// Ratio of the thickest end of a limb to the thinnest that it may stand on: the ends of a forked trunk of
// even thickness differ by how they were cut, the tips of drooping branches are thinner by far.
inline constexpr double k_thinner_base = 2;
// Diameters of a ring up to which a point beyond it closes it as a lid or a rounded end does; farther out it
// is the tip of a cone.
inline constexpr double k_blunt_point = 1;
// Depth of the lowest point below y = 0, as a share of the trunk's height, up to which y = 0 is the ground.
// Roots are sunk by a few per cent; a model that is centred on the origin is at 1/2.
inline constexpr double k_ground_depth = 0.2;
// Share of the trunk's height by which bases that stand on one level may differ: what is put on a floor is
// put on it exactly. On a trunk that is much longer than thick, k_ground_level is less.
inline constexpr double k_same_level = 1e-4;
// Radii of the base by which it may stand above the lowest base of all to stand on the same ground.
inline constexpr double k_ground_level = 0.25;
// Radii of another stem from its axis, up to which a stem that stands on the ground grows from that stem and
// not from the ground.
inline constexpr double k_ground_offset = 0.5;
// Height of a plate that trees stand on over its smaller width, and how far it may lie above the lowest point
// over the trunk's height; its widths over the trunk's.
inline constexpr double k_plate_height = 0.1;
inline constexpr double k_plate_width = 0.5;
// Radii of the base between its centre and the surface of what it is attached to. A tube that is laid against
// its parent along its side touches it at one; the second is for skins that are polygons or bent.
inline constexpr double k_contact_reach = 2;
// Possible parents that are looked at: the nearest by distance over radius. Twigs cross in twos and threes.
inline constexpr std::size_t k_candidates = 16;
// Share of a limb's own reach that may separate it from what it floats above.
inline constexpr double k_float_gap = 0.1;
// Ratio of a branch's radius to its parent's that is still common: generators let branches start up to 1.2
// times as thick as the place that they grow from.
inline constexpr double k_thicker_child = 1.25;
// The same ratio up to which a limb may be held by the middle of another one: a flared base on a thin rod.
inline constexpr double k_thinner_holder = 2;
// Limbs with one possible parent that it takes to learn a file's habit; the spread, in radii of the parent,
// that is assumed without, and the least that is believed (rounding of a thin twig's centre).
inline constexpr std::size_t k_habit_limbs = 5;
inline constexpr double k_habit_unknown = 0.25;
inline constexpr double k_habit_least = 1e-4;
// The least spread of ln(child's radius / parent's radius) that is believed: children differ by level and by
// chance.
inline constexpr double k_habit_least_ratio = 0.1;
// Share of the trunk's size by which rounding in the file may move a ring's centre or a point of an axis.
inline constexpr double k_rounding = 1e-6;
// Radius of a child over its parent's at which the parent's thickness stops to matter: it is not the parent.
inline constexpr double k_much_thicker = 16;
// Costs, in spreads: the most that an unusual offset, and that an unusual ratio of radii can cost; a parent
// thinner by a factor e than it may be; a parent at its own buried base; a gap, or an end that is not the
// base by its taper; a root where something would hold it. So a root is better than a parent that is thinner
// than half the child, whatever else speaks for it.
inline constexpr double k_cost_offset = 20;
inline constexpr double k_cost_ratio = 2;
inline constexpr double k_cost_too_thin = 60;
inline constexpr double k_cost_buried = 2;
inline constexpr double k_cost_doubt = 9;
inline constexpr double k_cost_root = 30;
// By how much less the other end must cost for a limb that may begin with either to be turned.
inline constexpr double k_cost_turn = 4;

}  // namespace copse
