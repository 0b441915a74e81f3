#include "tools/treeplay/renderer.h"

#include "tools/treeplay/shaders.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace copse::treeplay {

namespace {

enum Unit : int { unit_image, unit_shadow_map, unit_shadow_depth, unit_sky, unit_samples };

// A tile's buffers hold at most this many fragments: 4 samples of 8 bytes each make that 200 MB.
constexpr std::int64_t k_tile_fragments = 6'500'000;
constexpr float k_ground_reach = 40;  // times the model's size; all haze long before
constexpr float k_haze = 10;          // of a forest, times its size

Backdrop backdrop_of(const Look& look) {
  if (look.backdrop != Backdrop::automatic) return look.backdrop;
  return look.show == Show::surface ? Backdrop::sky : Backdrop::studio;
}

bool shows_surface(Show show) {
  return show == Show::surface || show == Show::both;
}

bool has_ground(const FramePlan& plan, const Scene& scene) {
  const Backdrop backdrop = backdrop_of(plan.look);
  const bool plain = backdrop == Backdrop::white || backdrop == Backdrop::black;
  return !scene.eco && plan.look.ground && plan.look.lit && !plain && shows_surface(plan.look.show) &&
         plan.view.eye.y > scene.ground;
}

}  // namespace

// A part of the picture, in pixels from its lower left corner.
struct Renderer::Tile {
  int x = 0, y = 0, width = 0, height = 0;
  Mat4 clip;  // of this tile: relative -> clip
  Float3 offset;
  int sub_pixels = 1;
  Float2 corner() const {  // in fragments
    return {static_cast<float>(x * sub_pixels), static_cast<float>(y * sub_pixels)};
  }
};

Renderer::Renderer(const Scene& scene, const RenderSettings& settings) : scene_(scene), settings_(settings) {
  GLint texture = 0, viewport[2] = {};
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &texture);
  glGetIntegerv(GL_MAX_VIEWPORT_DIMS, viewport);
  largest_size_ = std::min({texture, viewport[0], viewport[1]});
  sub_pixels_ = settings.samples <= 4 ? 1 : static_cast<int>(std::lround(std::sqrt(settings.samples / 4.0)));
}

Result<std::unique_ptr<Renderer>> Renderer::make(const Scene& scene, const RenderSettings& settings) {
  std::unique_ptr<Renderer> r(new Renderer(scene, settings));
  if (auto done = r->make_programs(); !done) return std::unexpected(done.error());
  if (auto done = r->surfaces_.upload(scene); !done) return std::unexpected(done.error());
  if (scene.skeleton) {
    if (auto done = r->skeleton_.upload(*scene.skeleton); !done) return std::unexpected(done.error());
  }
  if (scene.levels) r->level_ = full_detail(scene.levels->spectra());
  if (scene.lines_points) {
    auto pass = SkeletonPass::make();
    if (!pass) return std::unexpected(pass.error());
    r->primitives_ = std::move(*pass);
  }
  if (scene.eco) r->forest_ = std::make_unique<ForestPlanner>(scene, settings.cull);
  r->impostor_of_.assign(scene.eco ? scene.forest.types.size() : 1, k_none);
  if (scene.levels && scene.levels->impostor()) {
    const std::size_t only[] = {0};
    if (auto done = r->upload_impostors(only); !done) return std::unexpected(done.error());
  }
  if (auto done = r->make_lights(); !done) return std::unexpected(done.error());
  return r;
}

// Of those that have none yet: `numbers`, of types, or 0 of a tree.
Result<void> Renderer::upload_impostors(std::span<const std::size_t> numbers) {
  std::vector<const TreeImpostor*> wanted;
  std::vector<std::size_t> places;
  for (const std::size_t n : numbers) {
    if (impostor_of_[n] != k_none) continue;
    const TreeImpostor* pictures =
        scene_.eco ? scene_.forest.types[n].impostor.get() : &*scene_.levels->impostor();
    // Types of one tree share its pictures.
    const auto [known, is_new] = impostor_numbers_.try_emplace(pictures, impostor_numbers_.size());
    if (is_new) wanted.push_back(pictures);
    impostor_of_[n] = known->second;
  }
  if (wanted.empty()) return {};
  if (!impostor_) {
    auto pass = ImpostorPass::make();
    if (!pass) return std::unexpected(pass.error());
    impostor_.emplace(std::move(*pass));
  }
  const auto images = read_impostors(wanted);
  if (!images) return std::unexpected(images.error());
  for (std::size_t i = 0; i < wanted.size(); ++i)
    if (const auto done = impostor_->upload(wanted[i]->atlas, (*images)[i]); !done)
      return std::unexpected(done.error());
  return {};
}

// What a frame of a forest draws for the first time: the textures of its trees, and their pictures.
Result<void> Renderer::prepare(const FramePlan& plan) {
  if (!scene_.eco) return {};
  const auto& groups = forest_->groups();
  std::vector<SurfacePass::Ranges> fresh;
  for (; groups_ < groups.size(); ++groups_) fresh.emplace_back(groups[groups_].ranges);
  surfaces_.add_groups(scene_, fresh);
  std::vector<std::size_t> numbers;
  const auto add = [&](const ForestView& view) {
    for (std::size_t t = 0; t < view.impostors.size(); ++t)
      if (view.impostors[t].size() > 0) numbers.push_back(t);
  };
  add(plan.forest.seen);
  for (const ForestView& casters : plan.forest.casters) add(casters);
  if (auto done = upload_impostors(numbers); !done) return done;
  return check_gl("uploading textures");
}

Result<void> Renderer::make_programs() {
  using namespace shaders;
  auto surfaces = SurfacePass::make();
  if (!surfaces) return std::unexpected(surfaces.error());
  auto skeleton = SkeletonPass::make();
  if (!skeleton) return std::unexpected(skeleton.error());
  auto ground = Program::make("ground", k_common, k_ground_vertex, k_ground_fragment);
  if (!ground) return std::unexpected(ground.error());
  auto backdrop = Program::make("backdrop", k_common, k_screen_vertex, k_backdrop_fragment);
  if (!backdrop) return std::unexpected(backdrop.error());
  auto resolve = Program::make("resolve", k_common, k_screen_vertex, k_resolve_fragment);
  if (!resolve) return std::unexpected(resolve.error());
  surfaces_ = std::move(*surfaces);
  skeleton_ = std::move(*skeleton);
  ground_ = std::move(*ground);
  backdrop_ = std::move(*backdrop);
  resolve_ = std::move(*resolve);
  no_vertices_ = make_vertex_array();
  return {};
}

Result<void> Renderer::make_lights() {
  sky_texture_ = make_texture();
  glBindTexture(GL_TEXTURE_3D, sky_texture_.get());
  const SkyLight& sky = scene_.sky;
  glTexImage3D(GL_TEXTURE_3D, 0, GL_RGBA16F, static_cast<GLsizei>(sky.size[0]),
               static_cast<GLsizei>(sky.size[1]), static_cast<GLsizei>(sky.size[2]), 0, GL_RGBA, GL_FLOAT,
               sky.cells.data());
  for (const GLenum axis : {GL_TEXTURE_WRAP_S, GL_TEXTURE_WRAP_T, GL_TEXTURE_WRAP_R}) {
    glTexParameteri(GL_TEXTURE_3D, axis, GL_CLAMP_TO_EDGE);
  }
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_3D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);

  const int size = settings_.lights ? std::min(settings_.shadow_size, largest_size_) : 1;
  shadow_texture_ = make_texture();
  glBindTexture(GL_TEXTURE_2D, shadow_texture_.get());
  glTexImage2D(GL_TEXTURE_2D, 0, GL_DEPTH_COMPONENT32F, size, size, 0, GL_DEPTH_COMPONENT, GL_FLOAT, nullptr);
  const auto sampler = [](GLint filter, GLint mode) {
    Sampler s = make_sampler();
    glSamplerParameteri(s.get(), GL_TEXTURE_MIN_FILTER, filter);
    glSamplerParameteri(s.get(), GL_TEXTURE_MAG_FILTER, filter);
    glSamplerParameteri(s.get(), GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glSamplerParameteri(s.get(), GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glSamplerParameteri(s.get(), GL_TEXTURE_COMPARE_MODE, mode);
    glSamplerParameteri(s.get(), GL_TEXTURE_COMPARE_FUNC, GL_LEQUAL);
    return s;
  };
  compare_sampler_ = sampler(GL_LINEAR, GL_COMPARE_REF_TO_TEXTURE);
  depth_sampler_ = sampler(GL_NEAREST, GL_NONE);
  if (settings_.lights && !scene_.eco) draw_shadow_map();
  return check_gl("drawing the shadow map");
}

namespace {

// [-1, 1]^3 to [0, 1]^3, where textures are read.
Mat4 to_texture(const Mat4& clip) {
  Mat4 half;
  half.m = {0.5f, 0, 0, 0, 0, 0.5f, 0, 0, 0, 0, 0.5f, 0, 0.5f, 0.5f, 0.5f, 1};
  return multiply(half, clip);
}

}  // namespace

// Depth alone, into a square of the shadow texture.
void Renderer::begin_shadow(int x, int y, int texels) {
  if (!shadow_framebuffer_) shadow_framebuffer_ = make_framebuffer();
  glBindFramebuffer(GL_FRAMEBUFFER, shadow_framebuffer_.get());
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D, shadow_texture_.get(), 0);
  glDrawBuffer(GL_NONE);
  glReadBuffer(GL_NONE);
  glViewport(x, y, texels, texels);
  glEnable(GL_DEPTH_TEST);
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_LESS);
  glEnable(GL_SCISSOR_TEST);
  glScissor(x, y, texels, texels);
  glClear(GL_DEPTH_BUFFER_BIT);
  glDisable(GL_SCISSOR_TEST);
}

void Renderer::draw_shadow_map() {
  // The sun's view of the model, as tight as its vertices allow, and deep enough to reach the ground behind
  // it.
  const CameraFrame f = frame_of({.eye = settings_.sun, .target = {}, .up = {0, 1, 0}, .fov = 1});
  DoubleBox box;
  for (const Float3& v : scene_.outline()) {
    const Double3 p = to_double(v);
    box.grow(Double3{dot(p, f.right), dot(p, f.up), dot(p, f.back)});
  }
  if (box.empty()) box.grow(Double3{});
  const double size = scene_.size();
  const double texel = std::max({box.extent().x, box.extent().y, 1e-6 * size}) / settings_.shadow_size;
  const double width = std::max(box.extent().x, box.extent().y) + 8 * texel;
  const Double3 c = box.centre();
  const double top = scene_.bounds().empty() ? 0 : scene_.bounds().max.y - scene_.ground;
  const double behind = top / settings_.sun.y + 0.05 * size;
  const double near_plane = -box.max.z - 0.01 * size, far_plane = -box.min.z + behind;
  const Mat4 clip = multiply(
      orthographic(c.x - width / 2, c.x + width / 2, c.y - width / 2, c.y + width / 2, near_plane, far_plane),
      rotation_into(f.right, f.up, f.back));
  shadow_maps_ = {{.matrix = to_texture(clip),
                   .reach = {static_cast<float>(width), static_cast<float>(far_plane - near_plane)}}};
  begin_shadow(0, 0, std::min(settings_.shadow_size, largest_size_));
  surfaces_.draw_shadow(clip);
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
}

// Beside one another in one texture; a single one has all of it.
Result<void> Renderer::draw_forest_shadows(const ForestFrame& frame) {
  shadow_maps_.clear();
  shadow_ends_ = !frame.shadows.whole;
  const int size = std::min(settings_.shadow_size, largest_size_), half = size / 2;
  for (std::size_t i = 0; i < frame.shadows.count; ++i) {
    const ShadowCascade& cascade = frame.shadows.cascades[i];
    const int column = static_cast<int>(i % 2), row = static_cast<int>(i / 2);
    shadow_maps_.push_back(
        {.matrix = to_texture(cascade.clip),
         .reach = {static_cast<float>(cascade.width), static_cast<float>(cascade.depth)},
         .place = {0.5f, 0.5f, 0.5f * static_cast<float>(column), 0.5f * static_cast<float>(row)}});
    if (auto shown = show(frame.casters[i]); !shown) return shown;
    begin_shadow(column * half, row * half, half);
    surfaces_.draw_shadow(cascade.clip);
    if (impostor_) impostor_->draw_shadow(cascade.clip);
  }
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  return {};
}

Result<void> Renderer::show(const ForestView& view) {
  surfaces_.show(view.copies, view.ground);
  for (std::size_t t = 0; t < view.impostors.size(); ++t) {
    if (impostor_of_[t] == k_none) continue;
    if (auto shown = impostor_->show(impostor_of_[t], view.impostors[t]); !shown) return shown;
  }
  return {};
}

// The shadow goes with the level: a coarse tree under the shadow of a fine one would be dappled wrongly. An
// impostor is a picture of full detail, so that casts its shadow.
void Renderer::take_level(const ShownLevel& shown) {
  if (!scene_.levels) return;
  const LodLevel level = shown.impostor ? full_detail(scene_.levels->spectra()) : shown.level;
  if (level == level_) return;
  scene_.levels->take(level, level_geometry_);
  surfaces_.replace(level_geometry_.indices, level_geometry_.ranges);
  if (settings_.lights) draw_shadow_map();
  level_ = level;
}

Result<FramePlan> Renderer::plan(const Camera& camera, const Look& look, int width, int height,
                                 LevelChoice& choice) {
  FramePlan plan;
  plan.look = look;
  plan.width = width;
  plan.height = height;
  const double size = scene_.size();
  const DoubleBox box = scene_.bounds();
  const Double3 eye = camera.eye;
  // As near as anything can be: the model's box, or the ground under the eye.
  Double3 gap;
  for (int a = 0; a < 3 && !box.empty(); ++a)
    gap[a] = std::max({0.0, box.min[a] - eye[a], eye[a] - box.max[a]});
  const double nearest = std::min(length(gap), std::abs(eye.y - scene_.ground));
  const double away = distance(eye, scene_.foot());
  const double far_plane = away + 1.5 * k_ground_reach * size;
  const double near_plane = std::max({0.3 * nearest, 1e-4 * size, 1e-6 * far_plane});
  plan.view = make_view(camera, static_cast<double>(width) / height, near_plane, far_plane);
  if (!scene_.eco) {
    plan_tree(camera, choice, plan);
  } else if (auto done = plan_forest(plan); !done) {
    return std::unexpected(done.error());
  }
  return plan;
}

void Renderer::plan_tree(const Camera& camera, LevelChoice& choice, FramePlan& plan) const {
  const Double3 eye = camera.eye;
  const Look& look = plan.look;
  plan.distance = scene_.distance_from(eye);
  plan.shown = choice.at(plan.distance);
  plan.instances_tested = 1;
  plan.tree_visible =
      classify(frustum_of(plan.view), eye, scene_.bounds(), &plan.plane_tests) != Visibility::outside;
  if (!plan.tree_visible) return;
  plan.instances_drawn = 1;
  if (shows_surface(look.show))
    plan.triangles = plan.shown.impostor ? 2
                     : scene_.levels     ? scene_.levels->triangles(plan.shown.level)
                                         : scene_.triangles();
  if (scene_.foliage && shows_surface(look.show)) {
    scene_.foliage->select(scene_.geometry, eye - scene_.geometry.origin, plan.foliage);
    plan.triangles = plan.foliage.indices.size() / 3;
  }
  if (scene_.lines_points && shows_surface(look.show)) {
    const Double3 forward = plan.view.frame.back * -1.0;
    scene_.lines_points->select(scene_.geometry, eye - scene_.geometry.origin, forward,
                                2 * plan.view.tan_half_y / plan.height,
                                look.lit ? to_float(settings_.sun) : Float3{}, plan.primitives);
    plan.triangles = plan.primitives.indices.size() / 3;
    plan.lines = plan.primitives.lines.size();
    plan.points = plan.primitives.points.size();
  }
  if (look.show != Show::surface) {
    plan.lines = skeleton_.lines();
    plan.points = skeleton_.points();
  }
}

Result<void> Renderer::plan_forest(FramePlan& plan) {
  ForestCounts& counts = plan.forest_counts;
  auto frame = forest_->plan(plan.view,
                             {.lit = plan.look.lit && settings_.lights,
                              .sun = settings_.sun,
                              .shadow_size = std::min(settings_.shadow_size, largest_size_),
                              .pixel = 2 * plan.view.tan_half_y / plan.height,
                              .fade = settings_.fade},
                             counts);
  if (!frame) return std::unexpected(frame.error());
  plan.forest = std::move(*frame);
  plan.is_forest = true;
  plan.triangles = counts.triangles;
  plan.instances_tested = counts.instances_tested;
  plan.instances_drawn = counts.instances_drawn;
  plan.plane_tests = counts.culling.plane_tests;
  return {};
}

Result<void> Renderer::fit_tile_buffers(int width, int height) {
  if (tile_framebuffer_ && tile_width_ == width && tile_height_ == height) return {};
  tile_width_ = width;
  tile_height_ = height;
  tile_colour_ = make_texture();
  tile_depth_ = make_texture();
  tile_framebuffer_ = make_framebuffer();
  const GLsizei wanted = std::min(settings_.samples, 4);
  glBindFramebuffer(GL_FRAMEBUFFER, tile_framebuffer_.get());
  glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, tile_colour_.get());
  glTexImage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, wanted, GL_SRGB8_ALPHA8, width, height, GL_TRUE);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D_MULTISAMPLE, tile_colour_.get(),
                         0);
  glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, tile_depth_.get());
  glTexImage2DMultisample(GL_TEXTURE_2D_MULTISAMPLE, wanted, GL_DEPTH_COMPONENT32F, width, height, GL_TRUE);
  glFramebufferTexture2D(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_TEXTURE_2D_MULTISAMPLE, tile_depth_.get(),
                         0);
  if (auto done = check_gl("making the frame's buffers"); !done) return done;
  if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
    return fail(Fault::io, "", "the graphics driver cannot draw to sRGB with multisampling",
                "try --samples 1");
  }
  glGetIntegerv(GL_SAMPLES, &multisamples_);
  multisamples_ = std::max(multisamples_, 1);
  return {};
}

Result<void> Renderer::draw(const FramePlan& plan, GLuint framebuffer) {
  // Full-width tiles of as many rows as the budget allows, narrower ones when a row is too wide.
  const int s = sub_pixels_;
  const int tile_width = std::min(plan.width, largest_size_ / s);
  const std::int64_t row = std::int64_t{tile_width} * s * s;
  const int tile_height = static_cast<int>(
      std::clamp<std::int64_t>(k_tile_fragments / row, 1, std::min(plan.height, largest_size_ / s)));
  if (auto done = fit_tile_buffers(tile_width * s, tile_height * s); !done) return done;
  if (scene_.eco) {
    if (auto done = prepare(plan); !done) return done;
    if (plan.look.lit)
      if (auto done = draw_forest_shadows(plan.forest); !done) return done;
    if (auto shown = show(plan.forest.seen); !shown) return shown;
  }
  take_level(plan.shown);
  if (plan.shown.impostor) {
    const Double3 eye = plan.view.eye - scene_.geometry.origin;
    const ImpostorCopies one{.blended = {impostor_copy({}, scene_.levels->impostor()->atlas, eye, false)},
                             .single = {}};
    if (auto shown = impostor_->show(0, one); !shown) return shown;
  }
  if (scene_.foliage && !plan.foliage.ranges.empty()) {
    surfaces_.replace(scene_.foliage->first_leaf_vertex(), plan.foliage.leaves);
    surfaces_.replace(plan.foliage.indices, plan.foliage.ranges);
  }
  if (scene_.lines_points && !plan.primitives.ranges.empty()) {
    surfaces_.replace(plan.primitives.indices, plan.primitives.ranges);
    if (auto done = primitives_.upload(plan.primitives.lines, plan.primitives.points); !done) return done;
  }
  const Mat4 camera = plan.view.rotation;
  for (int y = 0; y < plan.height; y += tile_height) {
    for (int x = 0; x < plan.width; x += tile_width) {
      // The last tile of a row or column hangs over the edge; what is outside is not resolved.
      Tile tile{x, y, tile_width, tile_height, {}, plan.view.offset_from_eye(scene_.geometry.origin), s};
      const double w = plan.width, h = plan.height;
      tile.clip = multiply(
          narrow(plan.view.projection, x / w, (x + tile_width) / w, y / h, (y + tile_height) / h), camera);
      draw_tile(plan, tile);
      Tile inside = tile;
      inside.width = std::min(tile_width, plan.width - x);
      inside.height = std::min(tile_height, plan.height - y);
      resolve(inside, framebuffer);
    }
  }
  return check_gl("drawing a frame");
}

void Renderer::set_common(const Program& program, const Tile& tile) const {
  program.use();
  program.set("sun_direction", to_float(settings_.sun));
  program.set("shadow_map", unit_shadow_map);
  program.set("shadow_depth", unit_shadow_depth);
  program.set("shadow_count", static_cast<int>(shadow_maps_.size()));
  program.set("shadow_ends", shadow_ends_ ? 1 : 0);
  for (std::size_t i = 0; i < shadow_maps_.size(); ++i) {
    program.set(fmt::format("shadow_matrix[{}]", i).c_str(), shadow_maps_[i].matrix);
    program.set(fmt::format("shadow_reach[{}]", i).c_str(), shadow_maps_[i].reach);
    program.set(fmt::format("shadow_place[{}]", i).c_str(), shadow_maps_[i].place);
  }
  program.set("sky_grid", unit_sky);
  const SkyLight& sky = scene_.sky;
  program.set("sky_corner", sky.corner);
  program.set("sky_opens", sky.opens);
  program.set("sky_extent", Float3{static_cast<float>(sky.size[0]), static_cast<float>(sky.size[1]),
                                   static_cast<float>(sky.size[2])} *
                                sky.cell);
  program.set("tile_corner", tile.corner());
  program.set("clip", tile.clip);
  program.set("offset", tile.offset);
}

void Renderer::draw_tile(const FramePlan& plan, const Tile& tile) {
  glBindFramebuffer(GL_FRAMEBUFFER, tile_framebuffer_.get());
  glViewport(0, 0, tile_width_, tile_height_);
  glEnable(GL_FRAMEBUFFER_SRGB);
  glEnable(GL_DEPTH_TEST);
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  glDepthMask(GL_TRUE);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glClearColor(0, 0, 0, 1);
  glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
  const auto bind = [](int unit, GLenum target, GLuint texture, GLuint sampler) {
    glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
    glBindTexture(target, texture);
    glBindSampler(static_cast<GLuint>(unit), sampler);
  };
  bind(unit_shadow_map, GL_TEXTURE_2D, shadow_texture_.get(), compare_sampler_.get());
  bind(unit_shadow_depth, GL_TEXTURE_2D, shadow_texture_.get(), depth_sampler_.get());
  bind(unit_sky, GL_TEXTURE_3D, sky_texture_.get(), 0);

  const Show show = plan.look.show;
  if (plan.tree_visible && shows_surface(show)) {
    draw_surfaces(plan, tile, show == Show::both ? 0.6f : 0);
    if (scene_.lines_points) draw_primitives(plan, tile);
  }
  draw_backdrop(plan, tile);
  if (plan.tree_visible && show != Show::surface) draw_skeleton(plan, tile);
}

// A forest goes on to the horizon; a tree stands on a ground that does (draw_backdrop).
float Renderer::haze_of(const FramePlan& plan) const {
  const bool haze = scene_.eco && backdrop_of(plan.look) == Backdrop::sky;
  return haze ? k_haze * static_cast<float>(scene_.size()) : 0;
}

void Renderer::draw_surfaces(const FramePlan& plan, const Tile& tile, float ghost) const {
  const bool surfaces = !plan.shown.impostor, impostors = impostor_ && draws_impostors(plan);
  const auto pixel = static_cast<float>(2 * plan.view.tan_half_y / (plan.height * tile.sub_pixels));
  glDepthFunc(GL_LESS);
  glColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
  glEnable(GL_SAMPLE_ALPHA_TO_COVERAGE);
  if (surfaces) surfaces_.draw_coverage(tile.clip, tile.offset, tile.corner(), multisamples_ > 1);
  if (impostors) impostor_->draw_coverage(tile.clip, tile.offset, tile.corner(), pixel, multisamples_ > 1);
  glDisable(GL_SAMPLE_ALPHA_TO_COVERAGE);
  glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
  glDepthFunc(GL_EQUAL);
  glDepthMask(GL_FALSE);
  if (surfaces) {
    set_common(surfaces_.light_program(), tile);
    surfaces_.draw_light(tile.clip, tile.offset, plan.look.lit, ghost, haze_of(plan));
  }
  if (impostors) {
    set_common(impostor_->light_program(), tile);
    set_common(impostor_->single_light_program(), tile);
    impostor_->draw_light(tile.clip, tile.offset, pixel, plan.look.lit, haze_of(plan));
  }
  glDepthMask(GL_TRUE);
}

void Renderer::draw_backdrop(const FramePlan& plan, const Tile& tile) const {
  const Backdrop backdrop = backdrop_of(plan.look);
  glDepthFunc(GL_LEQUAL);
  glDepthMask(GL_FALSE);
  set_common(backdrop_, tile);
  const CameraFrame& f = plan.view.frame;
  // The tile's rays: the centre of its part of the image plane at distance 1, and half its sides.
  const double across = plan.view.tan_half_x / plan.width, over = plan.view.tan_half_y / plan.height;
  const double cx = (2.0 * tile.x + tile.width - plan.width) * across;
  const double cy = (2.0 * tile.y + tile.height - plan.height) * over;
  backdrop_.set("ray_centre", to_float(f.right * cx + f.up * cy - f.back));
  backdrop_.set("ray_across", to_float(f.right * (tile.width * across)));
  backdrop_.set("ray_up", to_float(f.up * (tile.height * over)));
  backdrop_.set("backdrop", backdrop == Backdrop::sky ? 0 : backdrop == Backdrop::studio ? 1 : 2);
  backdrop_.set("plain", backdrop == Backdrop::white ? Float3{1, 1, 1} : Float3{});
  glBindVertexArray(no_vertices_.get());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  glDepthMask(GL_TRUE);
  if (!has_ground(plan, scene_)) return;

  glDepthFunc(GL_LESS);
  set_common(ground_, tile);
  ground_.set("ground_centre", to_float(scene_.foot() - scene_.geometry.origin));
  ground_.set("ground_reach", static_cast<float>(k_ground_reach * scene_.size()));
  ground_.set("ground_scale", static_cast<float>(scene_.size()));
  ground_.set("studio", backdrop == Backdrop::studio ? 1 : 0);
  if (backdrop == Backdrop::studio) glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glBindVertexArray(no_vertices_.get());
  glDrawArrays(GL_TRIANGLE_STRIP, 0, 4);
  glDisable(GL_BLEND);
}

SkeletonPass::Frame Renderer::line_frame(const FramePlan& plan, const Tile& tile) const {
  SkeletonPass::Frame frame;
  frame.clip = tile.clip;
  frame.offset = tile.offset;
  frame.view = &plan.view;
  frame.fragment_angle =
      static_cast<float>(2 * plan.view.tan_half_y / (static_cast<double>(plan.height) * tile.sub_pixels));
  frame.sun = to_float(settings_.sun);
  return frame;
}

// As wide as they were chosen to be, in the colours that they came with.
void Renderer::draw_primitives(const FramePlan& plan, const Tile& tile) {
  SkeletonPass::Frame frame = line_frame(plan, tile);
  frame.thinnest = 0;
  frame.lit = false;
  glDepthFunc(GL_LESS);
  glEnable(GL_SAMPLE_ALPHA_TO_COVERAGE);
  primitives_.draw_lines(frame);
  glDisable(GL_SAMPLE_ALPHA_TO_COVERAGE);
}

void Renderer::draw_skeleton(const FramePlan& plan, const Tile& tile) {
  if (!scene_.skeleton) return;
  SkeletonPass::Frame frame = line_frame(plan, tile);
  frame.thinnest = 0.7f * static_cast<float>(tile.sub_pixels);
  frame.scale = plan.look.show == Show::both ? 0.45f : 1.0f;
  frame.lit = plan.look.lit;
  // Over a surface the lines are always seen: they are what is looked at.
  if (plan.look.show == Show::both) glClear(GL_DEPTH_BUFFER_BIT);
  glDepthFunc(GL_LESS);
  glEnable(GL_SAMPLE_ALPHA_TO_COVERAGE);
  skeleton_.draw_lines(frame);
  glDisable(GL_SAMPLE_ALPHA_TO_COVERAGE);
  if (plan.look.show != Show::groups || skeleton_.spheres() == 0) return;
  glDepthMask(GL_FALSE);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  skeleton_.draw_spheres(frame);
  glDisable(GL_BLEND);
  glDepthMask(GL_TRUE);
}

void Renderer::resolve(const Tile& tile, GLuint framebuffer) const {
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer);
  glViewport(tile.x, tile.y, tile.width, tile.height);
  glDisable(GL_FRAMEBUFFER_SRGB);
  glDisable(GL_DEPTH_TEST);
  resolve_.use();
  resolve_.set("samples", unit_samples);
  resolve_.set("sample_count", multisamples_);
  resolve_.set("sub_pixels", tile.sub_pixels);
  resolve_.set("tile_origin", tile.x, tile.y);
  glActiveTexture(GL_TEXTURE0 + unit_samples);
  glBindTexture(GL_TEXTURE_2D_MULTISAMPLE, tile_colour_.get());
  glBindVertexArray(no_vertices_.get());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

Result<void> Renderer::draw_picture(const FramePlan& plan) {
  if (picture_width_ != plan.width || picture_height_ != plan.height) {
    picture_width_ = plan.width;
    picture_height_ = plan.height;
    picture_ = make_texture();
    picture_framebuffer_ = make_framebuffer();
    glBindTexture(GL_TEXTURE_2D, picture_.get());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_RGBA8, plan.width, plan.height, 0, GL_RGBA, GL_UNSIGNED_BYTE, nullptr);
    glBindFramebuffer(GL_FRAMEBUFFER, picture_framebuffer_.get());
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, picture_.get(), 0);
    if (auto done = check_gl("making the picture"); !done) return done;
  }
  return draw(plan, picture_framebuffer_.get());
}

Image Renderer::read_picture() const {
  Image image;
  image.width = picture_width_;
  image.height = picture_height_;
  const std::size_t row = 4 * static_cast<std::size_t>(picture_width_);
  const auto height = static_cast<std::size_t>(picture_height_);
  image.rgba.resize(row * height);
  glBindFramebuffer(GL_READ_FRAMEBUFFER, picture_framebuffer_.get());
  glPixelStorei(GL_PACK_ALIGNMENT, 4);
  glReadPixels(0, 0, picture_width_, picture_height_, GL_RGBA, GL_UNSIGNED_BYTE, image.rgba.data());
  // OpenGL's rows start at the bottom, a picture's at the top.
  for (std::size_t y = 0; y < height / 2; ++y) {
    std::uint8_t* top = image.rgba.data() + y * row;
    std::swap_ranges(top, top + row, image.rgba.data() + (height - 1 - y) * row);
  }
  return image;
}

}  // namespace copse::treeplay
