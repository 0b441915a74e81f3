#include "tools/treeplay/eco_scene.h"

#include "lib/formats/ecosystem_file.h"
#include "lib/formats/instance_codec.h"
#include "lib/formats/random.h"
#include "lib/formats/tree_file.h"
#include "tools/treeplay/tree_levels.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include <fmt/format.h>

namespace copse::treeplay {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t k_most_levels = 12;

// Where a type's mesh and materials are in the scene.
struct TypePart {
  std::vector<std::vector<DrawRange>> levels;  // finest first; materials are the scene's
  std::vector<float> coarser;                  // from where each but the first is drawn
};

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

// Times the terrain's own size; beyond the last one all is haze.
constexpr std::array<double, 7> k_surroundings{1.02, 1.1, 1.4, 2.5, 6, 18, 60};

class EcosystemReader {
 public:
  EcosystemReader(Scene& scene, const fs::path& path, bool levels, Context& context)
      : scene_(scene), path_(path), with_levels_(levels), context_(context) {}

  Result<void> read() {
    const auto file = EcosystemFile::open(path_);
    if (!file) return std::unexpected(file.error());
    auto eco = file->load();
    if (!eco) return std::unexpected(eco.error());
    context_.read(path_, true);
    eco_ = &scene_.eco.emplace(std::move(*eco));
    scene_.materials = eco_->materials;
    take_textures(eco_->textures, scene_.materials, 0, path_);
    scene_.geometry.origin = eco_->origin;
    scene_.geometry.bounds = eco_->bounds;
    add_terrain();
    for (const TreeType& type : eco_->types)
      if (auto done = add_type(type); !done) return done;
    add_instances();
    return {};
  }

 private:
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

  // `p` as vertices are: relative to the origin.
  Float2 ground_texcoord(const Double3& p) const {
    const double size = eco_->terrain.texture_size;
    return {static_cast<float>((p.x + eco_->origin.x) / size),
            static_cast<float>(-(p.z + eco_->origin.z) / size)};
  }

  void add_terrain() {
    const Terrain& t = eco_->terrain;
    TreeGeometry& g = scene_.geometry;
    DrawGroup group{.first_range = static_cast<std::uint32_t>(g.ranges.size()), .range_count = 1};
    const auto first = static_cast<std::uint32_t>(g.vertices.size());
    std::vector<Double3> normals(t.vertex_count());
    const auto position = [&](std::uint32_t c, std::uint32_t r) { return t.vertex(c, r) - eco_->origin; };
    const auto first_index = static_cast<std::uint32_t>(g.indices.size());
    for (std::uint32_t r = 0; r + 1 < t.rows; ++r)
      for (std::uint32_t c = 0; c + 1 < t.columns; ++c) {
        const std::uint32_t a = r * t.columns + c, b = a + 1, d = a + t.columns, e = d + 1;
        const Double3 pa = position(c, r), pb = position(c + 1, r), pd = position(c, r + 1),
                      pe = position(c + 1, r + 1);
        for (const std::uint32_t i : {a, d, e, a, e, b}) g.indices.push_back(first + i);
        const Double3 lower = cross(pd - pa, pe - pa), upper = cross(pe - pa, pb - pa);
        for (const std::uint32_t i : {a, d, e}) normals[i] += lower;
        for (const std::uint32_t i : {a, e, b}) normals[i] += upper;
      }
    for (std::uint32_t r = 0; r < t.rows; ++r)
      for (std::uint32_t c = 0; c < t.columns; ++c) {
        const Double3 p = position(c, r);
        const Double3 n = normalized(normals[std::size_t{r} * t.columns + c]);
        g.vertices.push_back({to_float(p), to_float(n.y < 0 ? -n : n), ground_texcoord(p)});
      }
    if (t.columns > 0) add_surroundings(first);
    g.ranges.push_back({DrawPart::ground, t.material, first_index,
                        static_cast<std::uint32_t>(g.indices.size()) - first_index});
    if (t.columns == 0) g.ranges.pop_back(), group.range_count = 0;
    group.instance_count = 1;
    scene_.copies.push_back(DrawCopy{});
    scene_.groups.push_back(group);
  }

  // The vertices along the border, once round.
  std::vector<std::uint32_t> border() const {
    const Terrain& t = eco_->terrain;
    std::vector<std::uint32_t> ring;
    for (std::uint32_t c = 0; c + 1 < t.columns; ++c) ring.push_back(c);
    for (std::uint32_t r = 0; r + 1 < t.rows; ++r) ring.push_back(r * t.columns + t.columns - 1);
    for (std::uint32_t c = t.columns - 1; c > 0; --c) ring.push_back((t.rows - 1) * t.columns + c);
    for (std::uint32_t r = t.rows - 1; r > 0; --r) ring.push_back(r * t.columns);
    return ring;
  }

  // A terrain that ends in mid-air looks like a slice of cake: it goes on, ever more level, into the haze.
  void add_surroundings(std::uint32_t first) {
    TreeGeometry& g = scene_.geometry;
    const std::vector<std::uint32_t> ring = border();
    const auto n = static_cast<std::uint32_t>(ring.size());
    Double3 middle;
    for (const std::uint32_t i : ring) middle += to_double(g.vertices[first + i].position) / n;
    const auto begin = static_cast<std::uint32_t>(g.vertices.size());
    for (const double factor : k_surroundings)
      for (const std::uint32_t i : ring) {
        const Double3 p = to_double(g.vertices[first + i].position), out = middle + (p - middle) * factor;
        // Half as high above the middle at twice the distance, and so on.
        const Double3 at{out.x, middle.y + (p.y - middle.y) / (factor * factor), out.z};
        g.vertices.push_back({to_float(at), {0, 1, 0}, ground_texcoord(at)});
      }
    for (std::uint32_t k = 0; k < k_surroundings.size(); ++k)
      for (std::uint32_t i = 0; i < n; ++i) {
        const std::uint32_t j = (i + 1) % n, outer = begin + k * n;
        const auto inner = [&](std::uint32_t v) { return k == 0 ? first + ring[v] : outer - n + v; };
        for (const std::uint32_t v : {inner(i), inner(j), outer + j, inner(i), outer + j, outer + i})
          g.indices.push_back(v);
      }
  }

  Result<void> add_type(const TreeType& type) {
    const fs::path path = path_.parent_path() / type.uri;
    const std::string name =
        type.packed.empty() ? path.string() : fmt::format("{}, tree '{}'", path_.string(), type.name);
    const auto file =
        type.packed.empty() ? TreeFile::open(path) : TreeFile::from_bytes(type.packed.to_vector(), name);
    if (!file) return std::unexpected(file.error());
    auto tree = file->load();
    if (!tree) return std::unexpected(tree.error());
    if (type.packed.empty()) context_.read(path, true);
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
    TypePart part;
    part.levels.push_back(add_triangles(mesh, first_vertex, first_material));
    for (const LodLevel& level : coarser) {
      levels->take(level, mesh);
      part.levels.push_back(add_triangles(mesh, first_vertex, first_material));
      part.coarser.push_back(level.distance);
    }
    parts_.push_back(std::move(part));
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

  static DrawCopy copy_of(const Instance& i, const Double3& origin) {
    const Double3 x = rotate(i.rotation, {i.scale, 0, 0}), y = rotate(i.rotation, {0, i.scale, 0}),
                  z = rotate(i.rotation, {0, 0, i.scale}), p = i.position - origin;
    DrawCopy c;
    for (int r = 0; r < 3; ++r)
      c.rows[static_cast<std::size_t>(r)] = {static_cast<float>(x[r]), static_cast<float>(y[r]),
                                             static_cast<float>(z[r]), static_cast<float>(p[r])};
    c.tint = {i.tint[0], i.tint[1], i.tint[2], 255};
    return c;
  }

  // Instances of one type and the same materials are a group; inside it they follow the blocks.
  void add_instances() {
    using Key = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>;
    std::map<Key, std::vector<std::pair<std::uint32_t, DrawCopy>>> groups;  // block, copy
    for (std::uint32_t b = 0; b < eco_->blocks.size(); ++b) {
      const InstanceBlock& block = eco_->blocks[b];
      for (std::size_t k = block.first; k < block.first + block.count; ++k) {
        const Instance i = instance_of(*eco_, block, k);
        groups[{block.type, i.trunk_material, i.leaf_material}].emplace_back(b, copy_of(i, eco_->origin));
      }
    }
    std::vector<std::vector<CopyRun>> runs(eco_->blocks.size());
    for (const auto& [key, members] : groups) {
      const auto& [type, trunk, leaf] = key;
      TreeGeometry& g = scene_.geometry;
      const auto add_group = [&](std::size_t level) {
        DrawGroup group{.first_range = static_cast<std::uint32_t>(g.ranges.size()),
                        .first_copy = static_cast<std::uint32_t>(scene_.copies.size())};
        for (DrawRange r : parts_[type].levels[level]) {
          if (r.part == DrawPart::trunk && trunk != k_none) r.material = trunk;
          if (r.part == DrawPart::leaves && leaf != k_none) r.material = leaf;
          g.ranges.push_back(r);
          ++group.range_count;
          group.triangles += r.index_count / 3;
        }
        scene_.groups.push_back(group);
      };
      const auto number = static_cast<std::uint32_t>(scene_.groups.size());
      for (std::size_t level = 0; level < parts_[type].levels.size(); ++level) add_group(level);
      scene_.groups[number].instance_count = static_cast<std::uint32_t>(members.size());
      scene_.groups[number].coarser = parts_[type].coarser;
      for (const auto& [block, copy] : members) {
        auto& of_block = runs[block];
        const auto at = static_cast<std::uint32_t>(scene_.copies.size());
        if (of_block.empty() || of_block.back().group != number) of_block.push_back({number, at, 0});
        ++of_block.back().count;
        scene_.copies.push_back(copy);
      }
    }
    for (const auto& of_block : runs) {
      scene_.first_run.push_back(static_cast<std::uint32_t>(scene_.runs.size()));
      scene_.runs.insert(scene_.runs.end(), of_block.begin(), of_block.end());
    }
    scene_.first_run.push_back(static_cast<std::uint32_t>(scene_.runs.size()));
  }

  Scene& scene_;
  fs::path path_;
  bool with_levels_ = false;
  Context& context_;
  const Ecosystem* eco_ = nullptr;
  std::vector<TypePart> parts_;
};

constexpr std::size_t k_cloud_copies = 4000, k_cloud_triangles = 60;  // enough for cells of metres

}  // namespace

Result<void> take_ecosystem(Scene& scene, const fs::path& path, bool levels, Context& context) {
  return EcosystemReader(scene, path, levels, context).read();
}

SkyLight forest_sky(const Scene& scene) {
  const TreeGeometry& g = scene.geometry;
  TreeGeometry cloud;
  cloud.bounds = g.bounds;
  std::vector<float> opacity;
  std::size_t trees = 0;
  for (std::size_t n = 1; n < scene.groups.size(); ++n) trees += scene.groups[n].instance_count;
  const std::size_t stride = trees / k_cloud_copies + 1;
  for (std::size_t n = 1; n < scene.groups.size(); ++n) {
    const DrawGroup& group = scene.groups[n];
    for (std::uint32_t k = 0; k < group.range_count; ++k) {
      const DrawRange& range = g.ranges[group.first_range + k];
      const std::size_t triangles = range.index_count / 3, taken = std::min(triangles, k_cloud_triangles);
      if (taken == 0) continue;
      // Fewer triangles and fewer trees, each as much larger.
      const auto larger = static_cast<float>(std::sqrt(
          static_cast<double>(triangles) / static_cast<double>(taken) * static_cast<double>(stride)));
      DrawRange out{range.part, range.material, static_cast<std::uint32_t>(cloud.indices.size()), 0};
      for (std::uint32_t c = 0; c < group.instance_count; c += static_cast<std::uint32_t>(stride)) {
        const DrawCopy& copy = scene.copies[group.first_copy + c];
        Random random = Random(n).fork(c).fork(k);
        for (std::size_t t = 0; t < taken; ++t) {
          const std::size_t triangle = random.below(triangles);
          std::array<Float3, 3> corner;
          Float3 centre{};
          for (std::size_t v = 0; v < 3; ++v) {
            corner[v] = moved(copy, g.vertices[g.indices[range.first_index + 3 * triangle + v]].position);
            centre += corner[v] / 3.0f;
          }
          for (const Float3& p : corner) {
            cloud.indices.push_back(static_cast<std::uint32_t>(cloud.vertices.size()));
            cloud.vertices.push_back({centre + (p - centre) * larger, {0, 1, 0}, {0, 0}});
          }
        }
      }
      out.index_count = static_cast<std::uint32_t>(cloud.indices.size()) - out.first_index;
      cloud.ranges.push_back(out);
      const Material m = material_of(scene, range);
      opacity.push_back(m.alpha * (m.alpha_cutoff > 0 ? m.alpha_coverage : 1));
    }
  }
  if (cloud.indices.empty()) return {};
  return make_sky_light(cloud, opacity, 96);
}

}  // namespace copse::treeplay
