// What a search finds does not depend on how the points are turned, where they lie, how large they are, in
// which order they come or how often: over the whole battery.
#include "lib/analysis/swept/swept_shape.h"
#include "lib/analysis/volumes/certify.h"
#include "lib/analysis/volumes/fit_volumes.h"
#include "tests/volumes/point_sets.h"

#include <string>

#include <gtest/gtest.h>

namespace copse {
namespace {

std::vector<FittedVolume> searched(const Points& points) {
  const auto fitter = VolumeFitter::make(points);
  std::vector<FittedVolume> out;
  for (const FitMethod& m : fit_methods()) {
    // What goes by the axes of the coordinates turns with them.
    if (!m.least || m.kind == VolumeKind::aabb || m.kind == VolumeKind::kdop) continue;
    if (auto v = fitter->fit(m)) out.push_back(std::move(*v));
  }
  return out;
}

double size_of(const Points& points) {
  DoubleBox box;
  for (const Double3& p : points) box.grow(p);
  return length(box.extent());
}

// Of the fits in double, in units of the base: `rounding` is what the coordinates have lost, of the size.
void expect_same(const std::vector<FittedVolume>& base, const std::vector<FittedVolume>& other, double scale,
                 double rounding, double size, const std::string& name) {
  ASSERT_EQ(base.size(), other.size()) << name;
  for (std::size_t i = 0; i < base.size(); ++i) {
    const double before = base[i].fitted, after = other[i].fitted / scale / scale / scale;
    const double valleys = 5e-4 * before;  // of two that are nearly as deep either is found
    // A thin body is as thin as its points lie, and a cylinder is told by its ends, which a rounding turns by
    // more the nearer they are.
    const double blur = 4 * std::max(rounding, 1e-9) * size;
    const double thin = blur * (base[i].measures.surface + blur * size);
    EXPECT_LE(std::abs(after - before), valleys + thin)
        << name << ": " << name_of(base[i].method.kind) << " " << before << " " << after;
    EXPECT_TRUE(other[i].certified) << name << ": " << name_of(base[i].method.kind);
  }
}

bool is_of_ordinary_size(const NamedPoints& set) {
  const double size = size_of(set.points);
  return size == 0 || (size > 1e-15 && size < 1e15);
}

TEST(Invariance, NoSearchDependsOnTheTurnThePlaceOrTheScaleOfTheBattery) {
  const Axes frame = turned(k_world_axes, {0.31, -0.73, 1.2});
  bool shrinks = false;
  for (const NamedPoints& set : float32_battery()) {
    if (!is_of_ordinary_size(set)) continue;
    const double size = size_of(set.points);
    double reach = 0;
    for (const Double3& p : set.points) reach = std::max(reach, length(p));
    const auto base = searched(set.points);
    Points there = set.points;
    for (Double3& p : there) p = into(frame, p);
    expect_same(base, searched(there), 1, size > 0 ? 1e-15 * (1 + reach / size) : 0, size,
                set.name + " turned");
    const double far = 1e7 * std::max(size, 1e-3);
    expect_same(base, searched(scaled(set.points, 1, {far, -far, 0.3 * far})), 1, 1e-8, size,
                set.name + " far away");
    shrinks = !shrinks || reach > 1e8;  // beyond float32 otherwise
    const double scale = shrinks ? 1e-30 : 1e30;
    expect_same(base, searched(scaled(set.points, scale)), scale, 1e-15, size, set.name + " scaled");
  }
}

TEST(Invariance, NotOneByteOfASearchDependsOnTheOrderOrRepetitionOfTheBattery) {
  Random random(1);
  for (const NamedPoints& set : float32_battery()) {
    const auto before = searched(set.points);
    Points shuffled = set.points;
    shuffled.insert(shuffled.end(), set.points.begin(), set.points.begin() + 1 + set.points.size() / 3);
    random.shuffle(std::span(shuffled));
    const auto after = searched(shuffled);
    ASSERT_EQ(before.size(), after.size()) << set.name;
    for (std::size_t i = 0; i < before.size(); ++i) {
      EXPECT_EQ(before[i].volume, after[i].volume) << set.name << ": " << name_of(before[i].method.kind);
      EXPECT_EQ(before[i].fitted, after[i].fitted) << set.name << ": " << name_of(before[i].method.kind);
    }
  }
}

// A ball is a capsule and a capsule is a lozenge, number by number as they are stored.
TEST(Invariance, NoLozengeIsStoredLargerThanTheCapsuleNorThatThanTheBallHoweverTheBatteryIsTurned) {
  for (const NamedPoints& set : float32_battery()) {
    for (const Double3& turn : {Double3{}, Double3{0.31, -0.73, 1.2}, Double3{-1.1, 0.2, 0.6}}) {
      const Axes frame = turned(k_world_axes, turn);
      Points there = set.points;
      for (Double3& p : there) p = into(frame, p);
      const auto all = searched(there);
      const auto volume = [&](VolumeKind kind) {
        return std::find_if(all.begin(), all.end(),
                            [&](const FittedVolume& v) { return v.method.kind == kind; })
            ->measures.volume;
      };
      const double capsule = volume(VolumeKind::capsule);
      EXPECT_LE(capsule, volume(VolumeKind::sphere) * (1 + 1e-12)) << set.name;
      EXPECT_LE(volume(VolumeKind::lozenge), capsule * (1 + 1e-12)) << set.name;
    }
  }
}

}  // namespace
}  // namespace copse
