// OBJ and MTL. Faces keep the order of the mesh; positions are written in double and round-trip.
#include "lib/formats/export/export_detail.h"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>

namespace copse {
namespace {

template <class... Args>
void add(std::string& out, fmt::format_string<Args...> format, Args&&... args) {
  fmt::format_to(std::back_inserter(out), format, std::forward<Args>(args)...);
}

void add_index(std::string& out, std::uint32_t index) {
  const fmt::format_int digits(std::uint64_t{index} + 1);
  out.append(digits.data(), digits.size());
}

void add_corner(std::string& out, std::uint32_t position, std::uint32_t texcoord, std::uint32_t normal) {
  out += ' ';
  add_index(out, position);
  if (texcoord != k_none || normal != k_none) out += '/';
  if (texcoord != k_none) add_index(out, texcoord);
  if (normal == k_none) return;
  out += '/';
  add_index(out, normal);
}

// About how many bytes the text takes, so that it is rarely moved while it grows.
std::size_t expected_size(const Mesh& mesh) {
  const std::size_t arrays = 1 + !mesh.texcoord_triangles.empty() + !mesh.normal_triangles.empty();
  const std::size_t digits = fmt::format_int(mesh.positions.size()).size();
  return mesh.positions.size() * 40 + mesh.normals.size() * 34 + mesh.texcoords.size() * 24 +
         mesh.triangles.size() * (2 + 3 * arrays * (digits + 1)) + 1024;
}

// Material names: those of the mesh and, when a part has none while others do, one more for it. There is no
// statement that ends the use of a material.
std::vector<std::string> material_names(const Mesh& mesh) {
  std::vector<Material> materials = mesh.materials;
  const bool some_without = std::any_of(mesh.parts.begin(), mesh.parts.end(),
                                        [](const Part& part) { return part.material == k_none; });
  if (!materials.empty() && some_without) materials.push_back({.name = "no_material"});
  return line_names(materials);
}

// Statements that say to which part the following faces belong: only those that change.
void add_part(std::string& out, const Part& part, const Part* previous,
              const std::vector<std::string>& materials) {
  const bool first = previous == nullptr;
  if ((first && !part.object.empty()) || (!first && part.object != previous->object)) {
    add(out, "o {}\n", line_name(part.object, "object"));
  }
  if ((first && !part.group.empty()) || (!first && part.group != previous->group)) {
    add(out, "g {}\n", line_name(part.group, "default"));
  }
  if (first || part.material != previous->material) {
    const std::size_t name = std::min<std::size_t>(part.material, materials.size() - 1);
    if (!materials.empty()) add(out, "usemtl {}\n", materials[name]);
  }
}

void add_faces(std::string& out, const Mesh& mesh, const std::vector<std::string>& materials) {
  const Part* current = nullptr;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Part* part = mesh.part_of.empty() ? nullptr : &mesh.parts[mesh.part_of[t]];
    if (part != current && part != nullptr) add_part(out, *part, current, materials);
    current = part;
    out += 'f';
    for (std::size_t c = 0; c < 3; ++c) {
      add_corner(out, mesh.triangles[t][c],
                 mesh.texcoord_triangles.empty() ? k_none : mesh.texcoord_triangles[t][c],
                 mesh.normal_triangles.empty() ? k_none : mesh.normal_triangles[t][c]);
    }
    out += '\n';
  }
}

std::string obj_text(const Mesh& mesh, const std::string& library,
                     const std::vector<std::string>& materials) {
  std::string out;
  out.reserve(expected_size(mesh));
  add(out, "# copse {}\n", COPSE_VERSION);
  if (!library.empty()) add(out, "mtllib {}\n", library);
  for (const Double3& p : mesh.positions) add(out, "v {} {} {}\n", p.x, p.y, p.z);
  for (const Float2& t : mesh.texcoords) add(out, "vt {} {}\n", t.x, t.y);
  for (const Float3& n : mesh.normals) add(out, "vn {} {} {}\n", n.x, n.y, n.z);
  add_faces(out, mesh, materials);
  return out;
}

std::string mtl_text(const Mesh& mesh, const std::vector<std::string>& names,
                     const std::vector<std::string>& textures) {
  std::string out;
  add(out, "# copse {}\n", COPSE_VERSION);
  for (std::size_t i = 0; i < names.size(); ++i) {
    const Material& m = i < mesh.materials.size() ? mesh.materials[i] : Material{};
    add(out, "\nnewmtl {}\n", names[i]);
    add(out, "Ka {} {} {}\n", m.ambient.x, m.ambient.y, m.ambient.z);
    add(out, "Kd {} {} {}\n", m.diffuse.x, m.diffuse.y, m.diffuse.z);
    add(out, "Ks {} {} {}\n", m.specular.x, m.specular.y, m.specular.z);
    if (m.emission != Float3{}) add(out, "Ke {} {} {}\n", m.emission.x, m.emission.y, m.emission.z);
    add(out, "Ns {}\nd {}\nillum 2\n", m.shininess, m.alpha);
    if (m.texture == k_none || !has_image(mesh.textures[m.texture])) continue;
    add(out, "map_Kd {}\n", textures[m.texture]);
    // An opacity map is how an MTL says that a material is drawn with an alpha test.
    if (m.alpha_cutoff > 0) add(out, "map_d {}\n", textures[m.texture]);
  }
  return out;
}

}  // namespace

Result<std::vector<ExportedFile>> export_obj(const Mesh& mesh, const std::string& name) {
  std::vector<ExportedFile> files(1);
  std::vector<std::string> textures;
  std::vector<ExportedFile> images;
  for (std::size_t t = 0; t < mesh.textures.size(); ++t) {
    const Texture& texture = mesh.textures[t];
    if (texture.bytes.empty()) {
      textures.push_back(line_name(texture.uri, "missing"));
      continue;
    }
    textures.push_back(texture_file_name(name, t, texture));
    images.push_back({textures.back(), std::string(texture.bytes.begin(), texture.bytes.end())});
  }
  const std::vector<std::string> materials = material_names(mesh);
  const std::string library = mesh.materials.empty() ? "" : stem_of(name) + ".mtl";
  files[0] = {name, obj_text(mesh, library, materials)};
  if (!library.empty()) files.push_back({library, mtl_text(mesh, materials, textures)});
  std::move(images.begin(), images.end(), std::back_inserter(files));
  return files;
}

}  // namespace copse
