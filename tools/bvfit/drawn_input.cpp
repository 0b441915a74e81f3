#include "tools/bvfit/drawn_input.h"

#include "lib/analysis/leaves/classify.h"
#include "lib/formats/container/mapped_file.h"
#include "lib/formats/export/export.h"
#include "lib/formats/import/image.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace copse::bvfit {
namespace {

bool begins_with(std::span<const std::uint8_t> bytes, std::span<const std::uint8_t> with) {
  return bytes.size() >= with.size() && std::equal(with.begin(), with.end(), bytes.begin());
}

// What a GLB may hold.
bool is_png_or_jpeg(std::span<const std::uint8_t> bytes) {
  constexpr std::array<std::uint8_t, 4> k_png{0x89, 'P', 'N', 'G'};
  constexpr std::array<std::uint8_t, 3> k_jpeg{0xff, 0xd8, 0xff};
  return begins_with(bytes, k_png) || begins_with(bytes, k_jpeg);
}

Result<Image> image_of(const Texture& texture, std::uint32_t index) {
  return texture.uri.empty() ? read_image(texture.bytes, fmt::format("embedded texture {}", index))
                             : read_image(texture.uri);
}

Result<void> embed(Texture& texture, std::uint32_t index, Context& context) {
  if (!texture.uri.empty()) {
    const auto file = MappedFile::open(texture.uri);
    if (!file) return std::unexpected(file.error());
    context.read(texture.uri, false);
    if (is_png_or_jpeg(file->bytes())) texture.bytes.assign(file->bytes().begin(), file->bytes().end());
  }
  if (!is_png_or_jpeg(texture.bytes)) {
    const auto image = image_of(texture, index);
    if (!image) return std::unexpected(image.error());
    auto png = encode_png(*image);
    if (!png) return std::unexpected(png.error());
    texture.bytes = std::move(*png);
  }
  texture.uri.clear(), texture.mime.clear();
  return {};
}

std::vector<bool> leaves_of(const Input& input, const Mesh& mesh) {
  std::vector<bool> out(mesh.triangles.size());
  if (input.file) {
    for (std::size_t t = 0; t < out.size(); ++t) out[t] = mesh.parts[mesh.part_of[t]].object == "leaves";
    return out;
  }
  // A mesh that cannot be told apart is drawn in one colour.
  if (const auto classes = classify(mesh)) {
    for (std::size_t t = 0; t < out.size(); ++t) out[t] = classes->leaf_of[t] != k_none;
  }
  return out;
}

}  // namespace

Mesh mesh_of(const Input& input) {
  if (input.file) {
    Mesh mesh = to_mesh(input.tree);
    for (Double3& p : mesh.positions) p -= input.tree.header.origin;
    for (Texture& t : mesh.textures) {
      if (!t.uri.empty()) t.uri = (input.folder / t.uri).string();
    }
    return mesh;
  }
  Mesh mesh = input.mesh;
  if (!mesh.triangles.empty()) mesh.positions = input.points;
  return mesh;
}

void embed_textures(Mesh& mesh, Context& context) {
  for (std::uint32_t i = 0; i < mesh.textures.size(); ++i) {
    const auto ok = embed(mesh.textures[i], i, context);
    if (ok) continue;
    context.warn(fmt::format("{}: {}; the texture is left out", ok.error().file, ok.error().what));
    for (Material& m : mesh.materials) m.texture = m.texture == i ? k_none : m.texture;
  }
}

DrawnInput drawn_input(const Input& input, Context& context) {
  DrawnInput out{mesh_of(input), {}, {}};
  Image image;
  out.masks = alpha_masks(out.mesh.materials, [&](std::uint32_t index) -> std::optional<TextureImage> {
    if (index >= out.mesh.textures.size()) return std::nullopt;
    const Texture& texture = out.mesh.textures[index];
    auto read = image_of(texture, index);
    if (!read) {
      context.warn(fmt::format("{}: {}; the texture counts as opaque", read.error().file, read.error().what));
      return std::nullopt;
    }
    if (!texture.uri.empty()) context.read(texture.uri, false);
    image = std::move(*read);
    return TextureImage{image.width, image.height, image.rgba};
  });
  out.is_leaf = leaves_of(input, out.mesh);
  return out;
}

}  // namespace copse::bvfit
