// Typed, checked reading of glTF accessors: any component type, normalized or not, interleaved, sparse.
#pragma once

#include "lib/formats/import/gltf/document.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

// An accessor without a buffer view is all zeros: it may have as many elements as this, or as the file has
// bytes.
inline constexpr std::uint64_t k_zero_accessor_floor = 65536;

struct GltfAccessor {
  std::string path;
  std::uint64_t count = 0;
  std::uint32_t component_type = 0;  // 5120 BYTE ... 5126 FLOAT
  std::uint32_t components = 0;      // 1 SCALAR ... 16 MAT4
  bool normalized = false;
  const std::uint8_t* data = nullptr;  // of element 0; null: all zeros
  std::uint64_t stride = 0;
  // Elements that are replaced.
  std::uint64_t sparse_count = 0;
  std::uint32_t sparse_index_type = 0;
  const std::uint8_t* sparse_indices = nullptr;
  const std::uint8_t* sparse_values = nullptr;
};

// Looks accessor `index` up and checks that all it refers to is there. With `count_only`, its buffer views
// are not looked at (a Draco primitive's accessors have none).
bool open_accessor(GltfDocument& document, std::uint32_t index, GltfAccessor& out, bool count_only = false);

// The numbers of all elements, `components` each (those of the accessor, or fewer), normalized integers as
// fractions. `out` has room for count * components.
void read_numbers(const GltfAccessor& accessor, std::uint32_t components, std::span<double> out);
void read_numbers(const GltfAccessor& accessor, std::uint32_t components, std::span<float> out);

// Unsigned scalars, as indices are.
bool read_indices(GltfDocument& document, const GltfAccessor& accessor, std::vector<std::uint32_t>& out);

}  // namespace copse
