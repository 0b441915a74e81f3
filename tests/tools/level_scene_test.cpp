// How an engine draws what lodbake has baked (docs/runtime.md, "A tree whose levels change"): one read, two
// vertex buffers that never change, and an index list that is taken again when the level does.
#include "lib/formats/levels/spectrum_file.h"
#include "lib/formats/tree_file/tree_file.h"
#include "lib/runtime/levels.h"
#include "tests/tools/baked_oak.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace copse {
namespace {

// --- the engine's half

// One of a tree's two parts. `vertices` go to the GPU once; `indices` hold as many as any level has.
struct DrawnPart {
  explicit DrawnPart(const Spectrum& spectrum)
      : vertices(spectrum.vertices), extractor(spectrum), indices(extractor.capacity()) {}
  // Material after material.
  std::span<const std::uint32_t> take(std::uint32_t steps) {
    return std::span(indices).first(extractor.extract(steps, indices));
  }

  std::span<const SpectrumVertex> vertices;
  LevelExtractor extractor;
  std::vector<std::uint32_t> indices;
};

class LevelScene {
 public:
  explicit LevelScene(LodSpectra spectra)
      : spectra_(std::move(spectra)), trunk_(spectra_.trunk), leaves_(spectra_.leaves) {}
  LevelScene(const LevelScene&) = delete;  // the parts refer to the spectra
  LevelScene& operator=(const LevelScene&) = delete;

  // Discrete levels: nothing to do while the number stays.
  std::size_t draw_discrete(double distance) {
    const std::uint32_t now = choose_discrete(spectra_, distance, number_);
    if (now != number_) {
      number_ = now;
      take(number_ == 0 ? full_detail(spectra_) : spectra_.discrete[number_ - 1]);
    }
    return drawn_;
  }
  // Continuous detail, which holds still while the camera sways.
  std::size_t draw_continuous(double distance) {
    held_ = held_distance(spectra_, distance, held_);
    take(level_of_distance(spectra_, held_));
    return drawn_;
  }
  const LodSpectra& spectra() const { return spectra_; }

 private:
  void take(const LodLevel& level) {
    drawn_ = (trunk_.take(level.trunk_steps).size() + leaves_.take(level.leaf_steps).size()) / 3;
  }

  LodSpectra spectra_;
  DrawnPart trunk_, leaves_;
  std::uint32_t number_ = k_none;
  double held_ = 0;
  std::size_t drawn_ = 0;
};

// --- the test's half

class LevelSceneTest : public BakedOak {
 protected:
  LodSpectra load() const {
    const auto file = TreeFile::open(out_);
    if (!file) throw std::runtime_error(file.error().what);
    auto spectra = load_spectra(file->container(), file->counts().radii, file->counts().materials);
    if (!spectra) throw std::runtime_error(spectra.error().what);
    return std::move(*spectra);
  }
};

TEST_F(LevelSceneTest, DrawsTheLevelThatBelongsToEachDistance) {
  ASSERT_EQ(bake({"--discrete", "0.5,0.1", "--continuous", "-q"}).status, 0);
  LevelScene scene(load());
  const LodSpectra& s = scene.spectra();
  ASSERT_EQ(s.discrete.size(), 2u);
  const auto beyond = [&](std::size_t level) {
    return s.discrete[level].distance * (1 + s.hysteresis) * 1.01;
  };
  EXPECT_EQ(scene.draw_discrete(0.01), full_detail(s).triangles);
  EXPECT_EQ(scene.draw_discrete(beyond(0)), s.discrete[0].triangles);
  EXPECT_EQ(scene.draw_discrete(s.discrete[0].distance), s.discrete[0].triangles) << "within the band";
  EXPECT_EQ(scene.draw_discrete(beyond(1)), s.discrete[1].triangles);
  EXPECT_EQ(scene.draw_discrete(0.01), full_detail(s).triangles);
}

TEST_F(LevelSceneTest, ContinuousDetailFallsWithDistanceAndHoldsWhileTheCameraSways) {
  ASSERT_EQ(bake({"--discrete", "0.1", "--continuous", "-q"}).status, 0);
  LevelScene scene(load());
  const double near = scene.spectra().near;
  std::size_t before = scene.draw_continuous(0.5 * near);
  EXPECT_EQ(before, full_detail(scene.spectra()).triangles);
  for (double d = near; d < 8 * near; d *= 1.3) {
    const std::size_t now = scene.draw_continuous(d);
    EXPECT_LE(now, before);
    EXPECT_EQ(scene.draw_continuous(0.97 * d), now) << d;
    EXPECT_EQ(scene.draw_continuous(d), now) << d;
    before = now;
  }
}

}  // namespace
}  // namespace copse
