// The command line of bvfit.
#pragma once

#include "lib/analysis/volumes/choose.h"
#include "lib/analysis/volumes/fit_volumes.h"
#include "tools/common/tool.h"

#include <filesystem>
#include <string>
#include <vector>

namespace copse::bvfit {

struct Options {
  std::vector<std::filesystem::path> inputs;
  std::filesystem::path output;  // .json, .tree, .stree; empty: the table alone
  std::vector<std::string> volumes{"all"}, methods{"best"}, per{"whole"};
  FitQuality quality = FitQuality::balanced;
  double budget = 0;  // seconds; 0: none
  Criterion choose = Criterion::volume;
  std::string costs = "table";  // or measured
  ExpectedCost expected;
  std::string aspect_tree;  // empty: the default
  bool tune = false;
  std::string hierarchy;  // "", "kd4", "rtree4", "clusters", "original", "flat"
  bool compare_hierarchies = false;
  double sway = 0;  // degrees
  bool times = false, sweep = false;
  std::filesystem::path verify, export_glb;
};

void add_options(CLI::App& app, Options& options);

}  // namespace copse::bvfit
