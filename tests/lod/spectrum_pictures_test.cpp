#include "lib/analysis/lod/spectrum_pictures.h"

#include "lib/analysis/lod/spectrum_builder.h"
#include "lib/formats/random.h"

#include <array>
#include <cmath>

#include <gtest/gtest.h>

namespace copse {
namespace {

constexpr int k_pixels = 24;

// Triangles anywhere in a cube, each step two of which become another one; many lie exactly upon others.
Spectrum triangles(std::uint64_t seed, int count) {
  Random draw(seed);
  SpectrumBuilder builder(LodMethod::collapse);
  std::vector<std::uint32_t> there;
  std::array<SpectrumVertex, 3> last{};
  const auto real = [&] { return static_cast<float>(2 * draw.uniform() - 1); };
  const auto add = [&] {
    const bool again = draw.uniform() < 0.2;
    std::array<std::uint32_t, 3> corners{};
    for (std::size_t c = 0; c < 3; ++c) {
      if (!again) {
        last[c] = {{real(), real(), real()}, {real(), real(), real()}, {2 * real(), 2 * real()}};
        if (draw.uniform() < 0.2) last[c].normal = {};
      }
      corners[c] = builder.vertex(last[c]);
    }
    const double material = draw.uniform();
    there.push_back(builder.element(material < 0.4   ? 0
                                    : material < 0.8 ? 1
                                                     : k_none,
                                    k_none, std::span(&corners, 1)));
  };
  for (int i = 0; i < count; ++i) add();
  while (there.size() > 1) {
    builder.step(1);
    for (int i = 0; i < 2; ++i) {
      builder.remove(there.back());
      there.pop_back();
    }
    if (!there.empty()) std::swap(there.front(), there.back());
    add();
  }
  return builder.finish();
}

class SpectrumPicturesTest : public testing::TestWithParam<std::size_t> {
 protected:
  SpectrumPicturesTest() {
    spectra_.trunk = triangles(1, 40), spectra_.leaves = triangles(2, 60);
    materials_[0].diffuse = {0.2f, 0.5f, 0.1f}, materials_[1].diffuse = {0.6f, 0.3f, 0.2f};
    masks_[1] = {2, 2, {1, 0, 0, 1}};
    for (int i = 0; i < 3; ++i)
      views_.push_back(frame_box({{-1, -1, -1}, {1, 1, 1}}, 2.1 * i, k_pixels, k_pixels));
  }
  Looks looks() const { return {materials_, masks_}; }

  LodSpectra spectra_;
  std::array<Material, 2> materials_;
  std::array<AlphaMask, 2> masks_;
  std::vector<OrthographicView> views_;
};

TEST_P(SpectrumPicturesTest, AreThoseOfTheWholeMesh) {
  SpectrumPictures pictures(spectra_, looks(), views_, 2, GetParam());
  Random draw(3);
  double covered = 0;
  for (int round = 0; round < 12; ++round) {
    const auto steps = static_cast<std::uint32_t>(draw.below(spectra_.trunk.steps() + 1));
    std::vector<std::uint8_t> leaves(spectra_.leaves.elements.size());
    for (std::uint8_t& leaf : leaves) leaf = draw.uniform() < 0.1 * round;
    DrawnMesh mesh = drawn_state(spectra_.trunk, steps);
    append(mesh, drawn_elements(spectra_.leaves, leaves));
    const std::vector<Picture> drawn = pictures.draw(steps, leaves);
    ASSERT_EQ(drawn.size(), views_.size());
    for (std::size_t v = 0; v < views_.size(); ++v) {
      const Picture expected = draw_picture(mesh, looks(), views_[v], 2);
      EXPECT_EQ(drawn[v].colour, expected.colour) << "round " << round << ", view " << v;
      EXPECT_EQ(drawn[v].coverage, expected.coverage) << "round " << round << ", view " << v;
      covered += covered_pixels(expected);
    }
  }
  EXPECT_GT(covered, 0.1 * 12 * 3 * k_pixels * k_pixels);
}

// All that is seen is kept, some of it, nothing.
INSTANTIATE_TEST_SUITE_P(Kept, SpectrumPicturesTest, testing::Values(SpectrumPictures::k_kept, 3000, 0));

TEST(SpectrumPictures, OfNothingAreWhite) {
  const LodSpectra none;
  const OrthographicView view = frame_box({{-1, -1, -1}, {1, 1, 1}}, 0, k_pixels, k_pixels);
  const std::vector<Picture> drawn = SpectrumPictures(none, {}, std::span(&view, 1)).draw(0, {});
  ASSERT_EQ(drawn.size(), 1u);
  EXPECT_EQ(covered_pixels(drawn[0]), 0);
  EXPECT_EQ(drawn[0].colour[0], (Float3{1, 1, 1}));
}

}  // namespace
}  // namespace copse
