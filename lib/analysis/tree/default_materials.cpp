#include "lib/analysis/tree/default_materials.h"

#include "lib/formats/default_look.h"

#include <algorithm>
#include <vector>

namespace copse {
namespace {

// What the elements of a part of the tree, `count` of them, are made of.
struct MadeOf {
  std::uint64_t count;
  std::uint32_t& all;
  Array<std::uint32_t>& each;
};

std::uint32_t add(const char* name, const Float3& colour, std::vector<Material>& materials) {
  Material material{.name = name, .diffuse = colour};
  material.double_sided = true;
  materials.push_back(std::move(material));
  return static_cast<std::uint32_t>(materials.size() - 1);
}

void fill(const char* name, const Float3& colour, const MadeOf& part, std::vector<Material>& materials) {
  if (part.count == 0) return;
  if (part.each.empty()) {
    if (part.all == k_none) part.all = add(name, colour, materials);
    return;
  }
  if (std::ranges::find(part.each, k_none) == part.each.end()) return;
  std::vector<std::uint32_t> filled = part.each.to_vector();
  std::ranges::replace(filled, k_none, add(name, colour, materials));
  part.each = std::move(filled);
}

// How many elements of the part are made of each material.
std::vector<std::uint64_t> uses(const MadeOf& part, std::uint64_t triangles, std::size_t materials) {
  std::vector<std::uint64_t> out(materials);
  if (part.count == 0) return out;
  if (part.each.empty()) {
    if (part.all != k_none) out[part.all] = triangles;
    return out;
  }
  // Of leaves with many triangles each: as if they had as many.
  const std::uint64_t weight = std::max<std::uint64_t>(triangles / part.count, 1);
  for (const std::uint32_t m : part.each) {
    if (m != k_none) out[m] += weight;
  }
  return out;
}

}  // namespace

void give_default_materials(std::span<const std::uint32_t> undefined, Tree& tree) {
  const MadeOf wood{tree.trunk.triangles.size(), tree.trunk.material, tree.trunk.materials};
  const MadeOf leaves{tree.leaf_count(), tree.leaves.material, tree.leaves.materials};
  if (!undefined.empty()) {
    const auto of_wood = uses(wood, tree.trunk.triangles.size(), tree.materials.size()),
               of_leaves = uses(leaves, tree.leaves.triangles.size(), tree.materials.size());
    for (const std::uint32_t m : undefined) {
      if (of_wood[m] + of_leaves[m] == 0) continue;
      tree.materials[m].diffuse = of_leaves[m] > of_wood[m] ? k_leaf_colour : k_wood_colour;
      tree.materials[m].double_sided = true;
    }
  }
  fill("wood", k_wood_colour, wood, tree.materials);
  fill("leaf", k_leaf_colour, leaves, tree.materials);
}

}  // namespace copse
