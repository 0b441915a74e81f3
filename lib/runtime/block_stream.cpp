#include "lib/runtime/block_stream.h"

#include "lib/formats/ecosystem/check_ecosystem.h"
#include "lib/formats/ecosystem/instance_bounds.h"
#include "lib/formats/ecosystem/instance_codec.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace copse {
namespace {

constexpr std::size_t k_page = 4096;

// The bytes of all instances as they are stored.
std::span<const std::uint8_t> stored(const Ecosystem& eco) {
  return eco.exact.empty() ? eco.packed.as_bytes().span() : eco.exact.as_bytes().span();
}

std::size_t stride(const Ecosystem& eco) {
  return eco.exact.empty() ? sizeof(PackedInstance) : sizeof(ExactInstance);
}

std::size_t page_of(const std::uint8_t* byte) {
  return reinterpret_cast<std::uintptr_t>(byte) / k_page;
}

}  // namespace

BlockStream::BlockStream(const Ecosystem& eco, std::size_t budget)
    : eco_(eco), budget_(budget), blocks_(eco.blocks.size()), read_(eco.blocks.size()) {
  for (const TreeType& type : eco.types) spheres_.push_back({sphere_of(type, false), sphere_of(type, true)});
  const auto bytes = stored(eco);
  if (!bytes.empty()) pages_.resize(page_of(&bytes.back()) - page_of(bytes.data()) + 1);
}

// Round the box that instance_bounds gives an instance that stands upright at the origin; a bounding sphere
// of the type itself where that is smaller.
BlockStream::Sphere BlockStream::sphere_of(const TreeType& type, bool moves) {
  const DoubleBox box = instance_bounds(type, {.motion = moves ? 1u : 0u});
  if (box.empty()) return {};
  Sphere sphere{box.centre(), length(box.extent()) / 2};
  for (const Volume<float>& v : moves && !type.envelopes.empty() ? type.envelopes : type.volumes) {
    const auto* round = std::get_if<BoundingSphere<float>>(&v);
    if (round && double{round->radius} < sphere.radius)
      sphere = {to_double(round->centre), double{round->radius}};
  }
  return sphere;
}

double reach_from_foot(const TreeType& type) {
  double reach = 0;
  for (const bool moves : {false, true}) {
    const BlockStream::Sphere sphere = BlockStream::sphere_of(type, moves);
    if (sphere.radius >= 0) reach = std::max(reach, length(sphere.centre) + sphere.radius);
  }
  return reach;
}

StreamedInstance BlockStream::ready(const InstanceBlock& block, std::size_t index) const {
  const Instance i = instance_of(eco_, block, index);
  const Double3 x = rotate(i.rotation, {i.scale, 0, 0}), y = rotate(i.rotation, {0, i.scale, 0}),
                z = rotate(i.rotation, {0, 0, i.scale}), p = i.position - eco_.origin;
  StreamedInstance out;
  for (int r = 0; r < 3; ++r)
    out.rows[static_cast<std::size_t>(r)] = {static_cast<float>(x[r]), static_cast<float>(y[r]),
                                             static_cast<float>(z[r]), static_cast<float>(p[r])};
  const Sphere& sphere = spheres_[block.type][i.motion == 0 ? 0 : 1];
  if (sphere.radius >= 0) {
    const Double3 centre = p + rotate(i.rotation, sphere.centre * i.scale);
    out.centre = to_float(centre);
    // Wider by what float32 makes of the centre and of the matrix.
    const double rounding = 0x1p-22 * (length(p) + i.scale * (length(sphere.centre) + sphere.radius));
    out.radius = round_up(sphere.radius * i.scale + rounding);
  }
  out.scale = static_cast<float>(i.scale);
  out.trunk_material = i.trunk_material, out.leaf_material = i.leaf_material, out.motion = i.motion;
  out.tint = {i.tint[0], i.tint[1], i.tint[2], 255};
  return out;
}

void BlockStream::count(const InstanceBlock& block) {
  const auto bytes = stored(eco_).subspan(block.first * stride(eco_), block.count * stride(eco_));
  ++counts_.blocks;
  counts_.instances += block.count;
  counts_.bytes += bytes.size();
  const std::size_t first = page_of(stored(eco_).data());
  for (std::size_t p = page_of(&bytes.front()) - first; p <= page_of(&bytes.back()) - first; ++p) {
    counts_.pages += !pages_[p];
    pages_[p] = true;
  }
}

std::span<const StreamedInstance> BlockStream::block(std::uint32_t index) {
  Kept& kept = blocks_[index];
  kept.used = frame_;
  if (!kept.instances.empty()) return kept.instances;
  const InstanceBlock& block = eco_.blocks[index];
  if (!read_[index]) {
    count(block);
    read_[index] = true;
    if (!is_sound_block(eco_, index)) damaged_ = std::min(damaged_, index);
  }
  if (damaged_ == index || (damaged_ != k_none && !is_sound_block(eco_, index))) return {};
  kept.instances.reserve(block.count);
  for (std::size_t i = block.first; i < std::size_t{block.first} + block.count; ++i)
    kept.instances.push_back(ready(block, i));
  counts_.unpacked += block.count;
  kept_ += block.count * sizeof(StreamedInstance);
  held_.push_back(index);
  return kept.instances;
}

void BlockStream::next_frame() {
  if (kept_ > budget_) {
    // Ties by number: what goes does not depend on the order in which blocks were asked for.
    std::sort(held_.begin(), held_.end(), [&](std::uint32_t a, std::uint32_t b) {
      return blocks_[a].used != blocks_[b].used ? blocks_[a].used > blocks_[b].used : a < b;
    });
    while (!held_.empty() && kept_ > budget_ && blocks_[held_.back()].used < frame_) {
      Kept& gone = blocks_[held_.back()];
      kept_ -= gone.instances.size() * sizeof(StreamedInstance);
      gone.instances = {};
      held_.pop_back();
    }
  }
  ++frame_;
}

}  // namespace copse
