// picture_error: how different two pictures of the same size look.
#pragma once

#include "lib/analysis/measure/picture.h"

namespace copse {

struct PictureError {
  double rmse = 0;  // root mean square over pixels and channels, of sRGB-coded values in [0, 1]
  double ssim = 1;  // mean structural similarity of sRGB-coded luma; windows of 8 x 8 pixels, 4 apart
};

// Both over the whole picture, ground included. Source of SSIM: Wang, Bovik, Sheikh, Simoncelli, "Image
// quality assessment: from error visibility to structural similarity" (2004), with uniform windows and its
// constants (0.01, 0.03). Pictures of different sizes have nothing in common: rmse 1, ssim 0. Linear.
PictureError picture_error(const Picture& a, const Picture& b);
// Its rmse alone, bit for bit: where both are the same nothing is coded, several times as fast.
double picture_rmse(const Picture& a, const Picture& b);

}  // namespace copse
