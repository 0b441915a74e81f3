#include "lib/analysis/lod/hausdorff_errors.h"

#include "lib/analysis/lod/leaf_collapse.h"
#include "lib/analysis/lod/spectrum_builder.h"
#include "lib/analysis/measure/drawn_mesh.h"
#include "lib/analysis/measure/surface_distance.h"
#include "tests/lod/leafy_tree.h"

#include <limits>

#include <gtest/gtest.h>

namespace copse {
namespace {

std::uint32_t add(SpectrumBuilder& b, const Double3& p, const Double3& q, const Double3& r) {
  std::array<std::array<std::uint32_t, 3>, 1> t;
  int c = 0;
  for (const Double3& corner : {p, q, r}) t[0][c++] = b.vertex({to_float(corner), {0, 1, 0}, {}});
  return b.element(0, k_none, t);
}

// A right triangle with its corner at `p`.
std::uint32_t right(SpectrumBuilder& b, const Double3& p, double size = 1) {
  return add(b, p, p + Double3{size, 0, 0}, p + Double3{0, 0, size});
}

// What is measured at a point is a lower bound, what is stored an upper one.
void expect_near(float error, double exact) {
  EXPECT_GE(error, exact);
  EXPECT_LE(error, (1 + k_hausdorff_slack) * 1.001 * exact);
}

TEST(HausdorffErrors, WhatIsGoneIsAsFarAsFromTheNearestThatIsLeft) {
  SpectrumBuilder b(LodMethod::collapse);
  right(b, {0, 0, 0});
  const auto middle = right(b, {0, 2, 0}), top = right(b, {0, 5, 0});
  b.step(0), b.remove(middle), b.step(0), b.remove(top);
  const auto errors = hausdorff_errors(b.finish());
  ASSERT_EQ(errors.size(), 3u);
  EXPECT_EQ(errors[0], 0);
  expect_near(errors[1], 2);
  expect_near(errors[2], 5);
}

TEST(HausdorffErrors, AGrownLeafIsAsFarAsItReachesFromFullDetail) {
  SpectrumBuilder b(LodMethod::collapse);
  const auto small = right(b, {0, 0, 0}), other = right(b, {0, 0.5, 0});
  b.step(0), b.remove(small), b.remove(other);
  right(b, {0, 0, 0}, 4);
  expect_near(hausdorff_errors(b.finish())[1], 3);  // from (4, 0, 0) to (1, 0, 0)
}

TEST(HausdorffErrors, TheOtherDiagonalOfASquareIsNoError) {
  SpectrumBuilder b(LodMethod::collapse);
  const Double3 p{0, 0, 0}, q{1, 0, 0}, r{1, 0, 1}, s{0, 0, 1};
  const auto one = add(b, p, q, r), two = add(b, p, r, s);
  add(b, {0, 30, 0}, {1, 30, 0}, {0, 30, 1});
  b.step(0), b.remove(one), b.remove(two);
  add(b, p, q, s), add(b, q, r, s);
  b.step(0);
  const auto errors = hausdorff_errors(b.finish());
  EXPECT_LE(errors[1], 4.01 * k_hausdorff_floor * std::sqrt(902.0));
}

TEST(HausdorffErrors, AStateThatComesBackToWhatWasNearerKeepsTheLargestError) {
  SpectrumBuilder b(LodMethod::collapse);
  const auto near = right(b, {0, 0, 0}), far = right(b, {0, 2, 0}), other = right(b, {0, 2.1, 0});
  b.step(0), b.remove(far), b.remove(other);
  b.step(0), b.remove(near), right(b, {0, 1, 0});
  const auto errors = hausdorff_errors(b.finish());
  expect_near(errors[1], 2.1);
  EXPECT_EQ(errors[2], errors[1]);
}

// All states of whole crowns of large cards, of small ones, and of such as thin out all at once.
TEST(HausdorffErrors, AreNoLessThanWhatIsMeasuredAndLittleMoreThanTheLargestOfIt) {
  for (const double half : {0.02, 0.1, 0.6})
    for (const CollapseQuality quality : {CollapseQuality::fast, CollapseQuality::balanced}) {
      const Spectrum s = collapse_spectrum(LeafyTree{.leaves = 50, .half = half, .radius = 1}.make(), {},
                                           {.quality = quality});
      const DrawnMesh full = drawn_state(s, 0);
      const double between = std::sqrt(50 * 4 * half * half / 2000);  // points
      double largest = 0;
      for (std::uint32_t n = 1; n <= s.steps(); ++n) {
        const SurfaceDistances d = surface_distance(full, drawn_state(s, n), 2000);
        largest = std::max({largest, d.from_level.max, d.from_source.max});
        EXPECT_GE(s.errors[n], largest) << half << " " << n;
        EXPECT_LE(s.errors[n], (1 + k_hausdorff_slack) * (largest + between)) << half << " " << n;
      }
    }
}

TEST(HausdorffErrors, WhereNothingIsDrawnTheyAreAsLargeAsCanBe) {
  SpectrumBuilder b(LodMethod::collapse);
  const auto only = right(b, {0, 0, 0});
  b.step(0), b.remove(only);
  EXPECT_EQ(hausdorff_errors(b.finish())[1], std::numeric_limits<float>::max());
}

TEST(HausdorffErrors, OfTrianglesOfNoSizeOrOfAnySizeTheyAreFinite) {
  for (const double size : {0.0, 1e-30, 1e18}) {
    SpectrumBuilder b(LodMethod::collapse);
    right(b, {0, 0, 0}, size);
    const auto point = right(b, {size, size, size}, 0), far = right(b, {0, size, 0}, size);
    b.step(0), b.remove(point), b.step(0), b.remove(far);
    for (const float e : hausdorff_errors(b.finish())) EXPECT_LE(e, 4e18f);
  }
}

TEST(HausdorffErrors, OfNoSpectrumThereAreNone) {
  EXPECT_TRUE(hausdorff_errors({}).empty());
  SpectrumBuilder b(LodMethod::collapse);
  EXPECT_EQ(hausdorff_errors(b.finish()), std::vector<float>{0});
}

}  // namespace
}  // namespace copse
