// The kinds of bounding volumes by name, and a volume as a row of float32 numbers: how files hold them.
#pragma once

#include "lib/formats/volumes/volume.h"

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

namespace copse {

// In the order of Volume<T>'s alternatives.
enum class VolumeKind : std::uint32_t {
  aabb = 0,
  sphere = 1,
  obb = 2,
  capsule = 3,
  cylinder = 4,
  lozenge = 5,
  ellipsoid = 6,
  kdop = 7,
};
inline constexpr std::uint32_t k_volume_kinds = 8;

inline constexpr std::array<std::string_view, k_volume_kinds> k_volume_names{
    "aabb", "sphere", "obb", "capsule", "cylinder", "lozenge", "ellipsoid", "kdop"};

template <class T>
VolumeKind kind_of(const Volume<T>& volume) {
  return static_cast<VolumeKind>(volume.index());
}
inline std::string_view name_of(VolumeKind kind) {
  return k_volume_names[static_cast<std::size_t>(kind)];
}
std::optional<VolumeKind> volume_kind(std::string_view name);

// How many numbers a volume of a kind has; of a k-DOP 5 a pair of planes, at least one.
bool is_number_count(VolumeKind kind, std::size_t count);

// Members in the order of their declaration, coordinates x y z; of a k-DOP all normals, then min, then max.
std::vector<float> numbers_of(const Volume<float>& volume);
// Precondition: is_number_count.
Volume<float> volume_of(VolumeKind kind, std::span<const float> numbers);

// Whether the numbers are finite, sizes not negative, boxes not inside out, a cylinder's ends apart and a
// k-DOP's normals not zero: what "inside" needs to have a meaning.
bool is_sound(const Volume<float>& volume);

}  // namespace copse
