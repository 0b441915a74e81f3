#include "tools/treegrow/options.h"

#include "tools/common/option_values.h"
#include "tools/treegrow/grow.h"
#include "tools/treegrow/species.h"
#include "tools/treegrow/treegrow.h"

#include <CLI/CLI.hpp>

namespace copse::treegrow {
namespace {

std::string power_of_two(const std::string& text) {
  for (int size = 64; size <= 4096; size *= 2)
    if (text == std::to_string(size)) return {};
  return "'" + text + "' is not 64, 128, 256, 512, 1024, 2048 or 4096";
}

}  // namespace

ToolInfo info() {
  return {
      .name = "treegrow",
      .summary =
          "Grows a tree and writes its mesh as an artist would export it, with painted textures; on request "
          "the exact hierarchy beside it. It obeys the strict model of the thesis, or breaks it in named "
          "ways.",
      .examples =
          {{"treegrow oak -o oak.glb --truth oak.json --seed 3",
            "an oak, and what treeprep should find in it"},
           {"treegrow spruce -o spruce.obj --strict-model --triangles 1000000",
            "a spruce of a million triangles that keeps every rule of the model"},
           {"treegrow dead -o dead.obj --break laid-against,capped-ngon,shuffled --truth dead.json.gz",
            "a dead tree that breaks the model in just three ways"},
           {"treegrow --print oak > mine.toml; treegrow --params mine.toml -o mine.glb",
            "a species of your own"}},
      .limits = {{"points that the stems of a tree are drawn through", grow::k_most_nodes, "points"},
                 {"triangles of a mesh", grow::k_most_triangles, "triangles"}}};
}

void add_options(CLI::App& app, Options& o) {
  std::string names;
  for (const std::string& name : grow::species_names()) names += (names.empty() ? "" : ", ") + name;
  app.add_option("SPECIES", o.species, "what to grow: " + names);
  app.add_option(
         "-o,--output", o.output,
         "the mesh: NAME.obj (with NAME.mtl and textures beside it), NAME.glb (all in one) or NAME.ply")
      ->type_name("FILE");
  app.add_option("--truth", o.truth, "the exact hierarchy of the mesh: NAME.json or NAME.json.gz")
      ->type_name("FILE");

  CLI::Option_group* tree = app.add_option_group("The tree");
  tree->add_option("--triangles", o.triangles,
                   "of the whole mesh, met within 2 %; default: what suits the species")
      ->check(whole_number_from(1, grow::k_most_triangles))
      ->type_name("N")
      ->default_str("");
  tree->add_option("--height", o.height, "m; default: of an ordinary specimen")
      ->check(number_between(1e-3, 1e4))
      ->type_name("H")
      ->default_str("");
  tree->add_option("--params", o.params, "a species of your own, as --print writes them")->type_name("FILE");

  CLI::Option_group* mesh = app.add_option_group("The mesh");
  CLI::Option* strict =
      mesh->add_flag("--strict-model", o.strict_model, "keep every rule of the strict model");
  mesh->add_option(
          "--break", o.breaks,
          "break the strict model in these ways only (--list-breaks); `artist`, the default, stands for "
          "free-tubes, pointed, seams, vary-k, quad-cards and quads")
      ->excludes(strict)
      ->type_name("NAME,...");
  mesh->add_option("--texture-size", o.texture_size, "edge of the textures, in texels")
      ->check(CLI::Validator(power_of_two, "", ""))
      ->capture_default_str()
      ->type_name("N");
  mesh->add_flag("--no-textures", o.no_textures, "materials have colours alone");

  CLI::Option_group* about = app.add_option_group("Instead of growing");
  about->add_flag("--list", o.list, "show the species and exit");
  about->add_flag("--list-breaks", o.list_breaks, "show the ways to break the model and exit");
  about->add_option("--print", o.print, "show a species' parameters as TOML and exit")->type_name("SPECIES");
}

}  // namespace copse::treegrow
