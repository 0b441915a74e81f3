#include "tools/lodbake/looks.h"

#include <memory>
#include <utility>

#include <fmt/format.h>

namespace copse::lodbake {

TreeLooks::TreeLooks(const Tree& tree, const std::filesystem::path& file, Context& context)
    : tree_(tree), file_(file), context_(context) {
  Image image;
  masks_ = alpha_masks(tree.materials, [&](std::uint32_t index) -> std::optional<TextureImage> {
    auto read_now = read(index, true);
    if (!read_now) return std::nullopt;
    image = std::move(*read_now);
    return TextureImage{image.width, image.height, image.rgba};
  });
}

std::optional<Image> TreeLooks::read(std::uint32_t texture, bool warn) const {
  if (texture >= tree_.textures.size()) return std::nullopt;
  const Texture& t = tree_.textures[texture];
  if (t.uri.empty() && t.bytes.empty()) return std::nullopt;
  const std::filesystem::path path = file_.parent_path() / t.uri;
  auto image = t.uri.empty() ? read_image(t.bytes, fmt::format("{}: texture {}", file_.string(), texture))
                             : read_image(path);
  if (!image) {
    if (warn)
      context_.warn(
          fmt::format("{}: {}; the texture counts as opaque", image.error().file, image.error().what));
    return std::nullopt;
  }
  if (!t.uri.empty()) context_.read(path, false);
  return std::move(*image);
}

ImageSource TreeLooks::images() const {
  // The image outlives the call that gave it, as an ImageSource promises.
  const auto image = std::make_shared<Image>();
  return [this, image](std::uint32_t index) -> std::optional<TextureImage> {
    auto now = read(index, false);
    if (!now) return std::nullopt;
    *image = std::move(*now);
    return TextureImage{image->width, image->height, image->rgba};
  };
}

}  // namespace copse::lodbake
