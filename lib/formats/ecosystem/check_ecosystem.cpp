#include "lib/formats/ecosystem/check_ecosystem.h"

#include "lib/formats/ecosystem/ecosystem_file.h"
#include "lib/formats/ecosystem/instance_bounds.h"
#include "lib/formats/ecosystem/instance_codec.h"
#include "lib/formats/hash.h"
#include "lib/formats/tree/scan.h"

#include <cmath>

#include <fmt/format.h>

namespace copse {
namespace {

bool is_power_of_two_or_zero(float v) {
  int exponent = 0;
  return v == 0 || (v > 0 && std::isfinite(v) && std::frexp(v, &exponent) == 0.5f);
}

bool contains(const FloatBox& outer, const FloatBox& inner) {
  return inner.empty() ||
         (outer.min.x <= inner.min.x && outer.min.y <= inner.min.y && outer.min.z <= inner.min.z &&
          outer.max.x >= inner.max.x && outer.max.y >= inner.max.y && outer.max.z >= inner.max.z);
}

void check_materials(const Ecosystem& eco, Findings& findings) {
  for (std::size_t i = 0; i < eco.materials.size(); ++i) {
    const Material& m = eco.materials[i];
    const float numbers[] = {m.ambient.x,     m.ambient.y,     m.ambient.z,     m.diffuse.x,
                             m.diffuse.y,     m.diffuse.z,     m.specular.x,    m.specular.y,
                             m.specular.z,    m.emission.x,    m.emission.y,    m.emission.z,
                             m.shininess,     m.alpha,         m.alpha_cutoff,  m.mean_colour.x,
                             m.mean_colour.y, m.mean_colour.z, m.alpha_coverage};
    for (const float n : numbers)
      if (!(n >= 0 && std::isfinite(n))) {
        findings.add("MATL", i, "a number is negative or not finite");
        break;
      }
    if (m.texture != k_none && m.texture >= eco.textures.size())
      findings.add("MATL", i, "texture out of range");
  }
  const std::uint32_t m = eco.terrain.material;
  if (m != k_none && m >= eco.materials.size())
    findings.add("EHED", Finding::k_no_element, "the terrain's material is out of range");
}

void check_terrain(const Terrain& t, Findings& findings) {
  if (!all_finite(t.heights.span())) findings.add("EHGT", Finding::k_no_element, "a height is not finite");
  if (!all_finite(as_floats(t.points.span())))
    findings.add("EPNT", Finding::k_no_element, "a vertex is not finite");
}

void check_blocks(const Ecosystem& eco, Findings& findings) {
  std::uint64_t next = 0;
  std::vector<std::uint64_t> of_type(eco.types.size());
  for (std::size_t i = 0; i < eco.blocks.size(); ++i) {
    const InstanceBlock& b = eco.blocks[i];
    if (b.first != next || b.count == 0)
      return findings.add("EBLK", i, "its instances do not follow those before");
    next += b.count;
    if (next > eco.instance_count()) return findings.add("EBLK", i, "more instances than there are");
    if (b.type >= eco.types.size()) return findings.add("EBLK", i, "type out of range");
    of_type[b.type] += b.count;
    if (!is_finite(b.origin)) findings.add("EBLK", i, "the origin is not finite");
    for (int a = 0; a < 3; ++a)
      if (!is_power_of_two_or_zero(b.step[a]) || (!eco.exact.empty() && b.step[a] != 0))
        findings.add("EBLK", i, "a step that is no power of two");
    if (!(b.bounds == FloatBox{}) &&
        (b.bounds.empty() || !is_finite(b.bounds.min) || !is_finite(b.bounds.max)))
      findings.add("EBLK", i, "the box is neither finite nor empty");
    if (b.reserved0 != 0 || b.reserved1 != 0) findings.add("EBLK", i, "reserved bytes are not zero");
  }
  if (next != eco.instance_count()) findings.add("EBLK", eco.blocks.size(), "instances belong to no block");
  for (std::size_t i = 0; i < of_type.size(); ++i)
    if (of_type[i] != eco.types[i].instances)
      findings.add("ETYP", i, "its number of instances is not that of its blocks");
}

// Every bit of the 24 bytes means something, so little can be wrong: bits above the fields, codes of
// rotations that are one step too many, materials.
bool is_sound(const PackedInstance& i, std::uint32_t materials) {
  const auto is_material = [&](std::uint8_t m) { return m == k_own_material || m < materials; };
  return !(i.position >> 63) && is_packed_rotation(i.rotation) && is_material(i.trunk_material) &&
         is_material(i.leaf_material);
}

bool is_rotation(const std::array<float, 4>& rotation) {
  double square = 0;
  for (const float r : rotation) square += static_cast<double>(r) * static_cast<double>(r);
  return std::abs(square - 1) < 1e-5;
}

bool has_materials(const ExactInstance& e, std::uint32_t materials) {
  const auto is_material = [&](std::uint32_t m) { return m == k_none || m < materials; };
  return is_material(e.trunk_material) && is_material(e.leaf_material);
}

bool is_sound(const ExactInstance& e, std::uint32_t materials) {
  return is_finite(e.position) && is_rotation(e.rotation) && e.scale > 0 && std::isfinite(e.scale) &&
         has_materials(e, materials) && e.tint[3] == 0;
}

template <class T>
bool all_sound(std::span<const T> instances, std::uint32_t materials) {
  std::size_t bad = 0;
  for (const T& i : instances) bad += !is_sound(i, materials);
  return bad == 0;
}

void check_packed(const Ecosystem& eco, Findings& findings) {
  const auto materials = static_cast<std::uint32_t>(eco.materials.size());
  if (all_sound(eco.packed.span(), materials)) return;
  for (std::size_t i = 0; i < eco.packed.size(); ++i)
    if (!is_sound(eco.packed[i], materials))
      findings.add("EINS", i, "rotation, material or unused bits are out of range");
}

void check_exact(const Ecosystem& eco, Findings& findings) {
  const auto materials = static_cast<std::uint32_t>(eco.materials.size());
  if (all_sound(eco.exact.span(), materials)) return;
  for (std::size_t i = 0; i < eco.exact.size(); ++i) {
    const ExactInstance& e = eco.exact[i];
    if (!is_finite(e.position) || !is_rotation(e.rotation))
      findings.add("EINX", i, "position or rotation is none");
    if (!(e.scale > 0 && std::isfinite(e.scale))) findings.add("EINX", i, "the scale is not above 0");
    if (!has_materials(e, materials)) findings.add("EINX", i, "material out of range");
    if (e.tint[3] != 0) findings.add("EINX", i, "reserved bytes are not zero");
  }
}

void check_hashes(const Ecosystem& eco, Findings& findings) {
  for (std::size_t i = 0; i < eco.block_hashes.size(); ++i)
    if (hash_of_block(eco, eco.blocks[i]) != eco.block_hashes[i])
      findings.add("EHSH", i, "the hash is not that of the block's instances");
}

void check_nodes(const Ecosystem& eco, Findings& findings) {
  for (std::size_t i = 0; i < eco.boxes.size(); ++i) {
    const QuadNode& n = eco.boxes[i];
    if (n.first_block > eco.blocks.size() || n.block_count > eco.blocks.size() - n.first_block)
      return findings.add("EBOX", i, "blocks out of range");
    if (!(n.bounds == FloatBox{}) &&
        (n.bounds.empty() || !is_finite(n.bounds.min) || !is_finite(n.bounds.max)))
      findings.add("EBOX", i, "the box is neither finite nor empty");
  }
  if (eco.boxes.empty()) return;
  if (eco.boxes[0].first_block != 0 || eco.boxes[0].block_count != eco.blocks.size())
    return findings.add("EBOX", 0, "the root does not hold every block");
  for (std::uint32_t level = 0; level < eco.depth; ++level) {
    const std::uint32_t first = first_quad_node(level), children = first_quad_node(level + 1);
    for (std::uint32_t i = 0; i < children - first; ++i) {
      const QuadNode& n = eco.boxes[first + i];
      std::uint32_t next = n.first_block;
      for (std::uint32_t c = 0; c < 4; ++c) {
        const QuadNode& child = eco.boxes[children + 4 * i + c];
        if (child.first_block != next)
          findings.add("EBOX", children + 4 * i + c, "its blocks do not follow its sister's");
        next = child.first_block + child.block_count;
      }
      if (next != n.first_block + n.block_count)
        findings.add("EBOX", first + i, "its blocks are not its children's");
    }
  }
}

// Skips lead forward, stay inside the node above, and bottom nodes are the last of their own.
void check_tree_nodes(std::string_view section, const Array<BlockNode>& nodes, const Ecosystem& eco,
                      Findings& findings) {
  std::vector<std::uint32_t> open;  // where the nodes above end
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    const BlockNode& n = nodes[i];
    while (!open.empty() && open.back() == i) open.pop_back();
    const std::uint64_t end = i == 0 ? nodes.size() : open.empty() ? i : open.back();
    if (n.skip <= i || n.skip > end || (i == 0 && n.skip != nodes.size()))
      return findings.add(section, i, "skip leads out of the node above");
    if (n.block != k_none && (n.block >= eco.blocks.size() || n.skip != i + 1))
      return findings.add(section, i, "block out of range, or nodes below a block");
    if (n.bounds.empty() || !is_finite(n.bounds.min) || !is_finite(n.bounds.max))
      findings.add(section, i, "the box is not finite");
    if (n.skip > i + 1) open.push_back(n.skip);
  }
}

void check_tree_boxes(std::string_view section, const Array<BlockNode>& nodes, const Ecosystem& eco,
                      Findings& findings) {
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].block != k_none && !contains(nodes[i].bounds, eco.blocks[nodes[i].block].bounds))
      findings.add(section, i, "the box does not hold its block");
    for (std::uint32_t c = i + 1; c < nodes[i].skip; c = nodes[c].skip)
      if (!contains(nodes[i].bounds, nodes[c].bounds))
        findings.add(section, i, "the box does not hold those below");
  }
}

}  // namespace

void check_ecosystem_frame(const Ecosystem& eco, Findings& findings) {
  check_materials(eco, findings);
  check_terrain(eco.terrain, findings);
  check_blocks(eco, findings);
  check_nodes(eco, findings);
  check_tree_nodes("EKDT", eco.kd_tree, eco, findings);
  check_tree_nodes("ERTR", eco.rtree, eco, findings);
}

void check_ecosystem_elements(const Ecosystem& eco, Findings& findings) {
  check_ecosystem_frame(eco, findings);
  check_packed(eco, findings);
  check_exact(eco, findings);
  if (findings.empty()) check_hashes(eco, findings);  // then blocks are where they are said to be
}

std::uint64_t hash_of_block(const Ecosystem& eco, const InstanceBlock& block) {
  const bool exact = !eco.exact.empty();
  const std::size_t stride = exact ? sizeof(ExactInstance) : sizeof(PackedInstance);
  const auto* bytes = exact ? reinterpret_cast<const std::uint8_t*>(eco.exact.data())
                            : reinterpret_cast<const std::uint8_t*>(eco.packed.data());
  return xxh3(std::span(bytes + block.first * stride, block.count * stride));
}

bool is_sound_block(const Ecosystem& eco, std::uint32_t index) {
  const InstanceBlock& block = eco.blocks[index];
  const auto materials = static_cast<std::uint32_t>(eco.materials.size());
  if (!eco.block_hashes.empty() && hash_of_block(eco, block) != eco.block_hashes[index]) return false;
  return eco.exact.empty() ? all_sound(eco.packed.span().subspan(block.first, block.count), materials)
                           : all_sound(eco.exact.span().subspan(block.first, block.count), materials);
}

void check_ecosystem_boxes(const Ecosystem& eco, Findings& findings) {
  for (std::size_t i = 0; i < eco.blocks.size(); ++i) {
    const InstanceBlock& b = eco.blocks[i];
    for (std::size_t k = b.first; k < b.first + b.count; ++k) {
      const DoubleBox box = instance_bounds(eco.types[b.type], instance_of(eco, b, k));
      if (box.empty()) continue;
      const DoubleBox local{box.min - eco.origin, box.max - eco.origin};
      // Judged with the rounding of the judge: a few units in the last place of doubles of this size.
      const double slack = 1e-14 * (std::abs(local.min.x) + std::abs(local.max.x) + std::abs(local.min.y) +
                                    std::abs(local.max.y) + std::abs(local.min.z) + std::abs(local.max.z) +
                                    length(eco.origin));
      bool inside = !b.bounds.empty();
      for (int a = 0; a < 3; ++a)
        inside &= local.min[a] >= static_cast<double>(b.bounds.min[a]) - slack &&
                  local.max[a] <= static_cast<double>(b.bounds.max[a]) + slack;
      if (!inside)
        findings.add("EBLK", i, "the box does not hold its instances",
                     [&] { return fmt::format("instance {}", k); });
    }
  }
  for (std::uint32_t level = 0; level <= eco.depth && !eco.boxes.empty(); ++level) {
    const std::uint32_t first = first_quad_node(level), children = first_quad_node(level + 1);
    for (std::uint32_t i = first; i < children; ++i) {
      const QuadNode& n = eco.boxes[i];
      if (n.bounds.empty() != (n.block_count == 0)) {
        const auto holds = [&](std::uint32_t b) { return !eco.blocks[b].bounds.empty(); };
        bool any = false;
        for (std::uint32_t b = 0; b < n.block_count; ++b) any |= holds(n.first_block + b);
        if (n.bounds.empty() == any) findings.add("EBOX", i, "valid and empty are confused");
      }
      for (std::uint32_t b = 0; b < n.block_count && level == eco.depth; ++b)
        if (!contains(n.bounds, eco.blocks[n.first_block + b].bounds))
          findings.add("EBOX", i, "the box does not hold its blocks");
      for (std::uint32_t c = 0; c < 4 && level < eco.depth; ++c)
        if (!contains(n.bounds, eco.boxes[children + 4 * (i - first) + c].bounds))
          findings.add("EBOX", i, "the box does not hold its children");
    }
  }
  check_tree_boxes("EKDT", eco.kd_tree, eco, findings);
  check_tree_boxes("ERTR", eco.rtree, eco, findings);
  if (!eco.boxes.empty() && !contains(eco.bounds, eco.boxes[0].bounds))
    findings.add("EHED", Finding::k_no_element, "the box of all does not hold the instances");
}

std::vector<std::string> check_ecosystem(const Ecosystem& eco) {
  Findings findings;
  check_ecosystem_elements(eco, findings);
  if (findings.empty()) check_ecosystem_boxes(eco, findings);
  return findings.lines();
}

}  // namespace copse
