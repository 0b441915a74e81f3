// What a document says, as plain data: nothing of JSON goes any further. Files are named, not yet read.
#pragma once

#include "lib/analysis/ecosystem/density_field.h"
#include "lib/analysis/ecosystem/terrain_grid.h"
#include "lib/formats/ecosystem/ecosystem.h"
#include "lib/formats/result.h"
#include "tools/ecogen/document.h"

#include <cstdint>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace copse::ecogen {

// An image and how its numbers are meant.
struct MapSource {
  std::filesystem::path file;
  std::string channel;  // "r", "g", "b", "a", "y" or a number; empty: the only one, or y
  double low = 0, high = 1;
  friend auto operator<=>(const MapSource&, const MapSource&) = default;
};

// An instance by hand; y when it does not stand on the ground, pitch or roll when it does not lean as its
// type.
struct PlantedSource {
  std::optional<double> y, pitch, roll;
  double x = 0, z = 0, head = 0, scale = 1;
  std::uint32_t trunk_material = k_none, leaf_material = k_none, motion = 0;
  std::array<std::uint8_t, 3> tint{255, 255, 255};
};

struct TypeSource {
  std::string name;
  std::filesystem::path tree;
  std::uint64_t count = 0;
  std::vector<PlantedSource> planted;
  ValueRange head{0, 360}, pitch{0, 0}, roll{0, 0}, scale{1, 1}, slope, altitude, distance;
  bool tilt_to_ground = false, fewer = false;
  std::optional<MapSource> scale_map, density, forbidden, distance_map;
  std::filesystem::path tint_map;  // empty: none
  std::uint32_t trunk_material = k_none, leaf_material = k_none, motion = 0;
  Clusters clusters;
  double footprint = 0, spacing = 0, view_range = 0;
  std::vector<std::size_t> avoid;  // types
  bool crown_footprint = true;
};

struct MixSource {
  std::uint64_t count = 0;
  std::optional<MapSource> density;
  struct Part {
    std::size_t type = 0;
    MapSource share;
  };
  std::vector<Part> parts;
};

struct Scene {
  std::uint64_t seed = 0;
  bool exact = false, kd_tree = false, rtree = false;
  std::uint32_t depth = k_none;
  std::optional<PlantedArea> area;
  TerrainPlan terrain;  // its maps still unread
  std::optional<MapSource> height_map;
  std::uint32_t terrain_material = k_none;
  double texture_size = 4;
  std::vector<Material> materials;  // `texture` into textures
  std::vector<std::filesystem::path> textures;
  std::vector<TypeSource> types;
  std::vector<MixSource> mixes;
};

// Precondition: validate() found nothing. Names of files are relative to `file`'s folder. Refused with the
// place: names that no material or type has, a min above its max, a net whose rows differ in length.
Result<Scene> read_scene(const Json& document, const std::filesystem::path& file);

}  // namespace copse::ecogen
