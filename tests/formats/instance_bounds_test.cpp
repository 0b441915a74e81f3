#include "lib/formats/ecosystem/instance_bounds.h"

#include "lib/formats/ecosystem/instance_codec.h"
#include "lib/formats/random.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace copse {
namespace {

Quaternion random_rotation(Random& random) {
  Quaternion q{};
  double square = 0;
  for (double& part : q) part = random.uniform(-1, 1), square += part * part;
  for (double& part : q) part /= std::sqrt(square);
  return q;
}

// Axes that are not quite at right angles, as float32 makes them and worse.
const std::array<Float3, 3> k_axes{{{0.6f, 0.8f, 0}, {-0.8f, 0.6f, 0.001f}, {0, 0.001f, 1}}};

std::vector<Volume<float>> volumes() {
  return {FloatBox{{-1, -0.5f, -3}, {2, 7, 0.25f}},
          BoundingSphere<float>{{0.5f, 3, -1}, 4},
          OrientedBox<float>{{0.5f, 3, -1}, k_axes, {2, 4, 1}},
          Capsule<float>{{0, 0, 0}, {1, 6, -2}, 1.5f},
          Cylinder<float>{{0, 0, 0}, {1, 6, -2}, 1.5f},
          Lozenge<float>{{-1, 0, -1}, {2, 0.5f, 0}, {-0.5f, 5, 1}, 0.75f},
          Ellipsoid<float>{{0.5f, 3, -1}, k_axes, {2, 4, 1}}};
}

// The inequalities of volume.h, in double.
bool is_inside(const Volume<float>& volume, const Double3& p) {
  const auto along = [&](const Float3& a, const Double3& q) { return dot(to_double(a), q); };
  const auto share = [&](const Float3& edge, const Double3& q) {
    return std::clamp(along(edge, q) / dot(to_double(edge), to_double(edge)), 0.0, 1.0);
  };
  switch (volume.index()) {
    case 0: {
      const auto& v = std::get<0>(volume);
      for (int a = 0; a < 3; ++a)
        if (p[a] < double{v.min[a]} || p[a] > double{v.max[a]}) return false;
      return true;
    }
    case 1:
      return distance(p, to_double(std::get<1>(volume).centre)) <= double{std::get<1>(volume).radius};
    case 2: {
      const auto& v = std::get<2>(volume);
      for (std::size_t a = 0; a < 3; ++a)
        if (std::abs(along(v.axes[a], p - to_double(v.centre))) > double{v.half_extents[static_cast<int>(a)]})
          return false;
      return true;
    }
    case 3: {
      const auto& v = std::get<3>(volume);
      const Float3 d = v.b - v.a;
      const Double3 q = p - to_double(v.a);
      return length(q - to_double(d) * share(d, q)) <= double{v.radius};
    }
    case 4: {
      const auto& v = std::get<4>(volume);
      const Double3 d = to_double(v.b) - to_double(v.a), q = p - to_double(v.a);
      return dot(q, d) >= 0 && dot(q, d) <= dot(d, d) && length(cross(q, d)) <= double{v.radius} * length(d);
    }
    case 5: {
      const auto& v = std::get<5>(volume);
      const Double3 q = p - to_double(v.origin);
      return length(q - to_double(v.edge0) * share(v.edge0, q) - to_double(v.edge1) * share(v.edge1, q)) <=
             double{v.radius};
    }
    default: {
      const auto& v = std::get<6>(volume);
      double sum = 0;
      for (std::size_t a = 0; a < 3; ++a)
        sum +=
            std::pow(along(v.axes[a], p - to_double(v.centre)) / double{v.semi_axes[static_cast<int>(a)]}, 2);
      return sum <= 1;
    }
  }
}

TEST(InstanceBounds, AVolumeReachesAsFarAsItsFarthestPointAndHardlyFarther) {
  Random random(1);
  for (const Volume<float>& v : volumes()) {
    std::vector<Double3> points;
    while (points.size() < 20000) {
      const Double3 p{random.uniform(-6, 6), random.uniform(-3, 9), random.uniform(-6, 6)};
      if (is_inside(v, p)) points.push_back(p);
    }
    for (int i = 0; i < 50; ++i) {
      const Double3 e = rotate(random_rotation(random), {0, 1, 0});
      double farthest = -1e9;
      for (const Double3& p : points) farthest = std::max(farthest, dot(e, p));
      EXPECT_GE(reach_of(v, e), farthest) << v.index();
      EXPECT_LE(reach_of(v, e), farthest + 0.6) << v.index();
      EXPECT_NEAR(reach_of(v, e * 3.0), 3 * reach_of(v, e), 1e-12);
    }
  }
}

TEST(InstanceBounds, HoldWhatAllVolumesHoldAndAreNoLargerThanTheBoxAlone) {
  Random random(2);
  TreeType type{.bounds = std::get<0>(volumes()[0])};
  type.volumes = volumes();
  std::vector<Double3> points;
  while (points.size() < 2000) {
    const Double3 p{random.uniform(-1, 2), random.uniform(-0.5, 7), random.uniform(-3, 0.25)};
    if (std::all_of(type.volumes.begin(), type.volumes.end(), [&](const auto& v) { return is_inside(v, p); }))
      points.push_back(p);
  }
  for (int i = 0; i < 500; ++i) {
    const Instance instance{.position = {random.uniform(-9, 9), 5, 1e6},
                            .rotation = random_rotation(random),
                            .scale = random.uniform(0.01, 100)};
    const DoubleBox box = instance_bounds(type, instance), alone = transformed(type.bounds, instance);
    for (const Double3& p : points) {
      const Double3 at = instance.position + rotate(instance.rotation, p * instance.scale);
      for (int a = 0; a < 3; ++a)
        ASSERT_TRUE(at[a] >= box.min[a] - 1e-9 && at[a] <= box.max[a] + 1e-9) << i << a;
    }
    for (int a = 0; a < 3; ++a) {
      EXPECT_GE(box.min[a], alone.min[a]);
      EXPECT_LE(box.max[a], alone.max[a]);
    }
  }
}

TEST(InstanceBounds, ASphereKeepsItsSizeHoweverItIsTurned) {
  TreeType type{.bounds = {{-1, -1, -1}, {1, 1, 1}}};
  type.volumes = {BoundingSphere<float>{{0, 0, 0}, 1}};
  const double eighth = 0.38268343236508977;  // of a half turn: sine of 22.5 degrees
  const Instance turned{.rotation = {eighth, 0, 0, std::sqrt(1 - eighth * eighth)}, .scale = 2};
  EXPECT_NEAR(transformed(type.bounds, turned).max.y, 2 * std::sqrt(2.0), 1e-12);
  EXPECT_NEAR(instance_bounds(type, turned).max.y, 2, 1e-12);
}

TEST(InstanceBounds, WhatSwaysHasTheBoxOfItsEnvelope) {
  TreeType type{.bounds = {{-1, 0, -1}, {1, 3, 1}}};
  type.envelopes = {BoundingSphere<float>{{0, 1, 0}, 5}};
  const Instance still{}, moving{.motion = 1};
  EXPECT_EQ(instance_bounds(type, still), transformed(type.bounds, still));
  EXPECT_NEAR(instance_bounds(type, moving).max.y, 6, 1e-9);
  type.envelopes.clear();
  EXPECT_EQ(instance_bounds(type, moving), transformed(type.bounds, moving));
  type.bounds = {};
  EXPECT_TRUE(instance_bounds(type, moving).empty());
}

TEST(InstanceBounds, AKdopLimitsNothing) {
  EXPECT_EQ(reach_of(Kdop<float>{{{1, 0, 0}}, {0}, {1}}, {1, 0, 0}), std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace copse
