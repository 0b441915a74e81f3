/* What the tools and the plug-in lib/libcopse_images.so say to each other, in C: nothing of OpenImageIO, no
   exception and no C++ type crosses. Pixels are RGBA, 8 bits, rows from the top; or all channels as floats.
 */
#pragma once

#include <cstddef>
#include <cstdint>

extern "C" {

#define COPSE_IMAGES_VERSION 2

struct CopseImageError {
  char text[240];
};

/* Called once the size is known; returns room for width * height * 4 bytes, or null to stop. */
using CopseImageAllocate = std::uint8_t* (*)(void* user, int width, int height, int has_alpha);
/* The same for width * height * channels floats. */
using CopseImageAllocateFloats = float* (*)(void* user, int width, int height, int channels);
/* Called once with the whole encoded file. */
using CopseImageSink = void (*)(void* user, const std::uint8_t* bytes, std::size_t size);

using CopseImageVersion = int (*)();
/* `format` as OpenImageIO names it: "png", "jpeg", "openexr". Return 0 when done. */
using CopseImageDecode = int (*)(const std::uint8_t* bytes, std::size_t size, const char* format,
                                 CopseImageAllocate allocate, void* user, CopseImageError* error);
/* Whole numbers become 0 to 1, floats stay as they are. */
using CopseImageDecodeFloats = int (*)(const std::uint8_t* bytes, std::size_t size, const char* format,
                                       CopseImageAllocateFloats allocate, void* user, CopseImageError* error);
using CopseImageEncode = int (*)(const std::uint8_t* rgba, int width, int height, int has_alpha,
                                 const char* format, CopseImageSink sink, void* user, CopseImageError* error);
}
