#include "tools/bvfit/input.h"

#include "lib/analysis/leaves/classify.h"
#include "lib/analysis/round/minimal_sphere.h"
#include "lib/analysis/tree/tree_parts.h"
#include "lib/analysis/volumes/motion_envelope.h"
#include "lib/formats/import/import.h"
#include "lib/formats/import/xyz.h"

#include <algorithm>
#include <functional>
#include <numbers>

#include <fmt/format.h>

namespace copse::bvfit {
namespace {

namespace fs = std::filesystem;

std::string extension_of(const fs::path& path) {
  fs::path p = path;
  if (p.extension() == ".gz") p = p.stem();
  std::string e = p.extension().string();
  std::transform(e.begin(), e.end(), e.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return e;
}

bool is_tree(const fs::path& path) {
  const std::string e = extension_of(path);
  return e == ".tree" || e == ".stree";
}

// A vertex of a mesh as a program will hold it.
Result<void> to_float32(std::vector<Double3>& points, std::size_t from, const std::string& name) {
  for (std::size_t i = from; i < points.size(); ++i) {
    const Double3 p = rounded_to_float(points[i]);
    if (!is_finite(p)) {
      return refuse(name,
                    fmt::format("vertex {} ({}, {}, {}) is beyond float32", i - from, points[i].x,
                                points[i].y, points[i].z),
                    "use a smaller scale");
    }
    points[i] = p;
  }
  return {};
}

Result<void> add_points(const fs::path& path, Input& input, Context& context) {
  auto points = read_xyz(path);
  if (!points) return std::unexpected(points.error());
  context.read(path, true);
  input.points.insert(input.points.end(), points->begin(), points->end());
  return {};
}

// The file as a group, and in it those of the file.
void add_groups_of(const Import& import, Input& input) {
  const auto file = static_cast<std::uint32_t>(input.groups.size());
  input.groups.push_back({"", k_none});
  for (const SourceGroup& g : import.groups)
    input.groups.push_back({g.name, g.parent == k_none ? file : file + 1 + g.parent});
  for (std::size_t t = 0; t < import.mesh.triangles.size(); ++t) {
    const std::uint32_t group = import.group_of.empty() ? k_none : import.group_of[t];
    input.group_of.push_back(group == k_none ? file : file + 1 + group);
  }
}

// Puts the normals or texture coordinates of a mesh of `count` triangles behind those of `before`; corners
// without any are k_none.
template <class T>
void add_corners(const std::vector<T>& values, const std::vector<Triangle>& corners, std::size_t count,
                 std::vector<T>& all, std::vector<Triangle>& all_corners, std::size_t before) {
  if (corners.empty() && all_corners.empty()) return;
  constexpr Triangle k_without{k_none, k_none, k_none};
  const auto base = static_cast<std::uint32_t>(all.size());
  all.insert(all.end(), values.begin(), values.end());
  all_corners.resize(before, k_without);
  for (Triangle t : corners) {
    for (std::uint32_t& i : t) i = i == k_none ? k_none : i + base;
    all_corners.push_back(t);
  }
  all_corners.resize(before + count, k_without);
}

// Left-over vertices count, as all vertices do: where they make volumes larger, that is told.
void warn_of_strays(const Mesh& mesh, const std::string& name, Context& context) {
  if (mesh.triangles.empty()) return;
  std::vector<bool> used(mesh.positions.size());
  DoubleBox box;
  for (const Triangle& t : mesh.triangles) {
    for (const std::uint32_t v : t) used[v] = true, box.grow(mesh.positions[v]);
  }
  std::size_t strays = 0;
  for (std::size_t i = 0; i < used.size(); ++i) {
    DoubleBox with = box;
    with.grow(mesh.positions[i]);
    strays += !used[i] && (with.min != box.min || with.max != box.max);
  }
  if (strays == 0) return;
  context.warn(
      fmt::format("{}: {} of {} vertices are in no face and lie beyond those that are; volumes hold them, "
                  "too: remove them if they are left over",
                  name, strays, used.size()));
}

Result<void> add_mesh(const fs::path& path, Input& input, Context& context) {
  auto import = import_mesh(path);
  if (!import) return std::unexpected(import.error());
  for (std::size_t i = 0; i < import->files.size(); ++i) context.read(import->files[i], i == 0);
  for (const std::string& warning : import->warnings) context.warn(path.string() + ": " + warning);
  Mesh& mesh = import->mesh;
  warn_of_strays(mesh, path.string(), context);
  const std::size_t base = input.points.size();
  input.points.insert(input.points.end(), mesh.positions.begin(), mesh.positions.end());
  // Points alone stay as they are written; a mesh's vertices are float32 when anything tests them.
  if (!mesh.triangles.empty()) {
    if (auto ok = to_float32(input.points, base, path.string()); !ok) return ok;
  }
  const auto parts = static_cast<std::uint32_t>(input.mesh.parts.size());
  const auto materials = static_cast<std::uint32_t>(input.mesh.materials.size());
  const auto textures = static_cast<std::uint32_t>(input.mesh.textures.size());
  for (Texture t : mesh.textures) {
    if (!t.uri.empty()) t.uri = (path.parent_path() / t.uri).string();
    input.mesh.textures.push_back(std::move(t));
  }
  for (Material m : mesh.materials) {
    if (m.texture != k_none) m.texture += textures;
    input.mesh.materials.push_back(std::move(m));
  }
  add_corners(mesh.texcoords, mesh.texcoord_triangles, mesh.triangles.size(), input.mesh.texcoords,
              input.mesh.texcoord_triangles, input.mesh.triangles.size());
  add_corners(mesh.normals, mesh.normal_triangles, mesh.triangles.size(), input.mesh.normals,
              input.mesh.normal_triangles, input.mesh.triangles.size());
  for (Part p : mesh.parts) {
    if (p.material != k_none) p.material += materials;
    input.mesh.parts.push_back(std::move(p));
  }
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    Triangle v = mesh.triangles[t];
    for (std::uint32_t& i : v) i += static_cast<std::uint32_t>(base);
    input.mesh.triangles.push_back(v);
    input.mesh.part_of.push_back(parts + mesh.part_of[t]);
  }
  add_groups_of(*import, input);
  return {};
}

Result<void> add_tree(const fs::path& path, Input& input, Context& context) {
  auto file = TreeFile::open(path);
  if (!file) return std::unexpected(file.error());
  context.read(path, true);
  auto tree = file->load();
  if (!tree) return std::unexpected(tree.error());
  auto cells = read_foliage_cells(*file);
  if (!cells) return fail(cells.error().fault, path.string(), cells.error().what, cells.error().remedy);
  if (!cells->cells.empty() && cells->parameters.leaves != hash_leaves(*tree)) {
    return refuse(path.string(), "FCEL: its foliage cells were made for other leaves",
                  "bake them again (lodbake)");
  }
  input.tree = std::move(*tree);
  input.cells = std::move(*cells);
  input.file = std::move(*file);
  input.folder = path.parent_path();
  const TreeParts parts(input.tree);
  input.points = parts.points();
  input.trunk_points = parts.trunk_points();
  const auto add = [&](const Array<CornerTriangle>& triangles, std::uint32_t base, std::uint32_t part) {
    for (const CornerTriangle& t : triangles) {
      input.mesh.triangles.push_back({t.vertex[0] + base, t.vertex[1] + base, t.vertex[2] + base});
      input.mesh.part_of.push_back(part);
    }
  };
  input.mesh.parts = {{"trunk", "", k_none}, {"leaves", "", k_none}};
  add(input.tree.trunk.triangles, 0, 0);
  add(input.tree.leaves.triangles, input.trunk_points, 1);
  return {};
}

// Gathers the points of some triangles, each once.
class Gatherer {
 public:
  explicit Gatherer(const Input& input) : input_(input), index_(input.points.size(), k_none) {}
  void add(const Triangle& t, PartSet& set) {
    Triangle local{};
    for (std::size_t c = 0; c < 3; ++c) local[c] = add(t[c], set);
    set.triangles.push_back(local);
  }
  std::uint32_t add(std::uint32_t point, PartSet& set) {
    if (index_[point] == k_none) {
      index_[point] = static_cast<std::uint32_t>(set.points.size());
      set.points.push_back(input_.points[point]);
      set.source.push_back(point);
      touched_.push_back(point);
    }
    return index_[point];
  }
  void finish(PartSet set, std::vector<PartSet>& sets) {
    for (const std::uint32_t p : touched_) index_[p] = k_none;
    touched_.clear();
    if (!set.points.empty()) sets.push_back(std::move(set));
  }

 private:
  const Input& input_;
  std::vector<std::uint32_t> index_;
  std::vector<std::uint32_t> touched_;
};

PartSet named(VolumePart part, std::uint32_t index = k_none) {
  PartSet set;
  set.part = part, set.index = index;
  set.name = set_name({.part = part, .index = index});
  return set;
}

PartSet set_of(TreePart part, const Input& input, VolumePart which, std::uint32_t index) {
  PartSet set = named(which, index);
  for (const std::uint32_t p : part.points) set.points.push_back(input.points[p]);
  set.source = std::move(part.points);
  set.triangles = std::move(part.triangles);
  return set;
}

using Sets = std::vector<PartSet>;

Result<void> add_whole(const Input& input, Sets& sets) {
  PartSet set = named(VolumePart::whole);
  set.points = input.points;
  set.triangles = input.mesh.triangles;
  sets.push_back(std::move(set));
  return {};
}

// Of a tree they are stored apart; of a mesh they are told apart as treeprep does.
Result<void> add_trunk_or_leaves(const Input& input, bool leaves, Sets& sets) {
  const VolumePart which = leaves ? VolumePart::leaves : VolumePart::trunk;
  if (input.file) {
    PartSet set = set_of(TreeParts(input.tree).part(which), input, which, k_none);
    if (!set.points.empty()) sets.push_back(std::move(set));
    return {};
  }
  Gatherer gather(input);
  PartSet set = named(which);
  if (input.mesh.triangles.empty())
    return refuse(input.name, "points have no trunk and no leaves",
                  "name a mesh or a tree, or leave --per out");
  Mesh mesh = input.mesh;
  mesh.positions = input.points;
  const auto classes = classify(mesh);
  if (!classes) return std::unexpected(classes.error());
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if ((classes->leaf_of[t] != k_none) == leaves) gather.add(mesh.triangles[t], set);
  }
  gather.finish(std::move(set), sets);
  return {};
}

Result<void> needs_tree(const Input& input, const char* what) {
  if (input.file) return {};
  return refuse(input.name, fmt::format("a mesh has no {}", what),
                "make a tree of it first (treeprep), or use --per parts");
}

// Every group, segment or cell that has points.
Result<void> add_all(const Input& input, VolumePart which, Sets& sets) {
  TreeParts parts(input.tree, &input.cells);
  for (std::uint32_t i = 0; i < parts.count(which); ++i) {
    PartSet set = set_of(parts.part(which, i), input, which, i);
    if (!set.points.empty()) sets.push_back(std::move(set));
  }
  return {};
}

Result<void> add_groups(const Input& input, Sets& sets) {
  if (auto ok = needs_tree(input, "leaf groups"); !ok) return ok;
  if (!TreeParts(input.tree).groups_have_leaves()) {
    return refuse(input.name, "the leaves of its groups (LORD, LTRI) were left out",
                  "prepare the tree with them");
  }
  return add_all(input, VolumePart::group, sets);
}

Result<void> add_segments(const Input& input, Sets& sets) {
  if (auto ok = needs_tree(input, "segments"); !ok) return ok;
  return add_all(input, VolumePart::segment, sets);
}

Result<void> add_cells(const Input& input, Sets& sets) {
  if (auto ok = needs_tree(input, "foliage cells"); !ok) return ok;
  if (input.cells.cells.empty()) {
    return refuse(input.name, "it has no foliage cells", "make them first (lodbake --foliage prune)");
  }
  if (input.tree.leaves.triangles.empty())
    return refuse(input.name, "the leaves of its cells (LTRI) were left out", "prepare the tree with them");
  return add_all(input, VolumePart::cell, sets);
}

// A scene of many meshes: every group that has triangles of its own, and what a file has in no group, in the
// order of their first triangles. A tree's are its trunk and its leaves.
Result<void> add_parts(const Input& input, Sets& sets) {
  if (input.mesh.triangles.empty()) return refuse(input.name, "points have no parts", "name a mesh");
  const std::vector<std::uint32_t>& group_of = input.file ? input.mesh.part_of : input.group_of;
  std::vector<std::size_t> place_of(input.file ? input.mesh.parts.size() : input.groups.size(), k_none);
  std::vector<std::vector<std::uint32_t>> members;
  for (std::uint32_t t = 0; t < input.mesh.triangles.size(); ++t) {
    std::size_t& place = place_of[group_of[t]];
    if (place == k_none) place = members.size(), members.emplace_back();
    members[place].push_back(t);
  }
  Gatherer gather(input);
  std::uint32_t index = 0;
  for (const std::vector<std::uint32_t>& triangles : members) {
    PartSet set;
    set.name = fmt::format("part {}", index), set.index = index++;
    if (!input.file) set.group = input.group_of[triangles[0]];
    const std::string& own = input.file ? std::string() : input.groups[set.group].name;
    const std::string& name = own.empty() ? input.mesh.parts[input.mesh.part_of[triangles[0]]].object : own;
    if (!name.empty()) set.name += " " + name;
    for (const std::uint32_t t : triangles) gather.add(input.mesh.triangles[t], set);
    gather.finish(std::move(set), sets);
  }
  return {};
}

struct Per {
  const char* name;
  bool brings_all;  // whole, trunk and leaves come along
  std::function<Result<void>(const Input&, Sets&)> add;
};

const std::vector<Per>& pers() {
  static const std::vector<Per> k_pers{
      {"whole", false, add_whole},
      {"trunk", false, [](const Input& i, Sets& s) { return add_trunk_or_leaves(i, false, s); }},
      {"leaves", false, [](const Input& i, Sets& s) { return add_trunk_or_leaves(i, true, s); }},
      {"groups", true, add_groups},
      {"segments", true, add_segments},
      {"cells", true, add_cells},
      {"parts", false, add_parts},
  };
  return k_pers;
}

}  // namespace

Result<Input> read_input(const std::vector<fs::path>& paths, Context& context) {
  Input input;
  Stage stage = context.stage("read");
  for (const fs::path& path : paths) {
    if (is_tree(path) && paths.size() > 1) {
      return fail(Fault::usage, path.string(), "a tree is fitted alone", "run bvfit once a tree");
    }
    const Result<void> ok = is_tree(path)                  ? add_tree(path, input, context)
                            : extension_of(path) == ".xyz" ? add_points(path, input, context)
                                                           : add_mesh(path, input, context);
    if (!ok) return std::unexpected(ok.error());
  }
  input.name = paths.front().string();
  if (paths.size() > 1) input.name += fmt::format(" (+{} more)", paths.size() - 1);
  stage.items(input.points.size(), "points");
  if (input.points.empty())
    return refuse(input.name, "there is no point in it", "export it with its vertices");
  for (std::size_t i = 0; i < input.points.size(); ++i) {
    if (!is_finite(input.points[i]))
      return refuse(input.name, fmt::format("point {} is not finite", i), "export it again");
    input.points[i] += Double3{};  // -0 becomes 0, or equal points were told apart by their bytes
  }
  return input;
}

Result<Sets> part_sets(const Input& input, const std::vector<std::string>& per) {
  std::vector<bool> wanted(pers().size());
  for (const std::string& name : per) {
    std::size_t i = 0;
    while (i < pers().size() && name != pers()[i].name) ++i;
    if (i == pers().size()) {
      return fail(Fault::usage, "", fmt::format("--per knows no '{}'", name),
                  "use whole, trunk, leaves, groups, segments, cells or parts");
    }
    wanted[i] = true;
    if (pers()[i].brings_all) wanted[0] = wanted[1] = wanted[2] = true;
  }
  Sets sets;
  for (std::size_t i = 0; i < pers().size(); ++i) {
    if (!wanted[i]) continue;
    if (auto ok = pers()[i].add(input, sets); !ok) return std::unexpected(ok.error());
  }
  return sets;
}

Result<Sets> parts_like(const Input& input, const std::string& name) {
  for (const Per& per : pers()) {
    const std::string singular = std::string(per.name).substr(0, std::string_view(per.name).size() - 1);
    if (name == per.name || name.starts_with(singular + " ")) return part_sets(input, {per.name});
  }
  return Sets{};
}

Result<Sway> Sway::make(const Input& input, float degrees) {
  if (!input.file || input.tree.header.kind != TreeKind::sensitive)
    return refuse(input.name, "only a tree with a hierarchy moves", "name an .stree, or leave --sway out");
  Sway sway;
  sway.degrees_ = degrees;
  sway.reach_ = sway_reach(input.tree, degrees * std::numbers::pi / 180);
  return sway;
}

std::vector<Double3> Sway::envelope(const PartSet& part) const {
  std::vector<double> radii;
  for (std::size_t p = 0; p < part.points.size(); ++p)
    radii.push_back(reach_[part.source.empty() ? p : part.source[p]]);
  return ball_envelope(part.points, radii);
}

}  // namespace copse::bvfit
