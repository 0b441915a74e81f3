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
                   plan.instances_drawn, plan.plane_tests, level_of(plan),
                   plan.is_forest ? std::optional(plan.forest_counts) : std::nullopt});
}

std::string Statistics::csv() const {
  std::string text =
      "frame,t_frame,t_application,t_render,t_estimated,budget,triangles,lines,points,instances_tested,"
      "instances_drawn,nodes_visited,plane_tests,missed,needless,ssim,level,level_error,distance,t_cull,"
      "blocks_tested,blocks_seen,impostors,shadow_triangles\n";
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const Row& r = rows_[i];
    const std::string nodes = r.forest ? fmt::format("{}", r.forest->culling.nodes_visited) : "";
    const std::string rest =
        r.forest ? fmt::format("{:.9f},{},{},{},{}", r.forest->cull_seconds, r.forest->culling.blocks_tested,
                               r.forest->blocks_seen, r.forest->impostors, r.forest->shadow_triangles)
                 : ",,,,";
    fmt::format_to(std::back_inserter(text), "{},{:.9f},{:.9f},{:.9f},,,{},{},{},{},{},{},{},,,,{},{}\n", i,
                   r.application + r.render, r.application, r.render, r.triangles, r.lines, r.points,
                   r.tested, r.drawn, nodes, r.plane_tests, r.level, rest);
  }
  return text;
}

Table Statistics::culling() const {
  Table table{"culling, the mean of a frame",
              {"nodes visited", "blocks tested", "plane tests", "blocks seen", "instances tested",
               "instances drawn", "ms"},
              {}};
  if (rows_.empty()) return table;
  const auto mean = [&](auto&& value) {
    double sum = 0;
    for (const Row& r : rows_)
      if (r.forest) sum += static_cast<double>(value(*r.forest));
    return sum / static_cast<double>(rows_.size());
  };
  std::vector<std::string> cells;
  for (const double x : {mean([](const ForestCounts& f) { return f.culling.nodes_visited; }),
                         mean([](const ForestCounts& f) { return f.culling.blocks_tested; }),
                         mean([](const ForestCounts& f) { return f.culling.plane_tests; }),
                         mean([](const ForestCounts& f) { return f.blocks_seen; }),
                         mean([](const ForestCounts& f) { return f.instances_tested; }),
                         mean([](const ForestCounts& f) { return f.instances_drawn; })})
    cells.push_back(fmt::format("{:.1f}", x));
  cells.push_back(fmt::format("{:.4f}", 1e3 * mean([](const ForestCounts& f) { return f.cull_seconds; })));
  table.rows.push_back(std::move(cells));
  return table;
}

Table Statistics::streaming(const Ecosystem& eco) const {
  const std::uint64_t bytes =
      eco.packed.size() * sizeof(PackedInstance) + eco.exact.size() * sizeof(ExactInstance);
  return {
      "instances read from the file",
      {"", "read", "of"},
      {{"blocks", fmt::format("{}", read_.blocks), fmt::format("{}", eco.blocks.size())},
       {"instances", fmt::format("{}", read_.instances), fmt::format("{}", eco.instance_count())},
       {"bytes", fmt::format("{}", read_.bytes), fmt::format("{}", bytes)},
       {"pages of 4096 bytes", fmt::format("{}", read_.pages), fmt::format("{}", (bytes + 4095) / 4096)}}};
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
