// Runs the tools as a user does: real processes, their exit status and what they print.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace copse {

struct Outcome {
  int status = -1;  // exit status; 128 + signal when a signal ended it
  std::string out, err;
  double seconds = 0;
};

// `command[0]` without a slash is a tool of this build. `environment`: "NAME=value", added to the caller's.
Outcome run_process(std::vector<std::string> command, const std::vector<std::string>& environment = {});

// A folder of its own for one test, removed at the end.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::filesystem::path& path() const { return path_; }
  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

// How many lines a text has; an error must be one.
std::size_t line_count(const std::string& text);

void write_text(const std::filesystem::path& path, const std::string& text);
std::string read_text(const std::filesystem::path& path);

}  // namespace copse
