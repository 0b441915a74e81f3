#include "tools/common/context.h"

#include "lib/formats/export/html.h"
#include "lib/formats/hash.h"
#include "lib/formats/printable.h"
#include "tools/common/depfile.h"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <fstream>

#include <fmt/format.h>
#include <sys/resource.h>

namespace copse {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// The kernel's ru_maxrss outlives exec(): of a tool that a large process starts it is that process' peak.
// VmHWM is this program's own.
std::uint64_t peak_bytes() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return std::strtoull(line.c_str() + 6, nullptr, 10) * 1024;
  rusage usage{};
  return ::getrusage(RUSAGE_SELF, &usage) == 0 ? static_cast<std::uint64_t>(usage.ru_maxrss) * 1024 : 0;
}

// "0.213 s, 20000 triangles (94 k triangles/s)"
std::string describe(const StageRecord& stage) {
  std::string text = fmt::format("{}: {:.3f} s", stage.name, stage.seconds);
  if (stage.unit.empty()) return text;
  text += fmt::format(", {} {}", stage.items, stage.unit);
  if (stage.items > 0 && stage.seconds > 1e-6) {
    double rate = static_cast<double>(stage.items) / stage.seconds;
    const char* scale = rate >= 1e9 ? "G " : rate >= 1e6 ? "M " : rate >= 1e3 ? "k " : "";
    rate /= rate >= 1e9 ? 1e9 : rate >= 1e6 ? 1e6 : rate >= 1e3 ? 1e3 : 1;
    text += fmt::format(" ({:.3g} {}{}/s)", rate, scale, stage.unit);
  }
  return text;
}

// A container that a stage extends may be its own output: outputs are renamed into place when all reading is
// done, and what is mapped keeps the old contents. A source mesh may not.
bool may_be_rewritten(const fs::path& path) {
  static const std::array<std::string, 3> k_containers{".tree", ".stree", ".eco"};
  return std::find(k_containers.begin(), k_containers.end(), path.extension().string()) != k_containers.end();
}

bool same_file(const fs::path& a, const fs::path& b) {
  if (a.empty() || b.empty()) return false;
  if (is_stdout(a) || is_stdout(b)) return is_stdout(a) && is_stdout(b);
  std::error_code error;
  const fs::path real_a = fs::weakly_canonical(fs::absolute(a), error),
                 real_b = fs::weakly_canonical(fs::absolute(b), error);
  return !error && real_a == real_b && (!fs::exists(a, error) || fs::is_regular_file(a, error));
}

std::unexpected<Error> named_twice(const fs::path& path) {
  return fail(Fault::usage, path.string(), "two outputs of this run have this name",
              "give each a name of its own");
}

}  // namespace

struct Stage::Impl {
  ToolContext& context;
  std::size_t index;  // into the report's stages
  RunningStage running;
};

Stage::Stage(std::unique_ptr<Impl> impl) : impl_(std::move(impl)) {}
Stage::Stage(Stage&&) noexcept = default;

Stage::~Stage() {
  if (!impl_) return;
  impl_->context.console().end(impl_->running);
  StageRecord& record = impl_->context.report().stages[impl_->index];
  record.seconds = seconds_since(impl_->running.start);
  if (impl_->context.options().verbose) {
    impl_->context.console().line(impl_->context.report().tool + ": " + describe(record));
  }
}

void Stage::items(std::uint64_t count, std::string unit) {
  StageRecord& record = impl_->context.report().stages[impl_->index];
  record.items = count;
  record.unit = std::move(unit);
}

void Stage::progress(double fraction) {
  impl_->running.fraction.store(fraction, std::memory_order_relaxed);
}

ToolContext::ToolContext(const ToolInfo& info, CommonOptions options)
    : options_(std::move(options)), console_(info.name) {
  report_.tool = info.name;
  report_.version = COPSE_VERSION;
}

Stage ToolContext::stage(std::string name) {
  report_.stages.push_back({.name = name, .seconds = 0, .items = 0, .unit = {}});
  auto impl = std::unique_ptr<Stage::Impl>(new Stage::Impl{*this, report_.stages.size() - 1, {}});
  impl->running.name = std::move(name);
  console_.begin(impl->running);
  return Stage(std::move(impl));
}

void ToolContext::warn(std::string_view message) {
  report_.warnings.emplace_back(message);
  if (options_.quiet) return;
  Error line{.fault = Fault::refused, .file = {}, .what = std::string(message), .remedy = {}};
  std::string text = to_line(line, report_.tool);
  const std::string_view error_word = ": error: ";
  text.replace(report_.tool.size(), error_word.size(), ": warning: ");
  console_.line(text);
}

void ToolContext::print(std::string_view text) {
  if (printed_) printed_ = write_stdout(printable_lines(text));
}

void ToolContext::read(const fs::path& path, bool is_input) {
  if (std::find(read_.begin(), read_.end(), path) != read_.end()) return;
  read_.push_back(path);
  if (!is_input) return;
  FileRecord record{.path = path.string(), .bytes = 0, .hash = {}};
  if (reports()) {
    if (auto hashed = hash_file(path)) record = std::move(*hashed);
  } else {
    std::error_code error;
    const std::uintmax_t size = fs::file_size(path, error);
    if (!error) record.bytes = size;
  }
  report_.inputs.push_back(std::move(record));
}

Result<void> ToolContext::check_inputs(const fs::path& path) const {
  if (is_stdout(path) || may_be_rewritten(path)) return {};
  std::error_code error;
  for (const fs::path& input : read_) {
    if (fs::is_regular_file(path, error) && fs::equivalent(path, input, error)) {
      return fail(Fault::usage, path.string(), "is an input and an output of this run",
                  "give the output another name");
    }
  }
  return {};
}

// What a tool may not write: its inputs, and what its report, page and dependency file are called.
Result<void> ToolContext::check_name(const fs::path& path) const {
  for (const fs::path* own : {&options_.report, &options_.html, &options_.depfile}) {
    if (same_file(path, *own)) return named_twice(path);
  }
  return check_inputs(path);
}

Result<void> ToolContext::check_own_outputs() const {
  const std::array<const fs::path*, 3> own{&options_.report, &options_.html, &options_.depfile};
  for (std::size_t i = 0; i < own.size(); ++i) {
    if (own[i]->empty()) continue;
    if (auto named = check_depfile_name(*own[i]); !named) return named;
    if (auto possible = Outputs::check(*own[i]); !possible) return possible;
    for (std::size_t j = 0; j < i; ++j) {
      if (same_file(*own[i], *own[j])) return named_twice(*own[i]);
    }
  }
  return {};
}

// What has been read and what will be written can be named in the dependency file, if there is to be one.
Result<void> ToolContext::check_depfile_name(const fs::path& output) const {
  if (options_.depfile.empty()) return {};
  for (const fs::path& input : read_) {
    if (auto fits = fits_depfile(input); !fits) return fits;
  }
  return is_stdout(output) ? Result<void>{} : fits_depfile(output);
}

Result<void> ToolContext::check_output(const fs::path& path) {
  if (auto free = check_name(path); !free) return free;
  if (auto named = check_depfile_name(path); !named) return named;
  return Outputs::check(path);
}

Result<void> Context::write(const fs::path& path, std::string_view bytes) {
  return write(path, Pieces::borrowed(bytes));
}

Result<void> ToolContext::write(const fs::path& path, const Pieces& bytes) {
  if (auto free = check_name(path); !free) return free;
  return outputs_.add(path, bytes);
}

Result<void> ToolContext::add_depfile() {
  std::vector<fs::path> targets;
  for (const FileRecord& output : report_.outputs) targets.emplace_back(output.path);
  // A run that only prints: what make waits for is its report or page, or this file itself.
  for (const fs::path* other : {&options_.report, &options_.html, &options_.depfile}) {
    if (targets.empty() && !other->empty() && !is_stdout(*other)) targets.push_back(*other);
  }
  const auto text = make_depfile(targets, read_);
  if (!text) return std::unexpected(text.error());
  return outputs_.add(options_.depfile, Pieces::borrowed(*text));
}

Result<void> ToolContext::add_reports() {
  report_.outputs = outputs_.records();
  report_.seconds = seconds_since(start_);
  report_.peak_bytes = peak_bytes();
  for (const fs::path* own : {&options_.report, &options_.html, &options_.depfile}) {
    if (auto free = check_inputs(*own); !free) return free;
  }
  Result<void> done;
  if (!options_.report.empty()) done = outputs_.add(options_.report, Pieces::borrowed(to_json(report_)));
  if (done && !options_.html.empty()) done = outputs_.add(options_.html, Pieces::borrowed(to_html(report_)));
  return done;
}

Result<void> ToolContext::finish() {
  if (!printed_) return printed_;
  auto done = add_reports();
  if (done && !options_.depfile.empty()) done = add_depfile();
  if (!done) return done;
  return outputs_.commit();
}

Result<void> ToolContext::finish_refused(const Error& error) {
  outputs_.discard();
  report_.warnings.push_back("nothing was written: " + to_line(error, report_.tool));
  if (auto done = add_reports(); !done) return done;
  return outputs_.commit();
}

}  // namespace copse
