// ecogen: a page of JSON and a few maps in, an ecosystem out.
#include "tools/common/tool.h"
#include "tools/ecogen/options.h"
#include "tools/ecogen/run.h"

int main(int argc, char** argv) {
  copse::ecogen::Options options;
  return copse::run_tool(
      copse::ecogen::info(), argc, argv, [&](CLI::App& app) { copse::ecogen::add_options(app, options); },
      [&](copse::Context& context) { return copse::ecogen::run(options, context); });
}
