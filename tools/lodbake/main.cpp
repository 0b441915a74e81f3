// lodbake: a tree in, the same tree with its LOD spectra out.
#include "tools/lodbake/options.h"
#include "tools/lodbake/run.h"

int main(int argc, char** argv) {
  copse::lodbake::Options options;
  return copse::run_tool(
      copse::lodbake::info(), argc, argv, [&](CLI::App& app) { copse::lodbake::add_options(app, options); },
      [&](copse::Context& context) { return copse::lodbake::run(options, context); });
}
