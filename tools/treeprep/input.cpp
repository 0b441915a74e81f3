#include "tools/treeprep/input.h"

#include "lib/analysis/leaves/stand_ins.h"
#include "lib/analysis/surface/spatial_order.h"
#include "lib/formats/import/import.h"
#include "lib/formats/import/text.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace copse::treeprep {
namespace {

namespace fs = std::filesystem;

template <class T>
std::uint32_t append(std::vector<T>& all, std::vector<T>& more) {
  const auto base = static_cast<std::uint32_t>(all.size());
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
  return base;
}

// Corner indices of a mesh that others follow: `count` triangles' worth must be there before it.
void append_corners(std::vector<Triangle>& all, const std::vector<Triangle>& more, std::size_t before,
                    std::size_t count, std::uint32_t base) {
  if (all.empty() && more.empty()) return;
  all.resize(before, {k_none, k_none, k_none});
  for (Triangle t : more) {
    for (std::uint32_t& i : t) {
      if (i != k_none) i += base;
    }
    all.push_back(t);
  }
  all.resize(before + count, {k_none, k_none, k_none});
}

void append_parts(Mesh& all, Mesh& more) {
  const std::uint32_t textures = append(all.textures, more.textures);
  for (Material& m : more.materials) {
    if (m.texture != k_none) m.texture += textures;
  }
  const std::uint32_t materials = append(all.materials, more.materials);
  for (Part& p : more.parts) {
    if (p.material != k_none) p.material += materials;
  }
  const std::uint32_t parts = append(all.parts, more.parts);
  for (const std::uint32_t p : more.part_of) all.part_of.push_back(p + parts);
}

// Puts `more` behind `all`.
void append_mesh(Mesh& all, Mesh more) {
  const std::size_t before = all.triangles.size(), count = more.triangles.size();
  const std::uint32_t normals = append(all.normals, more.normals);
  const std::uint32_t texcoords = append(all.texcoords, more.texcoords);
  append_corners(all.normal_triangles, more.normal_triangles, before, count, normals);
  append_corners(all.texcoord_triangles, more.texcoord_triangles, before, count, texcoords);
  const std::uint32_t positions = append(all.positions, more.positions);
  for (const Triangle& t : more.triangles) {
    all.triangles.push_back({t[0] + positions, t[1] + positions, t[2] + positions});
  }
  append_parts(all, more);
  all.face_of.clear();  // polygons are numbered a file; nothing behind this point names them
}

void relocate_textures(Mesh& mesh, const fs::path& from, const fs::path& to) {
  for (Texture& texture : mesh.textures) {
    if (texture.uri.empty()) continue;
    const fs::path image = from.parent_path() / texture.uri;
    std::error_code error;
    const fs::path target =
        fs::relative(fs::absolute(image, error), fs::absolute(to, error).parent_path(), error);
    texture.uri = (error || target.empty() ? image : target).generic_string();
  }
}

std::string format_name(MeshFormat format) {
  switch (format) {
    case MeshFormat::obj:
      return "obj";
    case MeshFormat::ply:
      return "ply";
    case MeshFormat::off:
      return "off";
    case MeshFormat::stl:
      return "stl";
    case MeshFormat::gltf:
      return "gltf";
    case MeshFormat::glb:
      return "glb";
    case MeshFormat::unknown:
      break;
  }
  return "unknown";
}

// A tree that lies along Z and stands nowhere near upright in Y was exported Z up; say so rather than guess.
void warn_if_z_up(const Mesh& mesh, const std::string& name, Context& context) {
  const DoubleBox box = bounds(mesh);
  const Double3 e = box.extent();
  const bool stands_on_z = std::abs(box.min.z) < 0.05 * e.z,
             centred_on_y = std::abs(box.centre().y) < 0.2 * e.y;
  if (e.z > 1.3 * e.y && stands_on_z && centred_on_y) {
    context.warn(fmt::format(
        "{}: the mesh seems to be Z up (it stands on z = 0 and is {:.3g} high there); pass --up z "
        "to stand it up",
        name, e.z));
  }
}

Result<void> check_size(const Mesh& mesh, const std::string& name) {
  if (mesh.triangles.empty()) {
    return refuse(name, "there is no triangle in it", "export the mesh with its faces");
  }
  const Double3 e = bounds(mesh).extent();
  const double extent = std::max({e.x, e.y, e.z});
  if (!(extent <= k_largest_extent)) {
    return refuse(
        name,
        fmt::format("the tree is {:.3g} m large; at most {:.0g} m can be stored", extent, k_largest_extent),
        "use a smaller --scale");
  }
  return {};
}

// "'UCX_oak', 'UCX_pine' and 3 more"
std::string listed(const std::vector<std::string>& names) {
  constexpr std::size_t k_listed = 6;  // a warning is one line
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), k_listed); ++i)
    text += (i == 0 ? "" : ", ") + in_quotes(names[i]);
  return names.size() > k_listed ? fmt::format("{} and {} more", text, names.size() - k_listed) : text;
}

// Collision hulls and coarser levels that stand beside the tree itself. Ids of triangles are the file's
// still.
void leave_out_stand_ins(Input& input, const Options& options, Context& context) {
  std::vector<std::string> patterns = options.trunk_patterns;
  patterns.insert(patterns.end(), options.leaf_patterns.begin(), options.leaf_patterns.end());
  std::vector<std::uint32_t> parts;
  std::vector<std::string> names;
  for (const StandIn& found : find_stand_ins(input.mesh, patterns)) {
    parts.push_back(found.part);
    if (std::ranges::find(names, found.name) == names.end()) names.push_back(found.name);
  }
  if (parts.empty()) return;
  const std::size_t before = input.mesh.triangles.size();
  input.file_order = remove_parts(input.mesh, parts);
  context.warn(fmt::format(
      "{}: {} of {} triangles are left out, as their names say collision hull or coarser level of detail: "
      "{}; name them with --trunk or --leaf, such as --trunk {}, to keep them",
      input.name, before - input.mesh.triangles.size(), before, listed(names), in_quotes(names.front())));
}

// `import` is to be put behind what `input` holds already.
void note_undefined(const Import& import, const fs::path& path, Input& input, Context& context) {
  if (import.undefined_materials.empty()) return;
  const auto before = static_cast<std::uint32_t>(input.mesh.materials.size());
  for (const std::uint32_t m : import.undefined_materials) input.undefined_materials.push_back(before + m);
  context.warn(
      fmt::format("{}: {} of its {} materials {} defined nowhere ({}{}); wood becomes brown, leaves green",
                  path.string(), import.undefined_materials.size(), import.mesh.materials.size(),
                  import.undefined_materials.size() == 1 ? "is" : "are",
                  in_quotes(import.mesh.materials[import.undefined_materials.front()].name),
                  import.undefined_materials.size() > 1 ? ", ..." : ""));
}

}  // namespace

Result<Input> read_input(const Options& options, Context& context) {
  Input input;
  Stage stage = context.stage("read");
  for (const fs::path& path : options.inputs) {
    auto import = import_mesh(path, {.strict = options.strict});
    const bool strictly = import.has_value();
    if (!import && options.strict) import = import_mesh(path, {});  // so that one fault does not hide others
    if (!import) return std::unexpected(import.error());
    if (!strictly) {
      for (const std::string& fault : import->warnings) input.faults.push_back(path.string() + ": " + fault);
    }
    for (std::size_t i = 0; i < import->files.size(); ++i) context.read(import->files[i], i == 0);
    for (const std::string& warning : import->warnings) context.warn(path.string() + ": " + warning);
    relocate_textures(import->mesh, path, options.output);
    note_undefined(*import, path, input, context);
    if (input.name.empty()) {
      input.name = path.string();
      input.format = format_name(import->format);
      input.mesh = std::move(import->mesh);
    } else {
      append_mesh(input.mesh, std::move(import->mesh));
    }
  }
  stage.items(input.mesh.triangles.size(), "triangles");
  if (options.inputs.size() > 1) input.name += fmt::format(" (+{} more)", options.inputs.size() - 1);
  if (const auto ok = settle(input, options, context); !ok) return std::unexpected(ok.error());
  return input;
}

Result<void> settle(Input& input, const Options& options, Context& context) {
  if (!options.strict) leave_out_stand_ins(input, options, context);
  orient(input.mesh, options.up, options.scale);
  if (const auto ok = check_size(input.mesh, input.name); !ok) return ok;
  if (options.up == UpAxis::y) warn_if_z_up(input.mesh, input.name, context);
  if (options.strict) return {};  // its messages go by the file's order
  std::vector<std::uint32_t> moved_from = order_by_place(input.mesh);
  if (input.file_order.empty()) {
    input.file_order = std::move(moved_from);
  } else if (!moved_from.empty()) {
    for (std::uint32_t& t : moved_from) t = input.file_order[t];
    input.file_order = std::move(moved_from);
  }
  return {};
}

double weld_tolerance(const Input& input, const Options& options) {
  return options.weld < 0 ? -1 : options.weld * length(bounds(input.mesh).extent());
}

}  // namespace copse::treeprep
