#include "lib/formats/import/plain_image.h"

#include <csetjmp>
#include <cstdio>
#include <cstring>
#include <new>
#include <vector>

#include <jpeglib.h>
#include <png.h>

namespace copse {
namespace {

// Both libraries leave by longjmp, so no object with a destructor is made in a function that calls them.

bool make_room(Image& image, std::uint64_t width, std::uint64_t height, bool has_alpha) {
  if (width == 0 || height == 0 || width > k_image_pixels / height) return false;
  image.width = static_cast<int>(width), image.height = static_cast<int>(height);
  image.has_alpha = has_alpha;
  image.rgba.resize(4 * width * height);
  return true;
}

using Span = std::span<const std::uint8_t>;

void png_bytes(png_structp png, png_bytep out, std::size_t size) {
  Span& left = *static_cast<Span*>(png_get_io_ptr(png));
  if (size > left.size()) png_error(png, "ends early");
  std::memcpy(out, left.data(), size);
  left = left.subspan(size);
}

[[noreturn]] void png_failed(png_structp png, png_const_charp) {
  png_longjmp(png, 1);
}

void png_warned(png_structp, png_const_charp) {}

bool is_plain(png_structp png, png_infop info) {
  const int type = png_get_color_type(png, info);
  return png_get_bit_depth(png, info) == 8 && (type == PNG_COLOR_TYPE_RGB || type == PNG_COLOR_TYPE_RGBA) &&
         png_get_valid(png, info, PNG_INFO_tRNS) == 0;
}

bool read_png(png_structp png, png_infop info, Image& image, std::vector<png_bytep>& rows) {
  if (setjmp(png_jmpbuf(png)) != 0) return false;
  png_read_info(png, info);
  if (!is_plain(png, info)) return false;
  const bool has_alpha = png_get_color_type(png, info) == PNG_COLOR_TYPE_RGBA;
  if (!make_room(image, png_get_image_width(png, info), png_get_image_height(png, info), has_alpha))
    return false;
  if (!has_alpha) png_set_add_alpha(png, 0xff, PNG_FILLER_AFTER);
  png_set_interlace_handling(png);
  png_read_update_info(png, info);
  for (int y = 0; y < image.height; ++y) {
    rows.push_back(image.rgba.data() +
                   std::size_t{4} * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(y));
  }
  png_read_image(png, rows.data());
  png_read_end(png, nullptr);
  return true;
}

bool decode_png(Span bytes, Image& image) {
  png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, nullptr, png_failed, png_warned);
  if (png == nullptr) return false;
  png_infop info = png_create_info_struct(png);
  std::vector<png_bytep> rows;
  png_set_read_fn(png, &bytes, png_bytes);
  bool good = false;
  try {
    good = info != nullptr && read_png(png, info, image, rows);
  } catch (const std::bad_alloc&) {
  }
  png_destroy_read_struct(&png, &info, nullptr);
  return good;
}

struct JpegErrors {
  jpeg_error_mgr manager;  // first: the library knows this alone
  std::jmp_buf jump;
};

[[noreturn]] void jpeg_failed(j_common_ptr jpeg) {
  std::longjmp(reinterpret_cast<JpegErrors*>(jpeg->err)->jump, 1);
}

// Warnings are of damaged data, messages of no interest.
void jpeg_told(j_common_ptr jpeg, int level) {
  if (level < 0) jpeg_failed(jpeg);
}

bool read_jpeg(jpeg_decompress_struct& jpeg, JpegErrors& errors, Span bytes, Image& image) {
  if (setjmp(errors.jump) != 0) return false;
  jpeg_create_decompress(&jpeg);
  jpeg_mem_src(&jpeg, bytes.data(), bytes.size());
  jpeg_read_header(&jpeg, TRUE);
  if (jpeg.num_components != 3 || (jpeg.jpeg_color_space != JCS_YCbCr && jpeg.jpeg_color_space != JCS_RGB) ||
      !make_room(image, jpeg.image_width, jpeg.image_height, false))
    return false;
  jpeg.out_color_space = JCS_EXT_RGBA;
  jpeg_start_decompress(&jpeg);
  while (jpeg.output_scanline < jpeg.output_height) {
    JSAMPROW row = image.rgba.data() + std::size_t{4} * jpeg.output_width * jpeg.output_scanline;
    jpeg_read_scanlines(&jpeg, &row, 1);
  }
  jpeg_finish_decompress(&jpeg);
  return true;
}

bool decode_jpeg(Span bytes, Image& image) {
  jpeg_decompress_struct jpeg{};
  JpegErrors errors{};
  jpeg.err = jpeg_std_error(&errors.manager);
  errors.manager.error_exit = jpeg_failed;
  errors.manager.emit_message = jpeg_told;
  bool good = false;
  try {
    good = read_jpeg(jpeg, errors, bytes, image);
  } catch (const std::bad_alloc&) {
  }
  jpeg_destroy_decompress(&jpeg);
  return good;
}

}  // namespace

bool decode_plain_image(std::span<const std::uint8_t> bytes, Image& image) {
  if (bytes.size() >= 8 && png_sig_cmp(bytes.data(), 0, 8) == 0) return decode_png(bytes, image);
  if (bytes.size() >= 3 && bytes[0] == 0xff && bytes[1] == 0xd8 && bytes[2] == 0xff)
    return decode_jpeg(bytes, image);
  return false;
}

}  // namespace copse
