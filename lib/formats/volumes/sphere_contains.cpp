#include "lib/formats/volumes/sphere_contains.h"

#include <array>
#include <cmath>
#include <cstddef>

namespace copse {
namespace {

// A number as an unevaluated sum of doubles that do not overlap, by ascending magnitude.
class Expansion {
 public:
  void add(double value) {
    std::size_t kept = 0;
    double carry = value;
    for (std::size_t i = 0; i < size_; ++i) {  // grow-expansion, dropping zeros
      const double sum = carry + terms_[i];
      const double part = sum - carry;
      const double error = (carry - (sum - part)) + (terms_[i] - part);
      carry = sum;
      if (error != 0) terms_[kept++] = error;
    }
    if (carry != 0) terms_[kept++] = carry;
    size_ = kept;
  }
  void add_product(double a, double b) {
    const double product = a * b;
    add(std::fma(a, b, -product));
    add(product);
  }
  // The last term outweighs all before it.
  bool is_positive() const { return size_ > 0 && terms_[size_ - 1] > 0; }

 private:
  std::array<double, 32> terms_{};  // at most 4 squares of 6 terms each
  std::size_t size_ = 0;
};

// a - b, exactly, as a rounded difference and its error.
struct Difference {
  double high, low;
  Difference(double a, double b) : high(a - b) {
    const double part = high - a;
    low = (a - (high - part)) - (b + part);
  }
};

void add_square(Expansion& sum, const Difference& d, double sign) {
  sum.add_product(sign * d.low, d.low);
  sum.add_product(sign * 2 * d.low, d.high);
  sum.add_product(sign * d.high, d.high);
}

}  // namespace

bool sphere_contains(const Float3& centre, float radius, const Float3& point) {
  return sphere_contains(centre, radius, point, 0);
}

bool sphere_contains(const Float3& centre, float radius, const Float3& inner_centre, float inner_radius) {
  if (inner_radius > radius) return false;
  const Difference x(inner_centre.x, centre.x), y(inner_centre.y, centre.y), z(inner_centre.z, centre.z);
  const Difference room(radius, inner_radius);
  const double distance = x.high * x.high + y.high * y.high + z.high * z.high;
  const double reach = room.high * room.high;
  // Each side is within 5 roundings (2^-53 each) of its exact value; 2^-48 leaves plenty.
  constexpr double k_band = 0x1p-48;
  if (distance <= reach * (1 - k_band)) return true;
  if (distance > reach * (1 + k_band)) return false;
  Expansion excess;
  add_square(excess, x, 1), add_square(excess, y, 1), add_square(excess, z, 1);
  add_square(excess, room, -1);
  return !excess.is_positive();
}

}  // namespace copse
