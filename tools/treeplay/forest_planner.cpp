#include "tools/treeplay/forest_planner.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include <fmt/format.h>

namespace copse::treeplay {

namespace {

constexpr std::size_t k_kept_bytes = std::size_t{256} << 20;  // of instances that are not seen any more
// Shadows reach this many heights of the forest's trees from the eye: there a crown is some pixels.
constexpr double k_shadow_heights = 25;
// A tree so many pixels high has no depth that could be seen: one picture does.
constexpr double k_picture_pixels = 40;
// Of the terrain, as a share of a pixel: half of one cannot be told.
constexpr double k_terrain_pixels = 0.5;

DoubleBox absolute(const FloatBox& box, const Double3& origin) {
  return {origin + to_double(box.min), origin + to_double(box.max)};
}

// A ball relative to the origin, against planes relative to the eye.
bool is_outside(const Frustum& frustum, const Double3& origin_from_eye, const StreamedInstance& i) {
  const Double3 c = origin_from_eye + to_double(i.centre);
  return std::any_of(frustum.begin(), frustum.end(),
                     [&](const Plane& p) { return dot(p.normal, c) + p.offset < -double{i.radius}; });
}

// Beyond what its type is drawn at; range 0: no limit.
bool is_beyond(double range, const Double3& eye, const StreamedInstance& i) {
  return range > 0 && distance(eye, to_double(i.centre)) - double{i.radius} > range;
}

// How far its foot is from the eye, for a tree of scale 1: one of half the size looks at 10 m as the tree
// itself does at 20 m.
double own_distance(const StreamedInstance& i, const Double3& eye) {
  return distance(eye, {double{i.rows[0].w}, double{i.rows[1].w}, double{i.rows[2].w}}) / double{i.scale};
}

// Of the tallest trees.
double height_of(const Ecosystem& eco) {
  double height = 0;
  for (const TreeType& t : eco.types)
    if (!t.bounds.empty() && t.instances > 0)
      height = std::max(height, double{t.scale_max} * double{t.bounds.max.y - t.bounds.min.y});
  return height;
}

}  // namespace

ForestPlanner::ForestPlanner(const Scene& scene, BlockHierarchy by)
    : scene_(scene), eco_(*scene.eco), by_(by), stream_(eco_, k_kept_bytes), ground_(scene.forest.ground) {
  groups_.emplace_back();
  if (!ground_.empty()) groups_[0].ranges = {{DrawPart::ground, ground_.material(), 0, 0}};
}

// A type at every level, in the instance's materials; the levels follow one another.
std::uint32_t ForestPlanner::first_group(std::uint32_t type, const StreamedInstance& instance) {
  const auto [known, is_new] = first_group_.try_emplace(
      {type, instance.trunk_material, instance.leaf_material}, static_cast<std::uint32_t>(groups_.size()));
  if (!is_new) return known->second;
  for (const std::vector<DrawRange>& level : scene_.forest.types[type].levels) {
    ForestGroup group{.ranges = level};
    for (DrawRange& r : group.ranges) {
      if (r.part == DrawPart::trunk && instance.trunk_material != k_none)
        r.material = instance.trunk_material;
      if (r.part == DrawPart::leaves && instance.leaf_material != k_none) r.material = instance.leaf_material;
      group.triangles += r.index_count / 3;
    }
    groups_.push_back(std::move(group));
  }
  return known->second;
}

void ForestPlanner::set_ladders(const ForestWish& wish) {
  ladders_.clear();
  for (const ForestType& type : scene_.forest.types)
    ladders_.push_back(
        {LevelLadder(type, false, wish.pixel, wish.fade), LevelLadder(type, true, wish.pixel, wish.fade)});
}

// At the level of its distance from the eye, between two at both; answers its triangles.
std::uint64_t ForestPlanner::show(const StreamedInstance& instance, std::uint32_t type, const Side& side,
                                  ForestView& out) {
  const bool own = instance.trunk_material == k_none && instance.leaf_material == k_none;
  LadderChoice choice = ladders_[type][own].at(own_distance(instance, side.eye));
  // A shadow is that of one of them, whole.
  if (side.sun) choice.main.pixels = k_all_pixels;
  std::uint64_t triangles = show_level(instance, type, side, choice.main, out);
  if (!side.sun && choice.other.level != k_none)
    triangles += show_level(instance, type, side, choice.other, out);
  return triangles;
}

std::uint64_t ForestPlanner::show_level(const StreamedInstance& instance, std::uint32_t type,
                                        const Side& side, const LadderLevel& level, ForestView& out) {
  DrawCopy drawn{instance.rows, instance.tint};
  drawn.tint[3] = level.pixels;
  if (level.level == k_impostor) {
    const ImpostorAtlas& atlas = scene_.forest.types[type].impostor->atlas;
    const auto& [x, y, z] = instance.rows;
    const Double3 place{double{x.w}, double{y.w}, double{z.w}};
    const ImpostorCopy copy =
        impostor_copy(drawn, atlas, side.sun ? *side.sun : side.eye - place, side.sun != nullptr);
    const bool small = side.sun || 2 * double{atlas.radius} <
                                       k_picture_pixels * side.pixel * own_distance(instance, side.eye);
    if (small) out.impostors[type].single.push_back(picture_of(copy));
    if (!small) out.impostors[type].blended.push_back(copy);
    return 2;
  }
  const std::uint32_t group = first_group(type, instance) + level.level;
  if (out.copies.size() <= group) out.copies.resize(group + 1);
  out.copies[group].push_back(drawn);
  return groups_[group].triangles;
}

std::uint64_t ForestPlanner::show_ground(const Frustum& frustum, const Double3& eye, ForestView& out) const {
  if (ground_.empty()) return 0;
  if (out.copies.empty()) out.copies.resize(1);
  out.copies[0].emplace_back();
  ground_.append(frustum, eye, out.ground);
  return out.ground.size() / 3;
}

void ForestPlanner::sort_by_distance(const Double3& eye) {
  std::vector<std::pair<double, SeenBlock>> order;
  order.reserve(seen_.size());
  for (const SeenBlock& s : seen_)
    order.emplace_back(distance_to(eye, absolute(eco_.blocks[s.block].bounds, eco_.origin)), s);
  std::sort(order.begin(), order.end(), [](const auto& a, const auto& b) {
    return a.first != b.first ? a.first < b.first : a.second.block < b.second.block;
  });
  for (std::size_t i = 0; i < order.size(); ++i) seen_[i] = order[i].second;
}

void ForestPlanner::see(const View& view, const ForestWish& wish, ForestFrame& frame, ForestCounts& counts) {
  const Frustum frustum = frustum_of(view);
  const auto start = std::chrono::steady_clock::now();
  visible_blocks(eco_, by_, frustum, view.eye, seen_, &counts.culling, &memory_);
  counts.cull_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  counts.blocks_seen = seen_.size();
  sort_by_distance(view.eye);
  nearest_ =
      seen_.empty() ? 0 : distance_to(view.eye, absolute(eco_.blocks[seen_[0].block].bounds, eco_.origin));
  const Double3 eye = view.eye - eco_.origin;
  for (const SeenBlock& s : seen_) {
    const InstanceBlock& block = eco_.blocks[s.block];
    const double range = double{eco_.types[block.type].view_range};
    for (const StreamedInstance& i : stream_.block(s.block)) {
      if (i.radius < 0) continue;
      const bool test = !s.whole && by_ != BlockHierarchy::none;
      counts.instances_tested += test;
      if (test && is_outside(frustum, -eye, i)) continue;
      if (is_beyond(range, eye, i)) continue;
      counts.triangles += show(i, block.type, {eye, wish.pixel, nullptr}, frame.seen);
      ++counts.instances_drawn;
    }
  }
  for (const auto& copies : frame.seen.impostors) counts.impostors += copies.size();
  ground_.choose(view.eye, k_terrain_pixels * wish.pixel);
  counts.triangles += show_ground(frustum, view.eye, frame.seen);
}

// Whatever may cast into a map, seen or not, but not what is beyond its view range: a shadow of nothing.
void ForestPlanner::cast(const View& view, const ForestWish& wish, ForestFrame& frame, ForestCounts& counts) {
  const DoubleBox scene = absolute(eco_.bounds, eco_.origin);
  if (!wish.lit || scene.empty()) return;
  const double size = length(scene.extent());
  const double reach = std::clamp(k_shadow_heights * height_of(eco_), 0.02 * size, 2 * size);
  // From above the forest begins far away; in powers of two, so that maps keep their widths while the eye
  // moves.
  double nearest = std::max(view.near_plane, 0.003 * reach);
  while (2 * nearest <= std::min(nearest_, reach / 2)) nearest *= 2;
  frame.shadows = shadow_cascades(view, wish.sun, scene, eco_.origin,
                                  {.count = k_max_cascades,
                                   .texels = wish.shadow_size / 2,
                                   .nearest = nearest,
                                   .farthest = std::max(reach, 2 * nearest)});
  const Double3 eye = view.eye - eco_.origin;
  for (std::size_t c = 0; c < frame.shadows.count; ++c) {
    const ShadowCascade& cascade = frame.shadows.cascades[c];
    visible_blocks(eco_, by_ == BlockHierarchy::none ? BlockHierarchy::flat : by_, cascade.casters, view.eye,
                   seen_);
    ForestView& casters = frame.casters[c];
    casters.impostors.resize(eco_.types.size());
    for (const SeenBlock& s : seen_) {
      const std::uint32_t type = eco_.blocks[s.block].type;
      const double range = double{eco_.types[type].view_range};
      for (const StreamedInstance& i : stream_.block(s.block))
        if (i.radius >= 0 && !is_beyond(range, eye, i) && (s.whole || !is_outside(cascade.casters, -eye, i)))
          counts.shadow_triangles += show(i, type, {eye, wish.pixel, &wish.sun}, casters);
    }
    counts.shadow_triangles += show_ground(cascade.casters, view.eye, casters);
  }
}

Result<ForestFrame> ForestPlanner::plan(const View& view, const ForestWish& wish, ForestCounts& counts) {
  stream_.next_frame();
  set_ladders(wish);
  ForestFrame frame;
  frame.seen.impostors.resize(eco_.types.size());
  see(view, wish, frame, counts);
  cast(view, wish, frame, counts);
  if (stream_.damaged() == k_none) return frame;
  return refuse(
      scene_.name,
      fmt::format("block {}: its instances are damaged (treedump --verify tells more)", stream_.damaged()),
      "restore the file, or make it again");
}

}  // namespace copse::treeplay
