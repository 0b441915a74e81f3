#include "tools/ecogen/page_textures.h"

#include "lib/analysis/measure/texture_statistics.h"
#include "lib/formats/container/mapped_file.h"
#include "lib/formats/import/image.h"

#include <system_error>

#include <fmt/format.h>

namespace copse::ecogen {
namespace {

namespace fs = std::filesystem;

// A triangle of every material, without texture coordinates: it counts as the whole texture.
Mesh swatches(const Ecosystem& eco) {
  Mesh mesh;
  mesh.positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  mesh.materials = eco.materials;
  mesh.textures = eco.textures;
  for (std::uint32_t m = 0; m < eco.materials.size(); ++m) {
    mesh.triangles.push_back({0, 1, 2});
    mesh.part_of.push_back(m);
    mesh.parts.push_back({.object = "", .group = "", .material = m});
  }
  return mesh;
}

}  // namespace

std::string relative_name(const fs::path& file, const fs::path& folder) {
  std::error_code error;
  const fs::path from = fs::absolute(folder.empty() ? "." : folder, error).lexically_normal();
  return fs::absolute(file, error).lexically_normal().lexically_proximate(from).generic_string();
}

Result<void> take_page_textures(const BuildOptions& options, Built& built, Context& context) {
  Ecosystem& eco = built.eco;
  if (eco.textures.empty()) return {};
  Result<void> state;
  Image image;
  const auto read = [&](std::uint32_t index) -> std::optional<TextureImage> {
    auto found = read_image(fs::path(eco.textures[index].uri));
    if (!found && state) {
      Error error = found.error();
      error.what = fmt::format("{}: {}", built.texture_places[index], error.what);
      state = std::unexpected(std::move(error));
    }
    if (!found) return std::nullopt;
    image = std::move(*found);
    return TextureImage{image.width, image.height, image.rgba};
  };
  const auto statistics = texture_statistics(swatches(eco), read);
  if (!state) return state;
  copse::apply(statistics, eco.materials);  // qualified: std::apply would be a candidate
  for (Texture& texture : eco.textures) {
    const fs::path path = texture.uri;
    context.read(path, true);
    if (!options.pack) {
      texture.uri = relative_name(path, options.folder);
      continue;
    }
    const auto file = MappedFile::open(path);
    if (!file) return std::unexpected(file.error());
    texture.bytes.assign(file->bytes().begin(), file->bytes().end());
    texture.uri.clear();
  }
  return {};
}

}  // namespace copse::ecogen
