#include "tools/treeplay/statistics.h"

#include <algorithm>
#include <functional>
#include <iterator>
#include <numeric>

#include <fmt/format.h>

namespace copse::treeplay {

namespace {

// A level in between has no number.
std::string level_of(const FramePlan& plan) {
  const std::string number = plan.shown.number == k_none ? "" : fmt::format("{}", plan.shown.number);
  return fmt::format("{},{:.6g},{:.6g}", number, plan.shown.level.error, plan.distance);
}

}  // namespace

void Statistics::add(const FramePlan& plan, double t_application, double t_render) {
  rows_.push_back({t_application, t_render, plan.triangles, plan.lines, plan.points, plan.instances_tested,
                   plan.instances_drawn, plan.plane_tests, level_of(plan)});
}

std::string Statistics::csv() const {
  std::string text =
      "frame,t_frame,t_application,t_render,t_estimated,budget,triangles,lines,points,instances_tested,"
      "instances_drawn,nodes_visited,plane_tests,missed,needless,ssim,level,level_error,distance\n";
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Row& r = rows_[i];
    fmt::format_to(std::back_inserter(text), "{},{:.9f},{:.9f},{:.9f},,,{},{},{},{},{},,{},,,,{}\n", i,
                   r.application + r.render, r.application, r.render, r.triangles, r.lines, r.points,
                   r.tested, r.drawn, r.plane_tests, r.level);
  }
  return text;
}

Table Statistics::table() const {
  Table table{"frame times", {"time", "mean, s", "median, s", "95 %, s", "largest, s"}, {}};
  const auto add_row = [&](const char* name, const std::function<double(const Row&)>& value) {
    std::vector<double> v;
    std::transform(rows_.begin(), rows_.end(), std::back_inserter(v), value);
    std::sort(v.begin(), v.end());
    const auto share = [&](double s) {
      return v[static_cast<std::size_t>(s * static_cast<double>(v.size() - 1) + 0.5)];
    };
    const double mean = std::accumulate(v.begin(), v.end(), 0.0) / static_cast<double>(v.size());
    std::vector<std::string> cells{name};
    for (const double x : {mean, share(0.5), share(0.95), v.back()})
      cells.push_back(fmt::format("{:.6f}", x));
    table.rows.push_back(std::move(cells));
  };
  if (rows_.empty()) return table;
  add_row("frame", [](const Row& r) { return r.application + r.render; });
  add_row("application", [](const Row& r) { return r.application; });
  add_row("render", [](const Row& r) { return r.render; });
  return table;
}

}  // namespace copse::treeplay
