#include "lib/analysis/lod/piece_removal.h"

#include "lib/analysis/lod/edge_collapse.h"
#include "lib/analysis/lod/edge_spectrum.h"
#include "lib/analysis/lod/spectrum_builder.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace copse {
namespace {

// Tetrahedra of these sizes, apart from one another, each triangle with vertices of its own; and one step.
Spectrum tetrahedra(const std::vector<float>& sizes) {
  SpectrumBuilder builder(LodMethod::edges);
  const auto triangle = [&](const std::array<Float3, 3>& at) {
    std::array<std::uint32_t, 3> v{};
    for (std::size_t c = 0; c < 3; ++c) v[c] = builder.vertex({at[c], {}, {}});
    return builder.element(0, k_none, std::span(&v, 1));
  };
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    const auto x = static_cast<float>(10 * i);
    const float s = sizes[i];
    const std::array<Float3, 4> p{Float3{x, 0, 0}, {x + s, 0, 0}, {x, s, 0}, {x, 0, s}};
    for (std::size_t out = 0; out < 4; ++out)
      triangle({p[(out + 1) % 4], p[(out + 2) % 4], p[(out + 3) % 4]});
  }
  const std::uint32_t spare = triangle({Float3{0, 90, 0}, {1, 90, 0}, {0, 91, 0}});
  builder.step(0.25);
  builder.remove(spare);
  return builder.finish();
}

// Places of what is drawn, in tens of metres.
std::vector<int> places(const Spectrum& s, std::uint32_t steps) {
  std::vector<int> out;
  for (std::size_t e = 0; e < s.elements.size(); ++e) {
    if (s.elements[e].birth > steps || s.elements[e].death <= steps) continue;
    out.push_back(static_cast<int>(s.vertices[s.triangles[s.first_triangle[e]][0]].position.x / 10 + 0.01f));
  }
  std::sort(out.begin(), out.end());
  return out;
}

TEST(PieceRemoval, TheSmallestGoesFirstAndTheLargestStays) {
  const Spectrum s = remove_pieces(tetrahedra({2, 1, 4, 3}));
  ASSERT_EQ(s.steps(), 4u);
  EXPECT_EQ(s.counts.to_vector(), (std::vector<std::uint32_t>{17, 16, 12, 8, 4}));
  EXPECT_EQ(places(s, 2), (std::vector<int>{0, 0, 0, 0, 2, 2, 2, 2, 3, 3, 3, 3}));
  EXPECT_EQ(places(s, 4), (std::vector<int>{2, 2, 2, 2}));
}

TEST(PieceRemoval, WhatWasBeforeIsAsItWas) {
  const Spectrum before = tetrahedra({2, 1, 4});
  const Spectrum s = remove_pieces(before);
  for (std::uint32_t step = 0; step <= before.steps(); ++step) {
    EXPECT_EQ(s.counts[step], before.counts[step]);
    EXPECT_EQ(s.errors[step], before.errors[step]);
    EXPECT_EQ(places(s, step), places(before, step));
  }
}

TEST(PieceRemoval, ErrsByTheSizeOfWhatHasGone) {
  const Spectrum s = remove_pieces(tetrahedra({2, 1, 4}));
  EXPECT_FLOAT_EQ(s.errors[2], std::sqrt(3.0f));
  EXPECT_FLOAT_EQ(s.errors[3], 2 * std::sqrt(3.0f));
}

TEST(PieceRemoval, StopsAtTheLeastNumberOfTriangles) {
  const Spectrum s = remove_pieces(tetrahedra({2, 1, 4, 3}), 9);
  EXPECT_EQ(s.counts[s.steps()], 12u);
}

TEST(PieceRemoval, OnePieceOrNothingIsLeftAlone) {
  const Spectrum one = tetrahedra({1});
  EXPECT_EQ(remove_pieces(one).counts.to_vector(), one.counts.to_vector());
  EXPECT_EQ(remove_pieces({}).steps(), 0u);
  EXPECT_EQ(remove_pieces(edge_spectrum({}, collapse_edges({}), {})).steps(), 0u);
}

}  // namespace
}  // namespace copse
