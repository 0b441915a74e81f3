#include "tools/treeplay/scene.h"

#include "lib/formats/import/import.h"
#include "lib/formats/tree_file.h"

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

double Scene::size() const {
  const double diagonal = length(bounds().extent());
  return diagonal > 0 ? diagonal : 1;
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
  if (range.part == DrawPart::trunk) m.diffuse = {0.23f, 0.165f, 0.115f};
  if (range.part == DrawPart::leaves) m.diffuse = {0.13f, 0.235f, 0.05f};
  if (range.part == DrawPart::mesh) m.diffuse = {0.42f, 0.41f, 0.39f};
  return m;
}

namespace {

bool is_tree_file(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension == ".tree" || extension == ".stree";
}

// The ground is y = 0 where the thesis plants its trees, if that touches the lower part of the model;
// otherwise the model's lowest point.
double ground_under(const DoubleBox& box) {
  if (box.empty()) return 0;
  const double height = box.max.y - box.min.y;
  return box.min.y <= 0 && box.min.y >= -0.15 * height ? 0 : box.min.y;
}

// Brings the textures in that something drawn uses; a name is relative to the file that gives it.
void load_images(Scene& scene, const std::vector<Texture>& textures, const fs::path& file, Context& context) {
  scene.images.resize(textures.size());
  for (std::size_t i = 0; i < textures.size(); ++i) {
    const auto uses = [&](const DrawRange& range) { return material_of(scene, range).texture == i; };
    if (std::none_of(scene.geometry.ranges.begin(), scene.geometry.ranges.end(), uses)) continue;
    const Texture& texture = textures[i];
    const fs::path path = file.parent_path() / texture.uri;
    Result<Image> image = texture.bytes.empty()
                              ? read_image(path)
                              : read_image(texture.bytes, fmt::format("{}, texture {}", file.string(), i));
    if (!image) {
      const Error& e = image.error();
      context.warn(fmt::format("{}{}{}; its surfaces are drawn in their mean colour", e.file,
                               e.file.empty() ? "" : ": ", e.what));
      continue;
    }
    if (texture.bytes.empty()) context.read(path, false);
    scene.images[i] = std::move(*image);
  }
}

Result<void> take_tree(Scene& scene, const fs::path& path, Context& context) {
  auto file = TreeFile::open(path);
  if (!file) return std::unexpected(file.error());
  auto tree = file->load();
  if (!tree) return std::unexpected(tree.error());
  context.read(path, true);
  scene.is_tree = true;
  scene.geometry = make_geometry(*tree);
  scene.skeleton = make_skeleton(*tree);
  scene.materials = tree->materials;
  load_images(scene, tree->textures, path, context);
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
  load_images(scene, import->mesh.textures, path, context);
  return {};
}

}  // namespace

Result<Scene> load_scene(const fs::path& path, bool lights, Context& context) {
  Scene scene;
  scene.name = path.filename().string();
  {
    Stage stage = context.stage("load");
    auto taken = is_tree_file(path) ? take_tree(scene, path, context) : take_mesh(scene, path, context);
    if (!taken) return std::unexpected(taken.error());
    stage.items(scene.triangles(), "triangles");
  }
  scene.ground = ground_under(scene.bounds());
  if (!lights) return scene;
  Stage stage = context.stage("sky light");
  std::vector<float> opacity;
  for (const DrawRange& range : scene.geometry.ranges) {
    const Material m = material_of(scene, range);
    opacity.push_back(m.alpha * (m.alpha_cutoff > 0 ? m.alpha_coverage : 1));
  }
  scene.sky = make_sky_light(scene.geometry, opacity);
  stage.items(scene.sky.cells.size(), "cells");
  return scene;
}

}  // namespace copse::treeplay
