#include "lib/formats/ecosystem/ecosystem_header.h"

#include "lib/formats/ecosystem/ecosystem_file.h"
#include "lib/formats/little_endian.h"

#include <cmath>

#include <fmt/format.h>

namespace copse {
namespace {

enum HeadFlags : std::uint32_t { flag_exact = 1, flag_regular = 2, all_flags = 3 };
enum TypeFlags : std::uint32_t { flag_packed = 1 };
constexpr std::size_t k_flags_offset = 80, k_used = 192;

// Every field of the head in its order; `field` reads or writes.
template <class Field, class Eco>
void walk(Field&& field, Eco& eco, EcosystemCounts& c, std::uint32_t& flags) {
  field(eco.origin);
  for (auto& side : eco.area) field(side);
  field(eco.bounds);
  field(flags), field(c.types), field(c.blocks), field(c.instances), field(c.materials), field(c.textures);
  field(eco.depth);
  field(eco.terrain.columns), field(eco.terrain.rows), field(eco.terrain.material);
  field(eco.terrain.origin), field(eco.terrain.spacing_x), field(eco.terrain.spacing_z);
  field(eco.terrain.texture_size);
  field(eco.position_error), field(eco.rotation_error), field(eco.scale_error);
  field(eco.seed);
  field(c.kd_nodes), field(c.rtree_nodes);
}

template <class Field, class Type>
void walk_type(Field&& field, Type& t, std::uint32_t& name, std::uint32_t& uri, std::uint32_t& flags) {
  field(name), field(uri), field(flags), field(t.instances);
  field(t.bounds), field(t.scale_min), field(t.scale_max), field(t.view_range);
  std::uint32_t reserved = 0;
  field(reserved);
  field(t.hash);
}

struct Writer {
  std::vector<std::uint8_t>& bytes;
  template <class T>
  void operator()(const T& value) {
    const std::size_t at = bytes.size();
    bytes.resize(at + sizeof value);
    put(std::span(bytes), at, value);
  }
};

struct Reader {
  std::span<const std::uint8_t> bytes;
  std::size_t at = 0;
  template <class T>
  void operator()(T& value) {
    value = get<T>(bytes, at);
    at += sizeof value;
  }
};

bool finite_or_empty(const FloatBox& b) {
  return b == FloatBox{} || (!b.empty() && is_finite(b.min) && is_finite(b.max));
}

bool non_negative(std::initializer_list<float> values) {
  for (const float v : values)
    if (!(v >= 0 && std::isfinite(v))) return false;
  return true;
}

// Terrain of the head: two sides of 2 to 32768 vertices, or none.
bool sound_terrain(const Terrain& t, bool regular) {
  if (!is_finite(t.origin) || !std::isfinite(t.spacing_x) || !std::isfinite(t.spacing_z)) return false;
  if (!(t.texture_size > 0 && std::isfinite(t.texture_size))) return false;
  if (t.columns == 0 && t.rows == 0) return true;
  const auto side = [](std::uint32_t n) { return n >= 2 && n <= k_max_terrain_side; };
  return side(t.columns) && side(t.rows) && (!regular || (t.spacing_x > 0 && t.spacing_z > 0));
}

}  // namespace

std::vector<std::uint8_t> encode_ecosystem_head(const Ecosystem& eco) {
  EcosystemCounts c{.types = static_cast<std::uint32_t>(eco.types.size()),
                    .blocks = static_cast<std::uint32_t>(eco.blocks.size()),
                    .instances = static_cast<std::uint32_t>(eco.instance_count()),
                    .materials = static_cast<std::uint32_t>(eco.materials.size()),
                    .textures = static_cast<std::uint32_t>(eco.textures.size()),
                    .kd_nodes = static_cast<std::uint32_t>(eco.kd_tree.size()),
                    .rtree_nodes = static_cast<std::uint32_t>(eco.rtree.size())};
  std::uint32_t flags = (eco.exact.empty() ? 0u : flag_exact) | (eco.terrain.regular() ? flag_regular : 0u);
  std::vector<std::uint8_t> bytes;
  bytes.reserve(k_ecosystem_head_size);
  walk(Writer{bytes}, eco, c, flags);
  bytes.resize(k_ecosystem_head_size);
  return bytes;
}

HeadFault decode_ecosystem_head(std::span<const std::uint8_t> bytes, Ecosystem& eco,
                                EcosystemCounts& counts) {
  if (bytes.size() != k_ecosystem_head_size) return {0, fmt::format("{} bytes, expected 256", bytes.size())};
  std::uint32_t flags = 0;
  walk(Reader{bytes}, eco, counts, flags);
  if (flags & ~std::uint32_t{all_flags}) return {k_flags_offset, fmt::format("unknown flags {:#x}", flags)};
  if (!all_zero(bytes.subspan(k_used))) return {k_used, "reserved bytes are not zero"};
  counts.exact = flags & flag_exact;
  counts.regular_terrain = flags & flag_regular;
  if (!is_finite(eco.origin)) return {0, "the origin is not finite"};
  if (!finite_or_empty(eco.bounds)) return {56, "the box is neither finite nor empty"};
  for (const double side : eco.area)
    if (!std::isfinite(side)) return {24, "the planted area is not finite"};
  if (counts.types > k_max_tree_types)
    return {84, fmt::format("{} types, the limit is {}", counts.types, k_max_tree_types)};
  if (eco.depth > k_max_quad_depth)
    return {104, fmt::format("depth {}, the limit is {}", eco.depth, k_max_quad_depth)};
  if (!sound_terrain(eco.terrain, counts.regular_terrain)) return {108, "the terrain's numbers make no grid"};
  if (!non_negative({eco.position_error, eco.rotation_error, eco.scale_error}))
    return {164, "an error is negative or not finite"};
  return {};
}

EncodedTypes encode_types(const std::vector<TreeType>& types) {
  EncodedTypes out;
  for (const TreeType& t : types) {
    auto name = static_cast<std::uint32_t>(t.name.size()), uri = static_cast<std::uint32_t>(t.uri.size());
    std::uint32_t flags = t.packed.empty() ? 0 : std::uint32_t{flag_packed};
    walk_type(Writer{out.records}, t, name, uri, flags);
    out.texts.insert(out.texts.end(), t.name.begin(), t.name.end());
    out.texts.insert(out.texts.end(), t.uri.begin(), t.uri.end());
  }
  return out;
}

RecordFault decode_types(std::span<const std::uint8_t> records, std::span<const std::uint8_t> texts,
                         std::vector<TreeType>& types, std::vector<bool>& packed) {
  types.clear();
  packed.clear();
  for (std::size_t at = 0; at < records.size(); at += k_type_record) {
    TreeType t;
    std::uint32_t name = 0, uri = 0, flags = 0;
    walk_type(Reader{records.subspan(at, k_type_record)}, t, name, uri, flags);
    if (flags > flag_packed) return {at + 8, fmt::format("unknown flags {:#x}", flags)};
    if (get<std::uint32_t>(records, at + 52) != 0) return {at + 52, "reserved bytes are not zero"};
    if (name > texts.size() || uri > texts.size() - name)
      return {at, "its texts are longer than what is left"};
    t.name.assign(texts.begin(), texts.begin() + name);
    t.uri.assign(texts.begin() + name, texts.begin() + name + uri);
    texts = texts.subspan(std::size_t{name} + uri);
    if (!finite_or_empty(t.bounds)) return {at + 16, "the box is neither finite nor empty"};
    if (!non_negative({t.scale_min, t.scale_max, t.view_range}) ||
        !(t.scale_min > 0 && t.scale_min <= t.scale_max))
      return {at + 40, "its scales are no range above 0"};
    types.push_back(std::move(t));
    packed.push_back(flags & flag_packed);
  }
  if (!texts.empty()) return {0, fmt::format("{} bytes of texts belong to none", texts.size())};
  return {};
}

std::string packed_section(std::size_t type) {
  return fmt::format("P{:03X}", type);
}

}  // namespace copse
