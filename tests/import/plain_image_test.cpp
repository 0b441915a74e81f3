#include "lib/formats/import/plain_image.h"

#include "lib/formats/random.h"
#include "tests/import/testing.h"

#include <fstream>
#include <iterator>

namespace copse {
namespace {

using namespace copse::testing;
using Bytes = std::vector<std::uint8_t>;

Image noise(int width, int height, bool alpha) {
  Image image{.width = width, .height = height, .rgba = {}, .has_alpha = alpha};
  Random random(3);
  for (int i = 0; i < 4 * width * height; ++i) {
    const auto value = static_cast<std::uint8_t>(random.below(256));
    image.rgba.push_back(i % 4 == 3 && !alpha ? 255 : value);
  }
  return image;
}

Bytes written(const std::string& name, const Image& image) {
  const Folder folder;
  EXPECT_TRUE(write_image(folder.path() / name, image));
  std::ifstream in(folder.path() / name, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

// Numbers are always read by OpenImageIO.
Image by_openimageio(const Bytes& bytes, const char* extension) {
  const Folder folder;
  const auto path = folder.path() / (std::string("image") + extension);
  std::ofstream(path, std::ios::binary).write(reinterpret_cast<const char*>(bytes.data()), std::ssize(bytes));
  const auto floats = read_float_image(path);
  EXPECT_TRUE(floats);
  Image image{
      .width = floats->width, .height = floats->height, .rgba = {}, .has_alpha = floats->channels == 4};
  for (std::size_t i = 0; i < floats->values.size(); ++i) {
    image.rgba.push_back(static_cast<std::uint8_t>(floats->values[i] * 255 + 0.5f));
    if (floats->channels == 3 && i % 3 == 2) image.rgba.push_back(255);
  }
  return image;
}

TEST(PlainImage, PngAndJpegHaveThePixelsThatOpenImageIoReads) {
  for (const bool alpha : {false, true}) {
    const Bytes png = written("a.png", noise(37, 21, alpha));
    Image image;
    ASSERT_TRUE(decode_plain_image(png, image));
    EXPECT_EQ(image.rgba, noise(37, 21, alpha).rgba);
    EXPECT_EQ(image.has_alpha, alpha);
  }
  const Bytes jpeg = written("a.jpg", noise(37, 21, false));
  Image image;
  ASSERT_TRUE(decode_plain_image(jpeg, image));
  const Image other = by_openimageio(jpeg, ".jpg");
  EXPECT_EQ(image.width, 37);
  EXPECT_EQ(image.height, 21);
  EXPECT_FALSE(image.has_alpha);
  EXPECT_EQ(image.rgba, other.rgba);
}

TEST(PlainImage, LeavesOtherFormatsAlone) {
  Image image;
  for (const char* name : {"a.bmp", "a.tif", "a.webp", "a.gif"}) {
    EXPECT_FALSE(decode_plain_image(written(name, noise(5, 4, false)), image)) << name;
  }
  EXPECT_FALSE(decode_plain_image({}, image));
}

TEST(PlainImage, WhatEndsEarlyIsRefusedWhereverThatIs) {
  for (const char* name : {"a.png", "a.jpg"}) {
    const Bytes whole = written(name, noise(9, 7, false));
    Image image;
    ASSERT_TRUE(decode_plain_image(whole, image)) << name;
    for (std::size_t n = 0; n < whole.size(); ++n)
      EXPECT_FALSE(decode_plain_image(std::span(whole).first(n), image)) << name << ' ' << n;
  }
}

TEST(PlainImage, DamagedBytesNeitherCrashNorGrowWithoutLimit) {
  for (const char* name : {"a.png", "a.jpg"}) {
    const Bytes whole = written(name, noise(16, 16, true));
    Random random(11);
    for (int i = 0; i < 2000; ++i) {
      Bytes mutant = whole;
      for (int n = 0; n <= i % 4; ++n)
        mutant[random.below(mutant.size())] = static_cast<std::uint8_t>(random.below(256));
      Image image;
      if (!decode_plain_image(mutant, image)) continue;
      EXPECT_EQ(image.rgba.size(),
                4u * static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height));
    }
  }
}

}  // namespace
}  // namespace copse
