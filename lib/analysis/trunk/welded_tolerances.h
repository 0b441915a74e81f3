// Every tolerance of the reading of welded surfaces, in one place: name, value, unit, reason.
#pragma once

#include <cstddef>

namespace copse {

// --- band_growth

// Radians: a vertex whose triangles' angles sum to less is the pointed end of a limb. 2 pi is flat; the
// corner of a cube has 3/2 pi; this is a cone whose side is 39 degrees off its axis.
inline constexpr double k_point_angle = 1.25 * 3.14159265358979323846;

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
// How much being low counts against being thick when the root is looked for: an end at the top must be this
// share thicker than one at the bottom.
inline constexpr double k_lowness = 0.5;
// Weight of the mean of the limbs' ends against their axes where limbs meet: enough to decide for parallel
// axes, too little to move the crossing of others by more than a few hundredths of the gap.
inline constexpr double k_meeting_pull = 0.02;

}  // namespace copse
