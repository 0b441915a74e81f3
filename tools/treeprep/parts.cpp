#include "tools/treeprep/parts.h"

#include <algorithm>

namespace copse::treeprep {
namespace {

struct Entry {
  PartName part;
  bool Wanted::*flag;
};

const std::vector<Entry>& entries() {
  static const std::vector<Entry> k_entries{
      {{"lines", "a line a segment, for drawing distant branches"}, &Wanted::lines},
      {{"trunk-normals", "normals of the trunk"}, &Wanted::trunk_normals},
      {{"trunk-texcoords", "texture coordinates of the trunk"}, &Wanted::trunk_texcoords},
      {{"leaves", "everything about leaves"}, &Wanted::leaves},
      {{"leaf-geometry", "the leaves' triangles; groups and centres stay"}, &Wanted::leaf_geometry},
      {{"leaf-normals", "normals of the leaves"}, &Wanted::leaf_normals},
      {{"leaf-texcoords", "texture coordinates of the leaves"}, &Wanted::leaf_texcoords},
      {{"leaf-groups", "which leaves hang on which terminal radius"}, &Wanted::leaf_groups},
      {{"group-hierarchy", "the hierarchy of bounding spheres over the leaf groups"},
       &Wanted::group_hierarchy},
      {{"textures", "texture references and embedded images"}, &Wanted::textures},
  };
  return k_entries;
}

// What falls away with something else.
void imply(Wanted& w) {
  if (!w.leaves) w.leaf_geometry = w.leaf_groups = false;
  if (!w.leaf_geometry) w.leaf_normals = w.leaf_texcoords = false;
  if (!w.leaf_groups) w.group_hierarchy = false;
}

std::string known_names() {
  std::string names;
  for (const Entry& e : entries()) names += (names.empty() ? "" : ", ") + std::string(e.part.name);
  return names;
}

Result<void> set(Wanted& wanted, const std::vector<std::string>& names, bool value, const char* option) {
  for (const std::string& name : names) {
    const auto e =
        std::find_if(entries().begin(), entries().end(), [&](const Entry& x) { return x.part.name == name; });
    if (e == entries().end()) {
      return fail(Fault::usage, "", std::string(option) + " does not know '" + name + "'",
                  "use one of: " + known_names());
    }
    wanted.*(e->flag) = value;
  }
  return {};
}

}  // namespace

const std::vector<PartName>& part_names() {
  static const std::vector<PartName> k_names = [] {
    std::vector<PartName> names;
    for (const Entry& e : entries()) names.push_back(e.part);
    return names;
  }();
  return k_names;
}

std::vector<std::string> Wanted::left_out() const {
  std::vector<std::string> names;
  for (const Entry& e : entries()) {
    if (!(this->*(e.flag))) names.push_back(e.part.name);
  }
  return names;
}

Result<Wanted> wanted_parts(const std::vector<std::string>& omit, const std::vector<std::string>& only) {
  Wanted wanted;
  if (!omit.empty() && !only.empty()) {
    return fail(Fault::usage, "", "--omit and --only exclude each other", "give one of them");
  }
  if (!only.empty()) {
    for (const Entry& e : entries()) wanted.*(e.flag) = false;
    if (const auto ok = set(wanted, only, true, "--only"); !ok) return std::unexpected(ok.error());
    // A detail that is asked for brings what it is a detail of.
    wanted.leaf_geometry |= wanted.leaf_normals || wanted.leaf_texcoords;
    wanted.leaf_groups |= wanted.group_hierarchy;
    wanted.leaves |= wanted.leaf_geometry || wanted.leaf_groups;
  } else if (const auto ok = set(wanted, omit, false, "--omit"); !ok) {
    return std::unexpected(ok.error());
  }
  imply(wanted);
  return wanted;
}

}  // namespace copse::treeprep
