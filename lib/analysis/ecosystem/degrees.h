// Sine and cosine of an angle in degrees, the same to the bit on every machine: libraries of mathematics
// differ in the last place, and a forest must not.
//
// The angle is reduced by fmod, which is exact, so 1e6 degrees is as good as 280; multiples of 90 give 0 and
// +-1 exactly. Within 1.2e-16 of the true values. Cost: about 15 multiplications.
#pragma once

namespace copse {

struct SinCos {
  double sin = 0, cos = 1;
};

// Precondition: finite.
SinCos sin_cos_degrees(double degrees);

}  // namespace copse
