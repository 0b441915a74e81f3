#include "tools/treeprep/options.h"

#include "lib/formats/import/limits.h"
#include "tools/common/option_values.h"
#include "tools/treeprep/input.h"
#include "tools/treeprep/parts.h"
#include "tools/treeprep/run.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include <CLI/CLI.hpp>

namespace copse::treeprep {

namespace {

// "X,Y,Z"
std::optional<Double3> point_in(std::string_view text) {
  Double3 p;
  const char* at = text.data();
  const char* const end = at + text.size();
  for (double* c : {&p.x, &p.y, &p.z}) {
    if (c != &p.x && (at == end || *at++ != ',')) return std::nullopt;
    const auto [next, error] = std::from_chars(at, end, *c);
    if (error != std::errc{} || !std::isfinite(*c)) return std::nullopt;
    at = next;
  }
  if (at != end) return std::nullopt;
  return p;
}

void add_root_option(CLI::Option_group& group, std::vector<Double3>& roots) {
  const auto set = [&roots](const std::vector<std::string>& points) {
    for (const std::string& p : points) roots.push_back(*point_in(p));
  };
  const auto check = [](const std::string& text) -> std::string {
    return point_in(text) ? "" : "'" + text + "' is not a point: write X,Y,Z in metres";
  };
  group
      .add_option_function<std::vector<std::string>>(
          "--root", set,
          "where a tree begins: at the end of the trunk nearest to this point of the finished tree (Y up, "
          "metres), whatever lies lower or is thicker; one for each tree of the mesh")
      ->check(CLI::Validator(check, "", ""))
      ->allow_extra_args(false)
      ->type_name("X,Y,Z");
}

std::vector<Limit> limits() {
  std::vector<Limit> all{{"extent of a tree", static_cast<std::uint64_t>(k_largest_extent), "m"}};
  for (const ImportLimit& l : import_limits()) all.push_back({l.name, l.value, l.unit});
  return all;
}

}  // namespace

ToolInfo info() {
  return {
      .name = "treeprep",
      .summary =
          "Turns the mesh of a tree into a .tree (static) or .stree (able to move) file: finds trunk and "
          "leaves, recovers the hierarchy of rings, groups the leaves, and reports how exact it was.",
      .examples =
          {{"treeprep oak.glb -o oak.stree --html oak.html", "prepare one tree and look at what was found"},
           {"treeprep pine.obj.gz -o pine.tree --up z --scale 0.01 --trunk '*bark*' --omit lines",
            "a mesh in centimetres, Z up, with its materials named, without the lines for distant views"}},
      .limits = limits()};
}

void add_options(CLI::App& app, Options& options) {
  app.add_option("INPUT", options.inputs,
                 "the mesh: OBJ, PLY, OFF, STL, glTF or GLB, gzipped or not; several make one tree")
      ->required()
      ->type_name("FILE...");
  app.add_option("-o,--output", options.output, "the tree: NAME.tree (static) or NAME.stree (able to move)")
      ->required()
      ->type_name("FILE");

  CLI::Option_group* mesh = app.add_option_group("Reading the mesh");
  add_choice<UpAxis>(*mesh, "--up", options.up, "the axis of the mesh that points up",
                     {{"y", UpAxis::y}, {"z", UpAxis::z}});
  mesh->add_option("--scale", options.scale, "metres a unit of the mesh: 0.01 for centimetres")
      ->check(number_above(0))
      ->type_name("N")
      ->capture_default_str();
  mesh->add_option(
          "--weld", options.weld,
          "positions closer than this share of the bounding box's diagonal are one (default: far below the "
          "shortest edges)")
      ->check(number_between(0, 1))
      ->type_name("EPS")
      ->default_str("");
  mesh->add_flag("--strict", options.strict,
                 "refuse what breaks the thesis' model rules, naming every breach");

  CLI::Option_group* parts = app.add_option_group("Trunk and leaves");
  parts
      ->add_option("--trunk", options.trunk_patterns,
                   "globs over material, object and group names: these are trunk")
      ->delimiter(',')
      ->type_name("PATTERN,...");
  parts
      ->add_option("--leaf", options.leaf_patterns,
                   "globs over material, object and group names: these are leaves")
      ->delimiter(',')
      ->type_name("PATTERN,...");
  add_choice<Skeleton>(
      *parts, "--skeleton", options.skeleton,
      "how the hierarchy is recovered: from rings, from the surface, or as fits",
      {{"auto", Skeleton::automatic}, {"rings", Skeleton::rings}, {"surface", Skeleton::surface}});
  add_root_option(*parts, options.roots);
  parts
      ->add_option("--max-leaf-groups", options.max_leaf_groups,
                   "merge the smallest leaf groups until there are at most N")
      ->check(whole_number_from(1, UINT32_MAX))
      ->type_name("N")
      ->default_str("");
  add_choice<LeafOrder>(
      *parts, "--leaf-order", options.leaf_order,
      "order of the leaves in a group: by distance from its centre or from its terminal radius, or at random",
      {{"group", LeafOrder::group}, {"terminal", LeafOrder::terminal}, {"random", LeafOrder::random}});

  std::string names;
  for (const PartName& part : part_names()) names += std::string("\n") + part.name + ": " + part.what;
  CLI::Option_group* output = app.add_option_group("What is written");
  output->add_option("--omit", options.omit, "leave out what the scene does not need:" + names)
      ->delimiter(',')
      ->type_name("PART,...");
  output->add_option("--only", options.only, "leave out every optional part but these")
      ->delimiter(',')
      ->type_name("PART,...");
  add_choice<Encoding>(*output, "--compress", options.encoding,
                       "how sections are stored: none (mapped in place) or zstd (small)",
                       {{"none", Encoding::raw}, {"zstd", Encoding::zstd}});
  add_choice<bool>(*output, "--encode", options.small,
                   "fast: exact, mapped in place; small: quantised and packed",
                   {{"fast", false}, {"small", true}})
      ->type_name("fast|small");
  output
      ->add_option("--position-bits", options.position_bits,
                   "of --encode small: bits of the longest side of the box")
      ->check(whole_number_from(8, 20))
      ->type_name("N")
      ->capture_default_str();
}

}  // namespace copse::treeprep
