#include "lib/analysis/swept/swept_search.h"

#include "tests/volumes/point_sets.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(SweptSearch, IsNeverWorseThanADescentFromAnyOfManyRandomFrames) {
  Random random(5);
  for (const NamedPoints& s : mixed_sets()) {
    for (const Swept kind : {Swept::capsule, Swept::lozenge}) {
      const double found = search_around(kind, s.points).volume();
      for (int k = 0; k < 12; ++k) {
        const Axes start = turned(k_world_axes, in_box(random, {1, 1, 1}));
        EXPECT_LE(found, descend_around(kind, s.points, start).volume() * 1.001) << s.name;
      }
    }
  }
}

TEST(SweptSearch, FindsTheThinnestLineThroughACube) {
  // The projection of a cube along a body diagonal is the hexagon with circumradius sqrt(2/3); along an edge
  // it is a square with sqrt(1/2), the least.
  EXPECT_NEAR(search_around(Swept::line, cube_corners()).rectangle.r, std::sqrt(0.5), 1e-7);
}

TEST(SweptSearch, GivesTheSameBitsAgain) {
  const Points p = torus();
  const SweptFit a = search_around(Swept::lozenge, p), b = search_around(Swept::lozenge, p);
  EXPECT_EQ(a.frame, b.frame);
  EXPECT_EQ(a.rectangle.r, b.rectangle.r);
}

}  // namespace
}  // namespace copse
