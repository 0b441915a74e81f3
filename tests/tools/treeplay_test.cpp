// treeplay as a user calls it: pictures whose every pixel is known, errors, windows.
#include "lib/formats/import/image.h"
#include "lib/formats/tree/check_tree.h"
#include "lib/formats/tree_file/tree_file.h"
#include "tests/tools/process.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace copse {
namespace {

using Strings = std::vector<std::string>;
using Pixel = std::array<int, 3>;

constexpr Pixel k_black{0, 0, 0}, k_red{255, 0, 0};

// At distance 4 the picture is 4 m high: tan(fov / 2) = 1 / 2.
const std::string k_front = "0,0,4,0,0,0,53.13010235415598";

// A square of side 2 round the origin that faces +Z; `at` is added to every coordinate.
std::string square_obj(double at = 0, const std::string& material = "red") {
  std::string obj = "mtllib square.mtl\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl " + material + "\n";
  for (const auto& [x, y] : {std::pair{-1, -1}, {1, -1}, {1, 1}, {-1, 1}}) {
    obj += "v " + std::to_string(at + x) + " " + std::to_string(at + y) + " " + std::to_string(at) + "\n";
  }
  return obj + "f 1/1 2/2 3/3 4/4\n";
}

const std::string k_square_mtl =
    "newmtl red\nKd 1 0 0\n"
    "newmtl leaf\nKd 1 1 1\nmap_Kd leaf.png\nmap_d leaf.png\n"
    "newmtl lost\nKd 1 1 1\nmap_Kd lost.png\n";

// One folder with a square in it.
struct Studio {
  TemporaryFolder folder;
  std::string mesh = folder.file("square.obj"), picture = folder.file("out.png");

  explicit Studio(const std::string& obj = square_obj()) {
    write_text(mesh, obj);
    write_text(folder.file("square.mtl"), k_square_mtl);
  }
  Outcome play(const Strings& options, const Strings& environment = {}) const {
    Strings command{"treeplay", mesh};
    command.insert(command.end(), options.begin(), options.end());
    return run_process(command, environment);
  }
  // A picture without light, sky or ground: colours are the materials'.
  Image flat(Strings options = {}) const {
    for (const char* o :
         {"--frames", picture.c_str(), "--unlit", "--background", "black", "--no-ground", "--camera"}) {
      options.emplace_back(o);
    }
    if (std::find(options.begin(), options.end(), k_front) == options.end()) options.push_back(k_front);
    return drawn(options);
  }
  Image drawn(const Strings& options) const {
    const Outcome outcome = play(options);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    auto image = read_image(picture);
    EXPECT_TRUE(image) << (image ? "" : image.error().what);
    return image.value_or(Image{});
  }
};

Pixel at(const Image& image, int x, int y) {
  const std::size_t i = 4 * static_cast<std::size_t>(y * image.width + x);
  if (i + 2 >= image.rgba.size()) return {-1, -1, -1};
  return {image.rgba[i], image.rgba[i + 1], image.rgba[i + 2]};
}

// How many pixels differ from what `expected` says.
int wrong_pixels(const Image& image, const std::function<Pixel(int, int)>& expected) {
  int wrong = 0;
  for (int y = 0; y < image.height; ++y) {
    for (int x = 0; x < image.width; ++x) wrong += at(image, x, y) != expected(x, y);
  }
  return wrong;
}

// The square covers the middle half of a picture of side `size`.
int wrong_in_square(const Image& image, int size) {
  EXPECT_EQ(image.width, size);
  EXPECT_EQ(image.height, size);
  const auto inside = [&](int v) { return v >= size / 4 && v < size * 3 / 4; };
  return wrong_pixels(image, [&](int x, int y) { return inside(x) && inside(y) ? k_red : k_black; });
}

// Digest 000, 4.9: blades of grass have the normal of their ground, and are lit alike from either side.
TEST(Treeplay, ACardWithTheNormalOfItsGroundIsLitAlikeFromBothSides) {
  const Studio studio(
      "mtllib square.mtl\nusemtl red\nvn 0 1 0\nv -1 -1 0.35\nv 1 -1 0.35\nv 1 1 -0.35\nv -1 1 -0.35\n"
      "f 1//1 2//1 3//1 4//1\n");
  const auto red = [&](const char* camera) {
    return at(studio.drawn({"--frames", studio.picture, "--size", "64x64", "--background", "black",
                            "--no-ground", "--sun", "0,90", "--camera", camera}),
              32, 32)[0];
  };
  const int front = red("0,0,4,0,0,0,53"), back = red("0,0,-4,0,0,0,53");
  EXPECT_GT(front, 150);
  EXPECT_NEAR(front, back, 12);
}

TEST(Treeplay, ARedSquareCoversExactlyItsPixels) {
  const Studio studio;
  for (const char* samples : {"1", "4", "16"}) {
    EXPECT_EQ(wrong_in_square(studio.flat({"--size", "64x64", "--samples", samples}), 64), 0) << samples;
  }
}

TEST(Treeplay, APictureDrawnInTilesHasNoSeams) {
  const Studio studio;
  // 8 x 8 fragments a pixel: 2816 x 2816 of them are more than one tile holds.
  EXPECT_EQ(wrong_in_square(studio.flat({"--size", "352x352", "--samples", "256"}), 352), 0);
}

TEST(Treeplay, TenThousandKilometresAwayNothingMoves) {
  const Studio studio(square_obj(1e7));
  const Strings camera{"--frames", studio.picture,
                       "--unlit",  "--background",
                       "black",    "--size",
                       "64x64",    "--no-ground",
                       "--camera", "10000000,10000000,10000004,10000000,10000000,10000000,53.13010235415598"};
  EXPECT_EQ(wrong_in_square(studio.drawn(camera), 64), 0);
}

// 16 x 16 texels of (200, 100, 50): the left half transparent.
void write_leaf(const TemporaryFolder& folder) {
  Image leaf{.width = 16, .height = 16, .rgba = {}, .has_alpha = true};
  for (int i = 0; i < 256; ++i) {
    for (const int byte : {200, 100, 50, i % 16 < 8 ? 0 : 255})
      leaf.rgba.push_back(static_cast<std::uint8_t>(byte));
  }
  ASSERT_TRUE(write_image(folder.file("leaf.png"), leaf));
}

TEST(Treeplay, CutsLeavesWhereTheirTextureIsTransparent) {
  const Studio studio(square_obj(0, "leaf"));
  write_leaf(studio.folder);
  const Image image = studio.flat({"--size", "64x64"});
  for (int y = 20; y < 44; ++y) {
    EXPECT_EQ(at(image, 24, y), k_black);
    const Pixel leaf = at(image, 40, y);
    for (const auto& [channel, value] : {std::pair<std::size_t, int>{0, 200}, {1, 100}, {2, 50}}) {
      EXPECT_NEAR(leaf[channel], value, 1);
    }
  }
}

TEST(Treeplay, ATexturesTopDoesNotShineThroughAtItsBottom) {
  const Studio studio(square_obj(0, "leaf"));
  Image leaf{.width = 16, .height = 16, .rgba = {}, .has_alpha = true};
  for (int i = 0; i < 256; ++i) {
    for (const int byte : {255, 0, 0, i < 16 * 8 ? 255 : 0})
      leaf.rgba.push_back(static_cast<std::uint8_t>(byte));
  }
  ASSERT_TRUE(write_image(studio.folder.file("leaf.png"), leaf));
  const Image image = studio.flat({"--size", "64x64"});
  EXPECT_EQ(at(image, 32, 16), k_red) << "the upper half is there to its edge";
  for (int y = 36; y < 64; ++y) EXPECT_EQ(at(image, 32, y), k_black) << y;
}

TEST(Treeplay, WarnsAboutAMissingTextureAndDrawsOn) {
  const Studio studio(square_obj(0, "lost"));
  const Outcome outcome = studio.play({"--frames", studio.picture, "--size", "32x32", "--samples", "1"});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.err.find("lost.png"), std::string::npos) << outcome.err;
  EXPECT_TRUE(std::filesystem::exists(studio.picture));
}

TEST(Treeplay, DrawsTheSameBytesAgainAndForAnyNumberOfThreads) {
  const Studio studio;
  std::vector<std::string> pictures;
  for (const char* jobs : {"1", "2", "2"}) {
    const Outcome outcome = studio.play({"--size", "96x64", "--frames", studio.picture, "--jobs", jobs});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    pictures.push_back(read_text(studio.picture));
  }
  EXPECT_EQ(pictures[0], pictures[1]);
  EXPECT_EQ(pictures[1], pictures[2]);
}

TEST(Treeplay, TheLitSceneHasASkyAGroundAndAShadow) {
  const Studio studio;
  const Image image = studio.drawn(
      {"--frames", studio.picture, "--size", "96x64", "--sun", "0,30", "--camera", "3,3,8,0,0,0,40"});
  const Pixel sky = at(image, 2, 1), ground = at(image, 92, 60);
  EXPECT_GT(sky[2], sky[0]) << "blue above";
  EXPECT_GT(ground[1], ground[2]) << "green below";
  // The square's shadow falls away from the sun, behind it; beside it the ground is in the sun.
  const Image without = studio.drawn({"--frames", studio.picture, "--size", "96x64", "--sun", "0,30",
                                      "--camera", "3,3,8,0,0,0,40", "--no-ground"});
  EXPECT_NE(at(without, 92, 60), ground);
  int darkest = 255 * 3;
  for (int x = 0; x < 96; ++x) {
    const Pixel p = at(image, x, 34);
    if (p[1] > p[0] && p[1] > p[2]) darkest = std::min(darkest, p[0] + p[1] + p[2]);
  }
  EXPECT_LT(darkest, (ground[0] + ground[1] + ground[2]) * 3 / 4);
}

// A stem of two radii from (0, -1, 0) to (0, 1, 0), 0.5 m thick, one leaf, in one group of radius 0.5 at (1,
// 1, 0).
Tree stem() {
  Tree tree;
  tree.header.kind = TreeKind::sensitive;
  tree.header.roots = 1;
  tree.header.ring_size = 3;
  tree.header.segment_factor = 6;
  tree.header.leaf_factor = 1;
  tree.header.monotone = true;
  tree.hierarchy.radii = std::vector<Radius>{{{0, -1, 0}, 0.5f, 0.2501f, 0, 1, 1, 0},
                                             {{0, 2, 0}, 0.5f, 0.2501f, 2, 0, 1, Radius::terminal}};
  const std::vector<Float3> ring{{0.25f, 0, 0}, {-0.125f, 0, -0.21650635f}, {-0.125f, 0, 0.21650635f}};
  std::vector<Float3> vectors = ring;
  vectors.insert(vectors.end(), ring.begin(), ring.end());
  tree.hierarchy.vectors = vectors;
  std::vector<CornerTriangle> triangles;
  for (std::uint32_t i = 0; i < 3; ++i) {
    const std::uint32_t j = (i + 1) % 3;
    triangles.push_back({.vertex = {i, j, j + 3}});
    triangles.push_back({.vertex = {i, j + 3, i + 3}});
  }
  tree.trunk.triangles = triangles;
  tree.trunk.lines = std::vector<std::array<std::uint32_t, 2>>{{0, 1}};
  tree.trunk.diameters = std::vector<float>{0.5f};
  tree.trunk.accumulated_lengths = std::vector<double>{2};
  tree.header.trunk_bounds = {{-0.125f, -1, -0.21650635f}, {0.25f, 1, 0.21650635f}};
  tree.header.bounds = tree.header.trunk_bounds;
  tree.header.mean_trunk_area = 0.4330127f;
  tree.header.mean_leaf_area = 0.005f;
  tree.header.bounds.grow(Float3{1.1f, 1.1f, 0});
  tree.leaves.vertices = std::vector<Float3>{{1, 1, 0}, {1.1f, 1, 0}, {1, 1.1f, 0}};
  tree.leaves.triangles = std::vector<CornerTriangle>{{.vertex = {0, 1, 2}}};
  tree.leaves.centres = std::vector<Float3>{{1.0333333f, 1.0333333f, 0}};
  tree.leaves.groups = std::vector<LeafGroup>{{{1, 1, 0}, 0.5f, 0.005f, 0, 1}};
  tree.leaves.order = std::vector<std::uint32_t>{0};
  tree.leaves.group_hierarchy = std::vector<GroupNode>{{{1, 1, 0}, 0.5f, 1, 0}};
  return tree;
}

// The stem as a file.
struct StemStudio : Studio {
  StemStudio() {
    mesh = folder.file("stem.stree");
    const Tree tree = stem();
    EXPECT_THAT(check_tree(tree), ::testing::IsEmpty());
    const auto bytes = encode_tree(tree);
    EXPECT_TRUE(bytes);
    if (bytes) write_text(mesh, {bytes->begin(), bytes->end()});
  }
};

TEST(Treeplay, DrawsTheHierarchyAsLinesAsThickAsTheirDiameter) {
  const StemStudio studio;
  const Image image = studio.flat({"--size", "64x64", "--show", "skeleton"});
  // 16 pixels a metre: the stem is 8 pixels wide from y = 16 to 48, with round ends 4 pixels beyond.
  const auto drawn = [&](int x, int y) { return at(image, x, y) != k_black; };
  for (const int y : {20, 32, 44}) {
    for (int x = 29; x < 35; ++x) EXPECT_TRUE(drawn(x, y)) << x << ", " << y;
    EXPECT_FALSE(drawn(26, y));
    EXPECT_FALSE(drawn(37, y));
  }
  EXPECT_FALSE(drawn(32, 9));
  EXPECT_FALSE(drawn(32, 55));
}

TEST(Treeplay, DrawsGroupsAsSpheres) {
  const StemStudio studio;
  const Image lines = studio.flat({"--size", "64x64", "--show", "skeleton"});
  const Image image = studio.flat({"--size", "64x64", "--show", "groups"});
  // The sphere of radius 8 pixels (a little more in perspective) round (48, 16).
  int changed = 0;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const bool differs = at(image, x, y) != at(lines, x, y);
      const double d = std::hypot(x + 0.5 - 48, y + 0.5 - 16);
      EXPECT_FALSE(differs && d > 9.5) << x << ", " << y;
      EXPECT_FALSE(!differs && d > 5 && d < 7) << x << ", " << y;
      changed += differs;
    }
  }
  EXPECT_GT(changed, 100);
}

TEST(Treeplay, AnStreeCoversWhatItsTrunkCovers) {
  const StemStudio studio;
  const Image image = studio.flat({"--size", "64x64"});
  EXPECT_NE(at(image, 32, 32), k_black);
  EXPECT_EQ(at(image, 10, 32), k_black);
}

TEST(Treeplay, NumbersTheFramesOfAPathAndCountsWhatItDrew) {
  const StemStudio studio;
  const std::string stats = studio.folder.file("stats.csv");
  const Outcome outcome =
      studio.play({"--frames", studio.folder.file("f%02d.png"), "--path", "orbit", "--count", "3", "--size",
                   "32x32", "--samples", "1", "--stats", stats});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  for (const char* name : {"f00.png", "f01.png", "f02.png"}) {
    EXPECT_TRUE(std::filesystem::exists(studio.folder.file(name))) << name;
  }
  const std::string text = read_text(stats);
  EXPECT_EQ(line_count(text), 4u);
  EXPECT_EQ(
      text.substr(0, text.find('\n')),
      "frame,t_frame,t_application,t_render,t_estimated,budget,triangles,lines,points,instances_tested,"
      "instances_drawn,nodes_visited,plane_tests,missed,needless,ssim,level,level_error,distance,t_cull,"
      "blocks_tested,blocks_seen,impostors,shadow_triangles");
  EXPECT_NE(text.find(",,,7,0,0,1,1,,"), std::string::npos) << text;
}

TEST(Treeplay, FollowsAPathFromAFile) {
  const Studio studio;
  const std::string path = studio.folder.file("path.json");
  write_text(path, R"({"schema":"copse.path/1","fov":53.13010235415598,"keys":[
      {"time":0,"eye":[0,0,40],"target":[0,0,0]},{"time":2,"eye":[0,0,4],"target":[0,0,0]}]})");
  Strings options{"--path", path,          "--count",  "2",
                  "--size", "64x64",       "--unlit",  "--background",
                  "black",  "--no-ground", "--frames", studio.folder.file("%d.png")};
  const Outcome outcome = studio.play(options);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto first = read_image(studio.folder.file("0.png")), last = read_image(studio.folder.file("1.png"));
  ASSERT_TRUE(first && last);
  EXPECT_EQ(wrong_in_square(*last, 64), 0);
  EXPECT_EQ(at(*first, 32, 32), k_red);
  EXPECT_EQ(at(*first, 24, 32), k_black);
}

struct Mistake {
  Strings options;
  int status;
  std::string says;
};

TEST(Treeplay, SaysWhatIsWrongInOneLine) {
  const Studio studio;
  const std::string bad_path = studio.folder.file("bad.json"), png = studio.picture;
  write_text(bad_path, R"({"schema":"copse.path/1","keys":[{"time":0,"eye":[0,0],"target":[0,0,0]}]})");
  const std::vector<Mistake> mistakes{
      {{"--frames", png, "--size", "0x64"}, 2, "--size '0x64'"},
      {{"--frames", png, "--size", "1000000000x64"}, 2, "16384"},
      {{"--frames", png, "--size", "64"}, 2, "--size '64'"},
      {{"--frames", png, "--size", "64x64x"}, 2, "--size"},
      {{"--frames", png, "--camera", "1,2,3"}, 2, "--camera"},
      {{"--frames", png, "--camera", "1,2,3,1,2,3"}, 2, "the same"},
      {{"--frames", png, "--camera", "1,2,3,4,5,nan"}, 2, "--camera"},
      {{"--frames", png, "--camera", "1,2,3,4,5,6,180"}, 2, "170"},
      {{"--frames", png, "--count", "2"}, 2, "%04d"},
      {{"--frames", studio.folder.file("%s.png")}, 2, "not understood"},
      {{"--frames", studio.folder.file("%d%d.png"), "--count", "2"}, 2, "not understood"},
      {{"--frames", studio.folder.file("out.xyz")}, 2, "PNG"},
      {{"--frames", studio.folder.file("nowhere/out.png")}, 3, "nowhere"},
      {{"--frames", png, "--path", "spiral", "--count", "1"}, 2, "--path 'spiral'"},
      {{"--frames", png, "--path", studio.folder.file("none.json"), "--count", "1"}, 3, "none.json"},
      {{"--frames", png, "--path", bad_path, "--count", "1"}, 1, "keys[0].eye"},
      {{"--frames", png, "--samples", "5"}, 2, "--samples 5"},
      {{"--frames", png, "--sun", "0,-3"}, 2, "--sun"},
      {{"--frames", png, "--show", "skeleton"}, 2, "treeprep"},
      {{"--frames", png, "--show", "nothing"}, 2, "nothing"},
  };
  for (const Mistake& m : mistakes) {
    const Outcome outcome = studio.play(m.options);
    EXPECT_EQ(outcome.status, m.status) << outcome.err;
    EXPECT_EQ(line_count(outcome.err), 1u) << outcome.err;
    EXPECT_TRUE(outcome.err.starts_with("treeplay: error: ")) << outcome.err;
    EXPECT_NE(outcome.err.find(m.says), std::string::npos) << m.says << " is not in: " << outcome.err;
  }
  EXPECT_FALSE(std::filesystem::exists(png));
}

TEST(Treeplay, RefusesWhatIsNoTreeAndNoMesh) {
  Studio studio;
  studio.mesh = studio.folder.file("junk.stree");
  write_text(studio.mesh, "this is not a tree");
  EXPECT_EQ(studio.play({"--frames", studio.picture}).status, 1);
  studio.mesh = studio.folder.file("none.obj");
  EXPECT_EQ(studio.play({"--frames", studio.picture}).status, 3);
}

TEST(Treeplay, SaysSoWhenThereIsNoDisplayOrNoOpenGl) {
  const Studio studio;
  const Strings no_display{"DISPLAY=", "WAYLAND_DISPLAY="};
  const Outcome blind = studio.play({}, no_display);
  EXPECT_EQ(blind.status, 2);
  EXPECT_NE(blind.err.find("--frames"), std::string::npos) << blind.err;
  const Outcome lost = studio.play({}, {"DISPLAY=:4711", "WAYLAND_DISPLAY="});
  EXPECT_EQ(lost.status, 3);
  EXPECT_EQ(line_count(lost.err), 1u) << lost.err;
  const Outcome no_driver =
      studio.play({"--frames", studio.picture}, {"__EGL_VENDOR_LIBRARY_FILENAMES=/none"});
  EXPECT_EQ(no_driver.status, 3);
  EXPECT_EQ(line_count(no_driver.err), 1u) << no_driver.err;
  EXPECT_NE(no_driver.err.find("libgl1-mesa-dri"), std::string::npos) << no_driver.err;
}

TEST(Treeplay, OpensAWindowDrawsAndCloses) {
  const std::string xvfb = "/usr/bin/xvfb-run";
  const StemStudio studio;
  const std::string stats = studio.folder.file("stats.csv");
  const Outcome outcome =
      run_process({xvfb, "-a", std::string(COPSE_BIN_DIR) + "/treeplay", studio.mesh, "--size", "320x200",
                   "--exit-after", "3", "--path", "orbit", "--show", "groups", "--stats", stats},
                  {"WAYLAND_DISPLAY="});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(line_count(read_text(stats)), 4u);
}

TEST(Treeplay, NamesEverythingThatItReadInTheDepfile) {
  const Studio studio(square_obj(0, "leaf"));
  write_leaf(studio.folder);
  const std::string depfile = studio.folder.file("out.d");
  const Outcome outcome =
      studio.play({"--frames", studio.picture, "--size", "16x16", "--samples", "1", "--depfile", depfile});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string text = read_text(depfile);
  for (const char* name : {"out.png", "square.obj", "square.mtl", "leaf.png"}) {
    EXPECT_NE(text.find(name), std::string::npos) << name;
  }
}

}  // namespace
}  // namespace copse
