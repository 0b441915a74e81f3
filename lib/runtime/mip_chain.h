// The smaller versions of a texture, made so that foliage looks the same from afar as from near.
//
// Colours are averaged in linear light and weighted by alpha, so what is invisible does not tint what is
// visible; texels with alpha 0 get the colour that surrounds them, so that filtering across the cut shows no
// dark or white fringe. For an alpha-tested texture every level lets the same share of the surface through as
// the largest one: without that, averaged alpha falls below the cutoff and distant trees go bald.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

struct MipLevel {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;  // sRGB colour, linear alpha; rows as in the source
};

// `rgba` has width * height * 4 bytes; sizes are halved, rounding down, to 1 x 1. alpha_cutoff 0: no alpha
// test. Level 0 has the source's alpha, and its colour wherever alpha > 0. O(texels); deterministic.
std::vector<MipLevel> mip_chain(std::span<const std::uint8_t> rgba, int width, int height,
                                float alpha_cutoff);

// The share of texels that pass the test alpha >= cutoff; 1 for cutoff 0 or no texels.
double alpha_coverage(const MipLevel& level, float alpha_cutoff);

}  // namespace copse
