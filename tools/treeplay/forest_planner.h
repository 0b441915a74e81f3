// Decides what a frame shows of a forest: the blocks that the camera sees, of those that lie across its
// border the instances, each at the level of its distance; and what casts shadows on them.
//
// Instances come out from near to far, so that what is near hides what is far before that costs anything.
#pragma once

#include "lib/runtime/block_culling.h"
#include "lib/runtime/block_stream.h"
#include "lib/runtime/camera.h"
#include "lib/runtime/shadow_cascades.h"
#include "tools/treeplay/impostor_copy.h"
#include "tools/treeplay/level_ladder.h"
#include "tools/treeplay/scene.h"

#include <array>
#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

namespace copse::treeplay {

// What is drawn from one side: by the camera, or by the sun.
struct ForestView {
  std::vector<std::vector<DrawCopy>> copies;  // of every group
  std::vector<ImpostorCopies> impostors;      // of every type
  std::vector<std::uint32_t> ground;          // indices of the scene's vertices
};

struct ForestFrame {
  ForestView seen;
  ShadowCascades shadows;
  std::array<ForestView, k_max_cascades> casters;
};

// What deciding on a frame and drawing it took.
struct ForestCounts {
  CullCounts culling;       // of the camera alone
  double cull_seconds = 0;  // of the hierarchy, without the instances
  std::uint64_t blocks_seen = 0, instances_tested = 0, instances_drawn = 0, impostors = 0;
  std::uint64_t triangles = 0, shadow_triangles = 0;
};

struct ForestWish {
  bool lit = true;
  Double3 sun{0, 1, 0};
  int shadow_size = 4096;  // texels a side, for all maps together
  double pixel = 1e-3;     // tangent of the angle that a pixel covers
  double fade = 0;         // between two levels, as LevelLadder takes it
};

// Ranges of the scene's geometry that are drawn together: a type at a level, in the materials of its
// instances.
struct ForestGroup {
  std::vector<DrawRange> ranges;
  std::uint64_t triangles = 0;  // of one copy
};

class ForestPlanner {
 public:
  // Keeps a reference. Precondition: an ecosystem that has the hierarchy.
  ForestPlanner(const Scene& scene, BlockHierarchy by);

  // Refused: a block whose instances are damaged.
  Result<ForestFrame> plan(const View& view, const ForestWish& wish, ForestCounts& counts);

  // Group 0 is the ground. New ones may be there after plan(): who draws must know them before.
  const std::vector<ForestGroup>& groups() const { return groups_; }
  const StreamCounts& read() const { return stream_.counts(); }

 private:
  using Key = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>;  // type, trunk's and leaves' materials
  std::uint32_t first_group(std::uint32_t type, const StreamedInstance& instance);
  void see(const View& view, const ForestWish& wish, ForestFrame& frame, ForestCounts& counts);
  void cast(const View& view, const ForestWish& wish, ForestFrame& frame, ForestCounts& counts);
  // What is shown from where: by the eye, or by the sun at the levels that the eye sees.
  struct Side {
    Double3 eye;  // relative to the origin
    double pixel = 0;
    const Double3* sun = nullptr;
  };
  std::uint64_t show(const StreamedInstance& instance, std::uint32_t type, const Side& side, ForestView& out);
  std::uint64_t show_level(const StreamedInstance& instance, std::uint32_t type, const Side& side,
                           const LadderLevel& level, ForestView& out);
  void set_ladders(const ForestWish& wish);
  std::uint64_t show_ground(const Frustum& frustum, const Double3& eye, ForestView& out) const;
  void sort_by_distance(const Double3& eye);

  const Scene& scene_;
  const Ecosystem& eco_;
  BlockHierarchy by_;
  BlockStream stream_;
  ForestGround ground_;  // with the levels that the last frame took
  std::vector<ForestGroup> groups_;
  std::map<Key, std::uint32_t> first_group_;
  std::vector<std::array<LevelLadder, 2>> ladders_;  // of every type in other materials, in its own
  std::vector<SeenBlock> seen_;
  CullMemory memory_;   // of the camera
  double nearest_ = 0;  // of the blocks that the camera saw last, metres from the eye
};

}  // namespace copse::treeplay
