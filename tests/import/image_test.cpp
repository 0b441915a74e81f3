#include "lib/formats/import/image.h"

#include "lib/formats/import/limits.h"
#include "tests/import/testing.h"

#include <algorithm>

namespace copse {
namespace {

using namespace copse::testing;

Image picture(bool alpha) {
  Image image{.width = 5, .height = 3, .rgba = {}, .has_alpha = alpha};
  for (int i = 0; i < 15; ++i) {
    const auto v = static_cast<std::uint8_t>(17 * i);
    image.rgba.insert(image.rgba.end(), {v, static_cast<std::uint8_t>(255 - v), 128,
                                         static_cast<std::uint8_t>(alpha ? v : 255)});
  }
  return image;
}

std::string text(const std::vector<std::uint8_t>& bytes) {
  return {bytes.begin(), bytes.end()};
}

TEST(Image, PngComesBackBitForBit) {
  for (const bool alpha : {false, true}) {
    const auto png = encode_png(picture(alpha));
    ASSERT_TRUE(png) << to_line(png.error(), "test");
    const auto back = read_image(*png, "leaf");
    ASSERT_TRUE(back) << to_line(back.error(), "test");
    EXPECT_EQ(back->width, 5);
    EXPECT_EQ(back->height, 3);
    EXPECT_EQ(back->has_alpha, alpha);
    EXPECT_EQ(back->rgba, picture(alpha).rgba) << "colours under alpha 0 are kept too";
    EXPECT_EQ(*encode_png(*back), *png) << "and the same bytes again";
  }
}

TEST(Image, EveryFormatThatIsWrittenIsReadAgain) {
  const Folder folder;
  for (const char* name :
       {"a.png", "a.jpg", "a.exr", "a.tif", "a.hdr", "a.webp", "a.bmp", "a.tga", "a.GIF"}) {
    const auto path = folder.path() / name;
    const auto written = write_image(path, picture(false));
    ASSERT_TRUE(written) << to_line(written.error(), "test");
    const auto back = read_image(path);
    ASSERT_TRUE(back) << to_line(back.error(), "test");
    EXPECT_EQ(back->width, 5) << name;
    EXPECT_EQ(back->height, 3) << name;
    const bool lossless =
        std::string(name) != "a.jpg" && std::string(name) != "a.webp" && std::string(name) != "a.GIF";
    if (!lossless) continue;
    int worst = 0;
    for (std::size_t i = 0; i < back->rgba.size(); ++i)
      worst = std::max(worst, std::abs(back->rgba[i] - picture(false).rgba[i]));
    EXPECT_LE(worst, std::string(name) == "a.hdr" ? 6 : 1) << name << ": sRGB stays sRGB";
  }
  for (const auto& entry : std::filesystem::directory_iterator(folder.path()))
    EXPECT_EQ(entry.path().stem(), "a") << "nothing is left beside the images";
}

TEST(Image, ExrKeepsAlphaAndColourApart) {
  const Folder folder;
  ASSERT_TRUE(write_image(folder.path() / "a.exr", picture(true)));
  const auto back = read_image(folder.path() / "a.exr");
  ASSERT_TRUE(back);
  EXPECT_TRUE(back->has_alpha);
  for (std::size_t i = 4; i < back->rgba.size(); ++i)
    EXPECT_NEAR(back->rgba[i], picture(true).rgba[i], 1) << "stored premultiplied, read straight";
}

TEST(Image, TheContentDecidesNotTheName) {
  const Folder folder;
  EXPECT_TRUE(read_image(folder.write("leaf.jpg", text(*encode_png(picture(true))))));
  EXPECT_EQ(to_line(read_image(as_bytes("no image"), "leaf.png").error(), "test"),
            "test: error: leaf.png: is of no image format that is read here; convert it to PNG or JPEG");
}

TEST(Image, EveryTruncationAndMutationIsAnErrorOrAnImage) {
  const std::string png = text(*encode_png(picture(true)));
  for (std::size_t size = 0; size < png.size(); ++size) {
    const auto result = read_image(as_bytes(png.substr(0, size)), "leaf");
    EXPECT_TRUE(!result || result->rgba.size() == 60u);
  }
  for (std::size_t i = 0; i < png.size(); ++i) {
    std::string bent = png;
    bent[i] = static_cast<char>(bent[i] ^ 0x55);
    const auto result = read_image(as_bytes(bent), "leaf");
    EXPECT_TRUE(!result || result->rgba.size() == 4u * static_cast<unsigned>(result->width * result->height));
  }
}

TEST(Image, WhatTheLibrariesPrintBecomesTheErrorInstead) {
  std::string png = text(*encode_png(picture(true)));
  png[png.size() - 16] = static_cast<char>(png[png.size() - 16] ^ 1);
  ::testing::internal::CaptureStderr();
  const auto result = read_image(as_bytes(png), "leaf.png");
  EXPECT_EQ(::testing::internal::GetCapturedStderr(), "");
  ASSERT_FALSE(result);
  EXPECT_EQ(to_line(result.error(), "test"),
            "test: error: leaf.png: cannot be read as png: libpng error: IDAT: CRC error; store it again, "
            "with at most "
            "67108864 pixels");
}

TEST(Image, AHugePictureIsRefusedBeforeMemoryIsTaken) {
  // A BMP header that claims 60000 x 60000 pixels.
  std::string bmp("BM\x36\0\0\0\0\0\0\0\x36\0\0\0\x28\0\0\0\x60\xea\0\0\x60\xea\0\0\1\0\x18\0", 30);
  bmp.resize(200);
  const auto result = read_image(as_bytes(bmp), "leaf");
  ASSERT_FALSE(result);
  EXPECT_EQ(result.error().fault, Fault::refused);
}

TEST(Image, AFolderThatIsMissingIsAnIoError) {
  const auto result = write_image("/nowhere/at/all.png", picture(false));
  ASSERT_FALSE(result);
  EXPECT_EQ(to_line(result.error(), "test"),
            "test: error: /nowhere/at/all.png: cannot be written: No such file or directory; check the "
            "folder and the space on "
            "its disk");
  EXPECT_EQ(write_image("a.xyz", picture(false)).error().fault, Fault::usage);
}

TEST(Limits, AreAllListedOnce) {
  const auto limits = import_limits();
  EXPECT_GE(limits.size(), 14u);
  for (const auto& limit : limits) {
    EXPECT_GT(limit.value, 0u) << limit.name;
    EXPECT_EQ(
        std::count_if(limits.begin(), limits.end(), [&](const auto& l) { return l.name == limit.name; }), 1);
  }
}

}  // namespace
}  // namespace copse
