#include "lib/runtime/upper_index.h"

#include "lib/formats/random.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

namespace copse {
namespace {

struct Scene {
  std::vector<Float3> at;
  explicit Scene(std::uint32_t n, std::uint64_t seed) {
    Random random(seed);
    for (std::uint32_t i = 0; i < n; ++i) {
      at.push_back(to_float(Double3{random.around(0, 50), random.around(0, 5), random.around(0, 50)}));
    }
  }
  FloatBox box(std::uint32_t i) const { return {at[i] - Float3{1, 1, 1}, at[i] + Float3{1, 2, 1}}; }
  void place(UpperIndex& index) const {
    for (std::uint32_t i = 0; i < at.size(); ++i) index.place(i, box(i));
  }
};

std::vector<FloatPlane> some_planes(Random& random) {
  std::vector<FloatPlane> planes;
  for (int i = 0; i < 4; ++i) {
    const Double3 n = normalized(Double3{random.around(0, 1), random.around(0, 1), random.around(0, 1)});
    planes.push_back({to_float(n), static_cast<float>(random.uniform(0, 30))});
  }
  return planes;
}

void expect_as_one_by_one(const UpperIndex& index, const Scene& scene, std::uint64_t seed) {
  Random random(seed);
  for (int i = 0; i < 20; ++i) {
    const std::vector<FloatPlane> planes = some_planes(random);
    std::vector<std::uint32_t> found, wanted;
    index.in_frustum(planes, 15, [&](std::uint32_t thing, std::uint32_t left) {
      found.push_back(thing);
      std::uint32_t own = 15;
      in_frustum(Volume<float>(scene.box(thing)), planes, own);
      EXPECT_EQ(left & ~own, 0u) << "a plane that is decided was left";
    });
    for (std::uint32_t t = 0; t < scene.at.size(); ++t) {
      std::uint32_t mask = 15;
      if (in_frustum(Volume<float>(scene.box(t)), planes, mask) != Visibility::outside) wanted.push_back(t);
    }
    std::sort(found.begin(), found.end());
    EXPECT_EQ(found, wanted);
  }
}

TEST(UpperIndex, FindsWhatTestingOneByOneFinds) {
  for (const std::uint32_t n : {0u, 1u, 2u, 3u, 100u, 777u}) {
    const Scene scene(n, n);
    UpperIndex index(n);
    scene.place(index);
    EXPECT_TRUE(index.update());
    expect_as_one_by_one(index, scene, n + 1);
  }
}

TEST(UpperIndex, FollowsThingsThatMoveAndOrdersAnewOnlyWhenTheyHaveDrifted) {
  Scene scene(500, 1);
  UpperIndex index(500);
  scene.place(index);
  EXPECT_TRUE(index.update());
  EXPECT_FALSE(index.update());
  Random random(2);
  int anew = 0;
  for (int frame = 0; frame < 60; ++frame) {
    for (Float3& p : scene.at) p += to_float(Double3{random.around(0, 4), 0, random.around(0, 4)});
    scene.place(index);
    anew += index.update();
    if (frame % 10 == 0) expect_as_one_by_one(index, scene, 100 + static_cast<std::uint64_t>(frame));
  }
  EXPECT_GT(anew, 0);
  EXPECT_LT(anew, 20);
}

// Beside the box of one that is far away those of all others are nothing.
TEST(UpperIndex, OneThatIsFarAwayDoesNotHideThatTheOthersHaveScrambled) {
  Scene scene(500, 7);
  scene.at[0] = {1e6f, 1e6f, 1e6f};
  UpperIndex index(500);
  scene.place(index);
  EXPECT_TRUE(index.update());
  EXPECT_FALSE(index.update());
  Random random(5);
  random.shuffle(std::span(scene.at).subspan(1));
  scene.place(index);
  EXPECT_TRUE(index.update());
  expect_as_one_by_one(index, scene, 9);
  int anew = 0;
  for (int frame = 0; frame < 100; ++frame) {  // alone on its way, it makes no one else's order worse
    scene.at[0] = scene.at[0] + Float3{1e4f, 0, 0};
    scene.place(index);
    anew += index.update();
  }
  EXPECT_LE(anew, 3);
}

TEST(UpperIndex, ThingsInOnePlaceAreNoSpecialCase) {
  Scene scene(64, 3);
  for (Float3& p : scene.at) p = {1, 2, 3};
  UpperIndex index(64);
  scene.place(index);
  index.update();
  std::size_t seen = 0;
  index.in_frustum({}, 0, [&](std::uint32_t, std::uint32_t) { ++seen; });
  EXPECT_EQ(seen, 64u);
}

}  // namespace
}  // namespace copse
