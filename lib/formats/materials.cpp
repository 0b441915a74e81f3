#include "lib/formats/materials.h"

#include "lib/formats/little_endian.h"

#include <fmt/format.h>

namespace copse {
namespace {

enum MaterialFlags : std::uint32_t { flag_double_sided = 1 };
constexpr std::size_t k_material_flags_offset = 4;

template <class Field>
void walk(Field&& field, std::uint32_t& name_length, std::uint32_t& flags, Material& m) {
  field(name_length), field(flags), field(m.texture);
  field(m.ambient), field(m.diffuse), field(m.specular), field(m.emission);
  field(m.shininess), field(m.alpha), field(m.alpha_cutoff);
  field(m.mean_colour), field(m.alpha_coverage);
}

template <class Field>
void walk(Field&& field, std::uint32_t& uri_length, std::uint32_t& mime_length, std::uint64_t& byte_length) {
  field(uri_length), field(mime_length), field(byte_length);
}

template <class T>
void append(std::vector<std::uint8_t>& bytes, const T& value) {
  const std::size_t at = bytes.size();
  bytes.resize(at + sizeof value);
  put(std::span(bytes), at, value);
}

void append_text(std::vector<std::uint8_t>& bytes, const std::string& text) {
  bytes.insert(bytes.end(), text.begin(), text.end());
}

// Cuts pieces off the front; `short_by` is set when a piece is longer than what is left.
struct Cutter {
  std::span<const std::uint8_t> rest;
  bool failed = false;
  std::span<const std::uint8_t> cut(std::uint64_t length) {
    if (length > rest.size()) failed = true;
    if (failed) return {};
    const auto piece = rest.first(length);
    rest = rest.subspan(length);
    return piece;
  }
  std::string text(std::uint64_t length) {
    const auto piece = cut(length);
    return {piece.begin(), piece.end()};
  }
};

}  // namespace

EncodedMaterials encode_materials(const std::vector<Material>& materials) {
  EncodedMaterials out;
  out.records.reserve(materials.size() * k_material_record);
  for (Material m : materials) {
    auto name_length = static_cast<std::uint32_t>(m.name.size());
    std::uint32_t flags = m.double_sided ? std::uint32_t{flag_double_sided} : 0;
    walk([&](const auto& value) { append(out.records, value); }, name_length, flags, m);
    append_text(out.names, m.name);
  }
  return out;
}

EncodedTextures encode_textures(const std::vector<Texture>& textures) {
  EncodedTextures out;
  for (const Texture& t : textures) {
    auto uri_length = static_cast<std::uint32_t>(t.uri.size());
    auto mime_length = static_cast<std::uint32_t>(t.mime.size());
    std::uint64_t byte_length = t.bytes.size();
    walk([&](const auto& value) { append(out.records, value); }, uri_length, mime_length, byte_length);
    append_text(out.texts, t.uri);
    append_text(out.texts, t.mime);
    out.images.insert(out.images.end(), t.bytes.begin(), t.bytes.end());
  }
  return out;
}

RecordFault decode_materials(std::span<const std::uint8_t> records, std::span<const std::uint8_t> names,
                             std::vector<Material>& materials) {
  Cutter cutter{names};
  materials.clear();
  materials.reserve(records.size() / k_material_record);
  for (std::size_t at = 0; at < records.size(); at += k_material_record) {
    Material m;
    std::uint32_t name_length = 0, flags = 0;
    std::size_t offset = at;
    walk(
        [&]<class T>(T& value) {
          value = get<T>(records, offset);
          offset += sizeof value;
        },
        name_length, flags, m);
    if (flags & ~std::uint32_t{flag_double_sided}) {
      return {at + k_material_flags_offset, fmt::format("unknown flags {:#x}", flags)};
    }
    m.double_sided = flags & flag_double_sided;
    m.name = cutter.text(name_length);
    if (cutter.failed)
      return {at, fmt::format("a name of {} bytes is longer than what is left", name_length)};
    materials.push_back(std::move(m));
  }
  if (!cutter.rest.empty()) return {0, fmt::format("{} bytes of names belong to none", cutter.rest.size())};
  return {};
}

RecordFault decode_textures(std::span<const std::uint8_t> records, std::span<const std::uint8_t> texts,
                            std::span<const std::uint8_t> images, bool has_images,
                            std::vector<Texture>& textures) {
  Cutter text{texts}, image{images};
  textures.clear();
  textures.reserve(records.size() / k_texture_record);
  for (std::size_t at = 0; at < records.size(); at += k_texture_record) {
    std::uint32_t uri_length = 0, mime_length = 0;
    std::uint64_t byte_length = 0;
    std::size_t offset = at;
    walk(
        [&]<class T>(T& value) {
          value = get<T>(records, offset);
          offset += sizeof value;
        },
        uri_length, mime_length, byte_length);
    Texture t;
    t.uri = text.text(uri_length);
    t.mime = text.text(mime_length);
    if (text.failed) return {at, "its texts are longer than what is left"};
    if (has_images) {
      const auto bytes = image.cut(byte_length);
      if (image.failed)
        return {at + 8, fmt::format("an image of {} bytes is longer than what is left", byte_length)};
      t.bytes.assign(bytes.begin(), bytes.end());
    }
    textures.push_back(std::move(t));
  }
  if (!text.rest.empty()) return {0, fmt::format("{} bytes of texts belong to none", text.rest.size())};
  if (!image.rest.empty()) return {0, fmt::format("{} bytes of images belong to none", image.rest.size())};
  return {};
}

}  // namespace copse
