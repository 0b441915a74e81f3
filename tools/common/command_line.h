// From argv to options: response files, the common options of every tool, configuration files, help.
#pragma once

#include "tools/common/tool.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace copse {

struct CommandLine {
  CommonOptions common;
  std::string answer;  // what --help, --version or --limits print; empty when the tool is to run
  std::vector<std::pair<std::string, std::string>> options;  // for the report, as given or defaulted
  std::vector<std::filesystem::path> files;  // response and configuration files that were read
};

// `arguments` are those after the program's name; `width` is the terminal's, for --help.
Result<CommandLine> parse_command_line(const ToolInfo& info, const std::vector<std::string>& arguments,
                                       const AddOptions& add_options, int width);

// The name among `names` that `given` was probably meant to be; empty when none is near.
std::string nearest_name(const std::string& given, const std::vector<std::string>& names);

}  // namespace copse
