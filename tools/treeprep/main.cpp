// treeprep: a mesh of a tree in, a .tree or .stree out.
#include "tools/common/memory.h"
#include "tools/common/tool.h"
#include "tools/treeprep/options.h"
#include "tools/treeprep/run.h"

int main(int argc, char** argv) {
  copse::return_large_arrays();
  copse::treeprep::Options options;
  return copse::run_tool(
      copse::treeprep::info(), argc, argv, [&](CLI::App& app) { copse::treeprep::add_options(app, options); },
      [&](copse::Context& context) { return copse::treeprep::run(options, context); });
}
