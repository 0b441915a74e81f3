// The command line of treegrow.
#pragma once

#include "tools/common/tool.h"

#include <cstdint>
#include <filesystem>
#include <string>

namespace copse::treegrow {

struct Options {
  std::string species;
  std::filesystem::path output, truth, params;
  std::uint64_t triangles = 0;  // 0: what the species has by itself
  double height = 0;            // m; 0: the species'
  bool strict_model = false;
  std::string breaks;  // empty: artist, unless strict_model
  int texture_size = 512;
  bool no_textures = false;
  bool list = false, list_breaks = false;
  std::string print;
};

ToolInfo info();
void add_options(CLI::App& app, Options& options);

}  // namespace copse::treegrow
