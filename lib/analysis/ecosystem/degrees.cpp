#include "lib/analysis/ecosystem/degrees.h"

#include <cmath>

namespace copse {
namespace {

constexpr double k_radians = 0.017453292519943295769;

// Taylor series to the term below 2^-53 at pi/4.
double sine(double x) {
  const double s = x * x;
  double sum = 0;
  for (int n = 17; n >= 3; n -= 2) sum = (1 - sum) * s / (n * (n - 1));
  return x * (1 - sum);
}

double cosine(double x) {
  const double s = x * x;
  double sum = 0;
  for (int n = 18; n >= 2; n -= 2) sum = (1 - sum) * s / (n * (n - 1));
  return 1 - sum;
}

}  // namespace

SinCos sin_cos_degrees(double degrees) {
  const double turn = std::fmod(degrees, 360.0);
  const double quarter = std::floor(turn / 90 + 0.5);
  const double rest = (turn - 90 * quarter) * k_radians;  // at most pi/4
  const double s = sine(rest), c = cosine(rest);
  switch ((static_cast<int>(quarter) % 4 + 4) % 4) {
    case 0:
      return {s, c};
    case 1:
      return {c, -s};
    case 2:
      return {-s, -c};
    default:
      return {-c, s};
  }
}

}  // namespace copse
