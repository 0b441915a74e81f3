// Draws a scene: shadow maps, surfaces, sky and ground, skeleton; multisampled, in tiles when the picture is
// larger than what fits, and resolved to sRGB. The same picture from run to run on the same driver.
#pragma once

#include "lib/runtime/camera.h"
#include "tools/treeplay/forest_planner.h"
#include "tools/treeplay/gl.h"
#include "tools/treeplay/impostor_pass.h"
#include "tools/treeplay/scene.h"
#include "tools/treeplay/skeleton_pass.h"
#include "tools/treeplay/surface_pass.h"
#include "tools/treeplay/tree_levels.h"

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <vector>

namespace copse::treeplay {

enum class Show { surface, skeleton, both, groups };
enum class Backdrop { automatic, sky, studio, white, black };

struct Look {
  Show show = Show::surface;
  Backdrop backdrop = Backdrop::automatic;  // sky for surfaces, studio for everything else
  bool lit = true;
  bool ground = true;  // never under a skeleton
};

struct RenderSettings {
  int samples = 4;         // a pixel: 1, 4, or 4 n^2
  Double3 sun{0, 1, 0};    // towards it; length 1, y > 0
  int shadow_size = 4096;  // texels a side, of all maps together
  bool lights = true;      // false: nothing lit will be drawn, so nothing is prepared for it
  BlockHierarchy cull = BlockHierarchy::boxes;  // of an ecosystem
  double fade = 0;  // between two levels of an ecosystem's trees, as LevelLadder takes it
};

// A picture that is about to be drawn: everything that the application decides.
struct FramePlan {
  Look look;
  View view;
  int width = 0, height = 0;
  bool tree_visible = true;
  ForestFrame forest;             // of an ecosystem
  ShownLevel shown;               // of a tree with levels
  PrunedFoliage::Frame foliage;   // with --lod foliage
  LinesPoints::Frame primitives;  // with --lod lines-points
  double distance = 0;            // of the eye from the middle of what is drawn, metres
  // What was done and what will be drawn, for the statistics.
  std::uint64_t triangles = 0, lines = 0, points = 0;
  std::uint64_t instances_tested = 0, instances_drawn = 0, plane_tests = 0;
  bool is_forest = false;
  ForestCounts forest_counts;
};

class Renderer {
 public:
  // Uploads the scene, which must outlive the renderer. Needs a current context of GL 3.3 core.
  static Result<std::unique_ptr<Renderer>> make(const Scene& scene, const RenderSettings& settings);

  // `choice`: of a tree with levels, decides on the level. Refused: instances of an ecosystem that turn out
  // to be damaged when they are first seen.
  Result<FramePlan> plan(const Camera& camera, const Look& look, int width, int height, LevelChoice& choice);

  // Reads and uploads what a frame draws for the first time; draw() does so by itself.
  Result<void> prepare(const FramePlan& plan);

  // Into a framebuffer of the plan's size: 0 is the window.
  Result<void> draw(const FramePlan& plan, GLuint framebuffer);

  // Into the renderer's own picture; read_picture() fetches it.
  Result<void> draw_picture(const FramePlan& plan);
  Image read_picture() const;

  int largest_size() const { return largest_size_; }
  // Of an ecosystem: what of its instances was read so far.
  StreamCounts read() const { return forest_ ? forest_->read() : StreamCounts{}; }

 private:
  struct Tile;
  explicit Renderer(const Scene& scene, const RenderSettings& settings);
  Result<void> make_programs();
  Result<void> make_lights();
  struct ShadowMap {
    Mat4 matrix;         // local -> [0, 1]^3
    Float2 reach{1, 1};  // width and depth, metres
    Float4 place{1, 1, 0, 0};
  };
  Result<void> upload_impostors(std::span<const std::size_t> numbers);
  void draw_shadow_map();
  Result<void> draw_forest_shadows(const ForestFrame& frame);
  void begin_shadow(int x, int y, int texels);
  Result<void> show(const ForestView& view);
  void take_level(const ShownLevel& shown);
  void plan_tree(const Camera& camera, LevelChoice& choice, FramePlan& plan) const;
  Result<void> plan_forest(FramePlan& plan);
  Result<void> fit_tile_buffers(int width, int height);
  void set_common(const Program& program, const Tile& tile) const;
  void draw_tile(const FramePlan& plan, const Tile& tile);
  void draw_surfaces(const FramePlan& plan, const Tile& tile, float ghost) const;
  bool draws_impostors(const FramePlan& plan) const { return plan.shown.impostor || scene_.eco; }
  float haze_of(const FramePlan& plan) const;
  void draw_backdrop(const FramePlan& plan, const Tile& tile) const;
  SkeletonPass::Frame line_frame(const FramePlan& plan, const Tile& tile) const;
  void draw_primitives(const FramePlan& plan, const Tile& tile);
  void draw_skeleton(const FramePlan& plan, const Tile& tile);
  void resolve(const Tile& tile, GLuint framebuffer) const;

  const Scene& scene_;
  RenderSettings settings_;
  int sub_pixels_ = 1;    // a side
  int multisamples_ = 1;  // what the driver gives
  int largest_size_ = 0;
  LodLevel level_;               // what the surfaces and the shadow map hold
  TreeGeometry level_geometry_;  // its indices and ranges
  SurfacePass surfaces_;
  std::optional<ImpostorPass> impostor_;  // where something has one
  SkeletonPass skeleton_, primitives_;
  Program ground_, backdrop_, resolve_;
  VertexArray no_vertices_;
  std::unique_ptr<ForestPlanner> forest_;
  std::size_t groups_ = 0;                // of the forest that surfaces_ knows
  std::vector<std::size_t> impostor_of_;  // of the tree, or of every type, in impostor_; k_none: none yet
  std::map<const TreeImpostor*, std::size_t> impostor_numbers_;
  std::vector<ShadowMap> shadow_maps_;  // nearest first
  bool shadow_ends_ = false;            // there are shadows beyond them
  Framebuffer shadow_framebuffer_;
  Texture2 shadow_texture_, sky_texture_;
  Sampler compare_sampler_, depth_sampler_;
  int tile_width_ = 0, tile_height_ = 0;  // in fragments
  Texture2 tile_colour_, tile_depth_;
  Framebuffer tile_framebuffer_;
  int picture_width_ = 0, picture_height_ = 0;
  Texture2 picture_;
  Framebuffer picture_framebuffer_;
};

}  // namespace copse::treeplay
