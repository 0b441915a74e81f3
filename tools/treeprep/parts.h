// What a tree file is made of, by the names that --omit and --only take; treedump prints the same names.
#pragma once

#include "lib/formats/result.h"
#include "lib/formats/tree.h"

#include <string>
#include <vector>

namespace copse::treeprep {

// A part that a scene may do without.
struct PartName {
  const char* name;
  const char* what;
};

const std::vector<PartName>& part_names();

// What is kept of a tree.
struct Wanted {
  bool lines = true;  // segments' lines: only needed by programs that draw or move with them
  bool trunk_normals = true;
  bool trunk_texcoords = true;
  bool leaves = true;         // all of the leaves
  bool leaf_geometry = true;  // their triangles; without it groups and centres remain
  bool leaf_normals = true;
  bool leaf_texcoords = true;
  bool leaf_groups = true;
  bool group_hierarchy = true;
  bool textures = true;

  std::vector<std::string> left_out() const;
};

// From --omit NAME,... or --only NAME,... (at most one of them); an unknown name is a usage error that lists
// the known ones.
Result<Wanted> wanted_parts(const std::vector<std::string>& omit, const std::vector<std::string>& only);

}  // namespace copse::treeprep
