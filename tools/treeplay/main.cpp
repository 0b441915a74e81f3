// treeplay: draws a tree, in a window or into pictures.
#include "tools/common/tool.h"
#include "tools/treeplay/options.h"
#include "tools/treeplay/play.h"

int main(int argc, char** argv) {
  copse::treeplay::Options options;
  return copse::run_tool(
      copse::treeplay::info(), argc, argv, [&](CLI::App& app) { copse::treeplay::add_options(app, options); },
      [&](copse::Context& context) { return copse::treeplay::run(options, context); });
}
