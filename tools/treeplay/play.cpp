#include "tools/treeplay/play.h"

#include "lib/formats/ecosystem/ecosystem_file.h"
#include "tools/treeplay/framing.h"
#include "tools/treeplay/headless.h"
#include "tools/treeplay/scene.h"
#include "tools/treeplay/statistics.h"
#include "tools/treeplay/viewer.h"

#include <algorithm>
#include <cctype>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <numbers>
#include <string_view>

#include <epoxy/gl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace copse::treeplay {

namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

bool has_display() {
  const auto is_set = [](const char* name) {
    const char* value = std::getenv(name);
    return value && *value;
  };
  return is_set("DISPLAY") || is_set("WAYLAND_DISPLAY");
}

// A picture as the bytes of a file; PNG is made in memory, so that all frames of a run appear together.
Result<void> write_frame(const fs::path& path, const Image& image, Context& context) {
  const auto png = encode_png(image);
  if (!png) return std::unexpected(png.error());
  return context.write(path, {reinterpret_cast<const char*>(png->data()), png->size()});
}

Result<void> check_frames(const Plan& plan, Context& context) {
  if (!plan.frames) return {};
  const fs::path first = plan.frames->name(0);
  std::string extension = first.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  if (extension != ".png") {
    return fail(Fault::usage, first.string(), "is not the name of a PNG picture", "let --frames end in .png");
  }
  return context.check_output(first);
}

Result<void> check_size(const Renderer& renderer, const Plan& plan) {
  const int largest = renderer.largest_size();
  if (plan.width <= largest && plan.height <= largest) return {};
  return fail(Fault::usage, "",
              fmt::format("--size {}x{} is more than this graphics driver can draw", plan.width, plan.height),
              fmt::format("ask for at most {0}x{0}", largest));
}

Result<void> draw_frames(Renderer& renderer, const CameraPath& path, const Plan& plan, LevelChoice& choice,
                         Statistics& statistics, Context& context) {
  Stage stage = context.stage("frames");
  for (std::uint64_t i = 0; i < plan.count; ++i) {
    const auto start = Clock::now();
    const auto frame =
        renderer.plan(path.at(path.moment(i, plan.count)), plan.look, plan.width, plan.height, choice);
    if (!frame) return std::unexpected(frame.error());
    const auto decided = Clock::now();
    if (auto done = renderer.draw_picture(*frame); !done) return done;
    glFinish();
    statistics.add(*frame, seconds(start, decided), seconds(decided, Clock::now()));
    if (plan.frames) {
      if (auto done = write_frame(plan.frames->name(i), renderer.read_picture(), context); !done) return done;
    }
    stage.progress(static_cast<double>(i + 1) / static_cast<double>(plan.count));
  }
  stage.items(plan.count, "frames");
  statistics.read(renderer.read());
  return {};
}

// A copy of everything, enough for the driver to have its shaders.
void keep_one_of_each(ForestView& view) {
  const auto keep_one = [](auto& copies) {
    if (copies.size() > 1) copies.erase(copies.begin() + 1, copies.end());
  };
  for (auto& copies : view.copies) keep_one(copies);
  for (ImpostorCopies& copies : view.impostors) keep_one(copies.blended), keep_one(copies.single);
}

// A first small frame lets the driver finish its shaders, so that the first one measured is like the rest,
// and brings its textures in. Of a forest one tree at each of its levels does: a driver in software would
// take as long for all of them as for a large frame.
Result<void> warm_up(Renderer& renderer, const Camera& camera, const Plan& plan, LevelChoice& choice,
                     Context& context) {
  auto first = renderer.plan(camera, plan.look, 16, 16, choice);
  if (!first) return std::unexpected(first.error());
  {
    Stage stage = context.stage("textures");
    if (auto done = renderer.prepare(*first); !done) return done;
    glFinish();
  }
  Stage stage = context.stage("warm up");
  keep_one_of_each(first->forest.seen);
  for (ForestView& casters : first->forest.casters) keep_one_of_each(casters);
  if (auto done = renderer.draw_picture(*first); !done) return done;
  glFinish();
  return {};
}

Result<void> run_headless(const Scene& scene, const CameraPath& path, const Plan& plan, LevelChoice& choice,
                          bool measured, Statistics& statistics, Context& context) {
  std::unique_ptr<GlContext> gl;
  {
    Stage stage = context.stage("open graphics");
    auto made = make_headless(context.options().jobs);
    if (!made) return std::unexpected(made.error());
    gl = std::move(*made);
  }
  context.report().options.emplace_back("renderer", gl->renderer());
  std::unique_ptr<Renderer> renderer;
  {
    Stage stage = context.stage("upload");
    auto made = Renderer::make(scene, plan.settings);
    if (!made) return std::unexpected(made.error());
    renderer = std::move(*made);
    if (auto done = check_size(*renderer, plan); !done) return done;
  }
  if (measured) {
    if (auto done = warm_up(*renderer, path.at(0), plan, choice, context); !done) return done;
  }
  return draw_frames(*renderer, path, plan, choice, statistics, context);
}

}  // namespace

ToolInfo info() {
  return {
      .name = "treeplay",
      .summary =
          "Draws a tree or a forest in a window, or into pictures without a display: surfaces with materials "
          "at any level of detail, skeletons as lines and points, groups of leaves as spheres.",
      .examples = {{"treeplay oak.stree", "look at a tree; H shows the keys"},
                   {"treeplay oak.stree --frames 'out/%04d.png' --path orbit --count 90 --size 1280x720",
                    "once round it, into 90 pictures"},
                   {"treeplay oak.stree --show skeleton --frames skeleton.png",
                    "its hierarchy as lines and points"},
                   {"treeplay forest.eco --frames forest.png",
                    "a forest, each tree at the level that its distance asks for"}},
      .limits = {{"side of a picture", k_largest_side, "pixels"},
                 {"frames of a run", k_most_frames, "frames"},
                 {"samples a pixel", 256, "samples"}}};
}

namespace {

// Trees of an ecosystem go by distance, each by the levels that its file has; --level 0 is full detail.
Wanted wanted_of(const Options& options, bool window) {
  Wanted wanted{.cull = options.cull};
  if (is_ecosystem(options.input)) {
    wanted.levels = !options.detail.level;
    return wanted;
  }
  // Lines, points and pruned crowns are made of the tree itself.
  wanted.lines_points = options.detail.lod == Lod::lines_points;
  wanted.foliage = options.detail.lod == Lod::foliage;
  wanted.levels = (window || options.detail.needs_levels()) && !wanted.lines_points && !wanted.foliage;
  return wanted;
}

Result<void> check_detail(const Scene& scene, const Options& options) {
  const bool lines_points = options.detail.lod == Lod::lines_points;
  const bool foliage = options.detail.lod == Lod::foliage;
  if ((!lines_points || scene.lines_points) && (!foliage || scene.foliage)) return {};
  return refuse(options.input.string(), "is no tree, and has no such detail",
                "make a tree of it with treeprep");
}

Result<void> check_show(const Scene& scene, const Options& options, const Look& look) {
  if (look.show == Show::surface || scene.skeleton) return {};
  return scene.is_tree ? fail(Fault::usage, options.input.string(), "has no hierarchy, lines or leaf groups",
                              "prepare it without leaving them out, or leave --show out")
                       : fail(Fault::usage, options.input.string(), "is a mesh and has no hierarchy to show",
                              "make a tree of it with treeprep, or leave --show out");
}

// What can be asked of ecosystems alone, or of all else alone: told when no more than the header is read.
Result<void> check_kind(const Options& options, const Look& look) {
  const std::string name = options.input.string();
  if (!is_ecosystem(options.input)) {
    if (options.cull == BlockHierarchy::boxes) return {};
    return fail(Fault::usage, name, "is no ecosystem, so there is nothing to cull by --cull",
                "leave --cull out");
  }
  if (const auto file = EcosystemFile::open(options.input); !file) return std::unexpected(file.error());
  if (options.detail.lod == Lod::lines_points || options.detail.lod == Lod::foliage)
    return fail(Fault::usage, name, "is an ecosystem, whose trees take levels by distance alone",
                "leave --lod out, or name one of its trees");
  if (options.detail.names_one() && options.detail.level != std::uint64_t{0})
    return fail(Fault::usage, name, "is an ecosystem, whose trees take their levels by distance",
                "leave the level out, or draw all in full detail by --level 0");
  if (look.show != Show::surface)
    return fail(Fault::usage, name, "is an ecosystem, of which surfaces alone are drawn",
                "leave --show out, or name one of its trees");
  return {};
}

// What ecogen left trees out for along a camera's path: such an option; none when it left none out.
std::optional<double> path_option(const Ecosystem& eco, const char* name) {
  const auto told = nlohmann::json::parse(eco.provenance, nullptr, false);
  const auto option = nlohmann::json::json_pointer("/options/" + std::string(name));
  if (told.is_discarded() || !told.contains(option) || !told[option].is_number()) return std::nullopt;
  return told[option].get<double>();
}

// Trees outside every frame may have been left out whose shadows a lower sun would throw into one.
void warn_of_low_sun(const Scene& scene, const Plan& plan, Context& context) {
  if (!scene.eco || !plan.look.lit) return;
  const auto wanted = path_option(*scene.eco, "lowest-sun");
  const double height = std::asin(std::clamp(plan.settings.sun.y, -1.0, 1.0)) * 180 / std::numbers::pi;
  if (!wanted || height >= *wanted - 1e-6) return;
  context.warn(
      fmt::format("{}: the sun stands {:.4g} degrees high, and trees whose shadows fall into a frame "
                  "were kept for {:g} only; make it with --lowest-sun {:.0f}, or raise --sun",
                  scene.name, height, *wanted, std::max(1.0, std::floor(height))));
}

// Likewise trees that stand beside frames that are not so wide.
void warn_of_wide_frames(const Scene& scene, const Plan& plan, Context& context) {
  const auto wanted = scene.eco ? path_option(*scene.eco, "widest") : std::nullopt;
  const double aspect = static_cast<double>(plan.width) / plan.height;
  if (!wanted || aspect <= *wanted * (1 + 1e-9)) return;
  context.warn(
      fmt::format("{}: the frame is {:.4g} times as wide as high, and trees were kept for {:g} at "
                  "most; make it with --widest {:.4g}, or ask for a narrower --size",
                  scene.name, aspect, *wanted, std::ceil(100 * aspect) / 100));
}

Result<void> raise_camera(const Scene& scene, const Options& options, Plan& plan) {
  if (!plan.above_ground) return {};
  for (Double3* point : {&plan.camera->eye, &plan.camera->target}) {
    const auto ground = scene.eco ? highest_ground(scene.eco->terrain, point->x, point->z) : std::nullopt;
    if (!ground)
      return fail(Fault::usage, options.input.string(),
                  fmt::format("has no terrain at ({:g}, {:g}) for --above-ground", point->x, point->z),
                  "leave --above-ground out, or let eye and target of --camera stand over the terrain");
    point->y += *ground;
  }
  return {};
}

}  // namespace

Result<void> run(const Options& options, Context& context) {
  auto plan = understand(options);
  if (!plan) return std::unexpected(plan.error());
  if (auto done = check_frames(*plan, context); !done) return done;
  const bool window = !plan->frames && !options.headless && has_display();
  if (!window && !plan->frames && !options.headless) {
    return fail(Fault::usage, "", "there is no display to open a window on",
                "write pictures with --frames NAME.png, or only measure with --headless");
  }
  if (auto fits = check_kind(options, plan->look); !fits) return fits;
  plan->settings.lights = window || plan->look.lit;
  const auto scene = load_scene(options.input, plan->settings.lights, wanted_of(options, window), context);
  if (!scene) return std::unexpected(scene.error());
  if (auto fits = check_detail(*scene, options); !fits) return fits;
  auto choice = LevelChoice::make(scene->levels, scene->eco ? DetailWish{} : options.detail, options.input);
  if (!choice) return std::unexpected(choice.error());
  if (auto fits = check_show(*scene, options, plan->look); !fits) return fits;
  if (auto raised = raise_camera(*scene, options, *plan); !raised) return raised;
  warn_of_low_sun(*scene, *plan, context);
  warn_of_wide_frames(*scene, *plan, context);
  const double aspect = static_cast<double>(plan->width) / plan->height;
  const auto path = make_path(options, plan->camera.value_or(framing(*scene, aspect)));
  if (!path) return std::unexpected(path.error());
  if (options.path.ends_with(".json")) context.read(options.path, true);

  Statistics statistics;
  const CommonOptions& common = context.options();
  const bool measured = !options.stats.empty() || !common.report.empty() || !common.html.empty();
  const auto done = window ? run_viewer(*scene, *path, options, *plan, *choice, statistics, context)
                           : run_headless(*scene, *path, *plan, *choice, measured, statistics, context);
  if (!done) return done;
  context.report().tables.push_back(statistics.table());
  if (scene->eco) {
    context.report().tables.push_back(statistics.culling());
    context.report().tables.push_back(statistics.streaming(*scene->eco));
  }
  if (options.stats.empty()) return {};
  return context.write(options.stats, statistics.csv());
}

}  // namespace copse::treeplay
