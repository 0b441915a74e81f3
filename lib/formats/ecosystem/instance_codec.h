// Instances to 24 or 48 bytes and back. Unpacking is exact: the same numbers everywhere.
//
// A rotation is stored as where it takes +Y, the trunk's axis, and a turn about that axis, because an axis
// that leans shows more than a head that is turned: the axis as a point of the octahedron |x| + |y| + |z| = 1
// (Meyer et al. 2010; x and z in 2^22 - 1 steps, the lower half folded out), from which the shortest rotation
// follows, and then the head as the tangent of a quarter of its angle, in 2^20 - 1 steps over [-1, 1].
// Upright is exact. Unpacking takes square roots and divisions alone.
#pragma once

#include "lib/formats/ecosystem/ecosystem.h"

namespace copse {

// The step of `extent` >= 0 that 21 bits can hold: a power of two; 0 for 0.
float position_step(double extent);

// Steps from `origin`, rounded to the nearest; clamped to what 21 bits hold.
std::uint64_t pack_position(const Double3& position, const InstanceBlock& block);
Double3 unpack_position(std::uint64_t packed, const InstanceBlock& block);

// Precondition: length 1. The largest angle between a rotation and what comes back is
// k_packed_rotation_error, that between their axes k_packed_axis_error.
std::uint64_t pack_rotation(const Quaternion& rotation);
Quaternion unpack_rotation(std::uint64_t packed);
// Whether the bits mean a rotation: all but the one code of each part that is one step too many.
bool is_packed_rotation(std::uint64_t packed);
// Radians. Of the four lattice points around an axis the nearest is taken: in the middle of a face, where it
// is worst, they lie 2 sqrt 2 half-steps of 2.4e-7 apart in triangles on a plane at 1 / sqrt 3.
inline constexpr double k_packed_axis_error = 6.8e-7;
// Half a step of the head is 9.54e-7, and the angle is 4 atan of it.
inline constexpr double k_packed_rotation_error = 3.9e-6;

std::uint16_t pack_scale(double scale, const TreeType& type);
double unpack_scale(std::uint16_t packed, const TreeType& type);

// All of it. A material index of 255 or more, or a motion above 255, does not fit 24 bytes: a precondition.
PackedInstance pack(const Instance& instance, const InstanceBlock& block, const TreeType& type);
Instance unpack(const PackedInstance& packed, const InstanceBlock& block, const TreeType& type);
ExactInstance pack_exactly(const Instance& instance, const InstanceBlock& block);
Instance unpack(const ExactInstance& exact, const InstanceBlock& block);

// Instance `index` of the file, which lies in `block`.
Instance instance_of(const Ecosystem& eco, const InstanceBlock& block, std::size_t index);

// v turned by q.
Double3 rotate(const Quaternion& q, const Double3& v);

// The box of `box` scaled, turned and moved: of its eight corners, in double. Empty stays empty.
DoubleBox transformed(const FloatBox& box, const Instance& instance);

}  // namespace copse
