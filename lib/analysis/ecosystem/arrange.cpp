#include "lib/analysis/ecosystem/arrange.h"

#include "lib/analysis/ecosystem/hilbert_curve.h"
#include "lib/analysis/ecosystem/tilt.h"
#include "lib/formats/ecosystem/instance_bounds.h"
#include "lib/formats/ecosystem/instance_codec.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_sort.h>

namespace copse {
namespace {

constexpr std::uint32_t k_fine_bits = 12;  // of the curve inside a leaf

struct Key {
  std::uint64_t curve = 0;  // leaf, type, place in the leaf
  std::uint32_t instance = 0;
  friend bool operator<(const Key& a, const Key& b) {
    return a.curve != b.curve ? a.curve < b.curve : a.instance < b.instance;
  }
};

std::uint32_t cell(double at, double low, double high, std::uint32_t cells) {
  const double f = high > low ? (at - low) / (high - low) * cells : 0;
  return static_cast<std::uint32_t>(std::clamp(f, 0.0, cells - 1.0));
}

// 20 bits of leaf, 12 of type, 24 of place: 56.
std::vector<Key> sorted_keys(const std::vector<Instance>& instances, const ArrangeOptions& o,
                             std::uint32_t depth) {
  const std::uint32_t bits = depth + k_fine_bits, cells = std::uint32_t{1} << bits;
  std::vector<Key> keys(instances.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, keys.size(), 4096), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      const Instance& p = instances[i];
      const std::uint64_t h = hilbert_index(cell(p.position.x, o.area[0], o.area[2], cells),
                                            cell(p.position.z, o.area[1], o.area[3], cells), bits);
      const std::uint64_t fine = h & ((std::uint64_t{1} << (2 * k_fine_bits)) - 1);
      keys[i] = {(h >> (2 * k_fine_bits)) << 36 | std::uint64_t{p.type} << 24 | fine,
                 static_cast<std::uint32_t>(i)};
    }
  });
  tbb::parallel_sort(keys.begin(), keys.end());
  return keys;
}

// The largest dimension of a tree, in metres at scale 1; what has none counts as 1 m.
double size_of(const TreeType& type) {
  if (type.bounds.empty()) return 1;
  const Float3 e = type.bounds.extent();
  const double size = std::max({e.x, e.y, e.z});
  return size > 0 ? size : 1;
}

class Cutter {
 public:
  Cutter(const std::vector<Instance>& instances, const std::vector<Key>& keys, const ArrangeOptions& options,
         Ecosystem& eco)
      : instances_(instances), keys_(keys), options_(options), eco_(eco) {}

  // Blocks of one leaf and one type, at most k_block_instances each, and none so wide that rounding its
  // instances' feet would show.
  std::vector<InstanceBlock> cut() {
    std::vector<InstanceBlock> blocks;
    for (std::size_t i = 0; i < keys_.size();) {
      const std::size_t end = end_of_block(i);
      InstanceBlock block;
      block.type = at(i).type;
      block.first = static_cast<std::uint32_t>(i);
      block.count = static_cast<std::uint32_t>(end - i);
      blocks.push_back(block);
      i = end;
    }
    return blocks;
  }

 private:
  const Instance& at(std::size_t i) const { return instances_[keys_[i].instance]; }

  std::size_t end_of_block(std::size_t first) const {
    DoubleBox box;
    double smallest = std::numeric_limits<double>::infinity();
    const double size = size_of(eco_.types[at(first).type]);
    // Rounding moves a foot by at most extent / steps; half of what is allowed stays in reserve.
    const double steps = options_.exact ? 0x1p25 : 0x1p21;
    std::size_t i = first;
    for (; i < keys_.size() && i < first + k_block_instances; ++i) {
      if (keys_[i].curve >> 24 != keys_[first].curve >> 24) break;
      DoubleBox grown = box;
      grown.grow(at(i).position);
      const double thinnest = std::min(smallest, at(i).scale * size);
      const Double3 e = grown.extent();
      // Along x and z rounding moves a tree, not its foot off the ground, so ten times as much is allowed.
      const double extent = std::max({0.1 * e.x, e.y, 0.1 * e.z});
      if (i > first && extent > 0.5 * k_foot_error * thinnest * steps) break;
      box = grown;
      smallest = thinnest;
    }
    return i;
  }

  const std::vector<Instance>& instances_;
  const std::vector<Key>& keys_;
  const ArrangeOptions& options_;
  Ecosystem& eco_;
};

struct Errors {
  double position = 0, rotation = 0, scale = 0;
  void take(const Errors& e) {
    position = std::max(position, e.position);
    rotation = std::max(rotation, e.rotation);
    scale = std::max(scale, e.scale);
  }
};

double angle_between(const Quaternion& a, const Quaternion& b) {
  double plus = 0, minus = 0;
  for (std::size_t i = 0; i < 4; ++i) {
    plus += (a[i] + b[i]) * (a[i] + b[i]);
    minus += (a[i] - b[i]) * (a[i] - b[i]);
  }
  return 2 * std::sqrt(std::min(plus, minus));  // twice the chord: the angle, to third order
}

// `put` is `meant` with the tilt of the ground under where it is stored: there, not where it was meant.
Errors errors_of(const Instance& meant, const Instance& put, const Instance& stored) {
  return {distance(meant.position, stored.position), angle_between(put.rotation, stored.rotation),
          std::abs(stored.scale / meant.scale - 1)};
}

// The block's frame: origin at the lower corner for packed instances, in the middle for exact ones.
void frame(InstanceBlock& block, const DoubleBox& box, bool exact) {
  block.origin = exact ? box.centre() : box.min;
  if (exact) return;
  const Double3 e = box.extent();
  block.step = {position_step(e.x), position_step(e.y), position_step(e.z)};
}

Double3 stored_position(const Instance& i, const InstanceBlock& block, bool exact) {
  if (exact) return block.origin + to_double(to_float(i.position - block.origin));
  return unpack_position(pack_position(i.position, block), block);
}

// What is to be stored: x and z as they are meant, y and tilt as the ground is under where they are after
// rounding. The block's frame then fits these feet.
std::vector<Instance> planted(const std::vector<Instance>& meant, const ArrangeOptions& o,
                              InstanceBlock& block) {
  DoubleBox feet;
  for (const Instance& i : meant) feet.grow(i.position);
  frame(block, feet, o.exact);
  if (!o.ground) return meant;
  std::vector<Instance> out = meant;
  DoubleBox grounded;
  for (Instance& i : out) {
    const Double3 at = stored_position(i, block, o.exact);
    if (i.on_ground || i.along_normal) {
      const auto here = o.ground->at(at.x, at.z);
      if (here && i.on_ground) i.position.y = here->height;
      if (here && i.along_normal) i.rotation = leaned(i.rotation, here->normal);
    }
    grounded.grow(i.position);
  }
  frame(block, grounded, o.exact);  // x and z are those of before, so the ground under them is, too
  return out;
}

void pack_block(const std::vector<Instance>& instances, const std::vector<Key>& keys, const ArrangeOptions& o,
                Ecosystem& eco, InstanceBlock& block, PackedInstance* packed, ExactInstance* exact,
                Errors& errors) {
  const TreeType& type = eco.types[block.type];
  std::vector<Instance> meant(block.count);
  for (std::size_t i = 0; i < block.count; ++i) meant[i] = instances[keys[block.first + i].instance];
  const std::vector<Instance> feet = planted(meant, o, block);
  DoubleBox bounds;
  for (std::size_t i = 0; i < block.count; ++i) {
    if (o.exact) exact[block.first + i] = pack_exactly(feet[i], block);
    if (!o.exact) packed[block.first + i] = pack(feet[i], block, type);
    const Instance stored =
        o.exact ? unpack(exact[block.first + i], block) : unpack(packed[block.first + i], block, type);
    errors.take(errors_of(meant[i], feet[i], stored));
    bounds.grow(instance_bounds(type, stored));
  }
  if (bounds.empty()) return;
  // Rounding of this sum and of a reader's: a few units in the last place.
  const double slack = 1e-14 * (length(eco.origin) + length(bounds.min) + length(bounds.max));
  const Double3 s{slack, slack, slack};
  block.bounds = round_outward({bounds.min - eco.origin - s, bounds.max - eco.origin + s});
}

std::vector<QuadNode> boxes_over(const std::vector<InstanceBlock>& blocks, const std::vector<Key>& keys,
                                 std::uint32_t depth) {
  std::vector<QuadNode> nodes(first_quad_node(depth + 1));
  const std::uint32_t leaves = first_quad_node(depth);
  for (std::uint32_t b = 0; b < blocks.size(); ++b) {
    QuadNode& leaf = nodes[leaves + (keys[blocks[b].first].curve >> 36)];
    leaf.bounds.grow(blocks[b].bounds);
    ++leaf.block_count;
  }
  std::uint32_t next = 0;
  for (std::size_t i = leaves; i < nodes.size(); ++i) {
    nodes[i].first_block = next;
    next += nodes[i].block_count;
  }
  for (std::uint32_t level = depth; level-- > 0;) {
    const std::uint32_t first = first_quad_node(level), children = first_quad_node(level + 1);
    for (std::uint32_t i = first; i < children; ++i) {
      nodes[i].first_block = nodes[children + 4 * (i - first)].first_block;
      for (std::uint32_t c = 0; c < 4; ++c) {
        const QuadNode& child = nodes[children + 4 * (i - first) + c];
        nodes[i].bounds.grow(child.bounds);
        nodes[i].block_count += child.block_count;
      }
    }
  }
  return nodes;
}

Result<void> check_indices(const std::vector<Instance>& instances, const Ecosystem& eco) {
  if (eco.materials.size() >= k_own_material)
    return refuse("", fmt::format("{} materials do not fit instances of 24 bytes", eco.materials.size()),
                  "use fewer than 255, or \"encoding\": \"exact\"");
  for (const Instance& i : instances)
    if (i.motion > 255)
      return refuse("", fmt::format("motion {} does not fit instances of 24 bytes", i.motion),
                    "use motions up to 255, or \"encoding\": \"exact\"");
  return {};
}

void count_types(const std::vector<Instance>& instances, Ecosystem& eco) {
  std::vector<std::uint32_t> counts(eco.types.size());
  for (const Instance& i : instances) {
    TreeType& t = eco.types[i.type];
    const float low = round_down(i.scale), high = round_up(i.scale);
    t.scale_min = counts[i.type] == 0 ? low : std::min(t.scale_min, low);
    t.scale_max = counts[i.type] == 0 ? high : std::max(t.scale_max, high);
    ++counts[i.type];
  }
  for (std::size_t t = 0; t < counts.size(); ++t) eco.types[t].instances = counts[t];
}

}  // namespace

std::uint32_t usual_depth(std::size_t instances) {
  std::uint32_t depth = 0;
  while (depth < k_max_quad_depth && instances > (std::uint64_t{2000} << (2 * depth))) ++depth;
  return depth;
}

Result<std::vector<std::uint32_t>> arrange(const std::vector<Instance>& instances,
                                           const ArrangeOptions& options, Ecosystem& eco) {
  if (!options.exact)
    if (auto fits = check_indices(instances, eco); !fits) return std::unexpected(fits.error());
  count_types(instances, eco);
  eco.area = options.area;
  eco.depth = options.depth == k_none ? usual_depth(instances.size()) : options.depth;
  const std::vector<Key> keys = sorted_keys(instances, options, eco.depth);
  std::vector<InstanceBlock> blocks = Cutter(instances, keys, options, eco).cut();
  std::vector<PackedInstance> packed(options.exact ? 0 : keys.size());
  std::vector<ExactInstance> exact(options.exact ? keys.size() : 0);
  std::vector<Errors> errors(blocks.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, blocks.size(), 16), [&](const auto& range) {
    for (std::size_t b = range.begin(); b < range.end(); ++b)
      pack_block(instances, keys, options, eco, blocks[b], packed.data(), exact.data(), errors[b]);
  });
  Errors worst;
  for (const Errors& e : errors) worst.take(e);
  eco.position_error = round_up(worst.position);
  eco.rotation_error = round_up(worst.rotation);
  eco.scale_error = round_up(worst.scale);
  eco.boxes = blocks.empty() ? std::vector<QuadNode>() : boxes_over(blocks, keys, eco.depth);
  for (const InstanceBlock& b : blocks) eco.bounds.grow(b.bounds);
  eco.blocks = std::move(blocks);
  eco.packed = std::move(packed);
  eco.exact = std::move(exact);
  std::vector<std::uint32_t> order(keys.size());
  for (std::size_t i = 0; i < keys.size(); ++i) order[i] = keys[i].instance;
  return order;
}

}  // namespace copse
