#include "lib/formats/levels/spectrum_leaves.h"

#include "lib/analysis/lod/leaf_collapse.h"
#include "lib/analysis/lod/spectrum_builder.h"
#include "lib/formats/levels/part_triangles.h"
#include "tests/lod/based_coding.h"
#include "tests/lod/leafy_tree.h"

namespace copse {
namespace {

Tree leafy(bool alpha, std::uint32_t leaves = 300) {
  LeafyTree maker;
  maker.alpha = alpha, maker.leaves = leaves;
  return maker.make();
}

TEST(SpectrumLeaves, LivesAreExactAndFullDetailIsTheTrees) {
  for (const bool alpha : {false, true}) {
    const Tree tree = leafy(alpha);
    expect_round_trip(collapse_spectrum(tree), tree);
  }
}

TEST(SpectrumLeaves, MadeLeavesKeepTheirAreaAndPlace) {
  const Tree tree = leafy(false);
  const Spectrum s = collapse_spectrum(tree);
  const auto e = encode_spectrum(s, k_small, &tree);
  const auto d = decode_spectrum(e->bytes, "test", &tree);
  ASSERT_TRUE(d.has_value());
  const auto sums = [](const Spectrum& x, std::uint32_t step) {
    double area = 0;
    Double3 centre{};
    for (std::size_t k = 0; k < x.elements.size(); ++k) {
      if (x.elements[k].birth > step || x.elements[k].death <= step) continue;
      for (std::uint32_t t = x.first_triangle[k]; t < x.first_triangle[k + 1]; ++t) {
        const auto at = [&](int c) { return to_double(x.vertices[x.triangles[t][c]].position); };
        const double a = 0.5 * length(cross(at(1) - at(0), at(2) - at(0)));
        area += a, centre += (at(0) + at(1) + at(2)) * (a / 3);
      }
    }
    return std::pair(area, centre / area);
  };
  for (const std::uint32_t step : {s.steps() / 4, s.steps() / 2, s.steps() - 10}) {
    const auto [area, centre] = sums(s, step);
    const auto [area_read, centre_read] = sums(*d, step);
    EXPECT_NEAR(area_read / area, 1, 0.02) << step;
    EXPECT_LT(distance(centre, centre_read), 0.02 * std::sqrt(area)) << step;
  }
}

TEST(SpectrumLeaves, TheOrderOfTheForestSparesNumbers) {
  const Tree tree = leafy(true);
  const Spectrum s = collapse_spectrum(tree);
  std::vector<std::uint32_t> order = spectrum_leaves::leaf_order(s, tree);
  ASSERT_EQ(order.size(), tree.leaf_count());
  std::sort(order.begin(), order.end());
  for (std::uint32_t i = 0; i < order.size(); ++i) EXPECT_EQ(order[i], i);
}

TEST(SpectrumLeaves, AreAFractionOfWhatTheyAreAlone) {
  const Tree tree = leafy(false, 600);
  const Spectrum s = collapse_spectrum(tree);
  EXPECT_LT(4 * encode_spectrum(s, k_small, &tree)->bytes.size(), encode_spectrum(s, k_small)->bytes.size());
}

TEST(SpectrumLeaves, NothingWithoutItsTree) {
  const Tree tree = leafy(true, 40);
  const auto e = encode_spectrum(collapse_spectrum(tree), k_small, &tree);
  const auto alone = decode_spectrum(e->bytes, "test");
  ASSERT_FALSE(alone.has_value());
  EXPECT_NE(alone.error().what.find("tree"), std::string::npos);
  const Tree other = leafy(true, 41);
  EXPECT_FALSE(decode_spectrum(e->bytes, "test", &other).has_value());
}

TEST(SpectrumLeaves, WhatIsNotOfTheTreeIsStoredAlone) {
  const Tree tree = leafy(true, 40), other = leafy(false, 50);
  EXPECT_FALSE(is_based(*encode_spectrum(collapse_spectrum(tree), k_small, &other)));
}

// On a coarse grid a leaf that has grown a little may be what it was.
TEST(SpectrumLeaves, AMadeLeafThatIsOneOfTheTreesAgainIsStillBasedOnIt) {
  const Tree tree = leafy(false, 40);
  const PartTriangles part = leaf_triangles(tree);
  SpectrumBuilder b(LodMethod::collapse);
  for (const SpectrumVertex& v : part.vertices) b.vertex(v);
  std::vector<std::uint32_t> elements;
  const auto add = [&](std::size_t t) {
    return b.element(part.materials[t], k_none, std::span(&part.triangles[t], 1));
  };
  for (std::size_t t = 0; t < part.triangles.size(); ++t) elements.push_back(add(t));
  b.step(0.1);
  b.remove(elements[3]);
  const std::uint32_t again = add(3);
  b.remove(elements[4]);
  b.step(0.2);
  b.remove(again);
  const Spectrum s = b.finish();
  EXPECT_TRUE(is_based(*encode_spectrum(s, k_small, &tree)));
  expect_round_trip(s, tree);
}

TEST(SpectrumLeaves, TenThousandMutantsAreRefusedOrHarmless) {
  const Tree tree = leafy(false, 25);
  expect_harmless(encode_spectrum(collapse_spectrum(tree), k_small, &tree)->bytes, tree, 10000);
}

}  // namespace
}  // namespace copse
