// --hierarchy: volumes above the parts.
#pragma once

#include "lib/analysis/bvh/box_tree.h"
#include "lib/formats/tree_file/tree_volumes.h"
#include "tools/bvfit/fits.h"

#include <array>
#include <span>
#include <string>
#include <vector>

namespace copse::bvfit {

// What --hierarchy can be.
inline constexpr std::array<const char*, 11> k_hierarchies{
    "kd2", "kd3", "kd4", "kd8", "kd16", "rtree2", "rtree4", "rtree8", "clusters", "original", "flat"};

// Whether it is at rest and none of the coarse ones; the parts of a scene are numbered wholes.
bool is_fine_part(VolumePart part, std::uint32_t index, VolumeMotion motion);

// Whether a hierarchy stands on this part.
bool is_hierarchy_item(const PartSet& part);

struct Hierarchy {
  BoxTree tree;                    // its items are `items`
  std::vector<std::size_t> items;  // indices into the parts: the finest that were asked for
  std::vector<SetFit> inner;       // one a node with several items, in the order of the nodes
};

// Whether it can be built, before anything is fitted; `kind` may be empty. Errors as of build_hierarchy.
Result<void> check_hierarchy(const std::string& kind, std::span<const PartSet> parts, const Input& input);

// The tree alone; `kind` as --hierarchy has it. An error (usage) for other names, refused when there are no
// parts to build on.
Result<Hierarchy> build_hierarchy(const std::string& kind, std::span<const PartSet> parts,
                                  const Input& input);

// Fits the inner nodes to the vertices below them.
Result<void> fit_hierarchy(Hierarchy& hierarchy, std::span<const PartSet> parts,
                           const std::vector<FitMethod>& methods, const Options& options,
                           const Choosing& choosing, Stage& stage);

// The nodes as they are stored, whose sets are those of `fits` (one a part, in order) and then
// hierarchy.inner.
std::vector<VolumeNode> stored_nodes(const Hierarchy& hierarchy, std::span<const SetFit> fits);

}  // namespace copse::bvfit
