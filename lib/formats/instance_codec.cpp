#include "lib/formats/instance_codec.h"

#include <algorithm>
#include <cmath>

namespace copse {
namespace {

constexpr std::uint64_t k_most_steps = (std::uint64_t{1} << k_position_bits) - 1;
constexpr std::uint64_t k_rotation_mask = (std::uint64_t{1} << k_rotation_bits) - 1;
constexpr double k_rotation_zero = static_cast<double>((1 << (k_rotation_bits - 1)) - 1);
constexpr double k_half_root = 0.70710678118654752440;

std::uint64_t steps(double distance, float step) {
  if (!(step > 0)) return 0;
  const double n = std::floor(distance / static_cast<double>(step) + 0.5);
  return static_cast<std::uint64_t>(std::clamp(n, 0.0, static_cast<double>(k_most_steps)));
}

std::uint8_t small_index(std::uint32_t material) {
  return material == k_none ? k_own_material : static_cast<std::uint8_t>(material);
}
std::uint32_t full_index(std::uint8_t material) {
  return material == k_own_material ? k_none : material;
}

}  // namespace

float position_step(double extent) {
  if (!(extent > 0)) return 0;
  int exponent = 0;
  const double fraction = std::frexp(extent / static_cast<double>(k_most_steps), &exponent);
  // A power of two is its own upper bound; float32 holds exponents from -149.
  return static_cast<float>(std::ldexp(1.0, std::max(fraction == 0.5 ? exponent - 1 : exponent, -149)));
}

std::uint64_t pack_position(const Double3& position, const InstanceBlock& block) {
  const Double3 d = position - block.origin;
  return steps(d.x, block.step.x) | steps(d.y, block.step.y) << k_position_bits |
         steps(d.z, block.step.z) << (2 * k_position_bits);
}

Double3 unpack_position(std::uint64_t packed, const InstanceBlock& block) {
  const auto part = [&](std::uint32_t axis, float step) {
    return static_cast<double>(packed >> (axis * k_position_bits) & k_most_steps) * static_cast<double>(step);
  };
  return block.origin + Double3{part(0, block.step.x), part(1, block.step.y), part(2, block.step.z)};
}

std::uint64_t pack_rotation(const Quaternion& rotation) {
  std::size_t largest = 0;
  for (std::size_t i = 1; i < 4; ++i)
    if (std::abs(rotation[i]) > std::abs(rotation[largest])) largest = i;
  const double sign = rotation[largest] < 0 ? -1 : 1;  // q and -q turn alike
  std::uint64_t packed = std::uint64_t{largest} << (3 * k_rotation_bits);
  std::uint32_t shift = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    if (i == largest) continue;
    const double part = std::clamp(sign * rotation[i] / k_half_root, -1.0, 1.0);
    packed |= static_cast<std::uint64_t>(std::floor((part + 1) * k_rotation_zero + 0.5)) << shift;
    shift += k_rotation_bits;
  }
  return packed;
}

Quaternion unpack_rotation(std::uint64_t packed) {
  const std::size_t largest = packed >> (3 * k_rotation_bits) & 3;
  Quaternion q{};
  double rest = 1;
  std::uint32_t shift = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    if (i == largest) continue;
    const double part = static_cast<double>(packed >> shift & k_rotation_mask);
    q[i] = (part - k_rotation_zero) / k_rotation_zero * k_half_root;
    rest -= q[i] * q[i];
    shift += k_rotation_bits;
  }
  q[largest] = std::sqrt(std::max(rest, 0.0));
  return q;
}

std::uint16_t pack_scale(double scale, const TreeType& type) {
  const double low = type.scale_min, span = type.scale_max - low;
  if (!(span > 0)) return 0;
  return static_cast<std::uint16_t>(std::clamp(std::floor((scale - low) / span * 65535 + 0.5), 0.0, 65535.0));
}

double unpack_scale(std::uint16_t packed, const TreeType& type) {
  const double low = type.scale_min, span = type.scale_max - low;
  return low + span * packed / 65535;
}

PackedInstance pack(const Instance& instance, const InstanceBlock& block, const TreeType& type) {
  return {.position = pack_position(instance.position, block),
          .rotation = pack_rotation(instance.rotation),
          .scale = pack_scale(instance.scale, type),
          .tint = instance.tint,
          .trunk_material = small_index(instance.trunk_material),
          .leaf_material = small_index(instance.leaf_material),
          .motion = static_cast<std::uint8_t>(instance.motion)};
}

Instance unpack(const PackedInstance& packed, const InstanceBlock& block, const TreeType& type) {
  return {.position = unpack_position(packed.position, block),
          .rotation = unpack_rotation(packed.rotation),
          .scale = unpack_scale(packed.scale, type),
          .type = block.type,
          .trunk_material = full_index(packed.trunk_material),
          .leaf_material = full_index(packed.leaf_material),
          .motion = packed.motion,
          .tint = packed.tint};
}

ExactInstance pack_exactly(const Instance& instance, const InstanceBlock& block) {
  ExactInstance e{.position = to_float(instance.position - block.origin),
                  .scale = static_cast<float>(instance.scale),
                  .trunk_material = instance.trunk_material,
                  .leaf_material = instance.leaf_material,
                  .motion = instance.motion,
                  .tint = {instance.tint[0], instance.tint[1], instance.tint[2], 0}};
  for (std::size_t i = 0; i < 4; ++i) e.rotation[i] = static_cast<float>(instance.rotation[i]);
  return e;
}

Instance unpack(const ExactInstance& exact, const InstanceBlock& block) {
  Instance i{.position = block.origin + to_double(exact.position),
             .scale = exact.scale,
             .type = block.type,
             .trunk_material = exact.trunk_material,
             .leaf_material = exact.leaf_material,
             .motion = exact.motion,
             .tint = {exact.tint[0], exact.tint[1], exact.tint[2]}};
  for (std::size_t c = 0; c < 4; ++c) i.rotation[c] = exact.rotation[c];
  return i;
}

Instance instance_of(const Ecosystem& eco, const InstanceBlock& block, std::size_t index) {
  return eco.exact.empty() ? unpack(eco.packed[index], block, eco.types[block.type])
                           : unpack(eco.exact[index], block);
}

Double3 rotate(const Quaternion& q, const Double3& v) {
  const Double3 u{q[0], q[1], q[2]};
  const Double3 t = cross(u, v) * 2.0;
  return v + t * q[3] + cross(u, t);
}

DoubleBox transformed(const FloatBox& box, const Instance& instance) {
  if (box.empty()) return {};
  // |R| applied to half the extent: the same box as that of the eight corners, at a third of the price.
  const Double3 low = to_double(box.min), high = to_double(box.max);
  const Double3 centre = rotate(instance.rotation, (low + high) * (0.5 * instance.scale));
  const Double3 half = (high - low) * (0.5 * instance.scale);
  const Double3 x = rotate(instance.rotation, {half.x, 0, 0}), y = rotate(instance.rotation, {0, half.y, 0}),
                z = rotate(instance.rotation, {0, 0, half.z});
  const Double3 reach{std::abs(x.x) + std::abs(y.x) + std::abs(z.x),
                      std::abs(x.y) + std::abs(y.y) + std::abs(z.y),
                      std::abs(x.z) + std::abs(y.z) + std::abs(z.z)};
  return {instance.position + centre - reach, instance.position + centre + reach};
}

}  // namespace copse
