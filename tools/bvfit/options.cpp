#include "tools/bvfit/options.h"

#include "lib/formats/import/limits.h"
#include "tools/bvfit/run.h"
#include "tools/common/option_values.h"

#include <CLI/CLI.hpp>

namespace copse::bvfit {
namespace {

std::vector<Limit> limits() {
  std::vector<Limit> all;
  for (const ImportLimit& l : import_limits()) all.push_back({l.name, l.value, l.unit});
  all.push_back({"planes of a k-DOP (--methods K)", k_most_planes, "planes"});
  return all;
}

}  // namespace

ToolInfo info() {
  return {
      .name = "bvfit",
      .summary =
          "Fits bounding volumes of every type round a mesh, a tree or points, as small as they can be, "
          "proves "
          "that each contains every vertex as written, and says which to use.",
      .examples = {{"bvfit oak.glb -o oak.volumes.json --html oak.html",
                    "every type, with pictures of what encloses what"},
                   {"bvfit oak.stree --per groups,segments --hierarchy kd4 -o oak.bv.stree",
                    "stores the volumes of every part of a tree in its file"},
                   {"bvfit --verify oak.volumes.json oak.glb", "judges a volumes file, whoever wrote it"}},
      .limits = limits()};
}

void add_options(CLI::App& app, Options& options) {
  app.add_option("INPUT", options.inputs,
                 "a mesh (OBJ, PLY, OFF, STL, glTF, GLB), a .tree or .stree, or points (.xyz, .ply); several "
                 "meshes make one scene")
      ->required()
      ->type_name("FILE...");
  app.add_option("-o,--output", options.output,
                 "NAME.json: the volumes as JSON (- is stdout); NAME.tree or NAME.stree: the tree with the "
                 "volumes in it; without it only the table is printed")
      ->type_name("FILE");

  CLI::Option_group* what = app.add_option_group("What is fitted");
  what->add_option("--volumes", options.volumes,
                   "all, or of aabb, sphere, obb, capsule, lozenge, cylinder, ellipsoid, kdop")
      ->delimiter(',')
      ->allow_extra_args(false)  // the next argument may be the input
      ->type_name("TYPE,...")
      ->default_str("all");
  what->add_option("--methods", options.methods,
                   "all, best (of each type), or methods by name (the table of --methods all lists them)")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("NAME,...")
      ->default_str("best");
  what->add_option("--per", options.per,
                   "whole, trunk, leaves, groups, segments, cells (these three bring the others along), or "
                   "parts: every object of a scene")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("PART,...")
      ->default_str("whole");
  add_choice<FitQuality>(
      *what, "--quality", options.quality,
      "fast: closed forms; balanced: a global search for the least volume; exact: and a proof of how near it "
      "comes",
      {{"fast", FitQuality::fast}, {"balanced", FitQuality::balanced}, {"exact", FitQuality::exact}})
      ->type_name("fast|balanced|exact");
  what->add_option("--budget", options.budget,
                   "the best within this time a set of points; what is found in time depends on the machine")
      ->check(number_above(0))
      ->default_str("none")
      ->type_name("SECONDS");

  CLI::Option_group* choice = app.add_option_group("Choosing");
  add_choice<Criterion>(
      *choice, "--choose", options.choose,
      "by the least volume, volume times the cost of a test, the proportions of the box alone, "
      "or the expected cost of test and needless content",
      {{"volume", Criterion::volume},
       {"weighted", Criterion::weighted},
       {"aspect", Criterion::aspect},
       {"expected", Criterion::expected}})
      ->type_name("volume|weighted|aspect|expected");
  choice
      ->add_option("--costs", options.costs,
                   "of a test: table (counted operations) or measured (on this machine: then the choice "
                   "depends on it)")
      ->check(CLI::IsMember({"table", "measured"}))
      ->capture_default_str();
  choice
      ->add_option("--content-cost", options.expected.content,
                   "with --choose expected: what a needless hit costs, in tests of a sphere")
      ->check(number_from(0))
      ->capture_default_str()
      ->type_name("C");
  choice
      ->add_option("--ray-share", options.expected.rays,
                   "with --choose expected: share of the tests that are rays; the others are frustum planes")
      ->check(number_between(0, 1))
      ->capture_default_str()
      ->type_name("P");
  choice
      ->add_option(
          "--aspect-tree", options.aspect_tree,
          "with --choose aspect: the comparisons, as ratio1>2?capsule:(ratio3>2.5?lozenge:obb); default "
          "(tuned) or seed (to begin with)")
      ->type_name("TREE");
  choice->add_flag("--tune", options.tune,
                   "finds the aspect tree whose choices come nearest to the smallest volumes of all parts, "
                   "and prints it; of "
                   "the types named by --volumes, or sphere, obb, capsule, cylinder and lozenge");

  CLI::Option_group* above = app.add_option_group("Above the parts");
  above
      ->add_option("--hierarchy", options.hierarchy,
                   "a hierarchy over the finest parts, with volumes fitted to the vertices below each node: "
                   "kd2, kd3, kd4, kd8, kd16, rtree2, rtree4, rtree8, clusters, original or flat")
      ->type_name("KIND");
  above->add_flag("--compare-hierarchies", options.compare_hierarchies,
                  "builds all of them and prints what they cost");
  above
      ->add_option("--sway", options.sway,
                   "also fits the envelope of everywhere that the parts come to when every link of the "
                   "tree's hierarchy turns by up to this angle")
      ->check(number_between(0, 90))
      ->type_name("DEGREES");

  CLI::Option_group* more = app.add_option_group("More");
  more->add_option("--verify", options.verify,
                   "judges the volumes in this file (JSON of any program, or a tree) by the points of INPUT; "
                   "exit status 1 names the worst point")
      ->type_name("FILE");
  more->add_option("--export-glb", options.export_glb, "the mesh with the volumes drawn round it")
      ->type_name("FILE");
  more->add_flag("--times", options.times,
                 "put the time of every fit into the JSON, which then differs from run to run");
  more->add_flag(
      "--sweep", options.sweep,
      "runs every method at every quality and tells excess volume against time (table, report, page)");
}

}  // namespace copse::bvfit
