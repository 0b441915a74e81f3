#include "tools/lodbake/measure_stage.h"

#include "lib/analysis/lod/discrete_spectra.h"
#include "lib/analysis/measure/lod_quality.h"
#include "lib/analysis/measure/surface_distance.h"
#include "lib/formats/levels/spectrum_file.h"
#include "lib/runtime/levels.h"
#include "tools/lodbake/level_pictures.h"
#include "tools/lodbake/levels.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <memory>

#include <fmt/format.h>

namespace copse::lodbake {
namespace {

// Pixels across the tree at which a level with this share of the triangles is shown.
int shown_size(double share) {
  return share >= 0.25 ? 512 : share >= 0.05 ? 128 : 32;
}

// One judge a size, made when it is first asked for.
class Judges {
 public:
  Judges(const DrawnMesh& source, const Looks& looks, int views)
      : source_(source), looks_(looks), views_(views) {}
  LodQuality measure(const DrawnMesh& level, double share) {
    auto& judge = judges_[shown_size(share)];
    if (!judge)
      judge = std::make_unique<LodJudge>(
          source_, looks_,
          LodQualityOptions{.views = views_, .image_size = shown_size(share), .mask_size = 256});
    return judge->measure(level);
  }

 private:
  const DrawnMesh& source_;
  Looks looks_;
  int views_;
  std::map<int, std::unique_ptr<LodJudge>> judges_;
};

std::string short_number(double value) {
  return fmt::format("{:.3f}", value);
}

std::vector<std::string> quality_row(std::string name, const LodQuality& q, double share, double asked) {
  return {std::move(name),
          fmt::format("{}", q.triangles),
          short_number(share),
          short_number(q.area_ratio),
          short_number(q.coverage_ratio),
          short_number(q.iou),
          fmt::format("{:.4f}", q.rmse),
          short_number(q.ssim),
          short_number(q.hull_growth),
          fmt::format("{}", shown_size(asked))};
}

const std::vector<std::string>& quality_columns() {
  static const std::vector<std::string> k_columns{"Level",       "Triangles",      "Share", "Area",
                                                  "Coverage",    "Silhouette IoU", "RMSE",  "SSIM",
                                                  "Hull growth", "Pixels"};
  return k_columns;
}

// Of the segments whose tubes are gone, in all segments' length; nothing without a hierarchy.
std::string lost_length(const Tree& tree, const Spectrum& trunk, std::uint32_t steps) {
  if (tree.radius_count() == 0 || tree.trunk.lines.empty()) return "-";
  const std::vector<Double3> centres = absolute_centres(tree);
  const std::vector<std::uint32_t> parent = parents(tree);
  std::vector<std::uint8_t> there(tree.radius_count(), 0);
  for (const SpectrumElement& e : trunk.elements) {
    if (steps < e.birth || steps >= e.death) continue;
    // A tube names the last of its segments, and a limb outlives what grows from it: down to the root all is
    // there.
    for (std::uint32_t r = e.radius; r < there.size() && !there[r]; r = parent[r]) there[r] = 1;
  }
  double all = 0, lost = 0;
  for (const auto& [from, to] : tree.trunk.lines) {
    const double length = distance(centres[from], centres[to]);
    all += length, lost += there[to] ? 0 : length;
  }
  return short_number(all > 0 ? lost / all : 0);
}

// Of both spectra, if this level were the only one beside full detail.
std::string stored_bytes(const Tree& tree, const LodSpectra& spectra, const LodLevel& level,
                         const SpectrumCodingOptions& coding) {
  LodSpectra one = spectra;
  one.discrete = {level};
  one = discrete_spectra(one);
  std::size_t bytes = 0;
  for (const Spectrum* part : {&one.trunk, &one.leaves}) {
    if (part->elements.empty()) continue;
    const auto encoded = encode_spectrum(*part, coding, &tree);
    if (!encoded) return "-";
    bytes += encoded->bytes.size();
  }
  return fmt::format("{}", bytes);
}

// Microseconds to take a level: the median of several.
double extraction_time(const LevelExtractor& trunk, const LevelExtractor& leaves, const LodLevel& level,
                       std::vector<std::uint32_t>& buffer) {
  std::vector<double> times;
  for (int i = 0; i < 21; ++i) {
    const auto start = std::chrono::steady_clock::now();
    trunk.extract(level.trunk_steps, buffer);
    leaves.extract(level.leaf_steps, buffer);
    times.push_back(
        std::chrono::duration<double, std::micro>(std::chrono::steady_clock::now() - start).count());
  }
  std::nth_element(times.begin(), times.begin() + 10, times.end());
  return times[10];
}

}  // namespace

void measure_levels(const Tree& tree, const LodSpectra& spectra, const Looks& looks,
                    const std::vector<LodLevel>& levels, const Options& options, Context& context) {
  Stage stage = context.stage("measure");
  stage.items(levels.size(), "levels");
  const DrawnMesh source = drawn_level(spectra, {});
  Judges judges(source, looks, options.views);
  const LevelExtractor trunk(spectra.trunk), leaves(spectra.leaves);
  std::vector<std::uint32_t> buffer(std::max(trunk.capacity(), leaves.capacity()));
  Table table{.name = "quality", .columns = quality_columns(), .rows = {}};
  table.columns.insert(table.columns.end(), {"Level to source (m)", "Source to level (m)",
                                             "Lost branch length", "Bytes", "Extraction (us)"});
  const std::vector<double> asked = asked_shares(options);
  Curve rmse{.name = "image error", .x = "triangles", .y = "RMSE", .points = {}},
      coverage{.name = "coverage", .x = "triangles", .y = "of full detail", .points = {}};
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const DrawnMesh drawn = drawn_level(spectra, levels[i]);
    const double share = static_cast<double>(drawn.triangles.size()) /
                         std::max<double>(1, static_cast<double>(source.triangles.size()));
    const double nominal = i > 0 && i <= asked.size() ? asked[i - 1] : share;
    const LodQuality q = judges.measure(drawn, nominal);
    const SurfaceDistances d = surface_distance(source, drawn);
    table.rows.push_back(quality_row(fmt::format("{}", i), q, share, nominal));
    table.rows.back().push_back(fmt::format("{:.4g}", d.from_level.mean));
    table.rows.back().push_back(fmt::format("{:.4g}", d.from_source.mean));
    table.rows.back().push_back(lost_length(tree, spectra.trunk, levels[i].trunk_steps));
    table.rows.back().push_back(stored_bytes(tree, spectra, levels[i], options.coding));
    table.rows.back().push_back(fmt::format("{:.1f}", extraction_time(trunk, leaves, levels[i], buffer)));
    rmse.points.push_back({fmt::format("{}", i), static_cast<double>(q.triangles), q.rmse});
    coverage.points.push_back({fmt::format("{}", i), static_cast<double>(q.triangles), q.coverage_ratio});
    stage.progress(static_cast<double>(i + 1) / static_cast<double>(levels.size()));
  }
  Report& report = context.report();
  report.tables.push_back(std::move(table));
  report.curves.push_back(std::move(rmse)), report.curves.push_back(std::move(coverage));
}

}  // namespace copse::lodbake
