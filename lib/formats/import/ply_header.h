// The header of a PLY file: what its elements are made of.
#pragma once

#include "lib/formats/import/mesh_builder.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace copse {

enum class PlyFormat { ascii, little, big };
enum class PlyType : std::uint8_t { i8, u8, i16, u16, i32, u32, f32, f64 };

std::size_t size_of(PlyType type);
inline bool is_integer(PlyType type) {
  return type != PlyType::f32 && type != PlyType::f64;
}

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::f32;  // of the scalar, or of a list's items
  bool list = false;
  PlyType count_type = PlyType::u8;
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
  // What a row takes at least, in the format's bytes.
  std::uint64_t least_row(PlyFormat format) const;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::ascii;
  std::vector<PlyElement> elements;
  std::vector<std::string> textures;  // of `comment TextureFile NAME`
  std::size_t size = 0;               // of the header in bytes: the data begin there
  std::uint64_t lines = 0;            // of the header
};

// False: refused, with the line.
bool read_ply_header(std::string_view text, PlyHeader& out, MeshBuilder& builder);

}  // namespace copse
