// bvfit: bounding volumes round meshes, trees and points, proven to enclose them as written.
#include "tools/bvfit/options.h"
#include "tools/bvfit/run.h"
#include "tools/common/tool.h"

int main(int argc, char** argv) {
  copse::bvfit::Options options;
  return copse::run_tool(
      copse::bvfit::info(), argc, argv, [&](CLI::App& app) { copse::bvfit::add_options(app, options); },
      [&](copse::Context& context) { return copse::bvfit::run(options, context); });
}
