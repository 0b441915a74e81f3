// --hierarchy and --compare-hierarchies: volumes above the parts.
#pragma once

#include "lib/analysis/bvh/box_tree.h"
#include "lib/formats/tree_volumes.h"
#include "tools/bvfit/fits.h"

#include <span>
#include <string>
#include <vector>

namespace copse::bvfit {

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

// Builds and fits every kind and tells what each costs to make and to test with, beside the dissertation's
// times (T6.1).
Result<std::string> compare_hierarchies(std::span<const PartSet> parts, std::span<const SetFit> fits,
                                        const Input& input, const std::vector<FitMethod>& methods,
                                        const Options& options, const Choosing& choosing, Context& context);

}  // namespace copse::bvfit
