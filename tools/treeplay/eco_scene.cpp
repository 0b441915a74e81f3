#include "tools/treeplay/eco_scene.h"

#include "lib/formats/ecosystem/ecosystem_file.h"
#include "lib/formats/ecosystem/type_hash.h"
#include "lib/formats/hash.h"
#include "lib/formats/tree_file/tree_file.h"
#include "lib/runtime/stochastic_levels.h"
#include "tools/treeplay/tree_levels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include <fmt/format.h>

namespace copse::treeplay {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t k_most_levels = 12;
// Triangles of stochastic levels: for trees that are 32, 16, 8 and 4 pixels high, and less.
constexpr std::array<std::uint32_t, 4> k_stochastic{1024, 256, 64, 16};

FloatBox mesh_box(const TreeGeometry& geometry, const std::vector<DrawRange>& ranges) {
  FloatBox box;
  for (const DrawRange& r : ranges)
    for (std::size_t i = 0; i < r.index_count; ++i)
      box.grow(geometry.vertices[geometry.indices[r.first_index + i]].position);
  return box;
}

// The levels that a forest goes by: the discrete ones, or of a schedule alone one at every doubling of the
// distance.
std::vector<LodLevel> levels_by_distance(const LodSpectra& spectra) {
  if (!spectra.discrete.empty()) return spectra.discrete;
  std::vector<LodLevel> levels;
  if (spectra.schedule.empty() || !(spectra.near > 0)) return levels;
  for (float d = 2 * spectra.near; d < 2 * spectra.far && levels.size() < k_most_levels; d *= 2) {
    LodLevel level = level_of_distance(spectra, double{d});
    level.distance = d;
    levels.push_back(level);
  }
  return levels;
}

class EcosystemReader {
 public:
  EcosystemReader(Scene& scene, const fs::path& path, const Wanted& wanted, Context& context)
      : scene_(scene), path_(path), wanted_(wanted), context_(context) {}

  Result<void> read() {
    if (auto done = open(); !done) return done;
    {
      Stage stage = context_.stage("terrain");
      scene_.forest.ground = ForestGround(eco_->terrain, eco_->origin, scene_.geometry);
      stage.items(eco_->terrain.vertex_count(), "vertices");
    }
    Stage stage = context_.stage("trees");
    scene_.materials = eco_->materials;
    take_textures(std::vector(eco_->textures), scene_.materials, 0, path_);
    for (const TreeType& type : eco_->types)
      if (auto done = add_type(type); !done) return done;
    stage.items(eco_->types.size(), "trees");
    return {};
  }

 private:
  // Maps the file and checks all of it but its instances: those wait until they are seen.
  Result<void> open() {
    Stage stage = context_.stage("open");
    const auto file = EcosystemFile::open(path_);
    if (!file) return std::unexpected(file.error());
    auto eco = file->load(Instances::on_demand);
    if (!eco) return std::unexpected(eco.error());
    if (!has_hierarchy(*eco, wanted_.cull))
      return fail(Fault::usage, path_.string(), "has no such hierarchy over its blocks",
                  "make it with \"block_trees\": [\"kd\", \"r\"] in its page, or cull by its box hierarchy");
    context_.read(path_, true);
    eco_ = &scene_.eco.emplace(std::move(*eco));
    scene_.geometry.origin = eco_->origin;
    scene_.geometry.bounds = eco_->bounds;
    stage.items(eco_->instance_count(), "instances");
    return {};
  }

  // Textures of one file join those of all; its materials, from `first` on, follow them there.
  void take_textures(std::vector<Texture>&& textures, std::vector<Material>& materials, std::size_t first,
                     const fs::path& file) {
    const auto offset = static_cast<std::uint32_t>(scene_.textures.size());
    std::vector<bool> used(textures.size());
    for (std::size_t m = first; m < materials.size(); ++m) {
      if (materials[m].texture == k_none) continue;
      if (materials[m].texture < used.size()) used[materials[m].texture] = true;
      materials[m].texture += offset;
    }
    add_textures(scene_, std::move(textures), used, file, context_);
  }

  // Types of one tree share all of it.
  Result<void> add_type(const TreeType& type) {
    const std::pair<std::string, std::uint64_t> key{
        type.uri, type.packed.empty() ? type.hash : xxh3(type.packed.span())};
    const auto [known, is_new] = known_.try_emplace(key, scene_.forest.types.size());
    if (is_new) return load_type(type);
    scene_.forest.types.push_back(ForestType(scene_.forest.types[known->second]));
    return {};
  }

  Result<void> load_type(const TreeType& type) {
    const fs::path path = path_.parent_path() / type.uri;
    const std::string name =
        type.packed.empty() ? path.string() : fmt::format("{}, tree '{}'", path_.string(), type.name);
    const auto file =
        type.packed.empty() ? TreeFile::open(path) : TreeFile::from_bytes(type.packed.to_vector(), name);
    if (!file) return std::unexpected(file.error());
    auto tree = file->load();
    if (!tree) return std::unexpected(tree.error());
    if (type.packed.empty()) {
      context_.read(path, true);
      if (const std::string changed = changed_tree(type, path); !changed.empty())
        context_.warn(fmt::format("{}: {}; its boxes may be wrong, make {} again", path.string(), changed,
                                  path_.string()));
    }
    const auto first_material = static_cast<std::uint32_t>(scene_.materials.size());
    scene_.materials.insert(scene_.materials.end(), tree->materials.begin(), tree->materials.end());
    take_textures(std::move(tree->textures), scene_.materials, first_material,
                  type.packed.empty() ? path : path_);
    std::shared_ptr<const TreeLevels> levels;
    if (wanted_.levels) {
      auto loaded = TreeLevels::load(*file, *tree);
      if (!loaded) return std::unexpected(loaded.error());
      levels = std::move(*loaded);
    }
    const std::vector<LodLevel> coarser =
        levels ? levels_by_distance(levels->spectra()) : std::vector<LodLevel>();
    TreeGeometry mesh = coarser.empty() ? make_geometry(*tree) : levels->geometry();
    const auto first_vertex = static_cast<std::uint32_t>(scene_.geometry.vertices.size());
    for (DrawVertex v : mesh.vertices) {
      v.position = to_float(mesh.origin + to_double(v.position));
      scene_.geometry.vertices.push_back(v);
    }
    ForestType part;
    part.levels.push_back(add_triangles(mesh, first_vertex, first_material));
    for (const LodLevel& level : coarser) {
      levels->take(level, mesh);
      part.levels.push_back(add_triangles(mesh, first_vertex, first_material));
      part.coarser.push_back(level.distance);
    }
    const FloatBox box = mesh_box(scene_.geometry, part.levels[0]);
    part.height = std::max({box.extent().x, box.extent().y, box.extent().z});
    if (wanted_.levels) add_stochastic_levels(part);
    if (levels && levels->impostor())
      part.impostor = std::shared_ptr<const TreeImpostor>(levels, &*levels->impostor());
    scene_.forest.types.push_back(std::move(part));
    return {};
  }

  // For the trees of a few pixels, of those that have no pictures of their own or not always.
  void add_stochastic_levels(ForestType& part) {
    for (const std::uint32_t triangles : k_stochastic)
      part.levels.push_back(add_stochastic_level(scene_.geometry, part.levels[0], triangles));
  }

  // Appends the indices of a mesh whose vertices are there already; answers its ranges.
  std::vector<DrawRange> add_triangles(const TreeGeometry& mesh, std::uint32_t first_vertex,
                                       std::uint32_t first_material) {
    TreeGeometry& g = scene_.geometry;
    const auto first_index = static_cast<std::uint32_t>(g.indices.size());
    for (const std::uint32_t i : mesh.indices) g.indices.push_back(first_vertex + i);
    std::vector<DrawRange> ranges;
    for (DrawRange r : mesh.ranges) {
      r.first_index += first_index;
      if (r.material != k_none) r.material += first_material;
      ranges.push_back(r);
    }
    return ranges;
  }

  Scene& scene_;
  fs::path path_;
  Wanted wanted_;
  Context& context_;
  const Ecosystem* eco_ = nullptr;
  std::map<std::pair<std::string, std::uint64_t>, std::size_t> known_;  // by name and hash; the first type
};

}  // namespace

Result<void> take_ecosystem(Scene& scene, const fs::path& path, const Wanted& wanted, Context& context) {
  return EcosystemReader(scene, path, wanted, context).read();
}

}  // namespace copse::treeplay
