// The command line of lodbake.
#pragma once

#include "lib/analysis/lod/foliage_pruning.h"
#include "lib/analysis/lod/leaf_collapse.h"
#include "lib/analysis/lod/limb_ladder.h"
#include "lib/formats/levels/impostors.h"
#include "lib/formats/levels/spectrum_file.h"
#include "lib/formats/result.h"
#include "tools/common/tool.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace copse::lodbake {

enum class TrunkMethod { radii, edges };
enum class FoliageMethod { collapse, prune };
enum class Division { picture, even };

struct Options {
  std::filesystem::path input, output;
  std::vector<double> discrete;        // shares of the triangles, descending
  std::vector<double> discrete_error;  // metres, ascending
  std::optional<double> near, medium, far;
  bool continuous = false;
  std::uint64_t min_triangles = 0;
  std::uint64_t threshold = 0;       // trees with no more triangles get no levels
  double hysteresis = 10;            // percent
  std::vector<std::string> methods;  // names of --method
  bool trunk_given = false, foliage_given = false, quality_given = false, cells_given = false;
  bool impostor_views_given = false, impostor_layout_given = false;
  TrunkMethod trunk = TrunkMethod::radii;
  RemovalOrder removal = RemovalOrder::silhouette;
  FoliageMethod foliage = FoliageMethod::collapse;
  CollapseQuality quality = CollapseQuality::balanced;  // of --foliage collapse
  std::uint32_t cells = 256;  // of --foliage prune, at most; fewer for few leaves when not given
  PruningOptions pruning;     // of --foliage prune, beside what is named above
  bool pruning_given = false;
  bool lines_points = false;
  int impostor = 0;  // pixels of a view's side; 0: none
  int impostor_views = 8;
  ImpostorLayout impostor_layout = ImpostorLayout::octahedral;
  Division division = Division::picture;
  SpectrumCodingOptions coding;
  std::optional<double> max_error;  // metres
  int views = 42;                   // of --measure and --sweep
  bool measure = false, sweep = false;
};

// --method lines-points alone: the tree is checked and measured, and gets no spectra.
bool lines_points_alone(const Options& options);

ToolInfo info();
void add_options(CLI::App& app, Options& options);
// What CLI11 cannot say: order of the levels, of the distances, what excludes what.
Result<void> check(const Options& options);

}  // namespace copse::lodbake
