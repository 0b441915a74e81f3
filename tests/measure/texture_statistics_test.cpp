#include "lib/analysis/measure/texture_statistics.h"

#include "lib/formats/random.h"

#include <cmath>

#include <gtest/gtest.h>

namespace copse {
namespace {

struct Picture {
  int width, height;
  std::vector<std::uint8_t> rgba;
  Picture(int w, int h, const std::array<std::uint8_t, 4>& texel)
      : width(w), height(h), rgba(static_cast<std::size_t>(4 * w * h)) {
    for (int y = 0; y < h; ++y) {
      for (int x = 0; x < w; ++x) set(x, y, texel);
    }
  }
  void set(int x, int y, const std::array<std::uint8_t, 4>& texel) {
    for (int c = 0; c < 4; ++c) rgba[static_cast<std::size_t>(4 * (y * width + x) + c)] = texel[c];
  }
  TextureImage view() const { return {width, height, rgba}; }
};

// One material with one texture.
class Sheet {
 public:
  Mesh mesh;
  Sheet() {
    mesh.parts.push_back({"", "", 0});
    mesh.materials.resize(1);
    mesh.materials[0].texture = 0;
    mesh.textures.resize(1);
  }
  // A rectangle of `area` with texture corners (u0, v0) to (u1, v1).
  void card(float u0, float v0, float u1, float v1, double area = 1) {
    const auto p = static_cast<std::uint32_t>(mesh.positions.size()),
               t = static_cast<std::uint32_t>(mesh.texcoords.size());
    for (const Double3& q : {Double3{0, 0, 0}, {area, 0, 0}, {area, 1, 0}, {0, 1, 0}})
      mesh.positions.push_back(q);
    for (const Float2& q : {Float2{u0, v0}, {u1, v0}, {u1, v1}, {u0, v1}}) mesh.texcoords.push_back(q);
    for (const Triangle& c : {Triangle{0, 1, 2}, {0, 2, 3}}) {
      mesh.triangles.push_back({p + c[0], p + c[1], p + c[2]});
      mesh.texcoord_triangles.push_back({t + c[0], t + c[1], t + c[2]});
      mesh.part_of.push_back(0);
    }
  }
  TextureStatistics measure(const Picture& picture) const {
    return texture_statistics(mesh, [&](std::uint32_t) { return picture.view(); })[0];
  }
};

constexpr std::array<std::uint8_t, 4> k_green{0, 255, 0, 255}, k_red{255, 0, 0, 255},
    k_clear{255, 255, 255, 0};

// The left half is green and opaque, the right half clear.
Picture half_green() {
  Picture p(64, 32, k_clear);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) p.set(x, y, k_green);
  }
  return p;
}

TEST(TextureStatistics, OfTheWholeTextureAreItsMeans) {
  Sheet sheet;
  sheet.card(0, 0, 1, 1);
  const TextureStatistics s = sheet.measure(half_green());
  EXPECT_TRUE(s.sampled);
  EXPECT_EQ(s.triangles, 2u);
  EXPECT_EQ(s.footprints, 2u);
  EXPECT_NEAR(s.alpha_coverage, 0.5, 1e-3);  // two triangles: exact but for whole scanlines
  EXPECT_EQ(s.mean_colour, (Float3{0, 1, 0}));
}

TEST(TextureStatistics, OnlyWhatTheTrianglesCoverCounts) {
  Sheet left, right, most;
  left.card(0, 0, 0.5f, 1);
  right.card(0.5f, 0, 1, 1);
  most.card(0.25f, 0, 1, 1);
  EXPECT_FLOAT_EQ(left.measure(half_green()).alpha_coverage, 1);
  EXPECT_FLOAT_EQ(right.measure(half_green()).alpha_coverage, 0);
  EXPECT_EQ(right.measure(half_green()).mean_colour,
            (Float3{1, 1, 1}));  // nothing to see: as without a texture
  EXPECT_NEAR(most.measure(half_green()).alpha_coverage, 1.0 / 3, 1e-3);
}

TEST(TextureStatistics, LargeTrianglesCountMore) {
  Sheet sheet;
  sheet.card(0, 0, 0.5f, 1, 3);
  sheet.card(0.5f, 0, 1, 1, 1);
  EXPECT_NEAR(sheet.measure(half_green()).alpha_coverage, 0.75, 1e-6);
}

TEST(TextureStatistics, VUpwardsMeetsRowsFromTheTop) {
  Picture p(8, 8, k_green);
  for (int x = 0; x < 8; ++x) p.set(x, 0, k_red);  // the top row
  Sheet top, bottom;
  top.card(0, 0.875f, 1, 1);
  bottom.card(0, 0, 1, 0.125f);
  EXPECT_EQ(top.measure(p).mean_colour, (Float3{1, 0, 0}));
  EXPECT_EQ(bottom.measure(p).mean_colour, (Float3{0, 1, 0}));
}

TEST(TextureStatistics, TexturesRepeat) {
  Sheet sheet;
  sheet.card(-3.5f, 2, -3, 3);  // the right half, some repeats away
  EXPECT_FLOAT_EQ(sheet.measure(half_green()).alpha_coverage, 0);
  Sheet wide;
  wide.card(0.25f, 0.1f, 4.25f, 7.1f);
  EXPECT_NEAR(wide.measure(half_green()).alpha_coverage, 0.5, 1e-3);
  Sheet huge;
  huge.card(0, 0, 1000, 3);
  EXPECT_EQ(huge.measure(half_green()).whole, 2u);
  EXPECT_FLOAT_EQ(huge.measure(half_green()).alpha_coverage, 0.5);
}

TEST(TextureStatistics, ColoursAreLinearAndWeightedByAlpha) {
  Picture p(2, 1, {188, 188, 188, 255});
  p.set(1, 0, {0, 0, 0, 85});  // a third as opaque
  Sheet sheet;
  sheet.card(0, 0, 1, 1);
  const TextureStatistics s = sheet.measure(p);
  const double grey = std::pow((188 / 255.0 + 0.055) / 1.055, 2.4);
  // The two triangles see different shares of the columns; together each sees half.
  EXPECT_NEAR(s.mean_colour.x, grey * 0.75, 2e-3);
  EXPECT_NEAR(s.alpha_coverage, (1 + 1.0 / 3) / 2, 2e-3);
}

TEST(TextureStatistics, TheAlphaTestCountsWhatItLetsThroughWhole) {
  Picture p(2, 1, {255, 255, 255, 200});
  p.set(1, 0, {0, 0, 0, 100});
  Sheet sheet;
  sheet.card(0, 0, 1, 1);
  sheet.mesh.materials[0].alpha_cutoff = 0.5f;
  EXPECT_NEAR(sheet.measure(p).alpha_coverage, 0.5, 2e-3);
  EXPECT_EQ(sheet.measure(p).mean_colour, (Float3{1, 1, 1}));
  sheet.mesh.materials[0].alpha = 0.6f;  // 200 / 255 * 0.6 < 0.5
  EXPECT_FLOAT_EQ(sheet.measure(p).alpha_coverage, 0);
}

TEST(TextureStatistics, AgreesWithBruteForceOnRandomTriangles) {
  Random random(3);
  Picture p(37, 53, k_clear);
  for (int y = 0; y < 53; ++y) {
    for (int x = 0; x < 37; ++x) {
      const auto byte = [&] { return static_cast<std::uint8_t>(random.below(256)); };
      p.set(x, y, {byte(), byte(), byte(), byte()});
    }
  }
  for (int round = 0; round < 20; ++round) {
    Sheet sheet;
    sheet.card(0, 0, 1, 1);
    sheet.mesh.triangles.resize(1), sheet.mesh.texcoord_triangles.resize(1), sheet.mesh.part_of.resize(1);
    for (Float2& t : sheet.mesh.texcoords)
      t = {static_cast<float>(random.uniform(-1, 2)), static_cast<float>(random.uniform(-1, 2))};
    const auto& t = sheet.mesh.texcoords;
    double alpha = 0;
    constexpr int k_side = 700;  // points (a, b) of the triangle, evenly
    for (int i = 0; i < k_side; ++i) {
      for (int j = 0; j < k_side; ++j) {
        double a = (i + 0.5) / k_side, b = (j + 0.5) / k_side;
        if (a + b > 1) a = 1 - a, b = 1 - b;
        const double u = t[0].x + a * (t[1].x - t[0].x) + b * (t[2].x - t[0].x),
                     v = t[0].y + a * (t[1].y - t[0].y) + b * (t[2].y - t[0].y);
        const int x = std::min(36, static_cast<int>((u - std::floor(u)) * 37));
        const int y = std::min(52, static_cast<int>((1 - v - std::floor(1 - v)) * 53));
        alpha += p.rgba[static_cast<std::size_t>(4 * (y * 37 + x) + 3)] / 255.0;
      }
    }
    EXPECT_NEAR(sheet.measure(p).alpha_coverage, alpha / k_side / k_side, 0.01);
  }
}

TEST(TextureStatistics, TrianglesWithoutWidthOrWithinOneTexelAreSampledToo) {
  Picture p(8, 8, k_green);
  for (const float size : {0.0f, 1e-6f, 0.01f}) {
    Sheet sheet;
    sheet.card(0.5f, 0.5f, 0.5f + size, 0.5f + size);
    EXPECT_EQ(sheet.measure(p).mean_colour, (Float3{0, 1, 0})) << size;
    EXPECT_FLOAT_EQ(sheet.measure(p).alpha_coverage, 1) << size;
  }
}

TEST(TextureStatistics, OfVeryManyFootprintsASampleByAreaStandsForAll) {
  Sheet sheet;
  Random random(3);
  double covered = 0, area = 0;
  for (int i = 0; i < 80'000; ++i) {  // 160 000 footprints; large ones lie on the green half more often
    const bool large = i % 100 == 0;
    const float u = static_cast<float>(large ? 0.3 * random.uniform() : random.uniform());
    const float v = static_cast<float>(random.uniform()), width = 0.1f;
    const double size = large ? 50 : 1;
    sheet.card(u, v, u + width, v + 0.2f, size);
    const auto green = [](double to) { return std::floor(to) * 0.5 + std::min(to - std::floor(to), 0.5); };
    covered += size * (green(u + width) - green(u)) / width, area += size;
  }
  EXPECT_NEAR(sheet.measure(half_green()).alpha_coverage, covered / area, 3e-3);
}

TEST(TextureStatistics, WithoutImageTrianglesOrAreaThereIsAnAnswer) {
  Sheet sheet;
  sheet.card(0, 0, 1, 1);
  const auto none = texture_statistics(sheet.mesh, [](std::uint32_t) { return std::nullopt; });
  EXPECT_FALSE(none[0].sampled);
  EXPECT_EQ(none[0].alpha_coverage, 1);
  EXPECT_FLOAT_EQ(Sheet().measure(half_green()).alpha_coverage, 0.5);
  Sheet flat;
  flat.card(0, 0, 0.5f, 1, 0);
  EXPECT_FLOAT_EQ(flat.measure(half_green()).alpha_coverage, 0.5);
  EXPECT_TRUE(texture_statistics(Mesh{}, [](std::uint32_t) { return std::nullopt; }).empty());
}

TEST(TextureStatistics, EveryTextureIsAskedForOnce) {
  Sheet sheet;
  sheet.mesh.materials.resize(4, sheet.mesh.materials[0]);
  sheet.mesh.materials[1].texture = 7;
  sheet.mesh.materials[3].texture = k_none;
  std::vector<std::uint32_t> asked;
  const Picture p = half_green();
  const auto statistics = texture_statistics(sheet.mesh, [&](std::uint32_t t) {
    asked.push_back(t);
    return p.view();
  });
  EXPECT_EQ(asked, (std::vector<std::uint32_t>{0, 7}));
  EXPECT_TRUE(statistics[2].sampled);
  EXPECT_FALSE(statistics[3].sampled);
}

TEST(TextureStatistics, AreAppliedToMaterialsThatWereSampled) {
  std::vector<Material> materials(2);
  std::vector<TextureStatistics> statistics(2);
  statistics[0] = {{0.1f, 0.2f, 0.3f}, 0.4f, true, 1, 1, 0};
  statistics[1].alpha_coverage = 0.5f;
  copse::apply(statistics, materials);  // std::apply would be a candidate
  EXPECT_EQ(materials[0].mean_colour, (Float3{0.1f, 0.2f, 0.3f}));
  EXPECT_EQ(materials[0].alpha_coverage, 0.4f);
  EXPECT_EQ(materials[1].alpha_coverage, 1);
}

}  // namespace
}  // namespace copse
