#include "tools/treedump/options.h"

#include "lib/formats/container/container.h"
#include "tools/common/option_values.h"

#include <climits>

#include <CLI/CLI.hpp>

namespace copse {

ToolInfo treedump_info() {
  return {.name = "treedump",
          .summary =
              "Looks inside .tree, .stree and .eco files: a summary, everything as JSON, the hierarchy, the "
              "geometry, what is wrong with a file, or what differs between two.",
          .examples = {{"treedump oak.stree", "what is in the file, how large it is and what was left out"},
                       {"treedump oak.stree --export oak.glb", "the geometry, for any viewer"},
                       {"treedump oak.stree --verify -q && cp oak.stree game/",
                        "copies a file only if it is sound"}},
          .limits = {{"sections of a file", k_max_sections, "sections"},
                     {"decoded size of a file, per stored byte", k_max_expansion, "bytes"}}};
}

void add_options(CLI::App& app, DumpOptions& options) {
  app.add_option("FILE", options.files,
                 "a .tree, .stree or .eco file; two with --diff, any number with --verify")
      ->required()
      ->type_name("FILE");
  const char* what = "What to show (a summary for a person when none is given)";
  CLI::Option* json = app.add_flag("--json", options.json, "the summary for a program")->group(what);
  CLI::Option* arrays =
      app.add_flag("--arrays", options.arrays, "with --json: the bulk data too")->group(what);
  CLI::Option* hierarchy =
      app.add_flag("--hierarchy", options.hierarchy, "radii and leaf groups as JSON, in absolute coordinates")
          ->group(what);
  CLI::Option* verify =
      app.add_flag("--verify", options.verify,
                   "checks every checksum and every invariant and lists all that fail; exit "
                   "status 1 if any does")
          ->group(what);
  CLI::Option* diff =
      app.add_flag("--diff", options.diff,
                   "what differs between two files; exit status 1 if anything does. Provenance and the "
                   "way of storing are told, but are no difference")
          ->group(what);
  CLI::Option* tolerance = app.add_option("--tolerance", options.tolerance,
                                          "with --diff: numbers that differ by no more than this are equal")
                               ->type_name("T")
                               ->check(number_from(0))
                               ->group(what);
  const char* geometry = "Geometry";
  CLI::Option* export_to =
      app.add_option("--export", options.export_to,
                     "the geometry as .obj, .ply or .glb; an impostor's pictures as .png")
          ->type_name("FILE")
          ->group(geometry);
  CLI::Option* draco = app.add_flag("--draco", options.draco, "compress a .glb with Draco")->group(geometry);
  CLI::Option* level = app.add_option("--level", options.level, "this level of detail; 0 is full")
                           ->type_name("N")
                           ->check(whole_number_from(0, INT_MAX))
                           ->group(geometry);
  CLI::Option* ratio =
      app.add_option("--ratio", options.ratio, "the level with about this share of the triangles")
          ->type_name("R")
          ->check(number_between(0, 1))
          ->group(geometry);
  CLI::Option* error = app.add_option("--max-error", options.max_error,
                                      "the coarsest level with at most this error, in metres")
                           ->type_name("E")
                           ->check(number_from(0))
                           ->group(geometry);
  app.add_option("-o,--output", options.output, "where to write JSON or text; - is stdout")
      ->type_name("FILE");
  arrays->needs(json);
  tolerance->needs(diff);
  for (CLI::Option* option : {draco, level, ratio, error}) option->needs(export_to);
  level->excludes(ratio)->excludes(error);
  ratio->excludes(error);
  const std::vector<CLI::Option*> modes{json, hierarchy, verify, diff, export_to};
  for (std::size_t i = 0; i < modes.size(); ++i) {
    for (std::size_t j = i + 1; j < modes.size(); ++j) {
      if (modes[i] == json && modes[j] == verify) continue;  // the checks for a program
      modes[i]->excludes(modes[j]);
    }
  }
}

}  // namespace copse
