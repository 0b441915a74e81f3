// The smaller versions of a texture, made so that foliage looks the same from afar as from near.
//
// Colours are averaged in linear light and weighted by alpha, so what is invisible does not tint what is
// visible; texels with alpha 0 get the colour that surrounds them, so that filtering across the cut shows no
// dark or white fringe. For an alpha-tested texture every level lets the same share of the surface through as
// the largest one, as a filter between texels reads it: without that, averaged alpha falls below the cutoff
// and distant trees go bald (Castano, "Computing alpha mipmaps", 2010). The chain ends where so few texels
// cannot.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

struct MipLevel {
  int width = 0, height = 0;
  std::vector<std::uint8_t> rgba;  // sRGB colour, linear alpha; rows as in the source
};

// `rgba` has width * height * 4 bytes; sizes are halved, rounding down, to 1 x 1, or, with an alpha test, as
// far as alpha_coverage stays within k_coverage_tolerance of the largest level's. alpha_cutoff 0: no alpha
// test. Level 0 has the source's alpha, and its colour wherever alpha > 0. O(texels); deterministic.
std::vector<MipLevel> mip_chain(std::span<const std::uint8_t> rgba, int width, int height,
                                float alpha_cutoff);

// The share of the surface that passes the test alpha >= cutoff where alpha is read between texels and the
// texture repeats (bilinear, at 4096 places or more); 1 for cutoff 0 or no texels.
double alpha_coverage(const MipLevel& level, float alpha_cutoff);

inline constexpr double k_coverage_tolerance = 0.1;  // of the share

}  // namespace copse
