// EXT_meshopt_compression: buffer views packed by meshoptimizer (gltfpack -c).
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace copse {

// The codecs cannot shrink below 1/64: a view that claims more is refused before memory is taken for it.
inline constexpr std::uint64_t k_meshopt_ratio = 64;
inline constexpr std::uint64_t k_meshopt_floor = 65536;

struct MeshoptView {
  std::uint64_t count = 0, stride = 0;
  std::string mode;    // ATTRIBUTES, TRIANGLES, INDICES
  std::string filter;  // empty or NONE, OCTAHEDRAL, QUATERNION, EXPONENTIAL
};

// Unpacks into count * stride bytes. Returns what is wrong, or an empty text.
std::string decode_meshopt(std::span<const std::uint8_t> packed, const MeshoptView& view,
                           std::vector<std::uint8_t>& out);

}  // namespace copse
