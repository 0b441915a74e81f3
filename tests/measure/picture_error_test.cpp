#include "lib/analysis/measure/picture_error.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

Picture flat(int size, float value) {
  Picture p{size, size, {}, {}};
  p.colour.assign(static_cast<std::size_t>(size) * size, {value, value, value});
  p.coverage.assign(p.colour.size(), 0);
  return p;
}

TEST(PictureError, OfAPictureWithItselfIsNothing) {
  Picture p = flat(32, 1);
  for (std::size_t i = 0; i < p.colour.size(); i += 3) p.colour[i] = {0.2f, 0.4f, 0.1f};
  const PictureError e = picture_error(p, p);
  EXPECT_EQ(e.rmse, 0);
  EXPECT_NEAR(e.ssim, 1, 1e-12);
}

TEST(PictureError, BetweenBlackAndWhiteIsOne) {
  const PictureError e = picture_error(flat(16, 0), flat(16, 1));
  EXPECT_NEAR(e.rmse, 1, 1e-9);
  EXPECT_LT(e.ssim, 0.01);
}

TEST(PictureError, IsMeasuredOnCodedValues) {
  // linear 0.2140 is coded as 0.5
  EXPECT_NEAR(picture_error(flat(8, 0), flat(8, 0.21404f)).rmse, 0.5, 1e-4);
}

TEST(PictureError, RootMeanSquareIsOverAllPixels) {
  Picture a = flat(10, 1), b = a;
  b.colour[37] = {0, 0, 0};
  EXPECT_NEAR(picture_error(a, b).rmse, 0.1, 1e-6);
}

TEST(PictureError, SimilarityIsSymmetricAndSeesStructureThatRmseDoesNot) {
  Picture a = flat(32, 0.5f), inverse = a, brighter = a;
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) {
      const float s = (x + y) % 2 == 0 ? 0.05f : -0.05f;
      a.colour[y * 32 + x] = {0.5f + s, 0.5f + s, 0.5f + s};
      inverse.colour[y * 32 + x] = {0.5f - s, 0.5f - s, 0.5f - s};
      brighter.colour[y * 32 + x] = {0.6f + s, 0.6f + s, 0.6f + s};
    }
  }
  EXPECT_LT(picture_error(a, inverse).ssim, 0);
  EXPECT_GT(picture_error(a, brighter).ssim, 0.8);
  EXPECT_DOUBLE_EQ(picture_error(a, brighter).ssim, picture_error(brighter, a).ssim);
}

TEST(PictureError, RmseAloneIsTheSameBitForBit) {
  Picture a = flat(40, 1), b = a;
  for (std::size_t i = 0; i < a.colour.size(); ++i) {
    const auto part = static_cast<float>(i % 7);
    if (i % 3 != 0) a.colour[i] = {0.1f * part, 0.05f, 1 - 0.1f * part};
    if (i % 5 != 0) b.colour[i] = a.colour[i];
  }
  EXPECT_GT(picture_rmse(a, b), 0);
  EXPECT_EQ(picture_rmse(a, b), picture_error(a, b).rmse);
  EXPECT_EQ(picture_rmse(a, a), 0);
  EXPECT_EQ(picture_rmse(flat(8, 1), flat(9, 1)), 1);
  EXPECT_EQ(picture_rmse({}, {}), 0);
}

TEST(PictureError, OfDifferentSizesIsComplete) {
  const PictureError e = picture_error(flat(8, 1), flat(9, 1));
  EXPECT_EQ(e.rmse, 1);
  EXPECT_EQ(e.ssim, 0);
}

TEST(PictureError, OfTinyOrEmptyPicturesIsDefined) {
  EXPECT_EQ(picture_error(flat(0, 1), flat(0, 1)).rmse, 0);
  EXPECT_NEAR(picture_error(flat(3, 1), flat(3, 1)).ssim, 1, 1e-12);
}

}  // namespace
}  // namespace copse
