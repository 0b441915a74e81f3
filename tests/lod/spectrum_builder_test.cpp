#include "lib/analysis/lod/spectrum_builder.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

using Triangles = std::vector<std::array<std::uint32_t, 3>>;

// An element of `triangles` triangles, on three vertices of its own.
std::uint32_t piece(SpectrumBuilder& builder, std::size_t triangles) {
  std::uint32_t v[3];
  for (std::uint32_t& c : v) c = builder.vertex({});
  return builder.element(0, 7, Triangles(triangles, {v[0], v[1], v[2]}));
}

std::uint32_t alive(const Spectrum& s, std::uint32_t n) {
  std::uint32_t triangles = 0;
  for (std::size_t e = 0; e < s.elements.size(); ++e) {
    if (s.elements[e].birth <= n && n < s.elements[e].death)
      triangles += s.first_triangle[e + 1] - s.first_triangle[e];
  }
  return triangles;
}

TEST(SpectrumBuilder, CountsWhatIsThereAfterEveryStep) {
  SpectrumBuilder b(LodMethod::collapse);
  const auto a = piece(b, 2), c = piece(b, 2);
  piece(b, 2);
  b.step(0.5);
  b.remove(a), b.remove(c);
  piece(b, 2);
  b.step(0.25);
  const Spectrum s = b.finish();
  ASSERT_EQ(s.steps(), 2u);
  EXPECT_EQ(s.counts.to_vector(), (std::vector<std::uint32_t>{6, 4, 4}));
  EXPECT_EQ(s.errors.to_vector(), (std::vector<float>{0, 0.5f, 0.5f}));  // never less than before
  for (std::uint32_t n = 0; n <= s.steps(); ++n) EXPECT_EQ(alive(s, n), s.counts[n]) << n;
}

TEST(SpectrumBuilder, SortsElementsByDeathThenBirth) {
  SpectrumBuilder b(LodMethod::collapse);
  const auto first = piece(b, 1), second = piece(b, 1);
  piece(b, 3);
  b.step(1);
  b.remove(second);
  b.step(2);
  b.remove(first);
  piece(b, 1);
  const Spectrum s = b.finish();
  for (std::size_t e = 1; e < s.elements.size(); ++e) {
    const SpectrumElement &x = s.elements[e - 1], &y = s.elements[e];
    EXPECT_TRUE(x.death > y.death || (x.death == y.death && x.birth <= y.birth)) << e;
  }
}

TEST(SpectrumBuilder, JoinsAStepThatWouldAddTriangles) {
  SpectrumBuilder b(LodMethod::radii);
  const auto a = piece(b, 4), c = piece(b, 4);
  b.step(1);
  b.remove(a);
  piece(b, 5);  // 9 triangles: more than the 8 before
  b.step(2);
  b.remove(c);
  const Spectrum s = b.finish();
  ASSERT_EQ(s.steps(), 1u);
  EXPECT_EQ(s.counts.to_vector(), (std::vector<std::uint32_t>{8, 5}));
  EXPECT_FLOAT_EQ(s.errors[1], 2);
  EXPECT_EQ(alive(s, 1), 5u);
}

TEST(SpectrumBuilder, DropsTrailingStepsThatOnlyAdd) {
  SpectrumBuilder b(LodMethod::radii);
  piece(b, 2);
  b.step(1);
  piece(b, 2);
  const Spectrum s = b.finish();
  EXPECT_EQ(s.steps(), 0u);
  EXPECT_EQ(s.elements.size(), 1u);
}

TEST(SpectrumBuilder, DropsWhatWasNeverThere) {
  SpectrumBuilder b(LodMethod::radii);
  piece(b, 2);
  b.step(1);
  b.remove(piece(b, 1));
  const Spectrum s = b.finish();
  EXPECT_EQ(s.elements.size(), 1u);
  EXPECT_EQ(s.vertices.size(), 3u);
}

TEST(SpectrumBuilder, MakesAnEmptySpectrumOfNothing) {
  const Spectrum s = SpectrumBuilder(LodMethod::edges).finish();
  EXPECT_EQ(s.steps(), 0u);
  EXPECT_EQ(s.counts.to_vector(), std::vector<std::uint32_t>{0});
}

}  // namespace
}  // namespace copse
