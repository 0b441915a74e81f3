// A tool with nothing but the common options and a few levers, so that tests can see run_tool from outside.
#include "tools/common/option_values.h"
#include "tools/common/tool.h"

#include <chrono>
#include <new>
#include <stdexcept>
#include <string>
#include <thread>

#include <CLI/CLI.hpp>

namespace {

using namespace copse;

struct ProbeOptions {
  std::filesystem::path input, output;
  std::string text = "probe\n";
  std::string fault;
  double wait = 0, share = 0.5;
  int side = 1;
  int level = 3;
  bool print = false;
  bool show = false;
  bool keep = false;
};

Result<void> raise_fault(const std::string& fault) {
  if (fault == "memory") throw std::bad_alloc();
  if (fault == "throw") throw std::runtime_error("two\nlines");
  if (fault == "int") throw 42;
  if (fault == "refused") return refuse("in.obj", "line 3: no\nsense", "mend it");
  if (fault == "limit") return fail(Fault::limit, "", "error 0.2 exceeds 0.1", "raise --max-error");
  return {};
}

Result<void> run(const ProbeOptions& options, Context& context) {
  if (!options.input.empty()) context.read(options.input, true);
  {
    Stage stage = context.stage("wait");
    for (int i = 0; i < 100; ++i) {
      std::this_thread::sleep_for(std::chrono::duration<double>(options.wait / 100));
      stage.progress(i / 100.0);
    }
    stage.items(100, "naps");
  }
  context.warn("this is\na probe");
  if (options.print) context.print("printed\n");
  if (options.show) {
    const CommonOptions& c = context.options();
    context.print("jobs " + std::to_string(c.jobs) + " seed " + std::to_string(c.seed) + " level " +
                  std::to_string(options.level) + " text " + options.text + "\n");
    context.print("side " + std::to_string(options.side) + "\n");
  }
  if (!options.output.empty()) {
    if (auto written = context.write(options.output, options.text); !written) return written;
  }
  if (options.keep) std::this_thread::sleep_for(std::chrono::seconds(30));
  return raise_fault(options.fault);
}

}  // namespace

int main(int argc, char** argv) {
  ProbeOptions options;
  const ToolInfo info{
      .name = "common_probe",
      .summary = "shows what all tools share, and nothing else; a summary that is long enough to be wrapped",
      .examples =
          {{"common_probe oak.obj -o oak.txt", "writes the text under its name"},
           {"common_probe oak.obj -o oak.txt --text 'a rather long text, so that the line must be broken'",
            "the same with another text"}},
      .limits = {{"levels of the probe", 7, "levels"}}};
  return copse::run_tool(
      info, argc, argv,
      [&](CLI::App& app) {
        app.add_option("INPUT", options.input, "a file to read");
        app.add_option("-o,--output", options.output, "the file to write")->type_name("FILE");
        app.add_option("--text", options.text, "what to write");
        app.add_option("--level", options.level, "a number that does nothing");
        app.add_option("--fault", options.fault, "what goes wrong: memory, throw, int, refused, limit");
        app.add_option("--wait", options.wait, "seconds to wait")->type_name("S");
        CLI::Option_group* levers = app.add_option_group("Levers");
        levers->add_option("--share", options.share, "a share")->check(number_between(0, 1));
        add_choice<int>(*levers, "--side", options.side, "a side", {{"left", 0}, {"right", 1}});
        app.add_flag("--print", options.print, "prints a line");
        app.add_flag("--show", options.show, "prints the options as they were understood");
        app.add_flag("--keep", options.keep, "waits 30 seconds with the output written but not yet visible");
      },
      [&](Context& context) { return run(options, context); });
}
