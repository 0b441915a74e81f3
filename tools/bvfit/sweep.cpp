#include "tools/bvfit/sweep.h"

#include <algorithm>
#include <array>
#include <limits>

#include <fmt/format.h>

namespace copse::bvfit {
namespace {

struct Run {
  FitMethod method;
  const char* quality = "";
  double volume = 0, lower_bound = 0, seconds = 0;
};

constexpr int k_repeats = 5;  // of quick fits; the least time counts
constexpr double k_quick = 0.02;

std::vector<Run> runs_of(const VolumeFitter& fitter, const std::vector<FitMethod>& methods, Stage& stage) {
  constexpr std::array k_qualities{std::pair{FitQuality::balanced, "balanced"},
                                   std::pair{FitQuality::exact, "exact"}};
  std::vector<Run> runs;
  std::size_t done = 0;
  for (const FitMethod& m : methods) {
    for (const auto& [quality, name] : k_qualities) {
      if ((m.quick || !m.least) && quality == FitQuality::exact) continue;  // the same in every quality
      Run run{m, m.quick ? "fast" : name, 0, 0, std::numeric_limits<double>::infinity()};
      for (int i = 0; i < k_repeats; ++i) {
        const auto fit = fitter.fit(m, {.quality = quality});
        if (!fit) break;
        run.volume = fit->measures.volume, run.lower_bound = fit->lower_bound;
        run.seconds = std::min(run.seconds, fit->seconds);
        if (run.seconds > k_quick) break;
      }
      if (run.volume > 0) runs.push_back(run);
    }
    stage.progress(static_cast<double>(++done) / static_cast<double>(methods.size()));
  }
  return runs;
}

}  // namespace

Result<std::string> sweep(const PartSet& set, const std::vector<FitMethod>& methods, Context& context) {
  Stage stage = context.stage("sweep");
  const auto fitter = VolumeFitter::make(set.points, set.triangles);
  if (!fitter) return std::unexpected(fitter.error());
  const std::vector<Run> runs = runs_of(*fitter, methods, stage);
  stage.items(runs.size(), "fits");
  std::array<double, k_volume_kinds> best, bound{};
  best.fill(std::numeric_limits<double>::infinity());
  for (const Run& r : runs) {
    const auto k = static_cast<std::size_t>(r.method.kind);
    best[k] = std::min(best[k], r.volume);
    if (r.method.kind != VolumeKind::kdop) bound[k] = std::max(bound[k], r.lower_bound);
  }
  std::string out = fmt::format(
      "{}: error against time, on {} of {} points\n\n    {:<10} {:<17} {:<9} {:>11} {:>13} {:>13}\n",
      set.name, fitter->hull().vertices.size(), set.points.size(), "type", "method", "quality", "time, ms",
      "over best", "over bound");
  Table table{"Error against time", {"type", "method", "quality", "time, ms", "over best", "over bound"}, {}};
  for (const Run& r : runs) {
    const auto k = static_cast<std::size_t>(r.method.kind);
    const double over = r.volume / best[k] - 1;
    const std::string over_bound =
        bound[k] > 0 ? fmt::format("{:.3g} %", 100 * (r.volume / bound[k] - 1)) : "";
    out += fmt::format("    {:<10} {:<17} {:<9} {:>11.4g} {:>11.4g} % {:>13}\n", name_of(r.method.kind),
                       r.method.name, r.quality, 1e3 * r.seconds, 100 * over, over_bound);
    table.rows.push_back({std::string(name_of(r.method.kind)), std::string(r.method.name), r.quality,
                          fmt::format("{:.4g}", 1e3 * r.seconds), fmt::format("{:.4g} %", 100 * over),
                          over_bound});
    auto& curves = context.report().curves;
    if (curves.empty() || curves.back().name != name_of(r.method.kind))
      curves.push_back({std::string(name_of(r.method.kind)), "seconds", "volume / best - 1", {}});
    // A logarithmic axis has no place for 0: what is best stands at the rounding of float32.
    curves.back().points.push_back(
        {fmt::format("{} {}", r.method.name, r.quality), std::max(r.seconds, 1e-7), std::max(over, 1e-8)});
  }
  context.report().tables.push_back(std::move(table));
  return out + "\n";
}

}  // namespace copse::bvfit
