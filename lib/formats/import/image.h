// Images in and out, through OpenImageIO. The library takes 0.2 s to load, so it sits in a plug-in
// (lib/libcopse_images.so beside the tools) that is loaded when the first image is asked for.
#pragma once

#include "lib/formats/result.h"

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace copse {

// Rows from the top, interleaved, 8 bits a channel as stored (colour images: sRGB), 4 channels: RGBA.
struct Image {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> rgba;
  bool has_alpha = false;  // false: alpha is 255 everywhere because the file has none
};

// The numbers of an image, for maps: rows from the top, channels interleaved, as many as the file has. Whole
// numbers of any width become 0 to 1 without any curve; floats stay as they are.
struct FloatImage {
  int width = 0, height = 0, channels = 0;
  std::vector<float> values;
};

// A picture of more pixels is refused: 8192 x 8192, 256 MB of RGBA.
inline constexpr std::uint64_t k_image_pixels = std::uint64_t{1} << 26;

// PNG, JPEG, EXR, TIFF, HDR, WebP, BMP, TGA and GIF (its first picture), recognised by content. Palettes,
// grey and 16 bits become RGBA of 8; floating-point images (EXR, HDR) are taken as linear and premultiplied,
// and become sRGB.
Result<Image> read_image(const std::filesystem::path& path);
Result<Image> read_image(std::span<const std::uint8_t> bytes, const std::string& name);

// At most 64 channels, and k_image_pixels numbers.
Result<FloatImage> read_float_image(const std::filesystem::path& path);

// The bytes of a PNG file, 8 bits a channel, RGBA (RGB without alpha); deterministic.
Result<std::vector<std::uint8_t>> encode_png(const Image& image);

// The extension picks the format (PNG, JPEG, EXR, TIFF, ...). Written beside, synced, renamed.
Result<void> write_image(const std::filesystem::path& path, const Image& image);

}  // namespace copse
