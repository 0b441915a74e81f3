#include "tools/treedump/options.h"
#include "tools/treedump/run.h"

int main(int argc, char** argv) {
  copse::DumpOptions options;
  return copse::run_tool(
      copse::treedump_info(), argc, argv, [&](CLI::App& app) { copse::add_options(app, options); },
      [&](copse::Context& context) { return copse::run_treedump(options, context); });
}
