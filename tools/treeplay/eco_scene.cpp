#include "tools/treeplay/eco_scene.h"

#include "lib/formats/ecosystem_file.h"
#include "lib/formats/hash.h"
#include "lib/formats/random.h"
#include "lib/formats/tree_file.h"
#include "lib/formats/type_hash.h"
#include "lib/runtime/block_stream.h"
#include "tools/treeplay/tree_levels.h"

#include <algorithm>
#include <cmath>
#include <map>

#include <fmt/format.h>

namespace copse::treeplay {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t k_most_levels = 12;

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
  EcosystemReader(Scene& scene, const fs::path& path, bool levels, Context& context)
      : scene_(scene), path_(path), with_levels_(levels), context_(context) {}

  Result<void> read() {
    if (auto done = open(); !done) return done;
    {
      Stage stage = context_.stage("terrain");
      scene_.forest.ground = ForestGround(eco_->terrain, eco_->origin, scene_.geometry);
      stage.items(eco_->terrain.vertex_count(), "vertices");
    }
    Stage stage = context_.stage("trees");
    scene_.materials = eco_->materials;
    take_textures(eco_->textures, scene_.materials, 0, path_);
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
    context_.read(path_, true);
    eco_ = &scene_.eco.emplace(std::move(*eco));
    scene_.geometry.origin = eco_->origin;
    scene_.geometry.bounds = eco_->bounds;
    stage.items(eco_->instance_count(), "instances");
    return {};
  }

  // Textures of one file join those of all; its materials, from `first` on, follow them there.
  void take_textures(const std::vector<Texture>& textures, std::vector<Material>& materials,
                     std::size_t first, const fs::path& file) {
    const auto offset = static_cast<std::uint32_t>(scene_.images.size());
    std::vector<bool> used(textures.size());
    for (std::size_t m = first; m < materials.size(); ++m) {
      if (materials[m].texture == k_none) continue;
      if (materials[m].texture < used.size()) used[materials[m].texture] = true;
      materials[m].texture += offset;
    }
    for (std::size_t i = 0; i < textures.size(); ++i)
      scene_.images.push_back(used[i] ? read_texture(textures[i], i, file, context_) : std::nullopt);
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
    take_textures(tree->textures, scene_.materials, first_material, type.packed.empty() ? path : path_);
    std::shared_ptr<const TreeLevels> levels;
    if (with_levels_) {
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
    if (levels && levels->impostor())
      part.impostor = std::shared_ptr<const TreeImpostor>(levels, &*levels->impostor());
    scene_.forest.types.push_back(std::move(part));
    return {};
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
  bool with_levels_ = false;
  Context& context_;
  const Ecosystem* eco_ = nullptr;
  std::map<std::pair<std::string, std::uint64_t>, std::size_t> known_;  // by name and hash; the first type
};

// Triangles of trees that stand for all: of a few trees many, enough for cells of metres; of a forest of
// cells of many trees a few of many, or the cells would differ by chance.
constexpr std::size_t k_few_trees = 4000, k_many_trees = 60000;
constexpr std::size_t k_triangles_of_few = 60, k_triangles_of_many = 4;

// Trees that stand for all of a type in a block, so many each.
struct CloudTree {
  std::uint32_t type = 0;
  DrawCopy copy;
  double stands_for = 1;
};

// Of a small ecosystem every tree; of a large one some anywhere in the box of each block, so that no instance
// is read for it.
std::vector<CloudTree> cloud_trees(const Ecosystem& eco) {
  std::vector<CloudTree> trees;
  const bool small = eco.instance_count() <= k_few_trees;
  BlockStream stream(eco, 0);
  double owed = 0;
  const double share = std::min(1.0, static_cast<double>(k_many_trees) /
                                         static_cast<double>(std::max<std::size_t>(eco.instance_count(), 1)));
  for (std::uint32_t b = 0; b < eco.blocks.size(); ++b) {
    const InstanceBlock& block = eco.blocks[b];
    if (block.bounds.empty()) continue;
    if (small) {
      for (const StreamedInstance& i : stream.block(b)) trees.push_back({block.type, {i.rows, i.tint}, 1});
      continue;
    }
    const TreeType& type = eco.types[block.type];
    const float scale = (type.scale_min + type.scale_max) / 2;
    Random random = Random(b);
    for (owed += block.count * share; owed >= 1; --owed) {
      const double x = random.uniform(double{block.bounds.min.x}, double{block.bounds.max.x}),
                   z = random.uniform(double{block.bounds.min.z}, double{block.bounds.max.z});
      const auto ground = ground_height(eco.terrain, x + eco.origin.x, z + eco.origin.z);
      const float y = ground ? static_cast<float>(*ground - eco.origin.y) : block.bounds.min.y;
      const auto fx = static_cast<float>(x), fz = static_cast<float>(z);
      trees.push_back(
          {block.type, {{Float4{scale, 0, 0, fx}, {0, scale, 0, y}, {0, 0, scale, fz}}, {}}, 1 / share});
    }
  }
  return trees;
}

// Of a tree where it stands, to a decimetre, and its type's name: the same whatever else is in the file.
std::uint64_t seed_of(const Ecosystem& eco, const CloudTree& tree) {
  std::uint64_t seed = xxh3(eco.types[tree.type].name);
  for (std::size_t a = 0; a < 3; ++a) {
    const double at = eco.origin[static_cast<int>(a)] + double{tree.copy.rows[a].w};
    seed = Random::mix(seed ^ static_cast<std::uint64_t>(std::llround(10 * at)));
  }
  return seed;
}

// Some triangles of a tree, each as much larger as there are fewer of them.
void add_to_cloud(const Scene& scene, const CloudTree& tree, std::size_t most, TreeGeometry& cloud,
                  std::vector<float>& opacity) {
  const TreeGeometry& g = scene.geometry;
  const Random of_tree(seed_of(*scene.eco, tree));
  std::uint64_t number = 0;
  for (const DrawRange& range : scene.forest.types[tree.type].levels[0]) {
    Random random = of_tree.fork(number++);
    const std::size_t triangles = range.index_count / 3, taken = std::min(triangles, most);
    if (taken == 0) continue;
    const auto larger = static_cast<float>(
        std::sqrt(static_cast<double>(triangles) / static_cast<double>(taken) * tree.stands_for));
    const auto first = static_cast<std::uint32_t>(cloud.indices.size());
    for (std::size_t t = 0; t < taken; ++t) {
      const std::size_t triangle = random.below(triangles);
      std::array<Float3, 3> corner;
      Float3 centre{};
      for (std::size_t v = 0; v < 3; ++v) {
        corner[v] = moved(tree.copy, g.vertices[g.indices[range.first_index + 3 * triangle + v]].position);
        centre += corner[v] / 3.0f;
      }
      for (const Float3& p : corner) {
        cloud.indices.push_back(static_cast<std::uint32_t>(cloud.vertices.size()));
        cloud.vertices.push_back({centre + (p - centre) * larger, {0, 1, 0}, {0, 0}});
      }
    }
    cloud.ranges.push_back(
        {range.part, range.material, first, static_cast<std::uint32_t>(cloud.indices.size()) - first});
    const Material m = material_of(scene, range);
    opacity.push_back(m.alpha * (m.alpha_cutoff > 0 ? m.alpha_coverage : 1));
  }
}

}  // namespace

Result<void> take_ecosystem(Scene& scene, const fs::path& path, bool levels, Context& context) {
  return EcosystemReader(scene, path, levels, context).read();
}

SkyLight forest_sky(const Scene& scene) {
  TreeGeometry cloud;
  cloud.bounds = scene.geometry.bounds;
  std::vector<float> opacity;
  const std::size_t most =
      scene.eco->instance_count() <= k_few_trees ? k_triangles_of_few : k_triangles_of_many;
  for (const CloudTree& tree : cloud_trees(*scene.eco)) add_to_cloud(scene, tree, most, cloud, opacity);
  if (cloud.indices.empty()) return {};
  return make_sky_light(cloud, opacity, 96);
}

}  // namespace copse::treeplay
