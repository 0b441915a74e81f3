// How an instance leans: the rotation that takes +Y to the terrain's normal, and the two angles of the thesis
// as a baseline.
//
// Source: digest 000, section 2.3, errata E1 to E4. The rotation of an instance is R_tilt * Ry(head): head
// spins about the trunk's own axis first.
#pragma once

#include "lib/formats/ecosystem/ecosystem.h"

namespace copse {

// `n` with length 1 and y >= 0; (0, 1, 0) when it has no direction (hazard H18).
Double3 upward(const Double3& n);

// The shortest rotation from +Y to `normal`, of length 1 and y >= 0.
Quaternion tilt_to(const Double3& normal);

// Rz(roll) * Rx(pitch): what the user writes as pitch and roll, in degrees.
Quaternion tilt_of(double pitch, double roll);

// tilt * Ry(head).
Quaternion with_head(const Quaternion& tilt, double head);

// `rotation`, whose axis is along one upward normal, with its axis along another and its head as it was.
Quaternion leaned(const Quaternion& rotation, const Double3& normal);

// head, pitch and roll, in degrees, of a rotation: with_head(tilt_of(pitch, roll), head) gives it back. Head
// in
// (-180, 180]. For people and CSV files; computed with the library's atan2.
struct Angles {
  double head = 0, pitch = 0, roll = 0;
};
Angles angles_of(const Quaternion& rotation);

// The listing of the thesis, its sign mended (E1): both angles taken alone, from the other two components.
// Only exact where n.x = 0 or n.z = 0 (E3).
Angles thesis_tilt(const Double3& normal);

// The angle in degrees between `normal` and where the thesis' two angles put +Y.
double thesis_tilt_error(const Double3& normal);

}  // namespace copse
