#include "tools/treegrow/art.h"

#include "tests/grow/mesh_facts.h"

#include <cmath>

#include <gtest/gtest.h>

namespace copse::grow {
namespace {

constexpr int k_size = 128;

const std::uint8_t* texel(const Image& image, int x, int y) {
  return image.rgba.data() + 4 * (static_cast<std::size_t>(y) * static_cast<std::size_t>(image.width) +
                                  static_cast<std::size_t>(x));
}

std::vector<Image> painted(const char* species, const char* breaks) {
  const Order order = small_order(species, breaks);
  return paint(order, grow_mesh(order)->mesh.materials.size(), k_size);
}

class ArtOf : public testing::TestWithParam<std::string> {};

TEST_P(ArtOf, LeavesAreCutOutAndBarkIsNot) {
  const auto images = painted(GetParam().c_str(), "artist");
  ASSERT_FALSE(images.empty());
  for (std::size_t i = 0; i < images.size(); ++i) {
    const Image& image = images[i];
    EXPECT_EQ(image.width, k_size);
    ASSERT_EQ(image.rgba.size(), 4u * k_size * k_size);
    double opaque = 0;
    for (std::size_t p = 3; p < image.rgba.size(); p += 4) opaque += image.rgba[p] >= 128;
    opaque /= k_size * k_size;
    const bool leaf = i == 1 || GetParam() == "grass";
    EXPECT_EQ(image.has_alpha, leaf);
    if (leaf) {
      EXPECT_GT(opaque, 0.08);
      EXPECT_LT(opaque, 0.9);
    } else {
      EXPECT_EQ(opaque, 1);
    }
  }
}

TEST_P(ArtOf, IsTheSameEveryTimeAndDiffersFromSeedToSeed) {
  Order order = small_order(GetParam(), "artist");
  const auto a = paint(order, 2, k_size), b = paint(order, 2, k_size);
  order.seed = 99;
  const auto c = paint(order, 2, k_size);
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i].rgba, b[i].rgba);
  EXPECT_NE(a.back().rgba, c.back().rgba);
}

INSTANTIATE_TEST_SUITE_P(Species, ArtOf, testing::ValuesIn(species_names()),
                         [](const auto& test) { return test.param; });

// All triangles of a small tree with huge rings go into its trunk.
TEST(Art, ATreeWithoutLeavesHasNoPictureOfThem) {
  Order order = small_order("pine", "huge-rings");
  EXPECT_EQ(paint(order, 1, k_size).size(), 1u);
  EXPECT_EQ(paint(order, 2, k_size).size(), 2u);
}

TEST(Art, BarkTiles) {
  // The step over the edge is no larger than the steps inside are, line by line.
  for (int art = 0; art < 8; ++art) {
    const Image image = paint_bark(static_cast<BarkArt>(art), {0.2f, 0.2f, 0.2f}, k_size, 5).image(false);
    const auto step = [&](int x0, int y0, int x1, int y1) {
      return std::abs(texel(image, x0, y0)[1] - texel(image, x1, y1)[1]);
    };
    double edge = 0, inside = 0;
    for (int i = 0; i < k_size; ++i) {
      edge += step(0, i, k_size - 1, i) + step(i, 0, i, k_size - 1);
      for (int j = 1; j < k_size; ++j)
        inside += (step(j, i, j - 1, i) + step(i, j, i, j - 1)) / double{k_size - 1};
    }
    EXPECT_LT(edge, 1.6 * inside + 40) << art;
  }
}

TEST(Art, DrawingsForTrianglesStayInsideTheTriangle) {
  for (const std::string& name : species_names()) {
    const Species s = find_species(name).value();
    if (s.leaves.art == LeafArt::none || s.grass.blades > 0) continue;
    const Image image = paint_leaves(s.leaves, true, 2 * k_size, 1).image(true);
    double inside = 0, outside = 0;
    for (int y = 0; y < k_size; ++y) {  // one quarter: the lower left
      for (int x = 0; x < k_size; ++x) {
        const double u = (x + 0.5) / k_size, v = (y + 0.5) / k_size;
        const bool drawn = texel(image, x, 2 * k_size - 1 - y)[3] >= 128;
        (std::abs(u - 0.5) <= 0.5 * v + 0.02 ? inside : outside) += drawn;
      }
    }
    EXPECT_GT(inside, 0.05 * k_size * k_size) << name;
    EXPECT_LT(outside, 0.06 * inside) << name;
  }
}

TEST(Art, ColourGoesOnPastTheEdgesOfLeaves) {
  const Image image = painted("oak", "artist")[1];
  for (std::size_t p = 0; p < image.rgba.size(); p += 4)
    EXPECT_GT(image.rgba[p + 1], 10) << "a black fringe would show";
}

TEST(Art, OneMaterialHasOnePictureSideBySide) {
  const auto images = painted("birch", "one-material");
  ASSERT_EQ(images.size(), 1u);
  EXPECT_EQ(images[0].width, 2 * k_size);
  EXPECT_EQ(images[0].height, k_size);
  EXPECT_EQ(texel(images[0], 5, 5)[3], 255);
  EXPECT_EQ(texel(images[0], k_size + 1, k_size / 4)[3], 0);
}

TEST(Art, NothingIsPaintedWhereNothingCanShowIt) {
  EXPECT_TRUE(painted("oak", "no-names").empty());
  EXPECT_TRUE(painted("oak", "no-uvs").empty());
  EXPECT_EQ(painted("oak", "blobs").size(), 1u);
  EXPECT_EQ(painted("dead", "artist").size(), 1u);
}

}  // namespace
}  // namespace copse::grow
