// The command line of ecogen.
#pragma once

#include "tools/common/tool.h"

#include <filesystem>
#include <string>
#include <vector>

namespace copse::ecogen {

struct Options {
  std::filesystem::path input, output;
  bool print_template = false, print_schema = false;
  std::vector<std::string> edits;
  bool pack = false, compress = false, glb_nodes = false;
  std::filesystem::path instances, camera_path;
  double view_range = 0;   // m; 0: no limit
  double widest = 2.4;     // width over height of a frame of the camera's path, at most
  double lowest_sun = 20;  // degrees
  std::vector<std::filesystem::path> exports;
};

ToolInfo info();
void add_options(CLI::App& app, Options& options);

}  // namespace copse::ecogen
