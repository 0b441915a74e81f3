#include "tools/lodbake/measure_stage.h"

#include "lib/analysis/measure/lod_quality.h"
#include "lib/analysis/measure/surface_distance.h"
#include "lib/runtime/levels.h"
#include "tools/lodbake/level_pictures.h"

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
  LodQuality measure(const DrawnMesh& level) {
    const double share = static_cast<double>(level.triangles.size()) /
                         std::max<double>(1, static_cast<double>(source_.triangles.size()));
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

std::vector<std::string> quality_row(std::string name, const LodQuality& q, double share) {
  return {std::move(name),
          fmt::format("{}", q.triangles),
          short_number(share),
          short_number(q.area_ratio),
          short_number(q.coverage_ratio),
          short_number(q.iou),
          fmt::format("{:.4f}", q.rmse),
          short_number(q.ssim),
          short_number(q.hull_growth),
          fmt::format("{}", shown_size(share))};
}

const std::vector<std::string>& quality_columns() {
  static const std::vector<std::string> k_columns{"Level",       "Triangles",      "Share", "Area",
                                                  "Coverage",    "Silhouette IoU", "RMSE",  "SSIM",
                                                  "Hull growth", "Pixels"};
  return k_columns;
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

void measure_levels(const LodSpectra& spectra, const Looks& looks, const std::vector<LodLevel>& levels,
                    const Options& options, Context& context) {
  Stage stage = context.stage("measure");
  stage.items(levels.size(), "levels");
  const DrawnMesh source = drawn_level(spectra, {});
  Judges judges(source, looks, options.views);
  const LevelExtractor trunk(spectra.trunk), leaves(spectra.leaves);
  std::vector<std::uint32_t> buffer(std::max(trunk.capacity(), leaves.capacity()));
  Table table{.name = "quality", .columns = quality_columns(), .rows = {}};
  table.columns.insert(table.columns.end(),
                       {"Level to source (m)", "Source to level (m)", "Extraction (us)"});
  Curve rmse{.name = "image error", .x = "triangles", .y = "RMSE", .points = {}},
      coverage{.name = "coverage", .x = "triangles", .y = "of full detail", .points = {}};
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const DrawnMesh drawn = drawn_level(spectra, levels[i]);
    const LodQuality q = judges.measure(drawn);
    const SurfaceDistances d = surface_distance(source, drawn);
    const double share =
        static_cast<double>(q.triangles) / std::max<double>(1, static_cast<double>(source.triangles.size()));
    table.rows.push_back(quality_row(fmt::format("{}", i), q, share));
    table.rows.back().push_back(fmt::format("{:.4g}", d.from_level.mean));
    table.rows.back().push_back(fmt::format("{:.4g}", d.from_source.mean));
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
