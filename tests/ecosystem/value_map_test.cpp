#include "lib/analysis/ecosystem/value_map.h"

#include "lib/formats/random.h"

#include <algorithm>
#include <limits>

#include <gtest/gtest.h>

namespace copse {
namespace {

const PlantedArea k_area{10, 20, 14, 22};
const ValueMap k_map{4, 2, {0, 1, 2, 3, 4, 5, 6, 7}};

TEST(ValueMap, APixelCoversItsPartOfTheArea) {
  EXPECT_EQ(pixel_at(k_map, k_area, 10.01, 20.01), 0);
  EXPECT_EQ(pixel_at(k_map, k_area, 13.99, 20.5), 3);
  EXPECT_EQ(pixel_at(k_map, k_area, 11.5, 21.5), 5);
  EXPECT_EQ(pixel_at(k_map, k_area, 14, 22), 7);  // the border belongs to the last one
  EXPECT_EQ(pixel_at(k_map, k_area, -100, 1e30), 4);
}

TEST(ValueMap, BetweenCentresItIsLinear) {
  EXPECT_EQ(smooth_at(k_map, k_area, 10.5, 20.5), 0);
  EXPECT_EQ(smooth_at(k_map, k_area, 11, 20.5), 0.5);
  EXPECT_EQ(smooth_at(k_map, k_area, 10.5, 21), 2);
  EXPECT_EQ(smooth_at(k_map, k_area, 10, 20), 0);  // no pixel beyond the border
}

TEST(ValueMap, OnePixelAndNoneAreMapsToo) {
  EXPECT_EQ(smooth_at({1, 1, {5}}, k_area, 12, 21), 5);
  EXPECT_EQ(pixel_at({}, k_area, 12, 21), 0);
}

TEST(ValueMap, TheLeastInARectangleIsAtMostWhatIsReadThere) {
  Random random(3);
  ValueMap map{9, 7, std::vector<float>(63)};
  for (float& v : map.values) v = static_cast<float>(random.uniform());
  const PlantedArea area{-1, 4, 8, 25};
  for (int i = 0; i < 500; ++i) {
    const double x0 = random.uniform(-1, 8), z0 = random.uniform(4, 25), x1 = x0 + random.uniform(0, 2),
                 z1 = z0 + random.uniform(0, 4);
    const double least = least_in(map, area, x0, z0, x1, z1);
    for (int k = 0; k < 20; ++k)
      EXPECT_GE(smooth_at(map, area, random.uniform(x0, x1), random.uniform(z0, z1)), least - 1e-12);
  }
  EXPECT_EQ(least_in(map, area, -1, 4, 8, 25),
            static_cast<double>(*std::min_element(map.values.begin(), map.values.end())));
  EXPECT_EQ(least_in({}, area, 0, 5, 1, 6), 0);
}

TEST(ValueMap, MeansBySizeAreOneMapOfEverySizeHoweverManyThereAre) {
  const ValueMap small{2, 1, {1, -5}}, tall{1, 2, {8, 4}}, other{2, 1, {3, 0}};
  const std::vector<const ValueMap*> maps{&small, &tall, &other, &small};
  const auto means = means_by_size(maps);
  ASSERT_EQ(means.size(), 2u);
  EXPECT_EQ(means[0].width, 2u);
  EXPECT_EQ(means[0].values, (std::vector<float>{5 / 4.0f, 0}));
  EXPECT_EQ(means[1].height, 2u);
  EXPECT_EQ(means[1].values, (std::vector<float>{2, 1}));
  EXPECT_TRUE(means_by_size({}).empty());
}

TEST(ValueMap, MeansOfTheLargestAndTheLeastFloatsAreNeitherInfiniteNorNothing) {
  const float most = std::numeric_limits<float>::max(), least = std::numeric_limits<float>::denorm_min();
  const ValueMap a{2, 1, {most, least}}, b{2, 1, {most, 0}};
  const std::vector<const ValueMap*> maps{&a, &b, &b};
  const auto means = means_by_size(maps);
  EXPECT_EQ(means[0].values, (std::vector<float>{most, least}));
}

}  // namespace
}  // namespace copse
