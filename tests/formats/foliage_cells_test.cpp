#include "lib/formats/levels/foliage_cells.h"

#include "tests/formats/tree_maker.h"

#include <limits>

#include <gtest/gtest.h>

namespace copse {
namespace {

FoliageCells two_cells() {
  FoliageCells f;
  FoliageCell a, b;
  a.box.half_extents = b.box.half_extents = {1, 1, 1};
  a.first = 0, a.count = 2, b.first = 2, b.count = 1;
  f.cells = std::vector<FoliageCell>{a, b};
  f.order = std::vector<std::uint32_t>{2, 0, 1};
  f.views = std::vector<Float3>{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  f.view_triangles = std::vector<std::array<std::uint32_t, 3>>{{0, 1, 2}};
  f.visibility = std::vector<CellVisibility>(6, {1, 2});
  f.parameters.near = 1, f.parameters.far = 10;
  return f;
}

TEST(FoliageCells, SoundOnesPass) {
  EXPECT_EQ(check_foliage_cells(two_cells(), 3), "");
}

TEST(FoliageCells, EachThingThatIsWrongIsNamed) {
  const auto wrong = [](auto&& change) {
    FoliageCells f = two_cells();
    change(f);
    return check_foliage_cells(f, 3);
  };
  const auto nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_NE(wrong([](auto& f) {
              f.order = std::vector<std::uint32_t>{2, 2, 1};
            }).find("FORD"),
            std::string::npos);
  EXPECT_NE(wrong([](auto& f) {
              f.order = std::vector<std::uint32_t>{2, 3, 1};
            }).find("FORD"),
            std::string::npos);
  EXPECT_NE(wrong([](auto& f) {
              f.order = std::vector<std::uint32_t>{0, 1};
            }).find("FCEL"),
            std::string::npos);
  EXPECT_NE(wrong([](auto& f) { f.views = std::vector<Float3>(3); }).find("FVWS"), std::string::npos);
  EXPECT_NE(wrong([](auto& f) { f.visibility = std::vector<CellVisibility>(5); }).find("FVIS"),
            std::string::npos);
  EXPECT_NE(wrong([](auto& f) {
              f.visibility = std::vector<CellVisibility>(6, {3, 2});
            }).find("FVIS"),
            std::string::npos);
  EXPECT_NE(wrong([](auto& f) {
              f.view_triangles = std::vector<std::array<std::uint32_t, 3>>{{0, 1, 3}};
            }).find("FVTR"),
            std::string::npos);
  EXPECT_NE(wrong([](auto& f) { f.parameters.far = 0.5; }).find("FPAR"), std::string::npos);
  EXPECT_NE(wrong([&](auto& f) { f.parameters.near = nan; }).find("FPAR"), std::string::npos);
  EXPECT_NE(wrong([](auto& f) { f.parameters.ramp = FoliageParameters::Ramp{2}; }).find("FPAR"),
            std::string::npos);
  EXPECT_NE(wrong([](auto& f) { f.parameters.anchor = FoliageParameters::Anchor{1}; }).find("FPAR"),
            std::string::npos);
  EXPECT_NE(wrong([](auto& f) { f.parameters.half_distance = 1; }).find("FPAR"), std::string::npos);
  EXPECT_NE(wrong([](auto& f) { f.parameters.anchor = FoliageParameters::Anchor(7); }).find("FPAR"),
            std::string::npos);
  EXPECT_NE(check_foliage_cells(two_cells(), 4), "");
}

Result<TreeFile> file_with(const FoliageCells& foliage) {
  const Tree tree = make_tree({.leaves = 3, .groups = 1}, 1);
  auto plain = Container::from_bytes(*encode_tree(tree), "a.stree");
  ContainerWriter writer(*plain);
  if (auto r = put_foliage_cells(writer, foliage); !r) return std::unexpected(r.error());
  return TreeFile::from_bytes(*writer.finish(), "a.stree");
}

TEST(FoliageCells, ComeBackFromAFileAsTheyWere) {
  const FoliageCells wrote = two_cells();
  const auto file = file_with(wrote);
  ASSERT_TRUE(file);
  const auto read = read_foliage_cells(*file);
  ASSERT_TRUE(read) << read.error().what;
  EXPECT_EQ(read->cells.to_vector(), wrote.cells.to_vector());
  EXPECT_EQ(read->order.to_vector(), wrote.order.to_vector());
  EXPECT_EQ(read->views.to_vector(), wrote.views.to_vector());
  EXPECT_EQ(read->view_triangles.to_vector(), wrote.view_triangles.to_vector());
  EXPECT_EQ(read->visibility.to_vector(), wrote.visibility.to_vector());
  EXPECT_EQ(read->parameters, wrote.parameters);
}

TEST(FoliageCells, ThatAreWrongAreRefusedWhenRead) {
  FoliageCells wrong = two_cells();
  wrong.order = std::vector<std::uint32_t>{0, 0, 1};
  const auto read = read_foliage_cells(*file_with(wrong));
  ASSERT_FALSE(read);
  EXPECT_NE(read.error().what.find("FORD"), std::string::npos);
}

TEST(FoliageCells, OfAFileWithoutThemAreEmpty) {
  const auto file = TreeFile::from_bytes(*encode_tree(make_tree({}, 1)), "a.stree");
  const auto read = read_foliage_cells(*file);
  ASSERT_TRUE(read);
  EXPECT_TRUE(read->cells.empty());
}

TEST(FoliageCells, NothingCoveredIsNotVisible) {
  EXPECT_EQ(CellVisibility{}.share(), 0);
  EXPECT_EQ((CellVisibility{1, 4}).share(), 0.25);
}

}  // namespace
}  // namespace copse
