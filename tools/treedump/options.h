// The command line of treedump.
#pragma once

#include "tools/common/tool.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace copse {

struct DumpOptions {
  std::vector<std::filesystem::path> files;
  std::filesystem::path output = "-";
  bool json = false;
  bool arrays = false;
  bool hierarchy = false;
  bool verify = false;
  bool diff = false;
  double tolerance = 0;  // of --diff
  std::filesystem::path export_to;
  bool draco = false;
  std::optional<int> level;
  std::optional<double> ratio, max_error;
};

ToolInfo treedump_info();
void add_options(CLI::App& app, DumpOptions& options);

}  // namespace copse
