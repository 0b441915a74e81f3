#include "tools/treedump/views.h"

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

// Full detail is level 0, all triangles, no error. Anything else needs levels, which this file has not.
Result<void> check_level(const DumpOptions& options) {
  const std::string remedy = "make levels with lodbake, or export full detail: --level 0";
  const auto none = [&](const std::string& wanted) {
    return refuse(options.files.front().string(),
                  fmt::format("holds no levels of detail, so there is none {}", wanted), remedy);
  };
  if (options.level && *options.level != 0) return none(fmt::format("numbered {}", *options.level));
  if (options.ratio && *options.ratio != 1)
    return none(fmt::format("with {} of the triangles", *options.ratio));
  if (options.max_error && *options.max_error != 0)
    return none(fmt::format("with an error up to {} m", *options.max_error));
  return {};
}

}  // namespace

Result<std::vector<ExportedFile>> export_tree(const TreeFile& file, const DumpOptions& options) {
  const auto format = export_format_of(options.export_to.string());
  if (!format) return std::unexpected(format.error());
  if (auto possible = check_level(options); !possible) return std::unexpected(std::move(possible.error()));
  auto tree = file.load();
  if (!tree) return std::unexpected(tree.error());
  Mesh mesh = to_mesh(*tree);
  for (Texture& texture : mesh.textures)
    texture.uri = moved_uri(texture.uri, options.files.front(), options.export_to);
  *tree = {};
  return export_mesh(mesh, *format, options.export_to.filename().string(), {.draco = options.draco});
}

}  // namespace copse
