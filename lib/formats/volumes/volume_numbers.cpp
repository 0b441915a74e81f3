#include "lib/formats/volumes/volume_numbers.h"

#include <algorithm>
#include <cmath>
#include <type_traits>

namespace copse {
namespace {

// Calls visit(number) for every number of a volume; a k-DOP's arrays have their size already.
template <class V, class Visit>
void each_number(V& v, Visit&& visit) {
  const auto n = [&](auto& x) {
    if constexpr (std::is_same_v<std::remove_cvref_t<decltype(x)>, float>) {
      visit(x);
    } else {
      visit(x.x), visit(x.y), visit(x.z);
    }
  };
  using Bare = std::remove_const_t<V>;
  if constexpr (std::is_same_v<Bare, FloatBox>) {
    n(v.min), n(v.max);
  } else if constexpr (std::is_same_v<Bare, BoundingSphere<float>>) {
    n(v.centre), n(v.radius);
  } else if constexpr (std::is_same_v<Bare, OrientedBox<float>>) {
    n(v.centre), n(v.axes[0]), n(v.axes[1]), n(v.axes[2]), n(v.half_extents);
  } else if constexpr (std::is_same_v<Bare, Capsule<float>> || std::is_same_v<Bare, Cylinder<float>>) {
    n(v.a), n(v.b), n(v.radius);
  } else if constexpr (std::is_same_v<Bare, Lozenge<float>>) {
    n(v.origin), n(v.edge0), n(v.edge1), n(v.radius);
  } else if constexpr (std::is_same_v<Bare, Ellipsoid<float>>) {
    n(v.centre), n(v.axes[0]), n(v.axes[1]), n(v.axes[2]), n(v.semi_axes);
  } else {
    for (auto& normal : v.normals) n(normal);
    for (auto& x : v.min) n(x);
    for (auto& x : v.max) n(x);
  }
}

Volume<float> blank(VolumeKind kind, std::size_t count) {
  switch (kind) {
    case VolumeKind::aabb:
      return FloatBox{};
    case VolumeKind::sphere:
      return BoundingSphere<float>{};
    case VolumeKind::obb:
      return OrientedBox<float>{};
    case VolumeKind::capsule:
      return Capsule<float>{};
    case VolumeKind::cylinder:
      return Cylinder<float>{};
    case VolumeKind::lozenge:
      return Lozenge<float>{};
    case VolumeKind::ellipsoid:
      return Ellipsoid<float>{};
    case VolumeKind::kdop:
      break;
  }
  Kdop<float> k;
  k.normals.resize(count / 5), k.min.resize(count / 5), k.max.resize(count / 5);
  return k;
}

bool not_negative(const Float3& v) {
  return v.x >= 0 && v.y >= 0 && v.z >= 0;
}

}  // namespace

std::optional<VolumeKind> volume_kind(std::string_view name) {
  const auto at = std::find(k_volume_names.begin(), k_volume_names.end(), name);
  if (at == k_volume_names.end()) return std::nullopt;
  return static_cast<VolumeKind>(at - k_volume_names.begin());
}

bool is_number_count(VolumeKind kind, std::size_t count) {
  static constexpr std::array<std::size_t, k_volume_kinds> k_counts{6, 4, 15, 7, 7, 10, 15, 0};
  if (kind == VolumeKind::kdop) return count > 0 && count % 5 == 0;
  return count == k_counts[static_cast<std::size_t>(kind)];
}

std::vector<float> numbers_of(const Volume<float>& volume) {
  std::vector<float> out;
  std::visit([&](const auto& v) { each_number(v, [&](float x) { out.push_back(x); }); }, volume);
  return out;
}

Volume<float> volume_of(VolumeKind kind, std::span<const float> numbers) {
  Volume<float> volume = blank(kind, numbers.size());
  std::size_t at = 0;
  std::visit([&](auto& v) { each_number(v, [&](float& x) { x = numbers[at++]; }); }, volume);
  return volume;
}

bool is_sound(const Volume<float>& volume) {
  bool ok = true;
  std::visit([&](const auto& v) { each_number(v, [&](float x) { ok &= std::isfinite(x); }); }, volume);
  if (!ok) return false;
  struct Meaning {
    bool operator()(const FloatBox& v) const { return !v.empty(); }
    bool operator()(const BoundingSphere<float>& v) const { return v.radius >= 0; }
    bool operator()(const OrientedBox<float>& v) const { return not_negative(v.half_extents); }
    bool operator()(const Capsule<float>& v) const { return v.radius >= 0; }
    bool operator()(const Cylinder<float>& v) const { return v.radius >= 0 && v.a != v.b; }
    bool operator()(const Lozenge<float>& v) const { return v.radius >= 0; }
    bool operator()(const Ellipsoid<float>& v) const { return not_negative(v.semi_axes); }
    bool operator()(const Kdop<float>& v) const {
      for (std::size_t i = 0; i < v.normals.size(); ++i) {
        if (v.normals[i] == Float3{} || !(v.min[i] <= v.max[i])) return false;
      }
      return true;
    }
  };
  return std::visit(Meaning{}, volume);
}

}  // namespace copse
