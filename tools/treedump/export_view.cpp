#include "lib/formats/level_mesh.h"
#include "lib/formats/spectrum_file.h"
#include "lib/runtime/levels.h"
#include "tools/treedump/views.h"

#include <cmath>

#include <fmt/format.h>

namespace copse {
namespace {

namespace fs = std::filesystem;

// A texture's path as seen from the file that names it -> as seen from the exported file.
std::string moved_uri(const std::string& uri, const fs::path& from, const fs::path& to) {
  if (uri.empty() || uri.find("://") != std::string::npos || fs::path(uri).is_absolute()) return uri;
  std::error_code error;
  const fs::path old_folder = fs::absolute(from, error).parent_path(),
                 new_folder = fs::absolute(to, error).parent_path();
  const fs::path moved =
      (old_folder / uri).lexically_normal().lexically_relative(new_folder.lexically_normal());
  return moved.empty() ? uri : moved.generic_string();
}

// Full detail is level 0, all triangles, no error. Anything else needs levels.
bool is_full_detail(const DumpOptions& options) {
  return !(options.level && *options.level != 0) && !(options.ratio && *options.ratio != 1) &&
         !(options.max_error && *options.max_error != 0);
}

std::unexpected<Error> no_level(const DumpOptions& options, const std::string& what) {
  return refuse(options.files.front().string(), what,
                "make levels with lodbake, or export full detail: --level 0");
}

Result<LodLevel> chosen_level(const DumpOptions& options, const LodSpectra& spectra) {
  if (options.level) {
    const auto n = static_cast<std::size_t>(*options.level);
    if (*options.level < 0 || n > spectra.discrete.size())
      return no_level(options, fmt::format("holds the discrete levels 0 to {}, there is none numbered {}",
                                           spectra.discrete.size(), *options.level));
    return n == 0 ? LodLevel{} : spectra.discrete[n - 1];
  }
  if (options.max_error) return level_of_error(spectra, *options.max_error);
  if (spectra.schedule.empty()) return no_level(options, "holds no schedule, only discrete levels");
  const double full = spectra.schedule.front().triangles;
  return level_of_triangles(spectra, static_cast<std::uint64_t>(std::floor(*options.ratio * full)));
}

// The whole tree at a level. A part without a spectrum is the tree's own.
Mesh mesh_at(const Tree& tree, const LodSpectra& spectra, const LodLevel& level) {
  Tree rest = tree;
  if (!spectra.trunk.elements.empty()) rest.trunk = {}, rest.hierarchy = {};
  if (!spectra.leaves.elements.empty()) rest.leaves = {};
  Mesh mesh = to_mesh(rest);
  append_state(mesh, spectra.trunk, level.trunk_steps, "trunk", tree.header.origin);
  append_state(mesh, spectra.leaves, level.leaf_steps, "leaves", tree.header.origin);
  // Twigs are flat ribbons below full detail.
  for (const Part& part : mesh.parts) {
    if (level.trunk_steps > 0 && part.object == "trunk" && part.material < mesh.materials.size())
      mesh.materials[part.material].double_sided = true;
  }
  return mesh;
}

Result<Mesh> wanted_mesh(const TreeFile& file, const Tree& tree, const DumpOptions& options) {
  const bool levels = has_spectra(file.container());
  if (!levels && is_full_detail(options)) return to_mesh(tree);
  if (!levels) return no_level(options, "holds no levels of detail");
  const auto spectra = load_spectra(file.container(), tree.radius_count(), tree.materials.size());
  if (!spectra) return std::unexpected(spectra.error());
  if (is_full_detail(options)) return mesh_at(tree, *spectra, {});
  const auto level = chosen_level(options, *spectra);
  if (!level) return std::unexpected(level.error());
  return mesh_at(tree, *spectra, *level);
}

}  // namespace

Result<std::vector<ExportedFile>> export_tree(const TreeFile& file, const DumpOptions& options) {
  const auto format = export_format_of(options.export_to.string());
  if (!format) return std::unexpected(format.error());
  auto tree = file.load();
  if (!tree) return std::unexpected(tree.error());
  auto mesh = wanted_mesh(file, *tree, options);
  if (!mesh) return std::unexpected(mesh.error());
  for (Texture& texture : mesh->textures)
    texture.uri = moved_uri(texture.uri, options.files.front(), options.export_to);
  *tree = {};
  return export_mesh(*mesh, *format, options.export_to.filename().string(), {.draco = options.draco});
}

}  // namespace copse
