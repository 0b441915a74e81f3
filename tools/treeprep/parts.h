// What --omit and --only take: parts of a tree by a telling name, or sections by their four letters
// (docs/formats.md).
#pragma once

#include "lib/formats/result.h"

#include <string>
#include <vector>

namespace copse::treeprep {

// A part that a scene may do without, and the sections that it is stored in.
struct PartName {
  std::string name;
  std::string what;
  std::vector<std::string> sections;
};

const std::vector<PartName>& part_names();

// What is left out: section names for the writer, and what need not even be computed.
struct LeftOut {
  std::vector<std::string> sections;  // in file order
  bool groups = false;
  bool group_hierarchy = false;
  bool textures = false;
};

// From --omit NAME,... or --only NAME,... (at most one of them). --only keeps what the named parts need. An
// unknown name is a usage error that lists the known ones.
Result<LeftOut> left_out_parts(const std::vector<std::string>& omit, const std::vector<std::string>& only);

}  // namespace copse::treeprep
