#include "lib/analysis/ecosystem/disc_cover.h"

#include <array>
#include <cmath>

namespace copse {
namespace {

constexpr double k_tolerance = 1e-9;  // of a radius
constexpr std::size_t k_no_disc = ~std::size_t{0};

// Coordinates count from the middle of the patch, so that they are small wherever it is.
class Cover {
 public:
  Cover(const Patch& patch, std::span<const Disc> discs, double growth)
      : x_(patch.x + patch.width / 2),
        z_(patch.z + patch.depth / 2),
        half_x_(patch.width / 2),
        half_z_(patch.depth / 2),
        discs_(discs),
        growth_(growth) {}

  // `action` is called with the open corners until it answers false.
  template <class Action>
  void open_corners(const Action& action) const {
    for (const double sx : {-half_x_, half_x_})
      for (const double sz : {-half_z_, half_z_})
        if (!tell({sx, sz}, k_no_disc, k_no_disc, action)) return;
    for (std::size_t i = 0; i < discs_.size(); ++i)
      if (!border_crossings(i, action)) return;
    for (std::size_t i = 0; i < discs_.size(); ++i)
      for (std::size_t k = 0; k < i; ++k)
        if (!circle_crossings(i, k, action)) return;
  }
  GroundPlace place(const GroundPlace& local) const { return {x_ + local.x, z_ + local.z}; }

 private:
  GroundPlace centre(std::size_t i) const { return {discs_[i].x - x_, discs_[i].z - z_}; }
  double radius(std::size_t i) const { return discs_[i].radius + growth_; }

  // What is on the border, within rounding, is told of by the border's own corners.
  double inside_x(std::size_t i) const { return half_x_ - k_tolerance * radius(i); }
  double inside_z(std::size_t i) const { return half_z_ - k_tolerance * radius(i); }

  template <class Action>
  bool tell(const GroundPlace& at, std::size_t on, std::size_t on_too, const Action& action) const {
    for (std::size_t i = 0; i < discs_.size(); ++i) {
      if (i == on || i == on_too) continue;
      const GroundPlace c = centre(i);
      const double dx = at.x - c.x, dz = at.z - c.z, reach = radius(i) * (1 + k_tolerance);
      if (dx * dx + dz * dz < reach * reach) return true;
    }
    return action(at);
  }

  template <class Action>
  bool border_crossings(std::size_t i, const Action& action) const {
    const GroundPlace c = centre(i);
    const double squared = radius(i) * radius(i);
    for (const double x : {-half_x_, half_x_}) {
      const double rest = squared - (x - c.x) * (x - c.x);
      if (!(rest > 0)) continue;
      for (const double z : {c.z - std::sqrt(rest), c.z + std::sqrt(rest)})
        if (std::abs(z) < inside_z(i) && !tell({x, z}, i, k_no_disc, action)) return false;
    }
    for (const double z : {-half_z_, half_z_}) {
      const double rest = squared - (z - c.z) * (z - c.z);
      if (!(rest > 0)) continue;
      for (const double x : {c.x - std::sqrt(rest), c.x + std::sqrt(rest)})
        if (std::abs(x) < inside_x(i) && !tell({x, z}, i, k_no_disc, action)) return false;
    }
    return true;
  }

  template <class Action>
  bool circle_crossings(std::size_t i, std::size_t k, const Action& action) const {
    const GroundPlace a = centre(i), b = centre(k);
    const double dx = b.x - a.x, dz = b.z - a.z, squared = dx * dx + dz * dz, r = radius(i), s = radius(k);
    if (!(squared > 0)) return true;
    const double along = ((r - s) * (r + s) / squared + 1) / 2, rest = r * r / squared - along * along;
    if (!(rest >= 0)) return true;
    const double across = std::sqrt(rest);
    for (const double side : {-across, across}) {
      const GroundPlace at{a.x + along * dx - side * dz, a.z + along * dz + side * dx};
      if (std::abs(at.x) < inside_x(i) && std::abs(at.z) < inside_z(i) && !tell(at, i, k, action))
        return false;
    }
    return true;
  }

  double x_, z_, half_x_, half_z_;
  std::span<const Disc> discs_;
  double growth_;
};

}  // namespace

bool is_covered(const Patch& patch, std::span<const Disc> discs, double growth) {
  bool covered = true;
  Cover(patch, discs, growth).open_corners([&](const GroundPlace&) { return covered = false; });
  return covered;
}

std::optional<GroundPlace> open_middle(const Patch& patch, std::span<const Disc> discs, double growth) {
  const Cover cover(patch, discs, growth);
  GroundPlace sum;
  double count = 0;
  cover.open_corners([&](const GroundPlace& at) {
    sum.x += at.x, sum.z += at.z, ++count;
    return true;
  });
  if (!(count > 0)) return std::nullopt;
  return cover.place({sum.x / count, sum.z / count});
}

}  // namespace copse
