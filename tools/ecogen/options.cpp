#include "tools/ecogen/options.h"

#include "lib/formats/ecosystem/ecosystem_file.h"
#include "tools/common/option_values.h"

#include <CLI/CLI.hpp>

namespace copse::ecogen {

ToolInfo info() {
  return {.name = "ecogen",
          .summary =
              "Makes an ecosystem of a page of JSON and a few maps: a terrain, materials, kinds of trees and "
              "their "
              "instances, in one file that the player opens at once.",
          .examples = {{"ecogen --new > forest.json", "a page to begin with"},
                       {"ecogen forest.json -o forest.eco --html forest.html",
                        "the ecosystem, and what became of it"},
                       {"ecogen forest.json --edit 'types[0].count=500' -o dense.eco",
                        "the same page, another number"}},
          .limits = {{"types of trees", k_max_tree_types, "types"},
                     {"vertices along a side of a terrain", k_max_terrain_side, "vertices"},
                     {"depth of the box hierarchy", k_max_quad_depth, "levels"}}};
}

void add_options(CLI::App& app, Options& o) {
  app.add_option("INPUT", o.input, "the page: JSON, see --new and --schema")->type_name("FILE");
  app.add_option("-o,--output", o.output, "the ecosystem, NAME.eco (of --new and --schema: the page)")
      ->type_name("FILE");
  CLI::Option_group* page = app.add_option_group("The page");
  page->add_flag("--new", o.print_template, "print a page to begin with (or write it, with -o), and exit");
  page->add_flag("--schema", o.print_schema,
                 "print (or write) the JSON Schema that pages are checked against, and exit");
  page->add_option("--edit", o.edits, "set a value of the page, such as types[0].count=500; may be repeated")
      ->type_name("PATH=VALUE")
      ->allow_extra_args(false);
  page->add_option("--instances", o.instances, "more instances by hand, as --export NAME.csv writes them")
      ->type_name("FILE.csv");
  CLI::Option_group* other = app.add_option_group("For other programs");
  other
      ->add_option("--export", o.exports,
                   "NAME.glb (with EXT_mesh_gpu_instancing), NAME.png (a map from above), NAME.csv (the "
                   "instances), NAME.obj (small ones); may be repeated")
      ->type_name("FILE")
      ->allow_extra_args(false);
  other->add_flag(
      "--glb-nodes", o.glb_nodes,
      "of a .glb: a node an instance, for programs that do not know the extension (Blender before 3.6); "
      "at most 200000");
  CLI::Option_group* frames = app.add_option_group("Leaving out what no frame shows");
  CLI::Option* path = frames
                          ->add_option("--camera-path", o.camera_path,
                                       "keys of a camera's path, as treeplay --path takes them")
                          ->type_name("FILE.json");
  frames
      ->add_option("--lowest-sun", o.lowest_sun,
                   "degrees above the horizon: with --camera-path trees stay whose shadows may fall into a "
                   "frame while the sun stands at least so high; 90: none for that reason")
      ->check(number_between(1, 90))
      ->type_name("DEGREES")
      ->needs(path)
      ->capture_default_str();
  frames
      ->add_option("--widest", o.widest,
                   "width over height of the frames of the path, at most: 3.56 for a screen of 32 : 9")
      ->check(number_between(0.1, 100))
      ->type_name("RATIO")
      ->needs(path)
      ->capture_default_str();
  frames
      ->add_option("--view-range", o.view_range,
                   "metres; nothing is drawn farther away, whatever view_range its type has")
      ->check(number_between(0, 1e9))
      ->type_name("M");
  CLI::Option_group* file = app.add_option_group("The file");
  file->add_flag("--pack", o.pack, "put trees and textures into it, instead of their names");
  file->add_flag("--compress", o.compress, "compress its sections (zstd): smaller, but not used in place");
}

}  // namespace copse::ecogen
