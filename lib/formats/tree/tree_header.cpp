#include "lib/formats/tree/tree_header.h"

#include "lib/formats/little_endian.h"

#include <fmt/format.h>

namespace copse {
namespace {

enum HeadFlags : std::uint32_t {
  flag_monotone = 1,
  flag_trunk_materials = 2,
  flag_leaf_materials = 4,
  known_flags = 7
};

constexpr std::size_t k_flags_offset = 92;
constexpr std::size_t k_leaf_order_offset = 96;

// One walk over the fields in file order serves both directions, so that they cannot drift apart.
template <class Field>
void walk(Field&& field, Head& h, std::uint32_t& flags, std::uint32_t& leaf_order) {
  TreeHeader& t = h.header;
  TreeCounts& c = h.counts;
  field(t.origin);
  field(t.bounds.min), field(t.bounds.max);
  field(t.trunk_bounds.min), field(t.trunk_bounds.max);
  field(t.area_density_centre);
  field(t.mean_trunk_area), field(t.mean_leaf_area);
  field(flags), field(leaf_order);
  field(c.trunk_triangles), field(c.trunk_vertices), field(c.trunk_normals), field(c.trunk_texcoords);
  field(c.segments), field(c.line_vertices);
  field(c.leaf_triangles), field(c.leaves), field(c.leaf_vertices), field(c.leaf_normals);
  field(c.leaf_texcoords), field(c.groups), field(c.group_nodes);
  field(t.roots), field(c.radii), field(t.ring_size), field(t.segment_factor), field(t.leaf_factor);
  field(t.unexplained);
  field(h.trunk_material), field(h.leaf_material);
  field(c.materials), field(c.textures);
}

TreeCounts count(const Tree& tree) {
  const auto n = [](const auto& array) { return static_cast<std::uint32_t>(array.size()); };
  const bool sensitive = tree.header.kind == TreeKind::sensitive;
  return {.trunk_triangles = n(tree.trunk.triangles),
          .trunk_vertices = sensitive ? n(tree.hierarchy.vectors) : n(tree.trunk.vertices),
          .trunk_normals = n(tree.trunk.normals),
          .trunk_texcoords = n(tree.trunk.texcoords),
          .segments = static_cast<std::uint32_t>(tree.segment_count()),
          .line_vertices = n(tree.trunk.line_vertices),
          .leaf_triangles = n(tree.leaves.triangles),
          .leaves = static_cast<std::uint32_t>(tree.leaf_count()),
          .leaf_vertices = n(tree.leaves.vertices),
          .leaf_normals = n(tree.leaves.normals),
          .leaf_texcoords = n(tree.leaves.texcoords),
          .groups = n(tree.leaves.groups),
          .group_nodes = n(tree.leaves.group_hierarchy),
          .radii = n(tree.hierarchy.radii),
          .materials = n(tree.materials),
          .textures = n(tree.textures)};
}

}  // namespace

Head head_of(const Tree& tree) {
  return {.header = tree.header,
          .counts = count(tree),
          .trunk_material = tree.trunk.material,
          .leaf_material = tree.leaves.material,
          .trunk_materials = !tree.trunk.materials.empty(),
          .leaf_materials = !tree.leaves.materials.empty()};
}

std::vector<std::uint8_t> encode_head(const Head& head) {
  std::vector<std::uint8_t> bytes(k_head_size);
  Head copy = head;
  std::uint32_t flags = 0;
  if (head.header.monotone) flags |= flag_monotone;
  if (head.trunk_materials) flags |= flag_trunk_materials;
  if (head.leaf_materials) flags |= flag_leaf_materials;
  auto leaf_order = static_cast<std::uint32_t>(head.header.leaf_order);
  std::size_t at = 0;
  walk(
      [&](const auto& value) {
        put(std::span(bytes), at, value);
        at += sizeof value;
      },
      copy, flags, leaf_order);
  return bytes;
}

HeadFault decode_head(std::span<const std::uint8_t> bytes, Head& head) {
  if (bytes.size() != k_head_size)
    return {0, fmt::format("it has {} bytes, not {}", bytes.size(), k_head_size)};
  std::uint32_t flags = 0, leaf_order = 0;
  std::size_t at = 0;
  walk(
      [&]<class T>(T& value) {
        value = get<T>(bytes, at);
        at += sizeof value;
      },
      head, flags, leaf_order);
  if (flags & ~std::uint32_t{known_flags}) return {k_flags_offset, fmt::format("unknown flags {:#x}", flags)};
  if (leaf_order > static_cast<std::uint32_t>(LeafOrder::random)) {
    return {k_leaf_order_offset, fmt::format("unknown leaf order {}", leaf_order)};
  }
  if (!all_zero(bytes.subspan(at))) return {at, "reserved bytes are not zero"};
  head.header.monotone = flags & flag_monotone;
  head.trunk_materials = flags & flag_trunk_materials;
  head.leaf_materials = flags & flag_leaf_materials;
  head.header.leaf_order = static_cast<LeafOrder>(leaf_order);
  return {};
}

}  // namespace copse
