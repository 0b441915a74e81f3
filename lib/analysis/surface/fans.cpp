#include "lib/analysis/surface/fans.h"

#include <algorithm>
#include <array>

namespace copse {
namespace {

using Key = std::array<std::uint32_t, 3>;  // the two higher vertices, then the triangle

Key key_of(const Triangle& t, std::uint32_t id) {
  const auto [low, high] = std::minmax({t[0], t[1], t[2]});
  const std::uint32_t middle = t[0] ^ t[1] ^ t[2] ^ low ^ high;
  return {middle, high, id};
}

void fill(Fans& fans, std::size_t vertices, std::span<const Triangle> triangles,
          std::span<const std::uint8_t> skipped) {
  fans.first.assign(vertices + 1, 0);
  const auto is_skipped = [&](std::size_t t) { return !skipped.empty() && skipped[t]; };
  for (std::size_t t = 0; t < triangles.size(); ++t) {
    if (is_skipped(t)) continue;
    for (const std::uint32_t v : triangles[t]) ++fans.first[v + 1];
  }
  for (std::size_t v = 0; v < vertices; ++v) fans.first[v + 1] += fans.first[v];
  fans.triangle.resize(fans.first[vertices]);
  std::vector<std::uint32_t> next(fans.first.begin(), fans.first.end() - 1);
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    if (is_skipped(t)) continue;
    for (const std::uint32_t v : triangles[t]) fans.triangle[next[v]++] = t;
  }
}

void find_repeated(Fans& fans, std::span<const Triangle> triangles) {
  std::vector<Key> keys;
  for (std::uint32_t v = 0; v + 1 < fans.first.size(); ++v) {
    keys.clear();
    for (const std::uint32_t t : fans.of(v)) {
      if (std::ranges::min(triangles[t]) == v) keys.push_back(key_of(triangles[t], t));
    }
    if (keys.size() < 2) continue;
    std::ranges::sort(keys);
    std::uint32_t lowest = keys[0][2];
    for (std::size_t i = 1; i < keys.size(); ++i) {
      const bool same = keys[i][0] == keys[i - 1][0] && keys[i][1] == keys[i - 1][1];
      if (!same) lowest = keys[i][2];
      if (same) fans.repeated.emplace_back(keys[i][2], lowest);
    }
  }
  std::ranges::sort(fans.repeated);
}

}  // namespace

Fans make_fans(std::size_t vertices, std::span<const Triangle> triangles) {
  Fans fans;
  fill(fans, vertices, triangles, {});
  find_repeated(fans, triangles);
  if (!fans.repeated.empty()) {
    std::vector<std::uint8_t> skipped(triangles.size(), 0);
    for (const auto& [triangle, original] : fans.repeated) skipped[triangle] = 1;
    fill(fans, vertices, triangles, skipped);
  }
  return fans;
}

}  // namespace copse
