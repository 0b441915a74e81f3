#include "lib/analysis/skeleton/surface_skeleton.h"

#include "lib/analysis/trunk/fit.h"
#include "tests/trunk/welded_meshes.h"

#include <cmath>

#include <gtest/gtest.h>

namespace copse {
namespace {

constexpr SkeletonMethod k_methods[] = {SkeletonMethod::levels, SkeletonMethod::flow};

void expect_whole(const Surface& s, const Hierarchy& h) {
  EXPECT_EQ(breach(h, s.positions.size(), s.triangles.size()), "");
  EXPECT_EQ(h.ring_vertices.size(), s.positions.size());
  if (h.radii.size() < 2) return;
  EXPECT_EQ(std::ranges::count(h.segment_of, k_none), 0);
}

struct Bow {
  std::vector<Double3> axis;
  std::vector<double> radii;
};
Bow make_bow(int rings) {
  Bow b;
  for (int i = 0; i <= rings; ++i) {
    const double t = static_cast<double>(i) / rings;
    b.axis.push_back({6 * std::sin(1.2 * t), 10 * t, 2 * t * t});
    b.radii.push_back(0.8 - 0.6 * t);
  }
  return b;
}

TEST(SurfaceSkeleton, FollowsABentTubeWithItsRadius) {
  const Bow bow = make_bow(60);
  const Surface s = surface_of(tube(bow.axis, bow.radii, 10, true));
  const double centre[] = {0.02, 0.25}, diameter[] = {0.02, 0.3};  // shares of the radius, by method
  for (const SkeletonMethod method : k_methods) {
    const auto m = static_cast<std::size_t>(method);
    const Hierarchy h = surface_skeleton(s, method);
    expect_whole(s, h);
    ASSERT_GE(h.radii.size(), 4u);
    EXPECT_LT(h.radii[0].centre.y, 0.3);
    for (std::uint32_t r = 1; r + 1 < h.radii.size(); ++r) {
      double off = INFINITY, radius = 0;
      for (std::size_t i = 0; i + 1 < bow.axis.size(); ++i) {
        const Double3 d = bow.axis[i + 1] - bow.axis[i];
        const double t = std::clamp(dot(h.radii[r].centre - bow.axis[i], d) / dot(d, d), 0.0, 1.0);
        const double away = distance(bow.axis[i] + d * t, h.radii[r].centre);
        if (away < off) off = away, radius = bow.radii[i] + (bow.radii[i + 1] - bow.radii[i]) * t;
      }
      EXPECT_LT(off, centre[m] * radius) << r;
      EXPECT_NEAR(h.radii[r].diameter / (2 * radius), 1, diameter[m]) << r;
    }
  }
}

TEST(SurfaceSkeleton, HasALimbForEachLimb) {
  std::vector<Cell> cells;
  for (int y = 0; y < 14; ++y) cells.push_back({0, y, 0});
  for (int x = 1; x < 8; ++x) cells.push_back({x, 6, 0});
  for (int z = 1; z < 7; ++z) cells.push_back({0, 10, z});
  const Surface s = surface_of(smooth_cells(cells, 2));
  for (const SkeletonMethod method : k_methods) {
    const Hierarchy h = surface_skeleton(s, method);
    expect_whole(s, h);
    std::uint32_t branches = 0;
    for (const RadiusNode& r : h.radii) branches = std::max(branches, r.branch + 1);
    EXPECT_EQ(branches, 3u);
    EXPECT_LT(fit_of(s, h).cost(), 0.01);
    for (std::uint32_t r = 1; r < h.radii.size(); ++r) {
      const RadiusNode &child = h.radii[r], &parent = h.radii[child.parent];
      const Double3 c = child.centre, p = parent.centre;
      if (c.x < 1 || child.branch == parent.branch) continue;  // where the lower limb leaves the trunk
      EXPECT_NEAR(p.y, 6.5, 1);
      EXPECT_NEAR(p.x, 0.5, 0.3);
    }
  }
}

TEST(SurfaceSkeleton, OfABallIsAShortAxis) {
  const Surface s = surface_of(sphere(15, 24, 2));
  for (const SkeletonMethod method : k_methods) {
    const Hierarchy h = surface_skeleton(s, method);
    expect_whole(s, h);
    EXPECT_GE(h.radii.size(), 2u);
    EXPECT_LE(h.radii.size(), 5u);
    for (const RadiusNode& r : h.radii) {
      EXPECT_LE(length(r.centre), 2.2);
      EXPECT_LE(r.diameter, 4.2);
    }
  }
}

TEST(SurfaceSkeleton, CutsATorus) {
  const Surface s = surface_of(torus(40, 10, 5, 1));
  for (const SkeletonMethod method : k_methods) {
    const Hierarchy h = surface_skeleton(s, method);
    expect_whole(s, h);
    for (const RadiusNode& r : h.radii) {
      if (r.parent == k_none) continue;  // a torus has no end: where it is cut, one is only put near it
      EXPECT_NEAR(std::hypot(r.centre.x, r.centre.y), 5, 0.6);
      EXPECT_NEAR(r.diameter, 2, 0.2);
    }
  }
}

TEST(SurfaceSkeleton, OfAMoebiusStripIsSound) {
  const Surface s = surface_of(moebius(40));
  for (const SkeletonMethod method : k_methods) expect_whole(s, surface_skeleton(s, method));
}

TEST(SurfaceSkeleton, OfATriangleIsSound) {
  const TrunkMesh one{{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}, {0}, {0}};
  const TrunkMesh needle{{{0, 0, 0}, {1e-30, 1, 0}, {0, 2, 0}}, {{0, 1, 2}}, {0}, {0}};
  const TrunkMesh far{{{1e7, 1e7, 1e7}, {1e7 + 1, 1e7, 1e7}, {1e7, 1e7 + 1, 1e7}}, {{0, 1, 2}}, {0}, {0}};
  for (const TrunkMesh& mesh : {one, needle, far}) {
    const Surface s = surface_of(mesh);
    for (const SkeletonMethod method : k_methods) {
      const Hierarchy h = surface_skeleton(s, method);
      expect_whole(s, h);
      EXPECT_GE(h.radii.size(), 1u);
    }
  }
  EXPECT_TRUE(surface_skeleton(Surface{}).radii.empty());
}

TEST(SurfaceSkeleton, DoesNotDependOnTheScale) {
  const Bow bow = make_bow(20);
  TrunkMesh mesh = tube(bow.axis, bow.radii, 7, true);
  const Hierarchy one = surface_skeleton(surface_of(mesh));
  for (const double scale : {1e-25, 1e25}) {
    TrunkMesh scaled = mesh;
    for (Double3& p : scaled.positions) p *= scale;
    const Hierarchy other = surface_skeleton(surface_of(scaled));
    ASSERT_EQ(other.radii.size(), one.radii.size());
    for (std::size_t r = 0; r < one.radii.size(); ++r) {
      EXPECT_LT(distance(other.radii[r].centre / scale, one.radii[r].centre), 1e-9);
    }
  }
}

TEST(SurfaceSkeleton, IsTheSameTwice) {
  const Surface s = surface_of(fork_tree({.depth = 4}).mesh);
  for (const SkeletonMethod method : k_methods) {
    const Hierarchy a = surface_skeleton(s, method), b = surface_skeleton(s, method);
    ASSERT_EQ(a.radii.size(), b.radii.size());
    for (std::size_t r = 0; r < a.radii.size(); ++r) {
      EXPECT_EQ(a.radii[r].centre, b.radii[r].centre);
      EXPECT_EQ(a.radii[r].diameter, b.radii[r].diameter);
      EXPECT_EQ(a.radii[r].parent, b.radii[r].parent);
    }
    EXPECT_EQ(a.segment_of, b.segment_of);
  }
}

}  // namespace
}  // namespace copse
