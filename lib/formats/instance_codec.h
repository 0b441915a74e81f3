// Instances to 24 or 48 bytes and back. Unpacking is exact: the same numbers everywhere.
//
// A rotation is stored as the three parts of its quaternion that are not the largest (Shoemake's "smallest
// three"), each in 2^20 - 1 steps over [-1/sqrt 2, 1/sqrt 2], 0 among them; the largest follows from the
// length.
#pragma once

#include "lib/formats/ecosystem.h"

namespace copse {

// The step of `extent` >= 0 that 21 bits can hold: a power of two; 0 for 0.
float position_step(double extent);

// Steps from `origin`, rounded to the nearest; clamped to what 21 bits hold.
std::uint64_t pack_position(const Double3& position, const InstanceBlock& block);
Double3 unpack_position(std::uint64_t packed, const InstanceBlock& block);

// Precondition: length 1. The largest angle between a rotation and what comes back is
// k_packed_rotation_error.
std::uint64_t pack_rotation(const Quaternion& rotation);
Quaternion unpack_rotation(std::uint64_t packed);
// Radians. Half a step is 6.75e-7, so the three are off by at most 1.17e-6 together; the largest, at least
// 1/2, by sqrt(3)/2 / (1/2) of that; an angle is twice the distance of two quaternions.
inline constexpr double k_packed_rotation_error = 4.8e-6;

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
