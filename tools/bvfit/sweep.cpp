#include "tools/bvfit/sweep.h"

#include "lib/formats/printable.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include <fmt/format.h>

namespace copse::bvfit {
namespace {

struct Run {
  FitMethod method;
  std::string quality;
  double volume = 0, lower_bound = 0;
  double seconds = 0, hull_seconds = 0;  // the hull's are not part of the others
};

constexpr int k_repeats = 3;  // of quick fits; the least time counts
constexpr double k_quick = 0.02;
constexpr double k_useful = 1e4;  // an excess over a bound that says less is not told
// What a search has by these shares of its time.
constexpr std::array k_shares{1.0 / 32, 1.0 / 16, 1.0 / 8, 1.0 / 4, 1.0 / 2};

// On a fitter of its own: one remembers what it has found. None where float32 cannot hold the volume. The
// best of several: of a run with a limit that the machine interrupted, less has come than the time allows.
std::optional<Run> run_of(const PartSet& set, const FitMethod& method, FitQuality quality, double limit) {
  constexpr double k_never = std::numeric_limits<double>::infinity();
  Run run{method, "", k_never, 0, k_never, 0};
  for (int i = 0; i < k_repeats && (i == 0 || run.seconds <= k_quick); ++i) {
    const auto fitter = VolumeFitter::make(set.points, set.triangles);
    if (!fitter) return std::nullopt;
    if (method.on_hull) fitter->hull();  // the limit is the fit's alone
    const auto fit = fitter->fit(method, {quality, limit > 0 ? Deadline::after(limit) : Deadline()});
    if (!fit) return std::nullopt;
    run.volume = std::min(run.volume, fit->measures.volume);
    run.lower_bound = std::max(run.lower_bound, fit->lower_bound);
    if (fit->seconds < run.seconds) run.seconds = fit->seconds, run.hull_seconds = fitter->hull_seconds();
  }
  return run;
}

// By how much a volume is above the best of its kind or a bound; 0 where both are nothing, infinite where no
// number says it.
double excess_over(double volume, double least) {
  if (least > 0) return volume / least - 1;
  return volume > 0 ? std::numeric_limits<double>::infinity() : 0;
}

std::string excess_text(double excess) {
  return excess <= k_useful ? fmt::format("{:.3g} %", 100 * excess) : "none useful";
}

std::vector<Run> runs_of(const PartSet& set, const std::vector<FitMethod>& methods, Stage& stage) {
  std::vector<Run> runs;
  const auto add = [&](const FitMethod& m, std::string name, FitQuality quality, double limit) {
    auto run = run_of(set, m, quality, limit);
    if (!run) return 0.0;
    run->quality = std::move(name);
    runs.push_back(std::move(*run));
    return runs.back().seconds;
  };
  std::size_t done = 0;
  for (const FitMethod& m : methods) {
    const std::size_t at = runs.size();
    const double seconds = add(m, m.quick ? "fast" : "balanced", FitQuality::balanced, 0);
    if (!m.quick && seconds > 0) {
      for (const double share : k_shares) {
        const double limit = seconds * share;
        add(m, fmt::format("in {:.2g} ms", 1e3 * limit), FitQuality::balanced, limit);
      }
      std::rotate(runs.begin() + static_cast<std::ptrdiff_t>(at),
                  runs.begin() + static_cast<std::ptrdiff_t>(at) + 1, runs.end());
      if (m.least) add(m, "exact", FitQuality::exact, 0);
    }
    stage.progress(static_cast<double>(++done) / static_cast<double>(methods.size()));
  }
  return runs;
}

}  // namespace

Result<std::string> sweep(const PartSet& set, const std::vector<FitMethod>& methods, Context& context) {
  Stage stage = context.stage("sweep");
  const std::vector<Run> runs = runs_of(set, methods, stage);
  stage.items(runs.size(), "fits");
  std::array<double, k_volume_kinds> best, bound{};
  best.fill(std::numeric_limits<double>::infinity());
  for (const Run& r : runs) {
    const auto k = static_cast<std::size_t>(r.method.kind);
    best[k] = std::min(best[k], r.volume);
    if (r.method.kind != VolumeKind::kdop) bound[k] = std::max(bound[k], r.lower_bound);
  }
  std::string out = fmt::format(
      "{}: error against time, on {} points\n\n    {:<10} {:<17} {:<12} {:>10} {:>10} {:>13} {:>13}\n",
      printable(set.name), set.points.size(), "type", "method", "quality", "fit, ms", "in all, ms",
      "over best", "over bound");
  Table table{"Error against time",
              {"type", "method", "quality", "fit, ms", "with the hull, ms", "over best", "over bound"},
              {}};
  for (const Run& r : runs) {
    const auto k = static_cast<std::size_t>(r.method.kind);
    const std::string kind(name_of(r.method.kind));
    const double over = excess_over(r.volume, best[k]), over_least = excess_over(r.volume, bound[k]),
                 whole = r.seconds + (r.method.on_hull ? r.hull_seconds : 0);
    const std::string over_best = excess_text(over), over_bound = bound[k] > 0 ? excess_text(over_least) : "";
    out += fmt::format("    {:<10} {:<17} {:<12} {:>10.4g} {:>10.4g} {:>13} {:>13}\n", kind, r.method.name,
                       r.quality, 1e3 * r.seconds, 1e3 * whole, over_best, over_bound);
    table.rows.push_back({kind, r.method.name, r.quality, fmt::format("{:.4g}", 1e3 * r.seconds),
                          fmt::format("{:.4g}", 1e3 * whole), over_best, over_bound});
    auto& curves = context.report().curves;
    const bool over_proven = bound[k] > 0 && excess_over(best[k], bound[k]) <= k_useful;
    const double drawn = over_proven ? over_least : over;
    if (!(drawn <= k_useful)) continue;
    if (curves.empty() || curves.back().name != kind)
      curves.push_back({kind,
                        "seconds, with the hull",
                        over_proven ? "volume / proven bound - 1" : "volume / best - 1",
                        {},
                        true});
    // A logarithmic axis has no place for 0: what is best stands at the rounding of float32.
    curves.back().points.push_back(
        {fmt::format("{} {}", r.method.name, r.quality), std::max(whole, 1e-7), std::max(drawn, 1e-8)});
  }
  context.report().tables.push_back(std::move(table));
  return out + "\n";
}

}  // namespace copse::bvfit
