#include "lib/analysis/measure/footprints.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>

namespace copse {
namespace {

// Beyond it a float32 coordinate has no more digits for the place inside a repeat.
constexpr float k_largest_coordinate = 1 << 16;

bool usable(const Float2& p) {
  return std::abs(p.x) <= k_largest_coordinate && std::abs(p.y) <= k_largest_coordinate;  // false for NaN
}

// The triangle's coordinates in a form that depends neither on its first corner, nor on its winding, nor on
// the repeat; false when it has none.
bool read_corners(const Mesh& mesh, std::uint32_t triangle, double tiles, std::array<Float2, 3>& corners) {
  if (mesh.texcoord_triangles.empty()) return false;
  float low_u = std::numeric_limits<float>::infinity(), low_v = low_u, high_u = -low_u, high_v = -low_u;
  for (int i = 0; i < 3; ++i) {
    const std::uint32_t index = mesh.texcoord_triangles[triangle][i];
    if (index >= mesh.texcoords.size() || !usable(mesh.texcoords[index])) return false;
    corners[i] = mesh.texcoords[index];
    low_u = std::min(low_u, corners[i].x), high_u = std::max(high_u, corners[i].x);
    low_v = std::min(low_v, corners[i].y), high_v = std::max(high_v, corners[i].y);
  }
  if (high_u - low_u > tiles || high_v - low_v > tiles) return false;
  for (Float2& c : corners) c = {c.x - std::floor(low_u), c.y - std::floor(low_v)};
  std::sort(corners.begin(), corners.end(),
            [](const Float2& a, const Float2& b) { return a.x != b.x ? a.x < b.x : a.y < b.y; });
  return true;
}

std::uint64_t hash_of(const std::array<Float2, 3>& corners) {
  std::uint64_t h = 0x9e3779b97f4a7c15u;
  for (const Float2& c : corners) {
    for (const float x : {c.x, c.y}) {
      h = (h ^ std::bit_cast<std::uint32_t>(x + 0.0f)) * 0xff51afd7ed558ccdu;  // -0 as 0
      h ^= h >> 32;
    }
  }
  return h;
}

double area_of(const Mesh& mesh, const Triangle& t) {
  const Double3& a = mesh.positions[t[0]];
  const Double3 n = cross(mesh.positions[t[1]] - a, mesh.positions[t[2]] - a);
  const double square = dot(n, n);
  // The cheap way, but for triangles of less than 1e-75 m and more than 1e75 m.
  return (square > 1e-300 && square < 1e300 ? std::sqrt(square) : length(n)) / 2;
}

// A triangle's corners, by which its footprint is found.
struct Key {
  std::array<Float2, 3> corners{};
  std::uint64_t hash = 0;
  double area = 0;
};

// Finds footprints by their corners: an open-addressed table of indices into the list.
class Table {
 public:
  explicit Table(std::vector<Footprint>& list) : list_(list), slots_(64, k_none) {}

  Footprint& find_or_add(const Key& key) {
    if (2 * (list_.size() + 1) > slots_.size()) grow();
    std::uint32_t& slot = slots_[slot_of(key.corners, key.hash)];
    if (slot == k_none) {
      slot = static_cast<std::uint32_t>(list_.size());
      list_.push_back({key.corners, 0});
    }
    return list_[slot];
  }
  // What find_or_add() will need first, and then.
  void fetch_slot(const Key& key) const { __builtin_prefetch(&slots_[key.hash & (slots_.size() - 1)]); }
  void fetch_footprint(const Key& key) const {
    const std::uint32_t slot = slots_[key.hash & (slots_.size() - 1)];
    if (slot != k_none) __builtin_prefetch(&list_[slot]);
  }

 private:
  std::size_t slot_of(const std::array<Float2, 3>& corners, std::uint64_t hash) const {
    std::size_t s = hash & (slots_.size() - 1);
    while (slots_[s] != k_none && list_[slots_[s]].corners != corners) s = (s + 1) & (slots_.size() - 1);
    return s;
  }
  // By so much that all growing together costs a third of the adding: every slot is a miss of the caches.
  void grow() {
    slots_.assign(4 * slots_.size(), k_none);
    for (std::uint32_t i = 0; i < list_.size(); ++i) {
      slots_[slot_of(list_[i].corners, hash_of(list_[i].corners))] = i;
    }
  }

  std::vector<Footprint>& list_;
  std::vector<std::uint32_t> slots_;
};

}  // namespace

Footprints footprints(const Mesh& mesh, std::span<const std::uint32_t> triangles, double tiles) {
  // Nearly every look-up misses the caches, so they are asked for a block ahead, first the slot, then the
  // footprint.
  constexpr std::size_t k_block = 32;
  Footprints out;
  Table table(out.list);
  std::vector<Key> keys;
  keys.reserve(k_block);
  for (std::size_t begin = 0; begin < triangles.size(); begin += k_block) {
    keys.clear();
    for (const std::uint32_t t : triangles.subspan(begin, std::min(k_block, triangles.size() - begin))) {
      Key key;
      key.area = area_of(mesh, mesh.triangles[t]);
      if (read_corners(mesh, t, tiles, key.corners)) {
        key.hash = hash_of(key.corners);
        table.fetch_slot(key);
        keys.push_back(key);
      } else {
        out.whole_area += key.area;
        ++out.whole;
      }
    }
    for (const Key& key : keys) table.fetch_footprint(key);
    for (const Key& key : keys) table.find_or_add(key).area += key.area;
  }
  return out;
}

}  // namespace copse
