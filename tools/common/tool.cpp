#include "tools/common/tool.h"

#include "tools/common/command_line.h"
#include "tools/common/console.h"
#include "tools/common/context.h"
#include "tools/common/interrupt.h"
#include "tools/common/outputs.h"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <exception>
#include <new>
#include <string>

#include <fcntl.h>
#include <tbb/global_control.h>
#include <unistd.h>

namespace copse {
namespace {

// A file opened while stdin, stdout or stderr is closed would take its number, and what is printed would go
// into that file. The placeholder is opened the wrong way round, so that using it still fails.
void occupy_standard_files() {
  for (const int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
    if (::fcntl(file, F_GETFD) != -1 || errno != EBADF) continue;
    const int placeholder = ::open("/dev/null", file == STDIN_FILENO ? O_WRONLY : O_RDONLY);
    if (placeholder >= 0 && placeholder != file) ::close(placeholder);
  }
}

bool wants_bar(const CommonOptions& options) {
  if (options.progress == Progress::always) return true;
  if (options.progress == Progress::never || options.quiet || ::isatty(STDERR_FILENO) == 0) return false;
  const char* terminal = std::getenv("TERM");
  return terminal == nullptr || std::string(terminal) != "dumb";
}

Error bug(const std::string& what) {
  return {Fault::bug, "", "defect of the program: " + what,
          "please report it with the command line and the input"};
}

// Runs `work` and turns what escapes it into an Error.
template <class Work>
Result<void> guarded(const Work& work) {
  try {
    return work();
  } catch (const std::bad_alloc&) {
    return refuse("", "not enough memory", "use a smaller input, or a machine with more memory");
  } catch (const std::exception& error) {
    return std::unexpected(bug(error.what()));
  } catch (...) {
    return std::unexpected(bug("unknown exception"));
  }
}

Result<void> run_in_context(const ToolInfo& info, CommandLine&& line, const Run& run) {
  const tbb::global_control threads(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(line.common.jobs));
  ToolContext context(info, std::move(line.common));
  const InterruptGuard guard([&context] { context.outputs().discard(); });
  if (wants_bar(context.options())) context.console().enable_bar();
  context.report().options = std::move(line.options);
  for (const std::filesystem::path& file : line.files) context.read(file, false);
  if (auto writable = context.check_own_outputs(); !writable) return writable;
  const Result<void> done = run(context);
  if (done) return context.finish();
  if (done.error().fault == Fault::limit) {
    if (auto told = context.finish_refused(done.error()); !told) return told;
  }
  return done;
}

Result<void> run_command(const ToolInfo& info, const std::vector<std::string>& arguments,
                         const AddOptions& add_options, const Run& run) {
  auto line = parse_command_line(info, arguments, add_options, terminal_width(STDOUT_FILENO));
  if (!line) return std::unexpected(std::move(line.error()));
  if (!line->answer.empty()) return write_stdout(line->answer);
  return run_in_context(info, std::move(*line), run);
}

}  // namespace

int run_tool(const ToolInfo& info, int argc, char** argv, const AddOptions& add_options, const Run& run) {
  occupy_standard_files();
  std::signal(SIGPIPE, SIG_IGN);  // a closed pipe is an error like any other
  const Result<void> result = guarded([&] {
    return run_command(info, std::vector<std::string>(argv + std::min(argc, 1), argv + argc), add_options,
                       run);
  });
  if (result) return 0;
  guarded([&]() -> Result<void> {
    Console(info.name).line(to_line(result.error(), info.name));
    return {};
  });
  return static_cast<int>(result.error().fault);
}

}  // namespace copse
