#include "tools/treedump/json.h"
#include "tools/treedump/views.h"

namespace copse {
namespace {

// The radius that each leaf group hangs on; k_none when none does.
std::vector<std::uint32_t> radius_of_group(const Tree& tree) {
  std::vector<std::uint32_t> radius(tree.leaves.groups.size(), k_none);
  const Array<Radius>& radii = tree.hierarchy.radii;
  for (std::uint32_t r = 0; r < radii.size(); ++r) {
    const bool holds_group = (radii[r].flags & Radius::terminal) != 0 && radii[r].child_count == 1;
    if (holds_group && radii[r].first_child < radius.size()) radius[radii[r].first_child] = r;
  }
  return radius;
}

void add_index(JsonText& json, const char* name, std::uint32_t index) {
  json.member(name, index == k_none ? std::int64_t{-1} : std::int64_t{index});
}

void add_radii(JsonText& json, const Tree& tree) {
  const std::vector<Double3> centres = absolute_centres(tree);
  const std::vector<std::uint32_t> parent = parents(tree);
  json.key("radii");
  json.open_list();
  for (std::size_t r = 0; r < centres.size(); ++r) {
    json.open_object(JsonText::in_line);
    json.member("center", tree.header.origin + centres[r]);
    json.member("diameter", tree.hierarchy.radii[r].diameter);
    add_index(json, "parent", parent[r]);
    json.close();
  }
  json.close();
}

void add_groups(JsonText& json, const Tree& tree) {
  const std::vector<std::uint32_t> radius = radius_of_group(tree);
  json.key("leaf_groups");
  json.open_list();
  for (std::size_t g = 0; g < tree.leaves.groups.size(); ++g) {
    const LeafGroup& group = tree.leaves.groups[g];
    json.open_object(JsonText::in_line);
    json.member("center", tree.header.origin + to_double(group.centre));
    json.member("radius", group.radius);
    json.member("leaves", group.count);
    add_index(json, "radius_index", radius[g]);
    json.close();
  }
  json.close();
}

}  // namespace

Result<std::string> hierarchy_json(const TreeFile& file, const std::string& name) {
  if (file.header().kind != TreeKind::sensitive) {
    return refuse(name, "a .tree holds no hierarchy", "make an .stree: treeprep MESH -o NAME.stree");
  }
  const auto tree = file.load({"RADI", "LGRP"});
  if (!tree) return std::unexpected(tree.error());
  JsonText json;
  json.open_object();
  add_radii(json, *tree);
  add_groups(json, *tree);
  json.close();
  return json.take();
}

}  // namespace copse
