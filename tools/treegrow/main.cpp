// treegrow: a species in, the mesh of a tree out, with its exact hierarchy.
#include "tools/common/tool.h"
#include "tools/treegrow/options.h"
#include "tools/treegrow/run.h"

int main(int argc, char** argv) {
  copse::treegrow::Options options;
  return copse::run_tool(
      copse::treegrow::info(), argc, argv, [&](CLI::App& app) { copse::treegrow::add_options(app, options); },
      [&](copse::Context& context) { return copse::treegrow::run(options, context); });
}
