#include "lib/formats/levels/impostors.h"

#include "tests/formats/tampering.h"
#include "tests/formats/tree_maker.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <gtest/gtest.h>

namespace copse {
namespace {

using Layout = ImpostorLayout;

// As much of a PNG as the reader of a container looks at.
Array<std::uint8_t> png(std::uint8_t width, std::uint8_t height) {
  std::vector<std::uint8_t> out{0x89, 'P', 'N', 'G', '\r', '\n', 0x1a, '\n', 0, 0, 0, 13, 'I', 'H', 'D', 'R'};
  out.insert(out.end(), {0, 0, 0, width, 0, 0, 0, height, 8, 6, 0, 0, 0, 1, 2, 3, 4});
  return out;
}

ImpostorAtlas atlas() {
  return {.layout = Layout::octahedral,
          .views = 4,
          .size = 8,
          .centre = {1, 2, 3},
          .radius = 5,
          .distance = 70,
          .albedo = png(32, 32),
          .normal = png(32, 32)};
}

std::vector<std::uint8_t> file_with(const ImpostorAtlas& a) {
  const auto bytes = encode_tree(make_tree({}, 1));
  EXPECT_TRUE(bytes.has_value());
  const auto container = Container::from_bytes(*bytes, "test");
  EXPECT_TRUE(container.has_value());
  ContainerWriter writer(*container);
  EXPECT_TRUE(put_impostor(writer, a).has_value());
  return writer.finish().value();
}

Result<ImpostorAtlas> through_a_file(const ImpostorAtlas& a) {
  const auto file = TreeFile::from_bytes(file_with(a), "test");
  EXPECT_TRUE(file.has_value());
  return read_impostor(*file);
}

TEST(Impostors, ComeBackFromAFileAsTheyWere) {
  const auto back = through_a_file(atlas());
  ASSERT_TRUE(back.has_value()) << back.error().what;
  EXPECT_EQ(back->layout, Layout::octahedral);
  EXPECT_EQ(back->views, 4u);
  EXPECT_EQ(back->size, 8u);
  EXPECT_EQ(back->centre, (Float3{1, 2, 3}));
  EXPECT_EQ(back->radius, 5);
  EXPECT_EQ(back->distance, 70);
  EXPECT_EQ(back->albedo.to_vector(), atlas().albedo.to_vector());
  const auto none = through_a_file({});
  ASSERT_TRUE(none.has_value());
  EXPECT_TRUE(none->empty());
}

TEST(Impostors, EachThingThatIsWrongIsNamed) {
  const auto wrong = [](auto&& change) {
    ImpostorAtlas a = atlas();
    change(a);
    return check_impostor(a);
  };
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(check_impostor(atlas()), "");
  EXPECT_NE(wrong([](auto& a) { a.layout = static_cast<Layout>(9); }).find("layout"), std::string::npos);
  EXPECT_NE(wrong([](auto& a) { a.views = 65; }).find("atlas"), std::string::npos);
  EXPECT_NE(wrong([](auto& a) { a.size = 1u << 31; }).find("atlas"), std::string::npos);
  EXPECT_NE(wrong([](auto& a) { a.size = 0; }).find("atlas"), std::string::npos);
  EXPECT_NE(wrong([&](auto& a) { a.radius = nan; }).find("sphere"), std::string::npos);
  EXPECT_NE(wrong([&](auto& a) { a.centre.y = nan; }).find("sphere"), std::string::npos);
  EXPECT_NE(wrong([](auto& a) { a.distance = -1; }).find("distance"), std::string::npos);
  EXPECT_NE(wrong([](auto& a) { a.albedo = png(31, 32); }).find("IMPA"), std::string::npos);
  EXPECT_NE(wrong([](auto& a) { a.normal = {}; }).find("IMPN"), std::string::npos);
  EXPECT_NE(wrong([](auto& a) { a.normal = std::vector<std::uint8_t>(100, 7); }).find("PNG"),
            std::string::npos);
}

// Whatever one byte becomes, with the checksums put right: refused, or sound.
TEST(Impostors, ForgedBytesAreRefusedOrSound) {
  const std::vector<std::uint8_t> sound = file_with(atlas());
  int refused = 0;
  for (const char* section : {"IMPO", "IMPA", "IMPN"}) {
    const std::size_t first = tampering::section_at(sound, section);
    for (std::size_t i = 0; i < 32; ++i) {
      for (const std::uint8_t value : {0x00, 0x01, 0x7f, 0x80, 0xff}) {
        std::vector<std::uint8_t> bytes = sound;
        bytes[first + i] = value;
        tampering::mend_checksums(bytes);
        const auto file = TreeFile::from_bytes(bytes, "forged");
        ASSERT_TRUE(file.has_value());
        const auto read = read_impostor(*file);
        refused += read ? 0 : 1;
        if (read) {
          EXPECT_EQ(check_impostor(*read), "") << section << " " << i;
        }
      }
    }
  }
  EXPECT_GT(refused, 200);
}

TEST(Impostors, TheOctahedralMapGoesThereAndBack) {
  for (const std::uint32_t n : {1u, 3u, 16u}) {
    for (const Double3& d : impostor_views(Layout::octahedral, n)) {
      const auto [u, v] = octahedral_place(d);
      EXPECT_NEAR(distance(octahedral_direction(u, v), d), 0, 1e-12);
      EXPECT_NEAR(length(d), 1, 1e-12);
    }
  }
  EXPECT_NEAR(distance(octahedral_direction(0, 0), {0, 1, 0}), 0, 1e-12);
  EXPECT_TRUE(is_finite(octahedral_direction(1, 1)));
}

TEST(Impostors, AtAViewThatViewAloneCounts) {
  for (const Layout layout : {Layout::octahedral, Layout::billboard}) {
    const auto views = impostor_views(layout, 6);
    for (std::uint32_t v = 0; v < views.size(); ++v) {
      const ImpostorBlend blend = impostor_blend(layout, 6, views[v]);
      double own = 0;
      for (std::size_t k = 0; k < 3; ++k) own += blend.view[k] == v ? blend.weight[k] : 0;
      EXPECT_NEAR(own, 1, 1e-9) << v;
    }
  }
}

// Sums of weighted views, so that which of equal views is named first does not matter.
std::vector<double> weights(const Layout layout, std::uint32_t n, const Double3& d) {
  std::vector<double> out(impostor_views(layout, n).size());
  const ImpostorBlend b = impostor_blend(layout, n, d);
  for (std::size_t k = 0; k < 3; ++k) out[b.view[k]] += b.weight[k];
  return out;
}

TEST(Impostors, WeightsAreSharesAndChangeContinuously) {
  for (const Layout layout : {Layout::octahedral, Layout::billboard}) {
    std::vector<double> before;
    // A great circle that crosses the borders of the map.
    for (int i = 0; i <= 4000; ++i) {
      const double a = 2 * std::numbers::pi * i / 4000;
      const Double3 d = normalized({std::cos(a), 0.9 * std::sin(a), 0.37 * std::sin(a) + 0.2 * std::cos(a)});
      const std::vector<double> now = weights(layout, 5, d);
      double sum = 0, change = 0;
      for (std::size_t v = 0; v < now.size(); ++v) {
        EXPECT_GE(now[v], -1e-12);
        sum += now[v];
        if (!before.empty()) change = std::max(change, std::abs(now[v] - before[v]));
      }
      EXPECT_NEAR(sum, 1, 1e-9);
      EXPECT_LT(change, 0.05) << i;
      before = now;
    }
  }
  EXPECT_EQ(impostor_blend(Layout::octahedral, 0, {0, 1, 0}).weight[0], 0);
}

}  // namespace
}  // namespace copse
