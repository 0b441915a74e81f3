// The least volume round a few points is the same however they are turned: small hulls have few, deep
// valleys, and a search that depends on the axes misses some of them.
#include "lib/analysis/boxes/minimal_box.h"
#include "lib/analysis/round/cylinders.h"
#include "lib/analysis/swept/capsule.h"
#include "lib/analysis/swept/lozenge.h"
#include "lib/analysis/swept/minimal_capsule.h"
#include "lib/analysis/swept/minimal_lozenge.h"
#include "lib/analysis/volumes/volume_measures.h"
#include "lib/formats/random.h"

#include <array>
#include <limits>
#include <numbers>
#include <string>

#include <fmt/format.h>
#include <gtest/gtest.h>

namespace copse {
namespace {

using Points = std::vector<Double3>;

std::array<double, 4> least_volumes(const Points& points) {
  const ConvexHull hull = convex_hull(make_point_cloud(points).value());
  const auto out = [&](double volume) { return hull.frame.volume_out(volume); };
  MinimalCylinderOptions search_alone;
  search_alone.gap = std::numeric_limits<double>::infinity();
  return {out(measures_of(minimal_box(hull).volume).volume),
          out(interior_volume(minimal_capsule(hull).volume)),
          out(measures_of(minimal_cylinder(hull, search_alone).volume).volume),
          out(interior_volume(minimal_lozenge(hull).volume))};
}

TEST(Rotations, DoNotChangeTheLeastVolumesRoundAFewPoints) {
  constexpr std::array k_names{"box", "capsule", "cylinder", "lozenge"};
  for (int n = 4; n <= 12; ++n) {
    for (int set = 0; set < 2; ++set) {
      Random random(100 * n + set);
      const Double3 half{1, random.uniform(0.1, 1), random.uniform(0.05, 1)};
      Points points;
      for (int i = 0; i < n; ++i)
        points.push_back({random.around(0, half.x), random.around(0, half.y), random.around(0, half.z)});
      const auto base = least_volumes(points);
      for (int k = 0; k < 3; ++k) {
        const Axes frame =
            turned(k_world_axes, {random.around(0, 2), random.around(0, 2), random.around(0, 2)});
        Points there;
        for (const Double3& p : points) there.push_back(into(frame, p));
        const auto volumes = least_volumes(there);
        for (std::size_t t = 0; t < k_names.size(); ++t) {
          EXPECT_NEAR(volumes[t] / base[t], 1, 1e-6) << k_names[t] << " of " << n << " points, set " << set;
        }
      }
    }
  }
}

// A regular polygon at the bottom and one at the top, turned by half a step or not.
Points drum(int sides, double height, bool anti) {
  Points out;
  for (int i = 0; i < 2 * sides; ++i) {
    const bool top = i % 2 == 1;
    const double turn = 2 * std::numbers::pi * (i / 2 + (anti && top ? 0.5 : 0)) / sides;
    out.push_back({std::cos(turn), std::sin(turn), top ? height : 0});
  }
  return out;
}

// Along the axis of the drum, of all lengths.
double least_upright_capsule(double height) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i <= 2000; ++i) {
    const double l = height * i / 2000, cap = (height - l) / 2, square = 1 + cap * cap;
    least = std::min(least, std::numbers::pi * square * (l + 4.0 / 3 * std::sqrt(square)));
  }
  return least;
}

void expect_drums_least_volumes(int sides, double height, bool anti) {
  constexpr std::array k_names{"box", "capsule", "cylinder", "lozenge"};
  // Round a low prism of five sides lozenges of two valleys differ by some 1e-5, and either is found.
  constexpr std::array k_rooms{1e-6, 1e-6, 1e-6, 1e-4};
  const Points points = drum(sides, height, anti);
  const auto base = least_volumes(points);
  const std::string name = fmt::format("{} sides, {} high, anti {}", sides, height, anti);
  EXPECT_LE(base[1], least_upright_capsule(height) * (1 + 1e-6)) << name;
  EXPECT_LE(base[3], base[1] * (1 + 1e-9)) << name;
  const Axes frame = turned(k_world_axes, {0.3 * sides, 0.7, height});
  Points there;
  for (const Double3& p : points) there.push_back(into(frame, p));
  const auto volumes = least_volumes(there);
  for (std::size_t t = 0; t < k_names.size(); ++t)
    EXPECT_NEAR(volumes[t] / base[t], 1, k_rooms[t]) << k_names[t] << ": " << name;
}

TEST(Rotations, DoNotHideTheLeastVolumesRoundRegularPrismsAndAntiprisms) {
  for (const int sides : {3, 4, 5, 7, 10, 16, 32}) {
    for (const double height : {0.5, 1.2, 1.5, 3.0}) {
      for (const bool anti : {false, true}) expect_drums_least_volumes(sides, height, anti);
    }
  }
}

// Nearly a ball's: their least lozenges have many narrow valleys, of turns and of radii.
TEST(Rotations, DoNotHideTheLeastVolumesRoundPrismsAsHighAsTheirRadius) {
  for (int sides = 3; sides <= 24; ++sides) expect_drums_least_volumes(sides, 1, sides % 4 >= 2);
  for (const int sides : {10, 12, 20}) expect_drums_least_volumes(sides, 1, sides % 4 < 2);
}

TEST(Rotations, DoNotChangeTheLeastCylindersAndLozengesRoundPlates) {
  for (const double thick : {1e-2, 1e-4, 1e-6}) {
    Random random(static_cast<std::uint64_t>(-std::log10(thick)));
    for (const int n : {6, 14, 30}) {
      Points points;
      for (int i = 0; i < n; ++i)
        points.push_back({random.around(0, 1), random.around(0, 1), random.around(0, thick)});
      const auto base = least_volumes(points);
      for (int k = 0; k < 4; ++k) {
        const Axes frame =
            turned(k_world_axes, {random.around(0, 2), random.around(0, 2), random.around(0, 2)});
        Points there;
        for (const Double3& p : points) there.push_back(into(frame, p));
        const auto volumes = least_volumes(there);
        EXPECT_NEAR(volumes[3] / base[3], 1, 1e-3) << thick << ", " << n;
        // Ends that are `thick` apart tell the axis to a rounding of that, by which the rim rises and falls.
        EXPECT_NEAR(volumes[2] / base[2], 1, 1e-6 + 1e-16 / thick / thick) << thick << ", " << n;
      }
    }
  }
}

}  // namespace
}  // namespace copse
