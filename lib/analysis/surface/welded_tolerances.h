// Every tolerance of the reading of welded surfaces, in one place: name, value, unit, reason.
#pragma once

#include <cstddef>

namespace copse {

// --- band_growth

// Radians: a vertex whose triangles' angles sum to less is the pointed end of a limb. 2 pi is flat; the
// corner of a cube has 3/2 pi; this is a cone whose side is 46 degrees off its axis.
inline constexpr double k_point_angle = 1.45 * 3.14159265358979323846;

// Area over the square of the way round, as a share of a regular polygon's: what lies round the end of a limb
// is rounder. A rectangle three and a half times as long as wide has less, a rough or sheared ring more.
inline constexpr double k_ring_roundness = 0.7;

// Vertices: holes wider than this are not closed where a limb was cut into another one. Closing costs the
// square.
inline constexpr std::size_t k_widest_collar = 64;

// --- quads

// Radians, summed over the four corners: how far from rectangular two triangles may be and still be taken for
// a quad. A parallelogram of 45 and 135 degrees has pi.
inline constexpr double k_quad_skew = 3.0;
// The same when the file names the two triangles one after the other: a twisted tube has slanted quads.
inline constexpr double k_quad_skew_in_order = 6.0;

// --- fork_rings

// Share of the triangles that must lie in bands for quads in file order to be believed.
inline constexpr double k_enough_bands = 0.9;
// Share of the ring's radius: a vertex nearer than this to its ring's centre closes a limb, farther out it is
// a limb's pointed end.
inline constexpr double k_cap_height = 0.25;
// Radii that what a limb's last ring runs out into reaches beyond it to be a part of the limb, and no lid.
inline constexpr double k_far_end = 0.5;
// How much being low counts against being thick when the root is looked for: an end at the bottom must not be
// thinner than one at the top by more than this share of it. Pieces of drooping limbs have their thin ends
// below.
inline constexpr double k_lowness = 0.25;
// Weight of the mean of the limbs' ends against their axes where limbs meet: enough to decide for parallel
// axes, too little to move the crossing of others by more than a few hundredths of the gap.
inline constexpr double k_meeting_pull = 0.02;

// --- level_skeleton

// Pieces that slicing may cut the triangles into, on average, beyond one each: enough for three slices across
// the triangles of an even mesh, few enough to stay linear in time and memory ...
inline constexpr double k_pieces_of_triangle = 3;
// ... and how many more, so that a trunk of a hundred triangles is sliced as finely as a dense one.
inline constexpr double k_pieces_at_least = 4096;
// Slices from end to end. A limb longer than a thousand times its thickness loses no fork by it.
inline constexpr double k_most_slices = 65536;
// Share of the height within which vertices count as lowest: a foot that is cut level, not a slope.
inline constexpr double k_lowest_share = 1.0 / 256;

// --- section

// Share of an outline's length: corners nearer than this are one; closer ones have no direction to turn by.
inline constexpr double k_same_corner = 1e-9;
// How much an outline may turn, to and fro, against once round, and still count by its turns.
inline constexpr double k_nearly_convex = 1.5;

// Triangles that all cuts through a surface may pass, and how many more for each of its triangles: a limb is
// sampled a few thousand times and has a few hundred sides; what is cut through thousands of triangles
// thousands of times is no limb. A fifth of a second.
inline constexpr std::size_t k_section_steps = std::size_t{1} << 21;
inline constexpr std::size_t k_section_steps_of_triangle = 64;

// --- skeleton_limbs

// Radii of the limb that it starts in: what reaches less far from the limb's axis is a bump on it. Its
// surface is one radius away.
inline constexpr double k_spur_reach = 1.5;
// Radii of the fork: the stretch over which the limbs that leave it are compared; slices next to the fork are
// torn.
inline constexpr double k_fork_stretch = 3;
// How much going straight on counts against being thick at a fork.
inline constexpr double k_straightness = 1;
// A limb shorter than so many of its radii counts at a fork as if it were thinner by as much.
inline constexpr double k_limb_length = 4;

// --- limb_samples

// How fast a limb's rough radius may change along it; a slice that is thinner than that was torn.
inline constexpr double k_steepest_taper = 0.5;
// Radii between samples before they are thinned out: several to a bend.
inline constexpr double k_sample_spacing = 1.5;
// Share of a limb's length: thinner than this it counts as this thick when samples are spaced and left out,
// so that a flat or empty outline, which has no radius, does not ask for infinitely many.
inline constexpr double k_least_size = 1.0 / 4096;
// Share of a limb's greatest thickness: samples are not nearer than where it is this thick, or a cone's tip
// would have a dozen.
inline constexpr double k_least_spacing = 1.0 / 16;
// Neighbouring skeleton points whose triangles are tried when a point has none.
inline constexpr std::size_t k_seed_reach = 8;
// Rough radii: a section that is wider belongs to something else.
inline constexpr double k_widest_section = 3;
// A sample moves, its neighbours' directions follow, it moves again: the second move is a tenth of the first.
inline constexpr int k_section_rounds = 2;
// Share of the way to a limb's end at which the end is measured: before a rounded edge, after a cone's
// beginning.
inline constexpr double k_end_section = 0.9;
// Cosine: a limb whose last stretch bends less than 45 degrees is taken to end straight on.
inline constexpr double k_straight_on = 0.7;
// Rough radii: a last stretch that is shorter runs from the middle of the limb to any corner of its end, and
// does not tell where the limb goes, unless it goes back.
inline constexpr double k_end_stretch = 2;
// Rough radii from the axis within which the surface at a closed end is the end, and not a limb that turns
// away.
inline constexpr double k_end_width = 2;
// A section that is wider than both its neighbours by this cuts a fork.
inline constexpr double k_bulge = 1.2;
// Radii: how far a sample may be off the line between those that stay.
inline constexpr double k_sample_tolerance = 0.1;
// Radii: the longest segment, however straight the limb: a swaying one must be able to bend.
inline constexpr double k_sample_gap = 24;

// --- surface_skeleton

// Radii of the parent: the stretch of a limb whose direction leads back to where it grows from, and how far
// below the place where levels part that may be.
inline constexpr double k_seat_from = 1.5, k_seat_to = 3, k_seat_reach = 3;
// Radii of the parent before and behind a fork within which a section cuts the other limb too.
inline constexpr double k_fork_before = 1, k_fork_behind = 0.25;

// --- united_tubes

// Sine by which a surface must bend inward where two tubes meet: ten degrees; quads of bent tubes are folded
// by less.
inline constexpr double k_valley_sine = 0.17;
// Twice a triangle's area over the square of its longest edge: one that is thinner has no normal of its own.
inline constexpr double k_sliver = 1e-3;
// Share of a band's length: corners of one ring are nearer to one another along the axis.
inline constexpr double k_ring_gap = 0.3;
// How much thicker or thinner than the rings beside it what is left of a ring may be.
inline constexpr double k_partial_ratio = 1.5;
// Determinant over squared trace of corners: an arc of less bend tells no circle.
inline constexpr double k_flat_arc = 1e-4;

// --- flow_skeleton

// Triangles: a piece of more is thinned out to so many before it flows; each step factorises a matrix of that
// size.
inline constexpr std::size_t k_flow_triangles = 8000;
// Volume over area^1.5 (a ball's is 0.094) from which on there is an inside to flow to: below is rounding.
inline constexpr double k_flow_thinnest = 1e-9;
// Triangles: the long edges of a piece of fewer are cut: the flow needs vertices round a limb to find its
// middle.
inline constexpr std::size_t k_flow_triangles_at_least = 2000;
// Vertices: wider holes are closed by a vertex in their middle. Closing without one costs the cube.
inline constexpr std::size_t k_widest_hole = 128;

// --- implied_rings

// Rings with a ring before them: fewer tell nothing about how a surface was cut.
inline constexpr std::size_t k_even_steps = 64;
// The median step, in radii, and its inverse, between which the pieces of a surface are about square: four to
// sixteen sides.
inline constexpr double k_square_step = 3;
// Steps within this ratio of the median are even, and this share of all must be.
inline constexpr double k_even_ratio = 1.5;
inline constexpr double k_even_share = 0.85;
// The thickest tenth of the rings over the thinnest: where all are alike, steps of one length are even steps
// too.
inline constexpr double k_uneven_radii = 2;
// Radians between a step and the next: less is rounding.
inline constexpr double k_corner_bend = 0.005;
// Radii by which a ring may be off the line between the rings that stay, centre and radius together.
inline constexpr double k_implied_tolerance = 0.02;

// --- reverse_subdivision

// Triangles: a surface of fewer is no subdivision of anything that has rings.
inline constexpr std::size_t k_least_subdivided = 64;
// The least eigenvalue that is counted on, of a step and of a step and the limit: 1/4 and 1/9 where all is
// regular, somewhat less round vertices of many or few edges.
inline constexpr double k_least_step_eigenvalue = 0.15;
inline constexpr double k_least_limit_eigenvalue = 0.06;
// Share of the diagonal at which the iteration is done: below what files round to.
inline constexpr double k_solved_share = 1e-9;
inline constexpr int k_solver_rounds = 200;
// The round after which, a cage being off by some thousandths of an edge, points that are off by more than so
// many times what is allowed in the end are not the subdivision's: most surfaces are none, and wait for no
// more rounds.
inline constexpr int k_judged_round = 12;
inline constexpr double k_judged_slack = 2;
// Times the precision by which a point must be off to say that a vertex beside it was kept where it is; how
// far off on average the points beside such a vertex are, at least, as a share of the most about a neighbour
// (what is wrong about one vertex falls to a fourth from edge to edge); and how often such are looked for.
inline constexpr double k_corner_off = 8;
inline constexpr double k_corner_share = 0.5;
inline constexpr int k_corner_rounds = 16;
// Share of the edge points and face points that must be where the cage foretells them ...
inline constexpr double k_foretold_share = 0.9;
// ... and this share already before vertices are looked for that were kept where they are ...
inline constexpr double k_first_share = 0.5;
// ... within this share of the diagonal (five decimals of a ten metre tree; a circle of sixteen is off the
// curve that eight of its points foretell by more, unless it is a ten-thousandth of the tree) and this
// share of an edge.
inline constexpr double k_foretold_of_diagonal = 2e-6;
inline constexpr double k_foretold_of_edge = 1.0 / 128;

// --- hull_relaxation

// Rounds of the iteration at most, and the share of the movement at which it is done.
inline constexpr int k_relaxation_rounds = 200;
inline constexpr double k_relaxation_done = 1e-9;

// --- hull_frames

// Limbs of one fork that are looked at for rings that were hung on its hull though they do not look like it.
inline constexpr std::size_t k_most_hung = 16;
// Levenberg and Marquardt's iteration: rounds at most (10 where all is as foretold), the damping that it
// begins with (times the squares of slopes, which are about 1), and the share of the cost below which a gain
// is none.
inline constexpr int k_frame_rounds = 100;
inline constexpr double k_frame_damping = 1e-3;
inline constexpr double k_frame_done = 1e-6;
// Radii: the step of differences, the cube root of rounding.
inline constexpr double k_frame_difference = 6e-6;

// --- cage_rings, cage_axes

// How much more than the file's rounding moves a ring's centre: undoing a subdivision enlarges it.
inline constexpr double k_cage_noise = 16;
// Radii: what counts as exact besides.
inline constexpr double k_cage_tolerance = 1e-3;
// Determinant of the lines' normal matrix below which they are parallel: two lines at a hundredth of a radian
// have 1e-4.
inline constexpr double k_cage_parallel = 1e-7;
// Times the rounding that lines may miss one another by where they do not meet exactly: a tenth of a radius.
inline constexpr double k_about_meeting = 50;
// Radii by which a ring whose corners had been moved must be off the line to be a corner of the axis.
inline constexpr double k_moved_tolerance = 0.05;
// Share of the rings next to forks that must become regular for a smoothing of hulls to be believed.
inline constexpr double k_relaxed_share = 0.1;

// --- welded

// Share of the triangles that lie between rings from which on the rings are taken without trying anything
// else.
inline constexpr double k_rings_suffice = 0.9;
// Share of a surface skeleton's cost (see Fit) that the rings may cost at most to be taken where less of the
// surface lies between rings: then some are rings by chance.
inline constexpr double k_rings_may_cost = 0.9;
// Cost (see Fit) above which levels are doubted, and how much less another skeleton must cost to be taken
// instead.
inline constexpr double k_poor_fit = 0.02;
inline constexpr double k_clearly_better = 0.8;
// Share of the mesh's triangles that a surface must have to be worth the tenth of a second that a flow takes.
inline constexpr double k_flow_share = 1.0 / 8;

}  // namespace copse
