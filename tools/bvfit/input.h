// What is to be enclosed: a mesh, a tree or points, and its parts.
#pragma once

#include "lib/formats/import/import.h"
#include "lib/formats/levels/foliage_cells.h"
#include "lib/formats/mesh.h"
#include "lib/formats/result.h"
#include "lib/formats/tree_file/tree_file.h"
#include "lib/formats/tree_file/tree_volumes.h"
#include "tools/common/tool.h"

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace copse::bvfit {

struct Input {
  std::string name;  // for messages and the JSON: the first file, "(+2 more)" where there are several
  std::vector<Double3> points;  // every vertex; of a mesh as float32, relative to the origin of a tree
  // Its triangles over `points`; none for points alone. Textures that are files have names that can be
  // opened. Of a tree the triangles alone.
  Mesh mesh;
  // Of a scene of meshes: what its files group, each file at the top, and in which group each triangle is.
  std::vector<SourceGroup> groups;
  std::vector<std::uint32_t> group_of;
  std::optional<TreeFile> file;  // of a tree
  std::filesystem::path folder;  // of its file: where its textures are
  Tree tree;
  FoliageCells cells;              // that the tree came with
  std::uint32_t trunk_points = 0;  // of a tree: the trunk's vertices come first
};

Result<Input> read_input(const std::vector<std::filesystem::path>& paths, Context& context);

// A set of points with a name.
struct PartSet {
  std::string name;  // "whole", "group 12", "part Crown"
  VolumePart part = VolumePart::whole;
  std::uint32_t index = k_none;
  VolumeMotion motion = VolumeMotion::rest;
  float sway = 0;  // degrees, with --sway
  std::vector<Double3> points;
  std::vector<std::uint32_t> source;  // of each point in Input::points; empty: the same
  std::vector<Triangle> triangles;    // over `points`; may be empty
  std::uint32_t group = k_none;       // of a part of a scene: the Input::groups that it is
  std::vector<Double3> envelope;      // with --sway: points round everywhere that it can be; else empty
};

// The parts that --per names, in the order whole, trunk, leaves, groups, segments, cells, parts. Groups,
// segments and cells bring whole, trunk and leaves along. Empty parts are left out. Refused when the input
// does not have what is asked for.
Result<std::vector<PartSet>> part_sets(const Input& input, const std::vector<std::string>& per);

// The parts of the kind that `name` is of: of "group 12" all groups (and what they bring along). Refused when
// the input has none of these.
Result<std::vector<PartSet>> parts_like(const Input& input, const std::string& name);

// Points round everywhere that a part's points come to when every link of the tree's hierarchy turns by up to
// `degrees`, above 0. Refused when the input has no hierarchy.
class Sway {
 public:
  static Result<Sway> make(const Input& input, float degrees);
  std::vector<Double3> envelope(const PartSet& part) const;
  float degrees() const { return degrees_; }

 private:
  float degrees_ = 0;
  std::vector<double> reach_;  // of Input::points
};

}  // namespace copse::bvfit
