#include "lib/formats/export/export.h"

#include "lib/formats/export/export_detail.h"

#include <algorithm>
#include <filesystem>
#include <set>

#include <fmt/format.h>

namespace copse {
namespace {

// The first index out of range: "triangle 3 names vertex 99 of 8". `optional` indices may be k_none.
std::string bad_index(const std::vector<Triangle>& triangles, std::size_t count, const char* what,
                      bool optional) {
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    for (const std::uint32_t i : triangles[t]) {
      if (i >= count && !(optional && i == k_none))
        return fmt::format("triangle {} names {} {} of {}", t, what, i, count);
    }
  }
  return {};
}

std::string bad_lengths(const Mesh& mesh) {
  const std::size_t n = mesh.triangles.size();
  const auto fits = [n](std::size_t size) { return size == 0 || size == n; };
  if (n >= k_none) return fmt::format("there are {} triangles, more than can be numbered", n);
  if (mesh.positions.size() > k_none)
    return fmt::format("there are {} vertices, more than can be numbered", mesh.positions.size());
  if (!fits(mesh.normal_triangles.size()) || !fits(mesh.texcoord_triangles.size()) ||
      !fits(mesh.part_of.size())) {
    return "the arrays of its triangles differ in length";
  }
  return {};
}

std::string bad_parts(const Mesh& mesh) {
  for (std::size_t t = 0; t < mesh.part_of.size(); ++t) {
    if (mesh.part_of[t] >= mesh.parts.size()) {
      return fmt::format("triangle {} names part {} of {}", t, mesh.part_of[t], mesh.parts.size());
    }
  }
  for (const Part& part : mesh.parts) {
    if (part.material != k_none && part.material >= mesh.materials.size()) {
      return fmt::format("part '{}' names material {} of {}", part.object, part.material,
                         mesh.materials.size());
    }
  }
  for (const Material& material : mesh.materials) {
    if (material.texture != k_none && material.texture >= mesh.textures.size()) {
      return fmt::format("material '{}' names texture {} of {}", material.name, material.texture,
                         mesh.textures.size());
    }
  }
  return {};
}

// Empty when every index of the mesh is in range.
std::string problem_of(const Mesh& mesh) {
  for (const std::string& problem : {bad_lengths(mesh), bad_parts(mesh)}) {
    if (!problem.empty()) return problem;
  }
  std::string problem = bad_index(mesh.triangles, mesh.positions.size(), "vertex", false);
  if (problem.empty()) problem = bad_index(mesh.normal_triangles, mesh.normals.size(), "normal", true);
  if (problem.empty()) {
    problem = bad_index(mesh.texcoord_triangles, mesh.texcoords.size(), "texture coordinate", true);
  }
  return problem;
}

struct Magic {
  std::string_view bytes;
  const char* mime;
  const char* extension;
};

constexpr Magic k_magics[] = {{"\x89PNG\r\n\x1a\n", "image/png", ".png"},
                              {"\xff\xd8\xff", "image/jpeg", ".jpg"},
                              {"RIFF", "image/webp", ".webp"},
                              {"DDS ", "image/vnd-ms.dds", ".dds"},
                              {"\xabKTX 20\xbb", "image/ktx2", ".ktx2"},
                              {"BM", "image/bmp", ".bmp"},
                              {"II*", "image/tiff", ".tif"},
                              {"MM", "image/tiff", ".tif"}};

std::string extension_of(const Texture& texture) {
  const std::string mime = image_mime(texture);
  for (const Magic& magic : k_magics) {
    if (mime == magic.mime) return magic.extension;
  }
  return ".img";
}

}  // namespace

bool has_image(const Texture& texture) {
  return !texture.bytes.empty() || !texture.uri.empty();
}

std::string image_mime(const Texture& texture) {
  const std::string_view bytes(reinterpret_cast<const char*>(texture.bytes.data()), texture.bytes.size());
  for (const Magic& magic : k_magics) {
    if (bytes.starts_with(magic.bytes)) return magic.mime;
  }
  return texture.mime;
}

std::string stem_of(const std::string& name) {
  return std::filesystem::path(name).stem().string();
}

std::string texture_file_name(const std::string& name, std::size_t index, const Texture& texture) {
  return fmt::format("{}_texture{}{}", stem_of(name), index, extension_of(texture));
}

std::string line_name(std::string_view name, std::string_view fallback) {
  std::string out;
  for (const char c : name) {
    const auto u = static_cast<unsigned char>(c);
    out += u < 0x20 || u == 0x7f ? '_' : c;
  }
  while (!out.empty() && out.back() == ' ') out.pop_back();
  out.erase(0, out.find_first_not_of(' '));
  // A backslash at the end of a line would join it to the next one.
  if (!out.empty() && out.back() == '\\') out.back() = '_';
  return out.empty() ? std::string(fallback) : out;
}

std::vector<std::string> line_names(const std::vector<Material>& materials) {
  std::set<std::string> taken;
  std::vector<std::string> names;
  for (std::size_t m = 0; m < materials.size(); ++m) {
    const std::string wanted = line_name(materials[m].name, fmt::format("material_{}", m));
    std::string name = wanted;
    for (int n = 2; !taken.insert(name).second; ++n) name = fmt::format("{}_{}", wanted, n);
    names.push_back(std::move(name));
  }
  return names;
}

Result<std::vector<ExportedFile>> export_mesh(const Mesh& mesh, ExportFormat format, const std::string& name,
                                              const ExportOptions& options) {
  if (const std::string problem = problem_of(mesh); !problem.empty()) {
    return refuse(name, fmt::format("the mesh cannot be exported: {}", problem), "mend the mesh");
  }
  switch (format) {
    case ExportFormat::obj:
      return export_obj(mesh, name);
    case ExportFormat::ply:
      return export_ply(mesh, name);
    case ExportFormat::glb:
      break;
  }
  return export_glb(mesh, name, options);
}

Result<ExportFormat> export_format_of(const std::string& name) {
  std::string extension = std::filesystem::path(name).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
  if (extension == ".obj") return ExportFormat::obj;
  if (extension == ".ply") return ExportFormat::ply;
  if (extension == ".glb") return ExportFormat::glb;
  return fail(Fault::usage, name, "its extension names no format that can be written",
              "use .obj, .ply or .glb");
}

}  // namespace copse
