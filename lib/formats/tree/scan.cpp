#include "lib/formats/tree/scan.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>

namespace copse {
namespace {

// Values at a time, so that a loop over one block has a constant length and unrolls.
constexpr std::size_t k_block = 64;

// Ors what `bad` gives for each value; any set bit of the result means that one is bad.
template <class Bits, class T, class Bad>
Bits any(std::span<const T> values, Bad&& bad) {
  Bits found = 0;
  std::size_t i = 0;
  for (; i + k_block <= values.size(); i += k_block) {
    Bits block = 0;
    for (std::size_t j = 0; j < k_block; ++j) block |= bad(values[i + j]);
    found |= block;
  }
  for (; i < values.size(); ++i) found |= bad(values[i]);
  return found;
}

template <class T>
bool sorted(std::span<const T> values) {
  unsigned found = 0;
  for (std::size_t i = 1; i < values.size(); ++i) found |= static_cast<unsigned>(values[i] < values[i - 1]);
  return found == 0;
}

}  // namespace

bool all_finite(std::span<const float> values) {
  // An exponent of all ones, and only that, carries into the sign.
  const auto found = any<std::uint32_t>(
      values, [](float v) { return (std::bit_cast<std::uint32_t>(v) & 0x7f800000u) + 0x00800000u; });
  return (found & 0x80000000u) == 0;
}

bool all_finite(std::span<const double> values) {
  const auto found = any<std::uint64_t>(values, [](double v) {
    return (std::bit_cast<std::uint64_t>(v) & 0x7ff0000000000000u) + 0x0010000000000000u;
  });
  return (found & 0x8000000000000000u) == 0;
}

bool all_below(std::span<const std::uint32_t> values, std::uint32_t limit) {
  return any<std::uint32_t>(values,
                            [&](std::uint32_t v) { return static_cast<std::uint32_t>(v >= limit); }) == 0;
}

bool all_below_or_none(std::span<const std::uint32_t> values, std::uint32_t limit) {
  // k_none + 1 wraps to 0.
  return any<std::uint32_t>(values,
                            [&](std::uint32_t v) { return static_cast<std::uint32_t>(v + 1 > limit); }) == 0;
}

bool corners_below(std::span<const CornerTriangle> triangles, std::uint32_t vertices, std::uint32_t normals,
                   std::uint32_t texcoords) {
  // Four triangles are 36 indices: a whole number of vector registers. Vertices are tested by v >= limit, as
  // v + 0 > limit - 1; the others by v + 1 > limit, where k_none wraps to 0.
  if (vertices == 0) return triangles.empty();
  std::array<std::uint32_t, 36> add{}, limit{};
  for (std::size_t i = 0; i < 36; ++i) {
    const std::size_t column = i % 9 / 3;
    add[i] = column == 0 ? 0 : 1;
    limit[i] = column == 0 ? vertices - 1 : column == 1 ? normals : texcoords;
  }
  const auto* words = reinterpret_cast<const std::uint32_t*>(triangles.data());
  const std::size_t size = triangles.size() * 9;
  std::array<std::uint32_t, 36> found{};
  std::size_t i = 0;
  for (; i + 36 <= size; i += 36) {
    for (std::size_t j = 0; j < 36; ++j)
      found[j] |= static_cast<std::uint32_t>(words[i + j] + add[j] > limit[j]);
  }
  for (std::size_t j = 0; i < size; ++i, ++j)
    found[j] |= static_cast<std::uint32_t>(words[i] + add[j] > limit[j]);
  return std::all_of(found.begin(), found.end(), [](std::uint32_t f) { return f == 0; });
}

bool non_decreasing(std::span<const std::uint32_t> values) {
  return sorted(values);
}
bool non_decreasing(std::span<const float> values) {
  return sorted(values);
}
bool non_decreasing(std::span<const double> values) {
  return sorted(values);
}

FloatBox box_of(std::span<const Float3> points) {
  // Four points at a time: twelve floats fill whole registers.
  if (points.empty()) return {};
  std::array<float, 12> low{}, high{};
  for (std::size_t j = 0; j < 12; ++j) low[j] = high[j] = points[0][static_cast<int>(j % 3)];
  const auto* f = reinterpret_cast<const float*>(points.data());
  const std::size_t size = points.size() * 3;
  std::size_t i = 0;
  for (; i + 12 <= size; i += 12) {
    for (std::size_t j = 0; j < 12; ++j) {
      low[j] = f[i + j] < low[j] ? f[i + j] : low[j];
      high[j] = f[i + j] > high[j] ? f[i + j] : high[j];
    }
  }
  for (std::size_t j = 0; i < size; ++i, ++j)
    low[j] = std::min(low[j], f[i]), high[j] = std::max(high[j], f[i]);
  FloatBox box;
  for (std::size_t j = 0; j < 12; j += 3) {
    box.grow(Float3{low[j], low[j + 1], low[j + 2]});
    box.grow(Float3{high[j], high[j + 1], high[j + 2]});
  }
  return box;
}

}  // namespace copse
