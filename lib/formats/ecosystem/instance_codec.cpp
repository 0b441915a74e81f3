#include "lib/formats/ecosystem/instance_codec.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace copse {
namespace {

constexpr std::uint64_t k_most_steps = (std::uint64_t{1} << k_position_bits) - 1;
constexpr std::int64_t k_axis_zero = (std::int64_t{1} << (k_axis_bits - 1)) - 1;
constexpr std::int64_t k_head_zero = (std::int64_t{1} << (k_head_bits - 1)) - 1;
constexpr std::uint64_t k_axis_mask = (std::uint64_t{1} << k_axis_bits) - 1;

std::uint64_t steps(double distance, float step) {
  if (!(step > 0)) return 0;
  const double n = std::floor(distance / static_cast<double>(step) + 0.5);
  return static_cast<std::uint64_t>(std::clamp(n, 0.0, static_cast<double>(k_most_steps)));
}

// A point of the octahedron whose lower half is folded outwards: x and z in steps of 1 / k_axis_zero.
struct OctahedralPoint {
  std::int64_t x = 0, z = 0;
};

std::int64_t nearest_step(double v, std::int64_t zero) {
  return std::clamp(static_cast<std::int64_t>(std::floor(v * static_cast<double>(zero) + 0.5)), -zero, zero);
}

// On the octahedron of size k_axis_zero, so in whole numbers.
Double3 direction_of(const OctahedralPoint& p) {
  const std::int64_t across = std::abs(p.x), down = std::abs(p.z), y = k_axis_zero - across - down;
  if (y >= 0) return {static_cast<double>(p.x), static_cast<double>(y), static_cast<double>(p.z)};
  const auto x = static_cast<double>(k_axis_zero - down), z = static_cast<double>(k_axis_zero - across);
  return {p.x < 0 ? -x : x, static_cast<double>(y), p.z < 0 ? -z : z};
}

// Of the four around the direction `n` that which is nearest in angle; ties the first.
OctahedralPoint nearest_point(const Double3& n) {
  const double sum = std::abs(n.x) + std::abs(n.y) + std::abs(n.z);
  double x = n.x / sum, z = n.z / sum;
  if (n.y < 0) {
    const double folded = (1 - std::abs(z)) * (x < 0 ? -1 : 1);
    z = (1 - std::abs(x)) * (z < 0 ? -1 : 1);
    x = folded;
  }
  const auto low = [](double v) {
    const auto step = static_cast<std::int64_t>(std::floor(v * static_cast<double>(k_axis_zero)));
    return std::clamp(step, -k_axis_zero, k_axis_zero - 1);
  };
  const std::int64_t x0 = low(x), z0 = low(z);
  OctahedralPoint best;
  double least = std::numeric_limits<double>::infinity();
  for (const OctahedralPoint p : {OctahedralPoint{x0, z0}, {x0 + 1, z0}, {x0, z0 + 1}, {x0 + 1, z0 + 1}}) {
    const Double3 d = direction_of(p), off = cross(n, d);
    const double error = dot(off, off) / dot(d, d);
    if (error < least) least = error, best = p;
  }
  return best;
}

// The shortest rotation from +Y to the direction `d` of any length; half a turn about x to -Y.
Quaternion shortest_from_y(const Double3& d) {
  const double across = d.x * d.x + d.z * d.z, size = std::sqrt(across + d.y * d.y);
  // size + d.y, without cancellation.
  const double w = d.y >= 0 ? size + d.y : across / (size - d.y);
  if (!(w > 0)) return {1, 0, 0, 0};
  const double length = std::sqrt(across + w * w);
  return {d.z / length, 0, -d.x / length, w / length};
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
  const Double3 axis = rotate(rotation, {0, 1, 0});
  const OctahedralPoint point = nearest_point(axis);
  const Quaternion tilt = shortest_from_y(direction_of(point));
  // What is left, conj(tilt) * rotation, turns about y: its y and w, of the sign that makes w >= 0.
  double y = tilt[3] * rotation[1] - tilt[2] * rotation[0] + tilt[0] * rotation[2];
  double w = tilt[3] * rotation[3] + tilt[0] * rotation[0] + tilt[2] * rotation[2];
  if (w < 0 || (w == 0 && y < 0)) y = -y, w = -w;
  const double length = std::sqrt(y * y + w * w);
  const double tangent = length > 0 ? y / (length + w) : 0;
  const auto head = static_cast<std::uint64_t>(nearest_step(tangent, k_head_zero) + k_head_zero);
  return static_cast<std::uint64_t>(point.x + k_axis_zero) |
         static_cast<std::uint64_t>(point.z + k_axis_zero) << k_axis_bits | head << (2 * k_axis_bits);
}

Quaternion unpack_rotation(std::uint64_t packed) {
  const OctahedralPoint point{static_cast<std::int64_t>(packed & k_axis_mask) - k_axis_zero,
                              static_cast<std::int64_t>(packed >> k_axis_bits & k_axis_mask) - k_axis_zero};
  const Quaternion tilt = shortest_from_y(direction_of(point));
  const double t = static_cast<double>(static_cast<std::int64_t>(packed >> (2 * k_axis_bits)) - k_head_zero) /
                   static_cast<double>(k_head_zero);
  const double sine = 2 * t / (1 + t * t), cosine = (1 - t * t) / (1 + t * t);  // of half the head
  return {tilt[0] * cosine - tilt[2] * sine, tilt[3] * sine, tilt[0] * sine + tilt[2] * cosine,
          tilt[3] * cosine};
}

bool is_packed_rotation(std::uint64_t packed) {
  return (packed & k_axis_mask) != k_axis_mask && (packed >> k_axis_bits & k_axis_mask) != k_axis_mask &&
         packed >> (2 * k_axis_bits) != (std::uint64_t{1} << k_head_bits) - 1;
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
