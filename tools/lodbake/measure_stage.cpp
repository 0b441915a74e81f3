#include "tools/lodbake/measure_stage.h"

#include "lib/analysis/lod/discrete_spectra.h"
#include "lib/formats/levels/spectrum_file.h"
#include "lib/runtime/levels.h"
#include "tools/lodbake/level_pictures.h"
#include "tools/lodbake/levels.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

#include <fmt/format.h>

namespace copse::lodbake {

namespace {

// One judge a size, made when it is first asked for.
class Judges {
 public:
  Judges(const DrawnMesh& source, const Looks& looks, int views)
      : source_(source), looks_(looks), views_(views) {}
  LodQuality measure(const DrawnMesh& level, int pixels) {
    auto& judge = judges_[pixels];
    if (!judge)
      judge = std::make_unique<LodJudge>(
          source_, looks_, LodQualityOptions{.views = views_, .image_size = pixels, .mask_size = 256});
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

// What is as far away as rounding says lies on the surface.
std::string metres(double value, double size) {
  return value <= 1e-12 * size ? "0" : fmt::format("{:.4g}", value);
}

std::vector<std::string> quality_row(std::size_t level, const LevelFigures& f) {
  const LodQuality& q = f.quality;
  return {fmt::format("{}", level),
          fmt::format("{}", q.triangles),
          short_number(f.share),
          short_number(q.area_ratio),
          f.leaf_area ? short_number(*f.leaf_area) : "-",
          short_number(q.coverage_ratio),
          short_number(q.coverage_low),
          short_number(q.coverage_high),
          short_number(q.iou),
          short_number(q.iou_low),
          fmt::format("{:.4f}", q.rmse),
          short_number(q.ssim),
          short_number(q.hull_growth),
          fmt::format("{}", f.pixels)};
}

void add_image_errors(const std::vector<LevelFigures>& figures, Report& report) {
  Curve curve{.name = "where each level begins", .x = "triangles", .y = "RMSE", .points = {}};
  for (std::size_t i = 0; i < figures.size(); ++i)
    curve.points.push_back({fmt::format("{}, {} pixels", i, figures[i].pixels),
                            static_cast<double>(figures[i].quality.triangles), figures[i].quality.rmse});
  report.curves.push_back(std::move(curve));
}

void add_coverage(const std::vector<LevelFigures>& figures, Report& report) {
  const std::pair<const char*, double LodQuality::*> k_views[] = {{"all views", &LodQuality::coverage_ratio},
                                                                  {"least view", &LodQuality::coverage_low},
                                                                  {"most view", &LodQuality::coverage_high}};
  for (const auto& [name, member] : k_views) {
    Curve curve{.name = name, .x = "triangles", .y = "coverage", .points = {}};
    for (std::size_t i = 0; i < figures.size(); ++i)
      curve.points.push_back({.label = {},
                              .x = static_cast<double>(figures[i].quality.triangles),
                              .y = figures[i].quality.*member});
    report.curves.push_back(std::move(curve));
  }
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

// As large as a sphere of that diameter is on the screen where the level begins (levels.h), within reason.
int pixels_where_shown(double diameter, double distance) {
  constexpr int k_least = 16, k_most = 512;
  if (!(distance > 0)) return k_most;
  return static_cast<int>(
      std::clamp<double>(std::round(pixels_at_distance(diameter, distance)), k_least, k_most));
}

LevelFigures figures_of(const LodSpectra& spectra, const LodLevel& level, double diameter, Judges& judges) {
  const DrawnMesh drawn = drawn_level(spectra, level);
  LevelFigures f;
  f.share = static_cast<double>(drawn.triangles.size()) /
            std::max<double>(1, static_cast<double>(full_detail(spectra).triangles));
  f.pixels = pixels_where_shown(diameter, level.distance);
  f.quality = judges.measure(drawn, f.pixels);
  const double leaves = area(drawn_state(spectra.leaves, 0));
  if (leaves > 0) f.leaf_area = area(drawn_state(spectra.leaves, level.leaf_steps)) / leaves;
  return f;
}

void add_cost(const Tree& tree, const LodSpectra& spectra, const std::vector<LodLevel>& levels,
              const Options& options, Report& report) {
  const LevelExtractor trunk(spectra.trunk), leaves(spectra.leaves);
  std::vector<std::uint32_t> buffer(std::max(trunk.capacity(), leaves.capacity()));
  Table table{.name = "cost", .columns = {"Level", "Bytes", "Extraction (us)"}, .rows = {}};
  for (std::size_t i = 0; i < levels.size(); ++i)
    table.rows.push_back({fmt::format("{}", i), stored_bytes(tree, spectra, levels[i], options.coding),
                          fmt::format("{:.1f}", extraction_time(trunk, leaves, levels[i], buffer))});
  report.tables.push_back(std::move(table));
}

}  // namespace

std::vector<LevelFigures> measure_levels(const Tree& tree, const LodSpectra& spectra, const Looks& looks,
                                         const std::vector<LodLevel>& levels, const Options& options,
                                         Context& context) {
  Stage stage = context.stage("measure");
  stage.items(levels.size(), "levels");
  const DrawnMesh source = drawn_level(spectra, {});
  Judges judges(source, looks, options.views);
  const double diameter = length(bounds(source).extent());
  std::vector<LevelFigures> figures;
  Table table{
      .name = "quality",
      .columns = {"Level", "Triangles", "Share", "Area", "Leaf area", "Coverage", "Coverage, least",
                  "Coverage, most", "Silhouette IoU", "IoU, least", "RMSE", "SSIM", "Hull growth", "Pixels"},
      .rows = {}};
  for (std::size_t i = 0; i < levels.size(); ++i) {
    figures.push_back(figures_of(spectra, levels[i], diameter, judges));
    table.rows.push_back(quality_row(i, figures.back()));
    stage.progress(static_cast<double>(i + 1) / static_cast<double>(levels.size()));
  }
  Report& report = context.report();
  report.tables.push_back(std::move(table));
  add_cost(tree, spectra, levels, options, report);
  add_image_errors(figures, report);
  add_coverage(figures, report);
  return figures;
}

std::vector<SurfaceDistances> measure_surfaces(const Tree& tree, const LodSpectra& spectra,
                                               const std::vector<LodLevel>& levels, Context& context) {
  Stage stage = context.stage("surfaces");
  stage.items(levels.size(), "levels");
  const DrawnMesh source = drawn_level(spectra, {});
  const double size = length(bounds(source).extent());
  Table table{.name = "surface",
              .columns = {"Level", "Level to source (m)", "Level to source, largest (m)",
                          "Source to level (m)", "Source to level, largest (m)", "Lost branch length"},
              .rows = {}};
  std::vector<SurfaceDistances> distances;
  for (std::size_t i = 0; i < levels.size(); ++i) {
    const SurfaceDistances d =
        distances.emplace_back(surface_distance(source, drawn_level(spectra, levels[i])));
    table.rows.push_back({fmt::format("{}", i), metres(d.from_level.mean, size),
                          metres(d.from_level.max, size), metres(d.from_source.mean, size),
                          metres(d.from_source.max, size),
                          lost_length(tree, spectra.trunk, levels[i].trunk_steps)});
  }
  context.report().tables.push_back(std::move(table));
  return distances;
}

}  // namespace copse::lodbake
