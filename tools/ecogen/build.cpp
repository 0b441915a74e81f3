#include "tools/ecogen/build.h"

#include "lib/analysis/ecosystem/arrange.h"
#include "lib/analysis/ecosystem/block_trees.h"
#include "lib/analysis/ecosystem/mix_masses.h"
#include "lib/analysis/ecosystem/populate.h"
#include "lib/analysis/ecosystem/spread.h"
#include "lib/analysis/ecosystem/tilt.h"
#include "lib/formats/ecosystem/check_ecosystem.h"
#include "tools/ecogen/crown_reach.h"
#include "tools/ecogen/frames.h"
#include "tools/ecogen/inputs.h"
#include "tools/ecogen/leave_out.h"
#include "tools/ecogen/measure.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <tuple>

#include <fmt/format.h>

namespace copse::ecogen {
namespace {

namespace fs = std::filesystem;

enum Stream : std::uint64_t { stream_terrain = 1, stream_plants = 2 };

PlantedArea area_of(const Scene& scene, const TerrainGround& ground) {
  return scene.area.value_or(PlantedArea{ground.x0(), ground.z0(), ground.x1(), ground.z1()});
}

Result<void> check_area(const Scene& scene, const TerrainGround& ground, const fs::path& document) {
  if (!scene.area) return {};
  const PlantedArea& a = *scene.area;
  if (a.x0 >= ground.x0() && a.z0 >= ground.z0() && a.x1 <= ground.x1() && a.z1 <= ground.z1()) return {};
  return refuse(
      document.string(), "area: reaches out of the terrain",
      fmt::format("keep it within {}, {}, {}, {}", ground.x0(), ground.z0(), ground.x1(), ground.z1()));
}

// Errors from the libraries know places in the document, not its name.
std::unexpected<Error> in_file(Error error, const fs::path& document) {
  if (error.file.empty()) error.file = document.string();
  return std::unexpected(std::move(error));
}

// Errors of files know their file, not where the page names it.
std::unexpected<Error> named_at(const std::string& place, Error error) {
  error.what = fmt::format("{}: {}", place, error.what);
  return std::unexpected(std::move(error));
}

Instance instance_of(const PlantedSource& p, const TypeSource& type, GroundBeside& ground) {
  Instance i;
  const GroundPoint here = ground.at(p.x, p.z);
  i.position = {p.x, p.y.value_or(here.height), p.z};
  i.on_ground = !p.y;
  const Quaternion tilt = tilt_of(p.pitch.value_or(0), p.roll.value_or(0));
  i.along_normal = type.tilt_to_ground && !p.pitch && !p.roll;
  i.rotation = with_head(i.along_normal ? tilt_to(here.normal) : tilt, p.head);
  i.scale = p.scale;
  i.trunk_material = p.trunk_material;
  i.leaf_material = p.leaf_material;
  i.motion = p.motion;
  i.tint = p.tint;
  return i;
}

class Builder {
 public:
  Builder(const Scene& scene, const BuildOptions& options, Context& context)
      : scene_(scene), options_(options), context_(context), inputs_(context), random_(scene.seed) {}

  Result<Built> build() {
    if (auto done = make_ground(); !done) return in_file(done.error(), options_.document);
    const TerrainGround ground(built_.eco.terrain);
    if (auto done = check_area(scene_, ground, options_.document); !done)
      return std::unexpected(done.error());
    if (auto done = read_trees(); !done) return std::unexpected(done.error());
    if (auto done = plan_types(ground); !done) return std::unexpected(done.error());
    if (auto done = share_mixes(ground); !done) return in_file(done.error(), options_.document);
    auto population = plant(ground);
    if (!population) return in_file(population.error(), options_.document);
    tell_population(*population);
    built_.eco.materials = scene_.materials;
    built_.eco.seed = scene_.seed;
    for (const fs::path& texture : scene_.textures)
      built_.eco.textures.push_back({.uri = texture.string(), .mime = "", .bytes = {}});
    built_.texture_places.resize(scene_.textures.size());
    for (std::size_t m = scene_.materials.size(); m-- > 0;)  // the first that names it stays
      if (scene_.materials[m].texture != k_none)
        built_.texture_places[scene_.materials[m].texture] = fmt::format("materials[{}].texture", m);
    built_.sources = inputs_.files();
    if (options_.path) drop_frames(*population, ground);
    if (auto done = drop_unused(*population); !done) return std::unexpected(done.error());
    if (auto done = lay_out(*population, ground); !done) return in_file(done.error(), options_.document);
    return std::move(built_);
  }

 private:
  Result<void> make_ground() {
    Stage stage = context_.stage("terrain");
    TerrainPlan plan = scene_.terrain;
    auto heights = inputs_.map(scene_.height_map);
    if (!heights) return named_at("terrain.height_map", heights.error());
    plan.height_map = *heights;
    auto terrain = make_terrain(plan, random_.fork(stream_terrain));
    if (!terrain) return std::unexpected(terrain.error());
    Terrain& t = built_.eco.terrain = std::move(*terrain);
    t.material = scene_.terrain_material;
    t.texture_size = static_cast<float>(scene_.texture_size);
    // Boxes count from the middle of the terrain, so that float32 holds them as well far from the origin.
    DoubleBox box;
    for (std::uint32_t r = 0; r < t.rows; ++r)
      for (std::uint32_t c = 0; c < t.columns; ++c) box.grow(t.vertex(c, r));
    const Double3 centre = box.centre();
    built_.eco.origin = {std::floor(centre.x), std::floor(centre.y), std::floor(centre.z)};
    built_.eco.bounds = round_outward({box.min - built_.eco.origin, box.max - built_.eco.origin});
    // Not as items of the stage: the most that a stage went through is the headline of the report's page, and
    // that of a forest are its instances.
    context_.report().tables.push_back(
        {"ground",
         {"columns", "rows", "vertices", "stored as"},
         {{std::to_string(t.columns), std::to_string(t.rows), std::to_string(t.vertex_count()),
           t.regular() ? "heights of a grid" : "points"}}});
    return {};
  }

  Result<void> read_trees() {
    Stage stage = context_.stage("trees");
    for (std::size_t i = 0; i < scene_.types.size(); ++i) {
      const TypeSource& source = scene_.types[i];
      auto type = read_type(source, context_);
      if (!type) {
        Error error = type.error();
        if (const fs::path end = source.tree.extension(); end == ".glb" || end == ".gltf" || end == ".obj")
          error.remedy = "make a tree of the mesh by treeprep, and name that";
        return named_at(fmt::format("types[{}].tree", i), error);
      }
      type->uri = source.tree.string();
      if (const auto range = static_cast<float>(options_.view_range); range > 0)
        type->view_range = type->view_range > 0 ? std::min(type->view_range, range) : range;
      built_.farthest.push_back(type->view_range > 0 ? double{type->view_range}
                                                     : std::numeric_limits<double>::infinity());
      built_.eco.types.push_back(std::move(*type));
    }
    stage.items(scene_.types.size(), "trees");
    return {};
  }

  Result<void> plan_types(const TerrainGround& ground) {
    Stage stage = context_.stage("maps");
    plans_.reserve(scene_.types.size());
    GroundBeside all_ground(built_.eco.terrain, ground);
    const auto leans = [](const TypeSource& t) { return t.tilt_to_ground && t.crown_footprint; };
    const bool any = std::any_of(scene_.types.begin(), scene_.types.end(), leans);
    const SinCos steepest = any ? steepest_slope(built_.eco.terrain) : SinCos{};
    for (std::size_t i = 0; i < scene_.types.size(); ++i) {
      const TypeSource& s = scene_.types[i];
      TypePlan p;
      p.name = fmt::format("types[{}] ({})", i, s.name);
      p.count = s.count;
      p.head = s.head, p.pitch = s.pitch, p.roll = s.roll, p.scale = s.scale;
      p.tilt_to_ground = s.tilt_to_ground;
      p.trunk_material = s.trunk_material, p.leaf_material = s.leaf_material, p.motion = s.motion;
      p.rules.slope = s.slope, p.rules.altitude = s.altitude, p.rules.distance = s.distance;
      p.rules.clusters = s.clusters;
      p.footprint = s.crown_footprint ? crown_reach(built_.eco.types[i].bounds, s, steepest) : s.footprint;
      p.spacing = s.spacing;
      p.avoid = s.avoid;
      p.fewer = s.fewer;
      for (const PlantedSource& planted : s.planted) p.manual.push_back(instance_of(planted, s, all_ground));
      tell_outside(p, ground);
      const std::tuple<const char*, const std::optional<MapSource>*, const ValueMap**> maps[] = {
          {"scale_map", &s.scale_map, &p.scale_map},
          {"density", &s.density, &p.rules.density},
          {"forbidden", &s.forbidden, &p.rules.forbidden},
          {"distance.map", &s.distance_map, &p.rules.distance_to}};
      for (const auto& [key, source, target] : maps) {
        auto map = inputs_.map(*source);
        if (!map) return named_at(fmt::format("types[{}].{}", i, key), map.error());
        *target = *map;
      }
      auto tint = inputs_.tint(s.tint_map);
      if (!tint) return named_at(fmt::format("types[{}].tint_map", i), tint.error());
      p.tint_map = *tint;
      plans_.push_back(std::move(p));
    }
    return {};
  }

  void tell_outside(const TypePlan& p, const TerrainGround& ground) {
    const auto outside = std::count_if(p.manual.begin(), p.manual.end(), [&](const Instance& i) {
      return i.on_ground && !ground.covers(i.position.x, i.position.z);
    });
    if (outside > 0)
      context_.warn(
          fmt::format("{}: {} by hand stand outside the terrain, at the height of its nearest part; give "
                      "them a y, or move them",
                      p.name, outside));
  }

  // The types of a mix share its count as their maps share its density.
  Result<void> share_mixes(const TerrainGround& ground) {
    if (scene_.mixes.empty()) return {};
    Stage stage = context_.stage("mixes");
    const PlantedArea area = area_of(scene_, ground);
    std::uint64_t types = 0;
    Table table{"mixes", {"mix", "types", "instances", "cells a side", "points looked at"}, {}};
    for (std::size_t m = 0; m < scene_.mixes.size(); ++m) {
      const MixSource& mix = scene_.mixes[m];
      auto density = inputs_.map(mix.density);
      if (!density) return named_at(fmt::format("mixes[{}].density", m), density.error());
      std::vector<const ValueMap*> shares;
      std::uint32_t largest = *density ? std::max((*density)->width, (*density)->height) : 0;
      for (std::size_t i = 0; i < mix.parts.size(); ++i) {
        auto share = inputs_.map(mix.parts[i].share);
        if (!share) return named_at(fmt::format("mixes[{}].parts[{}].share", m, i), share.error());
        shares.push_back(*share);
        largest = std::max({largest, (*share)->width, (*share)->height});
      }
      // One grid for all, so that what they sum up to can be compared.
      std::uint32_t side = 0;
      for (const MixSource::Part& part : mix.parts)
        side = std::max(side, field_side(largest, mix.count, plans_[part.type].rules.clusters, area));
      const std::vector<ValueMap>& totals = share_totals_.emplace_back(means_by_size(shares));
      std::vector<MixPart> parts;
      for (std::size_t i = 0; i < mix.parts.size(); ++i) {
        TypePlan& plan = plans_[mix.parts[i].type];
        PlacementRules& rules = plan.rules;
        plan.field_cells = side;
        rules.density = *density;
        rules.share_of = shares[i];
        for (const ValueMap& total : totals) rules.share_total.push_back(&total);
        parts.push_back({&rules, cluster_random(random_.fork(stream_plants), mix.parts[i].type)});
      }
      const MixMasses shared = mix_masses(parts, area, ground, side, side);
      types += parts.size();
      table.rows.push_back({fmt::format("mixes[{}]", m), std::to_string(parts.size()),
                            std::to_string(mix.count), std::to_string(side), std::to_string(shared.points)});
      stage.progress(static_cast<double>(m + 1) / static_cast<double>(scene_.mixes.size()));
      const auto counts = apportion(mix.count, shared.masses);
      for (std::size_t i = 0; i < counts.size(); ++i) plans_[mix.parts[i].type].count = counts[i];
      if (mix.count > 0 && *std::max_element(shared.masses.begin(), shared.masses.end()) <= 0)
        return refuse("", fmt::format("mixes[{}]: there is no place that its maps and rules allow", m),
                      "widen them, or set its count to 0");
    }
    stage.items(types, "types");
    context_.report().tables.push_back(std::move(table));
    return {};
  }

  Result<Population> plant(const TerrainGround& ground) {
    Stage stage = context_.stage("plant");
    auto population = populate(plans_, ground, area_of(scene_, ground), random_.fork(stream_plants),
                               [&](double share) { stage.progress(share); });
    if (population) stage.items(population->instances.size(), "instances");
    return population;
  }

  void tell_population(const Population& p) {
    Table table{"types",
                {"type", "asked for", "by hand", "planted", "larger than their cell", "did not fit",
                 "had to leave their part of the density"},
                {}};
    std::uint64_t crowded = 0;
    for (std::size_t t = 0; t < plans_.size(); ++t) {
      const TypeCounts& c = p.types[t];
      crowded += c.crowded;
      if (c.crowded > 0)
        context_.warn(
            fmt::format("{}: {} of {} are larger than their cell, so neighbours may touch; lower "
                        "scale, count or footprint, or keep them apart by spacing",
                        plans_[t].name, c.crowded, c.placed));
      table.rows.push_back({scene_.types[t].name, std::to_string(plans_[t].count),
                            std::to_string(plans_[t].manual.size()),
                            std::to_string(c.placed + plans_[t].manual.size()), std::to_string(c.crowded),
                            std::to_string(c.missing), std::to_string(c.moved)});
      if (c.overlapping > 0)
        context_.warn(fmt::format(
            "{}: {} by hand overlap others by hand at this spacing; move them, or lower spacing or scale",
            plans_[t].name, c.overlapping));
      if (c.missing > 0)
        context_.warn(fmt::format("{}: {} of {} did not fit at this spacing", plans_[t].name, c.missing,
                                  plans_[t].count));
    }
    context_.report().tables.push_back(std::move(table));
    tell_densities(plans_, p, context_);
    if (p.cells > 0)
      context_.report().tables.push_back({"jittered cells",
                                          {"cells", "instances moved on to a free cell",
                                           "instances in random cells", "instances larger than their cell"},
                                          {{std::to_string(p.cells), std::to_string(p.displaced),
                                            std::to_string(p.in_random_cells), std::to_string(crowded)}}});
  }

  void drop_frames(Population& population, const TerrainGround& ground) {
    Stage stage = context_.stage("frames");
    const Seen seen = drop_unseen(population.instances, built_.eco.types, area_of(scene_, ground),
                                  *options_.path, options_.aspect, options_.lowest_sun);
    built_.farthest = seen.farthest;
    if (seen.dropped > 0)
      built_.left_out.push_back(
          {fmt::format("{} instances", seen.dropped),
           fmt::format("no frame of the camera's path shows them, nor their shadows on level ground while "
                       "the sun stands at least {:g} degrees high",
                       options_.lowest_sun),
           seen.dropped * (scene_.exact ? sizeof(ExactInstance) : sizeof(PackedInstance))});
    stage.items(seen.dropped, "instances left out");
  }

  Result<void> drop_unused(Population& population) {
    Stage stage = context_.stage("leave out");
    return leave_out(population.instances, options_, built_, context_);
  }

  Result<void> lay_out(const Population& population, const TerrainGround& ground) {
    Stage stage = context_.stage("arrange");
    stage.items(population.instances.size(), "instances");
    const PlantedArea area = area_of(scene_, ground);
    const ArrangeOptions options{.exact = scene_.exact,
                                 .depth = scene_.depth,
                                 .area = {area.x0, area.z0, area.x1, area.z1},
                                 .ground = &ground};
    const auto order = arrange(population.instances, options, built_.eco);
    if (!order) return std::unexpected(order.error());
    Ecosystem& e = built_.eco;
    std::vector<std::uint64_t> hashes;
    for (const InstanceBlock& b : e.blocks) hashes.push_back(hash_of_block(e, b));
    e.block_hashes = std::move(hashes);
    if (scene_.kd_tree) e.kd_tree = block_kd_tree(e);
    if (scene_.rtree) e.rtree = block_rtree(e);
    auto& errors = context_.report().errors;
    errors.push_back({"stored position", e.position_error, "m", e.position_error, {}, {}, "as placed"});
    errors.push_back({"stored rotation", e.rotation_error, "rad", e.rotation_error, {}, {}, "as placed"});
    errors.push_back({"stored scale", e.scale_error, "ratio", e.scale_error, {}, {}, "as placed"});
    tell_tilts(population, ground, context_);
    tell_ties(e, population.instances, *order, ground, context_);
    return {};
  }

  const Scene& scene_;
  const BuildOptions& options_;
  Context& context_;
  Inputs inputs_;
  Random random_;
  std::deque<std::vector<ValueMap>> share_totals_;  // of every mix; plans point at them
  std::vector<TypePlan> plans_;
  Built built_;
};

}  // namespace

Result<Built> build(const Scene& scene, const BuildOptions& options, Context& context) {
  return Builder(scene, options, context).build();
}

}  // namespace copse::ecogen
