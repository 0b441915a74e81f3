#include "tools/lodbake/looks.h"

#include "lib/formats/import/image.h"

#include <fmt/format.h>

namespace copse::lodbake {

TreeLooks::TreeLooks(const Tree& tree, const std::filesystem::path& file, Context& context) : tree_(tree) {
  Image image;
  masks_ = alpha_masks(tree.materials, [&](std::uint32_t index) -> std::optional<TextureImage> {
    if (index >= tree.textures.size()) return std::nullopt;
    const Texture& texture = tree.textures[index];
    if (texture.uri.empty() && texture.bytes.empty()) return std::nullopt;
    const std::filesystem::path path = file.parent_path() / texture.uri;
    auto read = texture.uri.empty()
                    ? read_image(texture.bytes, fmt::format("{}: texture {}", file.string(), index))
                    : read_image(path);
    if (!read) {
      context.warn(fmt::format("{}: {}; the texture counts as opaque", read.error().file, read.error().what));
      return std::nullopt;
    }
    if (!texture.uri.empty()) context.read(path, false);
    image = std::move(*read);
    return TextureImage{image.width, image.height, image.rgba};
  });
}

}  // namespace copse::lodbake
