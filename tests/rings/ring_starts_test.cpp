#include "lib/analysis/rings/ring_starts.h"

#include "tests/trunk/tube_maker.h"

#include <algorithm>
#include <numeric>

#include <gtest/gtest.h>

namespace copse {
namespace {

struct Started {
  Started() = default;
  explicit Started(const TubeShape& shape) {
    TubeMaker maker;
    maker.add(shape);
    trunk = make_trunk_mesh(maker.mesh, all_trunk(maker.mesh));
    fans = make_fans(trunk.positions.size(), trunk.triangles);
    vertices.resize(trunk.positions.size());
    std::iota(vertices.begin(), vertices.end(), 0u);
    triangles.resize(trunk.triangles.size());
    std::iota(triangles.begin(), triangles.end(), 0u);
  }
  TrunkMesh trunk;
  Fans fans;
  std::vector<std::uint32_t> vertices, triangles;
};

TubeShape shape_of(int sides, TubeEnd first, TubeEnd last) {
  TubeShape shape;
  shape.axis = axis_between({0, 0, 0}, {0, 4, 0}, 4);
  shape.radius = taper_between(0.5, 0.3, 4);
  shape.sides = sides;
  shape.first = first;
  shape.last = last;
  return shape;
}

TEST(RingStarts, FindTheLoopsOfAnOpenTube) {
  const Started tube(shape_of(7, TubeEnd::open, TubeEnd::open));
  RingStarts starts(tube.trunk, tube.fans);
  EXPECT_EQ(starts.first_on_boundary(tube.vertices), 0u);
  const auto loops = starts.loops(tube.vertices);
  ASSERT_EQ(loops.size(), 2u);
  EXPECT_EQ(loops[0].size(), 7u);
  EXPECT_EQ(loops[0][0], 0u);
  EXPECT_EQ(loops[1][0], 21u);
  EXPECT_EQ(starts.loop_through(22).size(), 7u);
}

TEST(RingStarts, FindNoBoundaryOnAClosedTubeButItsApexes) {
  for (const int sides : {3, 5, 6, 12}) {
    const Started tube(shape_of(sides, TubeEnd::fan, TubeEnd::point));
    RingStarts starts(tube.trunk, tube.fans);
    EXPECT_EQ(starts.first_on_boundary(tube.vertices), k_none);
    const auto apex = static_cast<std::uint32_t>(4 * sides);
    EXPECT_TRUE(starts.may_be_apex(apex));
    EXPECT_TRUE(starts.may_be_apex(apex + 1));
    if (sides > 5) {
      EXPECT_EQ(std::ranges::count_if(tube.vertices, [&](std::uint32_t v) { return starts.may_be_apex(v); }),
                2);
    }
  }
}

TEST(RingStarts, FindTheRimsOfLids) {
  const Started tube(shape_of(9, TubeEnd::lid, TubeEnd::lid));
  RingStarts starts(tube.trunk, tube.fans);
  const auto rims = starts.lids(tube.triangles, 0.9);
  const auto is_ring = [&](std::uint32_t first) {
    return std::ranges::any_of(rims, [&](const auto& rim) {
      return rim.size() == 9 &&
             std::ranges::all_of(rim, [&](std::uint32_t v) { return v >= first && v < first + 9; });
    });
  };
  EXPECT_TRUE(is_ring(0));
  EXPECT_TRUE(is_ring(27));
}

TEST(RingStarts, StartStripsAtTheirEars) {
  const Started strip(shape_of(2, TubeEnd::open, TubeEnd::open));
  RingStarts starts(strip.trunk, strip.fans);
  const auto rungs = starts.rungs(strip.vertices);
  EXPECT_EQ(rungs.size(), 6u);  // two ears: two edges and the point of each
  EXPECT_TRUE(std::ranges::any_of(rungs, [](auto r) {
    std::ranges::sort(r);
    return r == std::vector<std::uint32_t>{0, 1};
  }));
}

// Triangles with these corners, as they are.
Started started(std::size_t vertices, std::vector<Triangle> triangles) {
  Started all;
  all.trunk.positions.assign(vertices, {});
  all.trunk.triangles = std::move(triangles);
  all.fans = make_fans(vertices, all.trunk.triangles);
  all.vertices.resize(vertices);
  std::iota(all.vertices.begin(), all.vertices.end(), 0u);
  return all;
}

// Pages on one edge, each with a loop that touches the others at both its ends; or a disc with one hub.
TEST(RingStarts, LookAtEachEdgeOfALargeFanOnce) {
  for (const std::uint32_t n : {1000u, 100000u}) {
    std::vector<Triangle> pages, disc;
    for (std::uint32_t i = 0; i < n; ++i) pages.push_back({0, 1, i + 2});
    for (std::uint32_t i = 0; i < n; ++i) disc.push_back({0, i + 1, (i + 1) % n + 1});
    const Started book = started(n + 2, std::move(pages)), wheel = started(n + 1, std::move(disc));
    RingStarts of_book(book.trunk, book.fans), of_wheel(wheel.trunk, wheel.fans);
    EXPECT_TRUE(of_book.loops(book.vertices).empty());
    EXPECT_EQ(of_wheel.loops(wheel.vertices).size(), 1u);
    EXPECT_EQ(of_book.edges_looked_at(), 6 * n);
    EXPECT_EQ(of_wheel.edges_looked_at(), 6 * n);
  }
}

// Two strips that touch in vertex 0: the long boundary that leads there is walked once, from whichever
// vertex.
TEST(RingStarts, GiveUpAWayThatTouchesItselfForAllItsVertices) {
  const std::uint32_t n = 200000;
  std::vector<Triangle> strip;
  for (std::uint32_t i = 0; i + 2 < n; ++i) strip.push_back({i, i + 1, i + 2});
  strip.push_back({0, n, n + 1});
  const Started touching = started(n + 2, std::move(strip));
  RingStarts starts(touching.trunk, touching.fans);
  EXPECT_TRUE(starts.loops(touching.vertices).empty());
}

}  // namespace
}  // namespace copse
