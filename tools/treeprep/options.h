// The command line of treeprep.
#pragma once

#include "lib/analysis/trunk/recover.h"
#include "lib/formats/mesh.h"
#include "lib/formats/tree_file/tree_file.h"
#include "lib/formats/vec.h"
#include "tools/common/tool.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace copse::treeprep {

struct Options {
  std::vector<std::filesystem::path> inputs;  // several meshes make one tree
  std::filesystem::path output;
  UpAxis up = UpAxis::y;
  double scale = 1;
  std::vector<std::string> trunk_patterns, leaf_patterns;
  bool strict = false;
  Skeleton skeleton = Skeleton::automatic;
  std::vector<Double3> roots;         // where trees begin, metres, Y up; empty: it decides
  std::uint32_t max_leaf_groups = 0;  // 0: as many as there are terminal radii with leaves
  LeafOrder leaf_order = LeafOrder::group;
  double weld = -1;  // share of the bounding box's diagonal; negative: place by place (trunk/tolerances.h)
  std::vector<std::string> omit, only;  // names of parts.h
  Encoding encoding = Encoding::raw;
  bool small = false;      // packed (lib/formats/tree_file/tree_pack.h)
  int position_bits = 14;  // of a packed tree
};

void add_options(CLI::App& app, Options& options);

}  // namespace copse::treeprep
