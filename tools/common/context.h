// The Context that run_tool hands to a tool.
#pragma once

#include "tools/common/console.h"
#include "tools/common/outputs.h"
#include "tools/common/tool.h"

#include <chrono>
#include <string>
#include <vector>

namespace copse {

class ToolContext : public Context {
 public:
  ToolContext(const ToolInfo& info, CommonOptions options);

  const CommonOptions& options() const override { return options_; }
  Report& report() override { return report_; }
  Stage stage(std::string name) override;
  void warn(std::string_view message) override;
  void print(std::string_view text) override;
  void read(const std::filesystem::path& path, bool is_input) override;
  Result<void> check_output(const std::filesystem::path& path) override;
  using Context::write;
  Result<void> write(const std::filesystem::path& path, const Pieces& bytes) override;

  Console& console() { return console_; }
  Outputs& outputs() { return outputs_; }

  // Whether report, page and dependency file could be written.
  Result<void> check_own_outputs() const;
  // Report, page and dependency file as asked for, then everything becomes visible.
  Result<void> finish();
  // A limit that the user set is not met: no output is written, but report and page, which say why.
  Result<void> finish_refused(const Error& error);

 private:
  bool reports() const { return !options_.report.empty() || !options_.html.empty(); }
  Result<void> check_inputs(const std::filesystem::path& path) const;
  Result<void> check_name(const std::filesystem::path& path) const;
  Result<void> check_depfile_name(const std::filesystem::path& output) const;
  Result<void> add_depfile();
  Result<void> add_reports();

  CommonOptions options_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
  Report report_;
  Console console_;
  Outputs outputs_;
  std::vector<std::filesystem::path> read_;  // everything that was read, in order
  Result<void> printed_;                     // the first failure of print()
};

}  // namespace copse
