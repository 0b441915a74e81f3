// plain_image: PNG and JPEG as most textures are, without a large library.
//
// OpenImageIO reads everything, but loading it takes a quarter of a second and 150 MB, more than all else
// that is done to a tree of 300 000 triangles. What it would ask libpng or libjpeg for is asked for directly
// where there is nothing to convert: the pixels are the same, bit for bit.
#pragma once

#include "lib/formats/import/image.h"

#include <cstdint>
#include <span>

namespace copse {

// PNG of 8 bits a channel, RGB or RGBA, without a transparent colour; JPEG of three colours. False for
// everything else, for what is larger than k_image_pixels and for what is damaged in any way: OpenImageIO
// then reads it or says what is wrong. `image` is whole only where the answer is true.
bool decode_plain_image(std::span<const std::uint8_t> bytes, Image& image);

}  // namespace copse
