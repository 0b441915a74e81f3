// Materials and textures as sections: fixed-size records in one, their texts one after the other in a second,
// embedded image files in a third. docs/formats.md gives the bytes.
#pragma once

#include "lib/formats/material.h"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace copse {

inline constexpr std::size_t k_material_record = 88;
inline constexpr std::size_t k_texture_record = 16;

struct EncodedMaterials {
  std::vector<std::uint8_t> records, names;
};
EncodedMaterials encode_materials(const std::vector<Material>& materials);

struct EncodedTextures {
  std::vector<std::uint8_t> records, texts, images;
};
EncodedTextures encode_textures(const std::vector<Texture>& textures);

// What is wrong with a section's bytes, and where; `what` is empty when nothing is.
struct RecordFault {
  std::size_t offset = 0;
  std::string what;
};
// Precondition: whole records. The texts' lengths must add up to exactly the bytes of `names`.
RecordFault decode_materials(std::span<const std::uint8_t> records, std::span<const std::uint8_t> names,
                             std::vector<Material>& materials);
// `images` may be left out: the textures then come without bytes.
RecordFault decode_textures(std::span<const std::uint8_t> records, std::span<const std::uint8_t> texts,
                            std::span<const std::uint8_t> images, bool has_images,
                            std::vector<Texture>& textures);

}  // namespace copse
