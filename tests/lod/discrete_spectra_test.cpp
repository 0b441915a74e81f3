#include "lib/analysis/lod/discrete_spectra.h"

#include "lib/analysis/lod/leaf_collapse.h"
#include "lib/analysis/lod/trunk_radii.h"
#include "lib/analysis/measure/drawn_mesh.h"
#include "lib/formats/levels/spectrum_file.h"
#include "tests/lod/leafy_tree.h"
#include "tests/lod/tube_tree.h"

#include <algorithm>
#include <array>
#include <vector>

#include <gtest/gtest.h>

namespace copse {
namespace {

// The triangles of a state as places, whatever their order.
std::vector<std::array<double, 9>> shown(const Spectrum& s, std::uint32_t steps) {
  const DrawnMesh mesh = drawn_state(s, steps);
  std::vector<std::array<double, 9>> out;
  for (const Triangle& t : mesh.triangles) {
    std::array<double, 9> corners{};
    for (std::size_t c = 0; c < 3; ++c)
      for (int a = 0; a < 3; ++a) corners[3 * c + static_cast<std::size_t>(a)] = mesh.positions[t[c]][a];
    out.push_back(corners);
  }
  std::sort(out.begin(), out.end());
  return out;
}

LodSpectra with_levels(std::initializer_list<double> shares) {
  LodSpectra s;
  s.trunk = trunk_by_radii(stem_with_twigs(12, 8, 6)), s.leaves = collapse_spectrum(LeafyTree{}.make(), {});
  s.schedule = {{.triangles = s.trunk.counts[0] + s.leaves.counts[0]}};
  for (const double share : shares) {
    LodLevel level;
    level.trunk_steps = static_cast<std::uint32_t>(share * s.trunk.steps());
    level.leaf_steps = static_cast<std::uint32_t>(share * s.leaves.steps());
    level.triangles = s.trunk.counts[level.trunk_steps] + s.leaves.counts[level.leaf_steps];
    level.error = std::max(s.trunk.errors[level.trunk_steps], s.leaves.errors[level.leaf_steps]);
    s.discrete.push_back(level);
  }
  return s;
}

TEST(DiscreteSpectra, ShowTheSameTrianglesAtEveryLevel) {
  const LodSpectra all = with_levels({0.3, 0.6, 0.6, 1}), few = discrete_spectra(all);
  EXPECT_EQ(shown(few.trunk, 0), shown(all.trunk, 0));
  EXPECT_EQ(shown(few.leaves, 0), shown(all.leaves, 0));
  ASSERT_EQ(few.discrete.size(), all.discrete.size());
  for (std::size_t i = 0; i < all.discrete.size(); ++i) {
    const LodLevel &a = all.discrete[i], &b = few.discrete[i];
    EXPECT_EQ(shown(few.trunk, b.trunk_steps), shown(all.trunk, a.trunk_steps)) << i;
    EXPECT_EQ(shown(few.leaves, b.leaf_steps), shown(all.leaves, a.leaf_steps)) << i;
    EXPECT_EQ(b.triangles, a.triangles);
    EXPECT_EQ(few.leaves.errors[b.leaf_steps], all.leaves.errors[a.leaf_steps]);
  }
}

TEST(DiscreteSpectra, HoldNothingThatNoLevelShows) {
  const LodSpectra all = with_levels({0.5, 1}), few = discrete_spectra(all);
  EXPECT_LE(few.trunk.steps(), 2u);
  EXPECT_LE(few.leaves.steps(), 2u);
  EXPECT_TRUE(few.schedule.empty());
  EXPECT_LT(few.leaves.elements.size(), all.leaves.elements.size());
  EXPECT_LT(few.leaves.vertices.size(), all.leaves.vertices.size());
  std::vector<bool> used(few.leaves.vertices.size(), false);
  for (const auto& t : few.leaves.triangles)
    for (const std::uint32_t v : t) used[v] = true;
  EXPECT_TRUE(std::all_of(used.begin(), used.end(), [](bool u) { return u; }));
}

TEST(DiscreteSpectra, AreSoundAsAFileHoldsThem) {
  LodSpectra few = discrete_spectra(with_levels({0.2, 0.7}));
  for (Spectrum* s : {&few.trunk, &few.leaves}) {
    const auto bytes = encode_spectrum(*s, {});
    ASSERT_TRUE(bytes.has_value());
    const auto back = decode_spectrum(bytes->bytes, "test");
    ASSERT_TRUE(back.has_value()) << back.error().what;
    EXPECT_EQ(back->counts.to_vector(), s->counts.to_vector());
  }
  LodSpectra back;
  back.trunk = few.trunk, back.leaves = few.leaves;
  ASSERT_TRUE(decode_levels(encode_levels(few), "test", back).has_value());
  EXPECT_EQ(back.discrete, few.discrete);
}

TEST(DiscreteSpectra, OfNoLevelsAreFullDetail) {
  const LodSpectra all = with_levels({}), few = discrete_spectra(all);
  EXPECT_EQ(few.leaves.steps(), 0u);
  EXPECT_EQ(shown(few.leaves, 0), shown(all.leaves, 0));
  EXPECT_TRUE(discrete_spectra({}).trunk.elements.empty());
}

}  // namespace
}  // namespace copse
