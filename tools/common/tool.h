// What all tools share: the common options of cli.md, console, progress, report, output files, exit codes.
//
//   int main(int argc, char** argv) {
//     MyOptions options;
//     return run_tool({.name = "treegrow", .summary = "...", .examples = {...}}, argc, argv,
//                     [&](CLI::App& app) { add_options(app, options); },
//                     [&](Context& context) { return run(options, context); });
//   }
#pragma once

#include "lib/formats/pieces.h"
#include "lib/formats/report.h"
#include "lib/formats/result.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace copse {

// A built-in limit, for --limits: "nesting of a glTF scene", 1024, "levels".
struct Limit {
  std::string name;
  std::uint64_t value = 0;
  std::string unit;
};

struct ToolInfo {
  std::string name;
  std::string summary;                                        // one sentence, shown on top of --help
  std::vector<std::pair<std::string, std::string>> examples;  // at least two: command, what it does
  std::vector<Limit> limits;
};

enum class Progress { automatic, always, never };

struct CommonOptions {
  bool quiet = false;
  bool verbose = false;
  Progress progress = Progress::automatic;
  int jobs = 0;  // resolved before run: the smallest of affinity mask, cgroup quota and SLURM_CPUS_PER_TASK
  std::uint64_t seed = 0;
  std::filesystem::path report, html, depfile;
};

class Context;

// One stage of the work, timed while it lives; with -v one line on stderr when it ends, with a progress bar
// when it takes more than about a second.
class Stage {
 public:
  struct Impl;
  explicit Stage(std::unique_ptr<Impl> impl);  // Context::stage() makes stages
  Stage(Stage&&) noexcept;
  ~Stage();
  void items(std::uint64_t count, std::string unit);  // what the stage went through
  void progress(double fraction);  // 0 to 1; cheap, may be called often and from any thread

 private:
  std::unique_ptr<Impl> impl_;
};

class Context {
 public:
  virtual ~Context() = default;
  virtual const CommonOptions& options() const = 0;
  virtual Report& report() = 0;
  virtual Stage stage(std::string name) = 0;
  // Warns on stderr (unless --quiet) and in the report.
  virtual void warn(std::string_view message) = 0;
  // Text on stdout at once, whatever becomes of the run: for answers such as a list of failed checks.
  virtual void print(std::string_view text) = 0;
  // Notes a file that was read: for the depfile and, when it is an input, for the report (its hash is taken
  // only when a report or page was asked for). Call it before the outputs are written, so that an output
  // that would overwrite an input is refused.
  virtual void read(const std::filesystem::path& path, bool is_input) = 0;
  // Whether this output could be written, as far as that can be known beforehand: call it before long work.
  virtual Result<void> check_output(const std::filesystem::path& path) = 0;
  // Writes an output: beside it, synced, renamed; all outputs of a run become visible only when run() has
  // succeeded. "-" is stdout. After a Fault::limit only report and page do, which name it as a warning.
  virtual Result<void> write(const std::filesystem::path& path, const Pieces& bytes) = 0;
  Result<void> write(const std::filesystem::path& path, std::string_view bytes);
};

using AddOptions = std::function<void(CLI::App&)>;
using Run = std::function<Result<void>(Context&)>;

// Parses, runs, reports; returns the exit status of cli.md. Never throws: an exception that escapes run() is
// a bug (70), running out of memory is a refusal (1).
int run_tool(const ToolInfo& info, int argc, char** argv, const AddOptions& add_options, const Run& run);

}  // namespace copse
