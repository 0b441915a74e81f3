#include "tools/bvfit/table.h"

#include "lib/formats/printable.h"

#include <algorithm>
#include <array>

#include <fmt/format.h>

namespace copse::bvfit {
namespace {

constexpr std::size_t k_sets_in_full = 4, k_sets_in_report = 12;

std::string percent_text(double excess, const char* beyond) {
  if (!(excess <= 1e4)) return beyond;
  return excess < 5e-6 ? "0 %" : fmt::format("{:.3g} %", 100 * excess);
}

// How far the fit is above what is proven: in double, before it was stored.
std::string excess_text(const FittedVolume& v) {
  if (v.fitted == 0) return "0 %";
  return v.lower_bound <= 0 ? "unknown" : percent_text(v.fitted / v.lower_bound - 1, "none useful");
}

// What rounding it outward to float32 has added to that: units of the last place of the size, which count on
// what is thin.
std::string stored_text(const FittedVolume& v) {
  return v.measures.volume == v.fitted ? "0 %" : percent_text(v.measures.volume / v.fitted - 1, "all of it");
}

std::string seconds_text(double s) {
  return s < 1e-3 ? fmt::format("{:.0f} us", s * 1e6)
         : s < 1  ? fmt::format("{:.3g} ms", s * 1e3)
                  : fmt::format("{:.3g} s", s);
}

std::string points_text(std::span<const Double3> points) {
  std::string out;
  for (const Double3& p : points)
    out += fmt::format("{}({:.6g}, {:.6g}, {:.6g})", out.empty() ? "" : ", ", p.x, p.y, p.z);
  return out;
}

std::string set_text(const SetFit& set) {
  std::string out = fmt::format("{}: {} points", printable(set.name), set.points);
  if (set.hull_points) {
    out += set.hull_loss > 0 ? fmt::format(", a kernel of {} for the hull", *set.hull_points)
                             : fmt::format(", {} on the hull", *set.hull_points);
    out += fmt::format(" ({})", seconds_text(set.hull_seconds));
  }
  out += "\n\n";
  out += fmt::format("    {:<10} {:<17} {:>12} {:>12} {:>10} {:>9}  {:<9}\n", "type", "method", "volume",
                     "over bound", "by float32", "time", "certified");
  for (std::size_t i = 0; i < set.volumes.size(); ++i) {
    const FittedVolume& v = set.volumes[i];
    out += fmt::format("  {} {:<10} {:<17} {:>12.6g} {:>12} {:>10} {:>9}  {:<9}{}\n",
                       i == set.chosen ? '>' : ' ', name_of(v.method.kind), v.method.name, v.measures.volume,
                       excess_text(v), stored_text(v), seconds_text(v.seconds), v.certified ? "yes" : "NO",
                       i == set.chosen && set.chosen_as_flat ? "  flat: the cheapest test" : "");
  }
  for (const FittedVolume& v : set.volumes) {
    if (!v.support.empty())
      out += fmt::format("\n    the minimal sphere is held by {}\n", points_text(v.support));
  }
  return out + "\n";
}

// Of many sets: how often each type was chosen, and what it would cost to use one type for all.
std::string summary_text(std::span<const SetFit> sets) {
  struct Sum {
    std::size_t chosen = 0, fitted = 0;
    double volume = 0;
  };
  std::array<Sum, k_volume_kinds> sums{};
  std::size_t volumes = 0, certified = 0, thick = 0;
  double best = 0;
  for (const SetFit& set : sets) {
    // What is flat has no volume: the cheapest test is chosen, and whose rounding is least means nothing.
    const bool flat = is_flat(set.volumes[set.chosen].measures, set.size);
    thick += !flat;
    if (!flat) best += set.volumes[set.chosen].measures.volume;
    ++sums[static_cast<std::size_t>(set.volumes[set.chosen].method.kind)].chosen;
    std::array<double, k_volume_kinds> least;
    least.fill(-1);
    for (const FittedVolume& v : set.volumes) {
      double& l = least[static_cast<std::size_t>(v.method.kind)];
      if (l < 0 || v.measures.volume < l) l = v.measures.volume;
      ++volumes, certified += v.certified;
    }
    for (std::size_t k = 0; k < sums.size(); ++k) {
      if (least[k] >= 0 && !flat) ++sums[k].fitted, sums[k].volume += least[k];
    }
  }
  std::string out = fmt::format(
      "{} more sets{}, {} volumes, {} of them certified\n\n    {:<10} {:>9} {:>14} {:>12}\n", sets.size(),
      thick < sets.size() ? fmt::format(" ({} flat, in no sum)", sets.size() - thick) : "", volumes,
      certified, "type", "chosen", "sum of volume", "over chosen");
  for (std::size_t k = 0; k < sums.size(); ++k) {
    if (sums[k].fitted != thick || (thick == 0 && sums[k].chosen == 0)) continue;
    out += fmt::format("    {:<10} {:>9} {:>14.6g} {:>11.3g} %\n", k_volume_names[k], sums[k].chosen,
                       sums[k].volume, best > 0 ? 100 * (sums[k].volume / best - 1) : 0.0);
  }
  return out + fmt::format("    {:<10} {:>9} {:>14.6g}\n\n", "chosen", sets.size(), best);
}

std::vector<std::string> row_of(const SetFit& set, std::size_t i) {
  const FittedVolume& v = set.volumes[i];
  return {set.name,
          fmt::format("{}, {}", name_of(v.method.kind), v.method.name),
          fmt::format("{:.6g}", v.measures.volume),
          excess_text(v),
          stored_text(v),
          fmt::format("{:.5g}", v.measures.surface),
          fmt::format("{:.4g}", v.measures.mean_width),
          fmt::format("{:.3g}", 1e3 * v.seconds),
          fmt::format("{:.3g}", 1e3 * v.certify_seconds),
          fmt::format("{}{}", v.certified ? "yes" : "no", i == set.chosen ? ", chosen" : "")};
}

void report_error(const FittedVolume& v, Report& report) {
  const auto add = [&](const char* what, double ratio, const char* reference) {
    report.errors.push_back({fmt::format("{} ({}) {}", name_of(v.method.kind), v.method.name, what),
                             ratio - 1,
                             "ratio",
                             {},
                             {},
                             {},
                             reference});
  };
  if (v.lower_bound > 0) add("over its bound", v.fitted / v.lower_bound, "proven lower bound");
  constexpr double k_worth_telling = 1e-5;
  if (v.fitted > 0 && v.measures.volume / v.fitted - 1 > k_worth_telling)
    add("by float32", v.measures.volume / v.fitted, "the fit in double");
}

// What the set is tested with comes first: a page shows that in its headline.
void report_errors(const SetFit& set, Report& report) {
  report_error(set.volumes[set.chosen], report);
  for (std::size_t i = 0; i < set.volumes.size(); ++i) {
    if (i != set.chosen) report_error(set.volumes[i], report);
  }
}

}  // namespace

std::string table_text(const Input& input, std::span<const SetFit> sets) {
  const std::size_t full =
      sets.size() <= k_sets_in_full ? sets.size() : std::min<std::size_t>(3, sets.size());
  std::string out = fmt::format("{}\n\n", printable(input.name));
  for (const SetFit& set : sets.first(full)) out += set_text(set);
  if (full < sets.size()) out += summary_text(sets.subspan(full));
  return out;
}

void report_fits(std::span<const SetFit> sets, Report& report) {
  // No more columns than a page of 1280 pixels has room for; bounds are in the JSON.
  const std::vector<std::string> columns{"set",     "volume",     "interior", "over bound",  "by float32",
                                         "surface", "mean width", "fit, ms",  "certify, ms", "certified"};
  const auto full = sets.first(std::min(sets.size(), k_sets_in_report));
  Table table{"Volumes", columns, {}};
  for (const SetFit& set : full) {
    for (std::size_t i = 0; i < set.volumes.size(); ++i) table.rows.push_back(row_of(set, i));
  }
  report.tables.push_back(std::move(table));
  Table held{"What holds the minimal spheres", {"set", "points"}, {}};
  for (const SetFit& set : full) {
    for (const FittedVolume& v : set.volumes) {
      if (!v.support.empty()) held.rows.push_back({set.name, points_text(v.support)});
    }
  }
  if (!held.rows.empty()) report.tables.push_back(std::move(held));
  if (full.size() < sets.size()) {
    Table chosen{
        fmt::format("What was chosen for the other {} sets", sets.size() - full.size()), columns, {}};
    for (const SetFit& set : sets.subspan(full.size())) chosen.rows.push_back(row_of(set, set.chosen));
    report.tables.push_back(std::move(chosen));
  }
  if (!sets.empty()) report_errors(sets.front(), report);
}

}  // namespace copse::bvfit
