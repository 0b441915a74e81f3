#include "tools/treeplay/texture_reader.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

namespace copse::treeplay {

std::vector<std::optional<std::vector<MipLevel>>> read_textures(const Scene& scene,
                                                                std::span<const WantedTexture> wanted) {
  std::vector<std::optional<std::vector<MipLevel>>> read(wanted.size());
  std::vector<std::string> wrong(wanted.size());
  tbb::parallel_for(std::size_t{0}, wanted.size(), [&](std::size_t i) {
    const SceneTexture& t = scene.textures[wanted[i].texture];
    const Result<Image> image =
        t.texture.bytes.empty()
            ? read_image(t.path)
            : read_image(t.texture.bytes, fmt::format("{}, texture {}", t.path.string(), t.number));
    if (image) {
      read[i] = mip_chain(image->rgba, image->width, image->height, wanted[i].cutoff);
      return;
    }
    const Error& e = image.error();
    wrong[i] = fmt::format("{}{}{}; its surfaces are drawn in their mean colour", e.file,
                           e.file.empty() ? "" : ": ", e.what);
  });
  for (const std::string& what : wrong)
    if (!what.empty()) scene.warn(what);
  return read;
}

Result<std::vector<ImpostorImages>> read_impostors(std::span<const TreeImpostor* const> wanted) {
  std::vector<Result<Image>> images(2 * wanted.size());
  tbb::parallel_for(std::size_t{0}, images.size(), [&](std::size_t i) {
    const TreeImpostor& impostor = *wanted[i / 2];
    const bool normals = i % 2 == 1;
    images[i] = read_image(normals ? impostor.atlas.normal : impostor.atlas.albedo,
                           fmt::format("{}, section {}", impostor.file, normals ? "IMPN" : "IMPA"));
  });
  std::vector<ImpostorImages> out;
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (!images[i]) return std::unexpected(images[i].error());
    if (i % 2 == 0)
      out.push_back({std::move(*images[i]), {}});
    else
      out.back().normals = std::move(*images[i]);
  }
  return out;
}

}  // namespace copse::treeplay
