#include "tools/treeplay/options.h"

#include "tools/common/option_values.h"
#include "tools/treeplay/path_file.h"

#include <array>
#include <charconv>
#include <climits>
#include <cmath>
#include <numbers>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace copse::treeplay {

namespace {

constexpr double k_radians = std::numbers::pi / 180;
constexpr double k_fov = 32 * k_radians;

// Comma-separated finite numbers in the C locale; none when anything else is in the text.
std::optional<std::vector<double>> numbers_in(std::string_view text) {
  std::vector<double> values;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (true) {
    double value = 0;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc{} || !std::isfinite(value)) return std::nullopt;
    values.push_back(value);
    if (next == end) return values;
    if (*next != ',') return std::nullopt;
    at = next + 1;
  }
}

std::unexpected<Error> usage(std::string what, std::string remedy) {
  return fail(Fault::usage, "", std::move(what), std::move(remedy));
}

Result<std::array<int, 2>> parse_size(const std::string& text) {
  std::array<int, 2> size{};
  const char* const end = text.data() + text.size();
  const auto [x, bad_width] = std::from_chars(text.data(), end, size[0]);
  const bool crossed = bad_width == std::errc{} && x != end && *x == 'x';
  const auto [rest, bad_height] =
      crossed ? std::from_chars(x + 1, end, size[1]) : std::from_chars_result{x, std::errc::invalid_argument};
  const bool in_range =
      size[0] >= 1 && size[1] >= 1 && size[0] <= k_largest_side && size[1] <= k_largest_side;
  if (bad_height != std::errc{} || rest != end || !in_range) {
    return usage(
        fmt::format("--size '{}' is not a size", text),
        fmt::format("write WIDTHxHEIGHT in pixels, 1 to {0} each, such as 1280x720", k_largest_side));
  }
  return size;
}

Result<Double3> parse_sun(const std::string& text) {
  const auto v = numbers_in(text);
  if (!v || v->size() != 2 || (*v)[1] < 5 || (*v)[1] > 90) {
    return usage(fmt::format("--sun '{}' is not a direction", text),
                 "write AZIMUTH,ELEVATION in degrees: azimuth from +Z towards +X, elevation 5 to 90");
  }
  const double azimuth = (*v)[0] * k_radians, elevation = (*v)[1] * k_radians;
  return normalized({std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
                     std::cos(azimuth) * std::cos(elevation)});
}

bool is_sample_count(int samples) {
  for (int n = 1; n <= 8; ++n) {
    if (samples == 4 * n * n) return true;
  }
  return samples == 1;
}

bool is_path(const std::string& text) {
  return text.empty() || text == "orbit" || text == "linear" || text == "zigzag" || text.ends_with(".json");
}

Look look_of(const Options& options) {
  Look look;
  constexpr std::array<std::pair<std::string_view, Show>, 4> k_shows{{{"surface", Show::surface},
                                                                      {"skeleton", Show::skeleton},
                                                                      {"both", Show::both},
                                                                      {"groups", Show::groups}}};
  for (const auto& [name, show] : k_shows) {
    if (name == options.show) look.show = show;
  }
  constexpr std::array<std::pair<std::string_view, Backdrop>, 5> k_backdrops{{{"auto", Backdrop::automatic},
                                                                              {"sky", Backdrop::sky},
                                                                              {"studio", Backdrop::studio},
                                                                              {"white", Backdrop::white},
                                                                              {"black", Backdrop::black}}};
  for (const auto& [name, backdrop] : k_backdrops) {
    if (name == options.background) look.backdrop = backdrop;
  }
  look.lit = !options.unlit;
  look.ground = !options.no_ground;
  return look;
}

}  // namespace

void add_options(CLI::App& app, Options& options) {
  app.add_option("INPUT", options.input, "a .tree, .stree or .eco, or any mesh that treeprep reads")
      ->required()
      ->type_name("FILE");

  CLI::Option_group* pictures = app.add_option_group("Pictures");
  pictures->add_option("--frames", options.frames, "write pictures of this name; %04d is the frame's number")
      ->type_name("PATTERN");
  pictures->add_option("--count", options.count, "how many frames (default: 1, along a path 120)")
      ->check(whole_number_from(1, k_most_frames))
      ->type_name("N");
  pictures->add_option("--size", options.size, "of a picture or of the window, in pixels")
      ->type_name("WxH")
      ->capture_default_str();
  pictures
      ->add_option("--samples", options.samples, "a pixel: 1, 4, 16, 36 ... (default: pictures 16, window 4)")
      ->type_name("N")
      ->default_str("");
  pictures->add_flag("--headless", options.headless,
                     "open no window; without --frames, draw and only measure");
  pictures->add_option("--stats", options.stats, "a CSV with a row a frame")->type_name("FILE");
  pictures->add_option("--exit-after", options.exit_after, "close the window after N frames")
      ->type_name("N")
      ->default_str("");

  CLI::Option_group* camera = app.add_option_group("Camera");
  camera
      ->add_option(
          "--camera", options.camera,
          "six numbers in metres, and the vertical angle of view in degrees (default: fits the model)")
      ->type_name("EYE,TARGET[,FOV]");
  camera
      ->add_option("--path", options.path,
                   "how the camera moves: orbit, linear, zigzag, or keys from a JSON file")
      ->type_name("orbit|linear|zigzag|FILE.json");

  camera->add_flag("--above-ground", options.above_ground,
                   "the heights of --camera count from the terrain of an .eco, not from 0");

  CLI::Option_group* forest = app.add_option_group("Ecosystems");
  add_choice<BlockHierarchy>(
      *forest, "--cull", options.cull,
      "how what is not seen is found: not at all, block by block, by the box "
      "hierarchy, by that and what the frame before tells of it (coherent), by the kd-tree or the "
      "R-tree of the file (\"block_trees\")",
      {{"none", BlockHierarchy::none},
       {"flat", BlockHierarchy::flat},
       {"hierarchy", BlockHierarchy::boxes},
       {"coherent", BlockHierarchy::coherent},
       {"kd", BlockHierarchy::kd_tree},
       {"r", BlockHierarchy::rtree}})
      ->type_name("none|flat|hierarchy|coherent|kd|r");

  forest
      ->add_option("--fade", options.fade,
                   "how wide levels fade into one another before and behind their border, as a share of its "
                   "distance; 0: not at all")
      ->check(number_between(0, 0.5))
      ->type_name("SHARE")
      ->capture_default_str();

  CLI::Option_group* detail = app.add_option_group("Level of detail (of a tree that lodbake has been over)");
  CLI::Option* level = detail->add_option("--level", options.detail.level, "this discrete level; 0 is full")
                           ->check(whole_number_from(0, INT_MAX))
                           ->type_name("N");
  CLI::Option* ratio = detail->add_option("--ratio", options.detail.ratio, "this share of the triangles")
                           ->check(number_between(0, 1))
                           ->type_name("R");
  CLI::Option* error = detail
                           ->add_option("--max-error", options.detail.max_error,
                                        "the fewest triangles that err by no more metres")
                           ->check(number_from(0))
                           ->type_name("E");
  CLI::Option* lod =
      add_choice<Lod>(*detail, "--lod", options.detail.lod,
                      "by distance: the discrete levels with their hysteresis (auto), everything in between "
                      "(spectrum), thin segments as lines and far leaves as points (any tree), or the crown "
                      "cell by cell as it is "
                      "seen (foliage: lodbake --foliage prune)",
                      {{"off", Lod::off},
                       {"lines-points", Lod::lines_points},
                       {"foliage", Lod::foliage},
                       {"spectrum", Lod::spectrum},
                       {"auto", Lod::automatic}});
  lod->type_name("off|lines-points|foliage|spectrum|auto");
  level->excludes(ratio)->excludes(error)->excludes(lod);
  ratio->excludes(error)->excludes(lod);
  error->excludes(lod);

  CLI::Option_group* look = app.add_option_group("Look");
  look->add_option("--show", options.show, "what is drawn: groups are the spheres round the groups of leaves")
      ->check(CLI::IsMember({"surface", "skeleton", "both", "groups"}))
      ->capture_default_str();
  look->add_option("--background", options.background,
                   "behind it (auto: sky behind surfaces, studio otherwise)")
      ->check(CLI::IsMember({"auto", "sky", "studio", "white", "black"}))
      ->capture_default_str();
  look->add_option("--sun", options.sun, "where it stands, in degrees: azimuth from +Z towards +X")
      ->type_name("AZIMUTH,ELEVATION")
      ->capture_default_str();
  look->add_flag("--unlit", options.unlit, "colours as they are, without light");
  look->add_flag("--no-ground", options.no_ground, "no ground under the tree");
}

Result<Camera> parse_camera(const std::string& text) {
  const auto v = numbers_in(text);
  constexpr const char* k_remedy = "write EYE,TARGET[,FOV]: x,y,z,x,y,z in metres and the angle in degrees";
  if (!v || (v->size() != 6 && v->size() != 7)) {
    return usage(fmt::format("--camera '{}' is not six or seven numbers", text), k_remedy);
  }
  Camera camera;
  camera.eye = {(*v)[0], (*v)[1], (*v)[2]};
  camera.target = {(*v)[3], (*v)[4], (*v)[5]};
  camera.fov = v->size() == 7 ? (*v)[6] * k_radians : k_fov;
  if (v->size() == 7 && !((*v)[6] >= 0.01 && (*v)[6] <= 170)) {
    return usage(fmt::format("--camera '{}': the angle of view is not between 0.01 and 170 degrees", text),
                 k_remedy);
  }
  if (!is_valid(camera))
    return usage(fmt::format("--camera '{}': eye and target are the same", text), k_remedy);
  return camera;
}

Result<Plan> understand(const Options& options) {
  Plan plan;
  const auto size = parse_size(options.size);
  if (!size) return std::unexpected(size.error());
  plan.width = (*size)[0];
  plan.height = (*size)[1];
  if (!is_path(options.path)) {
    return usage(fmt::format("--path '{}' is not a path", options.path),
                 "write orbit, linear, zigzag or the name of a .json file");
  }
  plan.count = options.count.value_or(options.path.empty() ? 1 : 120);
  if (!options.frames.empty()) {
    auto pattern = FramePattern::parse(options.frames);
    if (!pattern) return std::unexpected(pattern.error());
    if (plan.count > 1 && !pattern->numbered()) {
      return usage(
          fmt::format("--frames '{}' names one picture, but there are {}", options.frames, plan.count),
          "put %04d where the frame's number goes");
    }
    plan.frames = std::move(*pattern);
  }
  if (!options.camera.empty()) {
    const auto camera = parse_camera(options.camera);
    if (!camera) return std::unexpected(camera.error());
    plan.camera = *camera;
  }
  if (options.above_ground && !plan.camera)
    return usage("--above-ground needs --camera", "say where it stands, or leave --above-ground out");
  plan.above_ground = options.above_ground;
  plan.settings.cull = options.cull;
  plan.settings.fade = options.fade;
  const auto sun = parse_sun(options.sun);
  if (!sun) return std::unexpected(sun.error());
  plan.settings.sun = *sun;
  plan.settings.samples = options.samples ? options.samples : options.headless || plan.frames ? 16 : 4;
  if (!is_sample_count(plan.settings.samples)) {
    return usage(fmt::format("--samples {} is not possible", options.samples),
                 "write 1, 4, 16, 36, ... up to 256");
  }
  plan.look = look_of(options);
  return plan;
}

Result<CameraPath> make_path(const Options& options, const Camera& camera) {
  if (options.path.empty()) return CameraPath::still(camera);
  if (options.path == "orbit") return CameraPath::orbit(camera);
  if (options.path == "linear") return CameraPath::linear(camera);
  if (options.path == "zigzag") return CameraPath::zigzag(camera);
  return read_path(options.path, camera.fov);  // understand() has seen to the name
}

}  // namespace copse::treeplay
