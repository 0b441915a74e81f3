#include "lib/formats/levels/impostors.h"
#include "lib/formats/levels/level_mesh.h"
#include "lib/formats/levels/spectrum_file.h"
#include "lib/runtime/levels.h"
#include "tools/treedump/impostor_cross.h"
#include "tools/treedump/views.h"

#include <algorithm>
#include <cmath>
#include <numbers>

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
  const auto wanted = static_cast<std::uint64_t>(std::floor(*options.ratio * full_detail(spectra).triangles));
  const LodLevel level = level_of_triangles(spectra, wanted);
  if (spectra.schedule.empty() && level.triangles > wanted)
    return refuse(options.files.front().string(),
                  fmt::format("holds discrete levels alone, and the coarsest has {} triangles, not {}",
                              level.triangles, wanted),
                  "bake with lodbake --continuous, or name a level");
  return level;
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

// A mesh, and for a GLB that holds several levels which part belongs to which.
struct Wanted {
  Mesh mesh;
  std::vector<std::uint32_t> level_of_part;
  std::vector<double> screen_coverage;
};

// Full detail, every discrete level and the impostor, if there is one, in one mesh: level 0 in the scene, the
// others behind MSFT_lod.
Wanted all_levels(const Tree& tree, const LodSpectra& spectra, const ImpostorAtlas& impostor) {
  Wanted out{.mesh = mesh_at(tree, spectra, {}), .level_of_part = {}, .screen_coverage = {}};
  out.level_of_part.assign(out.mesh.parts.size(), 0);
  // The share of the screen's height that the tree takes up where the next level takes over, seen at 60
  // degrees.
  const double height = tree.header.bounds.extent().y, reach = 2 * std::tan(std::numbers::pi / 6);
  const auto coverage = [&](double distance) {
    return distance > 0 ? std::min(1.0, height / (reach * distance)) : 1.0;
  };
  std::uint32_t number = 0;
  for (const LodLevel& level : spectra.discrete) {
    if (level.triangles == 0) continue;  // glTF has no mesh of nothing
    append_state(out.mesh, spectra.trunk, level.trunk_steps, "trunk", tree.header.origin);
    append_state(out.mesh, spectra.leaves, level.leaf_steps, "leaves", tree.header.origin);
    out.level_of_part.resize(out.mesh.parts.size(), ++number);
    out.screen_coverage.push_back(coverage(level.distance));
  }
  if (!impostor.empty()) {
    append_impostor_cross(out.mesh, impostor, tree.header.origin);
    out.level_of_part.resize(out.mesh.parts.size(), ++number);
    out.screen_coverage.push_back(coverage(impostor.distance));
  }
  out.screen_coverage.push_back(0);
  for (const Part& part : out.mesh.parts) {
    if (part.object == "trunk" && part.material < out.mesh.materials.size())
      out.mesh.materials[part.material].double_sided = true;
  }
  return out;
}

Result<Wanted> wanted_mesh(const TreeFile& file, const Tree& tree, const DumpOptions& options,
                           ExportFormat format) {
  const bool levels = has_spectra(file.container());
  if (!levels && is_full_detail(options))
    return Wanted{.mesh = to_mesh(tree), .level_of_part = {}, .screen_coverage = {}};
  if (!levels) return no_level(options, "holds no levels of detail");
  const auto spectra = load_spectra(file.container(), tree.radius_count(), tree.materials.size());
  if (!spectra) return std::unexpected(spectra.error());
  const bool names_one = options.level || options.ratio || options.max_error;
  const bool both = !spectra->trunk.elements.empty() || !spectra->leaves.elements.empty();
  if (!names_one && both && !spectra->discrete.empty() && format == ExportFormat::glb) {
    const auto impostor = read_impostor(file);
    if (!impostor) return std::unexpected(impostor.error());
    return all_levels(tree, *spectra, *impostor);
  }
  LodLevel level;
  if (!is_full_detail(options)) {
    const auto chosen = chosen_level(options, *spectra);
    if (!chosen) return std::unexpected(chosen.error());
    level = *chosen;
  }
  return Wanted{.mesh = mesh_at(tree, *spectra, level), .level_of_part = {}, .screen_coverage = {}};
}

}  // namespace

namespace {

// The pictures of an impostor as they are stored: "oak.png" the colours, "oak.normal.png" normals and depth.
Result<std::vector<ExportedFile>> export_impostor(const TreeFile& file, const DumpOptions& options) {
  const auto atlas = read_impostor(file);
  if (!atlas) return std::unexpected(atlas.error());
  if (atlas->empty())
    return refuse(options.files.front().string(), "holds no impostor, and nothing else is exported as .png",
                  "bake one with lodbake --impostor, or name an .obj, .ply or .glb");
  const auto text = [](const Array<std::uint8_t>& bytes) {
    return std::string(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  };
  const fs::path name = options.export_to.filename();
  return std::vector<ExportedFile>{{name.string(), text(atlas->albedo)},
                                   {name.stem().string() + ".normal.png", text(atlas->normal)}};
}

}  // namespace

Result<std::vector<ExportedFile>> export_tree(const TreeFile& file, const DumpOptions& options) {
  if (options.export_to.extension() == ".png") return export_impostor(file, options);
  const auto format = export_format_of(options.export_to.string());
  if (!format) return std::unexpected(format.error());
  if (options.draco && *format != ExportFormat::glb) {
    return fail(Fault::usage, options.export_to.string(), "only a .glb can be compressed with Draco",
                "name it .glb, or drop --draco");
  }
  auto tree = file.load();
  if (!tree) return std::unexpected(tree.error());
  auto wanted = wanted_mesh(file, *tree, options, *format);
  if (!wanted) return std::unexpected(wanted.error());
  for (Texture& texture : wanted->mesh.textures)
    texture.uri = moved_uri(texture.uri, options.files.front(), options.export_to);
  *tree = {};
  return export_mesh(wanted->mesh, *format, options.export_to.filename().string(),
                     {.draco = options.draco,
                      .level_of_part = std::move(wanted->level_of_part),
                      .screen_coverage = std::move(wanted->screen_coverage)});
}

}  // namespace copse
