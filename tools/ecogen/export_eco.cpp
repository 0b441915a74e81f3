#include "tools/ecogen/export_eco.h"

#include "lib/formats/ecosystem/instance_codec.h"
#include "lib/formats/ecosystem/terrain_normal.h"
#include "lib/formats/export/export.h"
#include "lib/formats/export/instancing.h"
#include "lib/formats/import/image.h"
#include "lib/formats/tree_file/tree_file.h"
#include "tools/ecogen/instance_table.h"
#include "tools/ecogen/map_legend.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <tuple>

#include <fmt/format.h>

namespace copse::ecogen {
namespace {

namespace fs = std::filesystem;

using Key = std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>;  // type, trunk and leaf material

// Instances that look alike: of one type and the same materials.
std::map<Key, std::vector<Instance>> grouped(const Ecosystem& eco) {
  std::map<Key, std::vector<Instance>> groups;
  for (const InstanceBlock& b : eco.blocks)
    for (std::size_t i = b.first; i < b.first + b.count; ++i) {
      const Instance instance = instance_of(eco, b, i);
      groups[{instance.type, instance.trunk_material, instance.leaf_material}].push_back(instance);
    }
  return groups;
}

Result<Mesh> mesh_of(const TreeType& type, const fs::path& trees) {
  const fs::path path = trees / type.uri;
  const auto file =
      type.packed.empty() ? TreeFile::open(path) : TreeFile::from_bytes(type.packed.to_vector(), type.name);
  if (!file) return std::unexpected(file.error());
  const auto tree = file->load();
  if (!tree) return std::unexpected(tree.error());
  Mesh mesh = to_mesh(*tree);
  // Names of images are relative to the tree's file; from here on to `trees`.
  const fs::path folder = fs::path(type.uri).parent_path();
  for (Texture& t : mesh.textures)
    if (!t.uri.empty()) t.uri = (folder / t.uri).lexically_normal().generic_string();
  return mesh;
}

// Names of images, relative to `from` before, are relative to `to` after.
void relocate(std::vector<Texture>& textures, const fs::path& from, const fs::path& to) {
  std::error_code error;
  for (Texture& t : textures) {
    if (t.uri.empty()) continue;
    const fs::path image = fs::absolute(from / t.uri, error).lexically_normal();
    const fs::path near = image.lexically_relative(fs::absolute(to / ".", error).lexically_normal());
    t.uri = (error || near.empty() ? image : near).generic_string();
  }
}

// Puts meshes one after the other into one.
class Merger {
 public:
  explicit Merger(const Ecosystem& eco) {
    mesh_.materials = eco.materials;
    mesh_.textures = eco.textures;
  }

  // `from`'s materials and textures are added once a type: `at` is where they begin.
  std::uint32_t add_materials(const Mesh& from) {
    const auto first = static_cast<std::uint32_t>(mesh_.materials.size());
    const auto first_texture = static_cast<std::uint32_t>(mesh_.textures.size());
    for (Material m : from.materials) {
      if (m.texture != k_none) m.texture += first_texture;
      mesh_.materials.push_back(std::move(m));
    }
    mesh_.textures.insert(mesh_.textures.end(), from.textures.begin(), from.textures.end());
    return first;
  }

  template <class Position, class Normal, class PartMaterial>
  void add(const Mesh& from, const std::string& object, Position&& position, Normal&& normal,
           PartMaterial&& material) {
    const auto vertex = static_cast<std::uint32_t>(mesh_.positions.size()),
               n = static_cast<std::uint32_t>(mesh_.normals.size()),
               t = static_cast<std::uint32_t>(mesh_.texcoords.size()),
               part = static_cast<std::uint32_t>(mesh_.parts.size());
    for (const Double3& p : from.positions) mesh_.positions.push_back(position(p));
    for (const Float3& v : from.normals) mesh_.normals.push_back(normal(v));
    mesh_.texcoords.insert(mesh_.texcoords.end(), from.texcoords.begin(), from.texcoords.end());
    for (const Part& p : from.parts) mesh_.parts.push_back({object, object, material(p)});
    const auto corners = [](const Triangle& c, std::uint32_t first) {
      Triangle out = c;
      for (std::uint32_t& i : out)
        if (i != k_none) i += first;
      return out;
    };
    constexpr Triangle k_no{k_none, k_none, k_none};
    for (std::size_t i = 0; i < from.triangles.size(); ++i) {
      mesh_.triangles.push_back(corners(from.triangles[i], vertex));
      mesh_.normal_triangles.push_back(from.normal_triangles.empty() ? k_no
                                                                     : corners(from.normal_triangles[i], n));
      mesh_.texcoord_triangles.push_back(
          from.texcoord_triangles.empty() ? k_no : corners(from.texcoord_triangles[i], t));
      mesh_.part_of.push_back(part + from.part_of[i]);
    }
  }

  std::size_t triangles() const { return mesh_.triangles.size(); }
  // For a file in `folder`; the images were relative to `trees`.
  Mesh take(const fs::path& trees, const fs::path& folder) {
    relocate(mesh_.textures, trees, folder);
    return std::move(mesh_);
  }

 private:
  Mesh mesh_;
};

// Relative to the ecosystem's origin.
Mesh terrain_mesh(const Ecosystem& eco) {
  const Terrain& t = eco.terrain;
  Mesh mesh;
  for (std::uint32_t r = 0; r < t.rows; ++r)
    for (std::uint32_t c = 0; c < t.columns; ++c) {
      const Double3 p = t.vertex(c, r);
      mesh.positions.push_back(p - eco.origin);
      mesh.normals.push_back(to_float(terrain_normal(t, c, r)));
      mesh.texcoords.push_back({static_cast<float>(p.x / double{t.texture_size}),
                                static_cast<float>(-p.z / double{t.texture_size})});
    }
  for (std::uint32_t r = 0; r + 1 < t.rows; ++r)
    for (std::uint32_t c = 0; c + 1 < t.columns; ++c) {
      const std::uint32_t a = r * t.columns + c, below = a + t.columns;
      mesh.triangles.push_back({a, below, below + 1});
      mesh.triangles.push_back({a, below + 1, a + 1});
    }
  mesh.texcoord_triangles = mesh.normal_triangles = mesh.triangles;
  mesh.part_of.assign(mesh.triangles.size(), 0);
  mesh.parts = {{.object = "terrain", .group = "terrain", .material = t.material}};
  return mesh;
}

// A part of the tree under its instance's own materials.
auto material_under(std::uint32_t first, std::uint32_t trunk, std::uint32_t leaf) {
  return [=](const Part& p) {
    const std::uint32_t own = p.object == "leaves" ? leaf : trunk;
    if (own != k_none) return own;
    return p.material == k_none ? k_none : p.material + first;
  };
}

std::string object_name(const Ecosystem& eco, const Key& key) {
  const auto& [type, trunk, leaf] = key;
  std::string name = eco.types[type].name;
  for (const std::uint32_t m : {trunk, leaf})
    if (m != k_none) name += "/" + eco.materials[m].name;
  return name;
}

struct Everything {
  std::vector<Mesh> meshes;          // a type
  std::vector<std::uint32_t> first;  // its materials
};

Result<Everything> read_meshes(const Ecosystem& eco, const fs::path& trees, Merger& merger) {
  Everything all;
  for (const TreeType& type : eco.types) {
    auto mesh = mesh_of(type, trees);
    if (!mesh) return std::unexpected(mesh.error());
    all.first.push_back(merger.add_materials(*mesh));
    all.meshes.push_back(std::move(*mesh));
  }
  return all;
}

bool is_tinted(const Instance& i) {
  return i.tint != std::array<std::uint8_t, 3>{255, 255, 255};
}

// Of a byte of sRGB.
float linear(std::uint8_t value) {
  const double v = value / 255.0;
  return static_cast<float>(v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4));
}

const auto k_same = [](const auto& v) { return v; };

void add_terrain(const Ecosystem& eco, Merger& merger) {
  if (eco.terrain.columns > 0)
    merger.add(terrain_mesh(eco), "terrain", k_same, k_same, [](const Part& p) { return p.material; });
}

Result<std::vector<ExportedFile>> glb_of(const Ecosystem& eco, const fs::path& trees, const fs::path& file,
                                         Instancing form) {
  const std::string name = file.filename().string();
  Merger merger(eco);
  const auto all = read_meshes(eco, trees, merger);
  if (!all) return std::unexpected(all.error());
  add_terrain(eco, merger);
  std::vector<NodeInstances> nodes;
  for (const auto& [key, instances] : grouped(eco)) {
    const auto& [type, trunk, leaf] = key;
    if (all->meshes[type].triangles.empty()) continue;
    NodeInstances n{object_name(eco, key), {}, {}, {}};
    const bool tinted = std::any_of(instances.begin(), instances.end(), is_tinted);
    for (const Instance& i : instances) {
      n.translations.push_back(to_float(i.position - eco.origin));
      auto& r = n.rotations.emplace_back();
      for (std::size_t c = 0; c < 4; ++c) r[c] = static_cast<float>(i.rotation[c]);
      n.scales.push_back(static_cast<float>(i.scale));
      if (tinted) n.colours.push_back({linear(i.tint[0]), linear(i.tint[1]), linear(i.tint[2])});
    }
    merger.add(all->meshes[type], n.node, k_same, k_same, material_under(all->first[type], trunk, leaf));
    nodes.push_back(std::move(n));
  }
  auto files = export_mesh(merger.take(trees, file.parent_path()), ExportFormat::glb, name);
  if (!files) return files;
  auto bytes = with_instances(files->front().bytes, nodes, eco.origin, form);
  if (!bytes) return refuse(name, bytes.error().what, bytes.error().remedy);
  files->front().bytes = std::move(*bytes);
  return files;
}

Result<std::vector<ExportedFile>> obj_of(const Ecosystem& eco, const fs::path& trees, const fs::path& file) {
  const std::string name = file.filename().string();
  Merger merger(eco);
  const auto all = read_meshes(eco, trees, merger);
  if (!all) return std::unexpected(all.error());
  const Terrain& ground = eco.terrain;
  std::uint64_t triangles =
      ground.columns > 0 ? 2 * (std::uint64_t{ground.columns} - 1) * (ground.rows - 1) : 0;
  for (std::size_t t = 0; t < eco.types.size(); ++t)
    triangles += all->meshes[t].triangles.size() * std::uint64_t{eco.types[t].instances};
  if (triangles > k_most_obj_triangles)
    return refuse(
        name,
        fmt::format("{} triangles are too many for an OBJ, the limit is {}", triangles, k_most_obj_triangles),
        "export a .glb, which has instances");
  if (eco.terrain.columns > 0)
    merger.add(
        terrain_mesh(eco), "terrain", [&](const Double3& p) { return p + eco.origin; }, k_same,
        [](const Part& p) { return p.material; });
  std::size_t number = 0;
  for (const auto& [key, instances] : grouped(eco)) {
    const auto& [type, trunk, leaf] = key;
    for (const Instance& i : instances)
      merger.add(
          all->meshes[type], fmt::format("{} {}", object_name(eco, key), ++number),
          [&](const Double3& p) { return i.position + rotate(i.rotation, p * i.scale); },
          [&](const Float3& n) { return to_float(rotate(i.rotation, to_double(n))); },
          material_under(all->first[type], trunk, leaf));
  }
  return export_mesh(merger.take(trees, file.parent_path()), ExportFormat::obj, name);
}

void warn_of_tints(const Ecosystem& eco, const fs::path& file, Context& context) {
  for (const InstanceBlock& b : eco.blocks)
    for (std::size_t i = b.first; i < b.first + b.count; ++i)
      if (is_tinted(instance_of(eco, b, i)))
        return context.warn(
            fmt::format("{}: tints have no place in it and were left out; a .glb has them by "
                        "EXT_mesh_gpu_instancing, without --glb-nodes",
                        file.string()));
}

Result<void> write_all(const std::vector<ExportedFile>& files, const fs::path& folder, Context& context) {
  for (const ExportedFile& f : files)
    if (auto done = context.write(folder / f.name, f.bytes); !done) return done;
  return {};
}

}  // namespace

Result<void> check_export(const fs::path& file) {
  const std::string e = file.extension().string();
  if (e == ".glb" || e == ".obj" || e == ".png" || e == ".csv") return {};
  return fail(Fault::usage, file.string(), "is of no format that is exported",
              "use .glb, .obj, .png or .csv");
}

Result<void> export_ecosystem(const Ecosystem& eco, const fs::path& trees, const fs::path& file,
                              Instancing form, ForestMap& map, Context& context) {
  Stage stage = context.stage(fmt::format("export {}", file.extension().string()));
  stage.items(eco.instance_count(), "instances");
  const std::string e = file.extension().string();
  if (e == ".csv") return context.write(file, instances_csv(eco));
  if (e == ".png") {
    const auto png = encode_png(map_with_legend(map));
    if (!png) return std::unexpected(png.error());
    return context.write(file, {reinterpret_cast<const char*>(png->data()), png->size()});
  }
  if (e == ".obj" || form == Instancing::nodes) warn_of_tints(eco, file, context);
  const auto files = e == ".glb" ? glb_of(eco, trees, file, form) : obj_of(eco, trees, file);
  if (!files) return std::unexpected(files.error());
  return write_all(*files, file.parent_path(), context);
}

}  // namespace copse::ecogen
