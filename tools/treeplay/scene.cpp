#include "tools/treeplay/scene.h"

#include "lib/formats/default_look.h"
#include "lib/formats/import/import.h"
#include "lib/formats/tree_file/tree_file.h"
#include "tools/treeplay/eco_scene.h"
#include "tools/treeplay/forest_sky.h"

#include <algorithm>
#include <cctype>

#include <fmt/format.h>

namespace copse::treeplay {

namespace fs = std::filesystem;

DoubleBox Scene::bounds() const {
  const FloatBox& b = geometry.bounds;
  if (b.empty()) return {};
  return {geometry.origin + to_double(b.min), geometry.origin + to_double(b.max)};
}

std::uint64_t Scene::triangles() const {
  if (!eco) return geometry.indices.size() / 3;
  std::uint64_t sum = forest.ground.triangles();
  for (std::size_t t = 0; t < forest.types.size(); ++t)
    for (const DrawRange& range : forest.types[t].levels[0])
      sum += std::uint64_t{range.index_count} / 3 * eco->types[t].instances;
  return sum;
}

std::vector<Float3> Scene::outline() const {
  std::vector<Float3> points;
  if (levels) return full_detail;
  if (!eco) {
    for (const DrawVertex& v : geometry.vertices) points.push_back(v.position);
    return points;
  }
  const FloatBox& b = geometry.bounds;
  for (int c = 0; c < 8 && !b.empty(); ++c)
    points.push_back({c & 1 ? b.max.x : b.min.x, c & 2 ? b.max.y : b.min.y, c & 4 ? b.max.z : b.min.z});
  return points;
}

double Scene::size() const {
  const double diagonal = length(bounds().extent());
  return diagonal > 0 ? diagonal : 1;
}

double Scene::distance_from(const Double3& eye) const {
  const DoubleBox box = bounds();
  return distance(eye, box.empty() ? geometry.origin : box.centre());
}

Double3 Scene::foot() const {
  const DoubleBox box = bounds();
  if (box.empty()) return geometry.origin;
  const Double3 centre = box.centre();
  return {centre.x, ground, centre.z};
}

Material material_of(const Scene& scene, const DrawRange& range) {
  if (range.material < scene.materials.size()) return scene.materials[range.material];
  Material m;
  m.double_sided = true;
  if (range.part == DrawPart::trunk) m.diffuse = k_wood_colour;
  if (range.part == DrawPart::leaves) m.diffuse = k_leaf_colour;
  if (range.part == DrawPart::ground) m.diffuse = {0.098f, 0.122f, 0.044f};
  if (range.part == DrawPart::mesh) m.diffuse = {0.42f, 0.41f, 0.39f};
  return m;
}

namespace {

std::string extension_of(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

bool is_tree_file(const fs::path& path) {
  const std::string extension = extension_of(path);
  return extension == ".tree" || extension == ".stree";
}

// The ground is y = 0 where the thesis plants its trees, if that touches the lower part of the model;
// otherwise the model's lowest point.
double ground_under(const DoubleBox& box) {
  if (box.empty()) return 0;
  const double height = box.max.y - box.min.y;
  return box.min.y <= 0 && box.min.y >= -0.15 * height ? 0 : box.min.y;
}

// Of a scene that is one tree or mesh.
void take_textures(Scene& scene, std::vector<Texture>&& textures, const fs::path& file, Context& context) {
  std::vector<bool> used(textures.size());
  for (const DrawRange& range : scene.geometry.ranges) {
    const std::uint32_t t = material_of(scene, range).texture;
    if (t < used.size()) used[t] = true;
  }
  add_textures(scene, std::move(textures), used, file, context);
}

// The mean colour of what a material covers.
Float3 flat_colour(const Scene& scene, std::uint32_t material, DrawPart part) {
  const Material m = material_of(scene, {.part = part, .material = material});
  return {m.diffuse.x * m.mean_colour.x, m.diffuse.y * m.mean_colour.y, m.diffuse.z * m.mean_colour.z};
}

Result<void> take_lines_points(Scene& scene, const Tree& tree, const fs::path& path) {
  const bool lines = tree.trunk.diameters.size() == tree.trunk.lines.size(),
             points = tree.leaves.centres.size() == tree.leaf_count() &&
                      tree.leaves.order.size() == tree.leaf_count();
  if (!lines || !points)
    return refuse(path.string(), "lacks what lines and points are drawn from",
                  "prepare the tree without --omit of lines, points or groups");
  scene.lines_points.emplace(tree, scene.geometry.ranges, [&](std::uint32_t material, DrawPart part) {
    return flat_colour(scene, material, part);
  });
  return {};
}

Result<void> take_foliage(Scene& scene, const TreeFile& file, const Tree& tree) {
  auto cells = read_foliage_cells(file);
  if (!cells) return std::unexpected(cells.error());
  const std::string& name = file.container().name();
  if (cells->cells.empty())
    return refuse(name, "holds no foliage cells", "bake them with lodbake --foliage prune");
  if (cells->parameters.leaves != hash_leaves(tree))
    return refuse(name, "its foliage cells are those of other leaves", "bake them again with lodbake");
  if (tree.leaves.centres.size() != tree.leaf_count())
    return refuse(name, "lacks the leaf centres round which leaves grow",
                  "prepare the tree with them (LCEN)");
  scene.foliage.emplace(tree, std::move(*cells), scene.geometry);
  return {};
}

Result<void> take_tree(Scene& scene, const fs::path& path, const Wanted& wanted, Context& context) {
  auto file = TreeFile::open(path);
  if (!file) return std::unexpected(file.error());
  auto tree = file->load();
  if (!tree) return std::unexpected(tree.error());
  context.read(path, true);
  scene.is_tree = true;
  scene.geometry = make_geometry(*tree);
  if (wanted.levels) {
    auto loaded = TreeLevels::load(*file, *tree);
    if (!loaded) return std::unexpected(loaded.error());
    scene.levels = std::move(*loaded);
  }
  if (scene.levels) {
    // The camera looks at full detail, whatever the level.
    const FloatBox bounds = scene.geometry.bounds;
    for (const DrawVertex& v : scene.geometry.vertices) scene.full_detail.push_back(v.position);
    scene.geometry = scene.levels->geometry();
    scene.geometry.bounds = bounds;
  }
  scene.skeleton = make_skeleton(*tree);
  scene.materials = tree->materials;
  if (wanted.foliage) {
    if (auto taken = take_foliage(scene, *file, *tree); !taken) return taken;
  }
  if (wanted.lines_points) {
    if (auto taken = take_lines_points(scene, *tree, path); !taken) return taken;
  }
  take_textures(scene, std::move(tree->textures), path, context);
  return {};
}

Result<void> take_mesh(Scene& scene, const fs::path& path, Context& context) {
  auto import = import_mesh(path);
  if (!import) return std::unexpected(import.error());
  for (const std::string& warning : import->warnings) context.warn(warning);
  for (const fs::path& file : import->files) context.read(file, file == path);
  context.read(path, true);
  scene.geometry = make_geometry(import->mesh);
  scene.materials = import->mesh.materials;
  take_textures(scene, std::move(import->mesh.textures), path, context);
  return {};
}

Result<void> take(Scene& scene, const fs::path& path, const Wanted& wanted, Context& context) {
  if (is_ecosystem(path)) return take_ecosystem(scene, path, wanted, context);
  Stage stage = context.stage("load");
  const auto taken =
      is_tree_file(path) ? take_tree(scene, path, wanted, context) : take_mesh(scene, path, context);
  stage.items(scene.triangles(), "triangles");
  return taken;
}

}  // namespace

bool is_ecosystem(const fs::path& path) {
  return extension_of(path) == ".eco";
}

void add_textures(Scene& scene, std::vector<Texture>&& textures, const std::vector<bool>& used,
                  const fs::path& file, Context& context) {
  for (std::size_t i = 0; i < textures.size(); ++i) {
    const bool beside = textures[i].bytes.empty();
    const fs::path path = beside ? file.parent_path() / textures[i].uri : file;
    std::error_code ignored;
    if (beside && used[i] && fs::is_regular_file(path, ignored)) context.read(path, false);
    scene.textures.push_back({std::move(textures[i]), path, i});
  }
}

Result<Scene> load_scene(const fs::path& path, bool lights, const Wanted& wanted, Context& context) {
  Scene scene;
  scene.name = path.filename().string();
  scene.warn = [&context](const std::string& what) { context.warn(what); };
  if (auto taken = take(scene, path, wanted, context); !taken) return std::unexpected(taken.error());
  scene.ground = ground_under(scene.bounds());
  if (!lights) return scene;
  Stage stage = context.stage("sky light");
  if (scene.eco) {
    scene.sky = forest_sky(scene);
    stage.items(scene.sky.cells.size(), "cells");
    return scene;
  }
  std::vector<float> opacity;
  for (const DrawRange& range : scene.geometry.ranges) {
    const Material m = material_of(scene, range);
    opacity.push_back(m.alpha * (m.alpha_cutoff > 0 ? m.alpha_coverage : 1));
  }
  scene.sky = make_sky_light(scene.geometry, opacity);
  if (scene.lines_points) scene.lines_points->take_light(scene.sky);
  stage.items(scene.sky.cells.size(), "cells");
  return scene;
}

}  // namespace copse::treeplay
