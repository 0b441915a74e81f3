#include "lib/analysis/ecosystem/value_map.h"

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

}  // namespace
}  // namespace copse
