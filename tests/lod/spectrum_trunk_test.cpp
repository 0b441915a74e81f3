#include "lib/formats/levels/spectrum_trunk.h"

#include "lib/analysis/lod/trunk_radii.h"
#include "tests/lod/based_coding.h"
#include "tests/lod/tube_tree.h"

namespace copse {
namespace {

TEST(SpectrumTrunk, LivesAreExactAndFullDetailIsTheTrees) {
  for (const int sides : {3, 6, 9}) {
    const Tree tree = stem_with_twigs(12, sides, 9);
    const Spectrum s = trunk_by_radii(tree);
    ASSERT_GT(s.steps(), 5u);
    expect_round_trip(s, tree);
  }
}

TEST(SpectrumTrunk, NoVertexIsFartherAwayThanItSays) {
  const Tree tree = stem_with_twigs(12, 6, 9);
  const Spectrum s = trunk_by_radii(tree);
  double before = 1e30;
  for (const int bits : {8, 12, 16}) {
    const auto e = encode_spectrum(s, {.coding = SpectrumCoding::small, .position_bits = bits}, &tree);
    const auto d = decode_spectrum(e->bytes, "test", &tree);
    ASSERT_TRUE(d.has_value());
    double worst = 0;
    for (const SpectrumVertex& v : s.vertices) {
      double nearest = 1e30;
      for (const SpectrumVertex& w : d->vertices)
        nearest = std::min(nearest, distance(to_double(v.position), to_double(w.position)));
      worst = std::max(worst, nearest);
    }
    EXPECT_LE(worst, e->position_error * 1.0001 + 1e-6) << bits;
    EXPECT_LT(e->position_error, before);
    before = e->position_error;
  }
}

TEST(SpectrumTrunk, IsAFractionOfWhatItIsAlone) {
  const Tree tree = stem_with_twigs(40, 8, 30);
  const Spectrum s = trunk_by_radii(tree);
  EXPECT_LT(2 * encode_spectrum(s, k_small, &tree)->bytes.size(), encode_spectrum(s, k_small)->bytes.size());
}

TEST(SpectrumTrunk, TenThousandMutantsAreRefusedOrHarmless) {
  const Tree tree = stem_with_twigs(6, 5, 4);
  expect_harmless(encode_spectrum(trunk_by_radii(tree), k_small, &tree)->bytes, tree, 10000);
}

}  // namespace
}  // namespace copse
