#include "tools/ecogen/measure.h"

#include "lib/analysis/ecosystem/tilt.h"
#include "lib/formats/ecosystem/instance_codec.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace copse::ecogen {
namespace {

// What the histogram of a density may be off by, and so many trees may have left their part of it unsaid.
constexpr double k_histogram_error = 0.02;

constexpr double k_full = 0.45;  // of the ground under discs: up to that a density is kept

constexpr std::size_t k_most_samples = 20000;  // the largest of so many is known well enough

// Largest, mean, 95 % and root mean square.
ErrorRecord record(std::string name, std::string unit, std::string reference, std::vector<double> values) {
  ErrorRecord r{std::move(name), 0, std::move(unit), {}, {}, {}, std::move(reference)};
  if (values.empty()) return r;
  double sum = 0, squares = 0;
  for (const double v : values) sum += v, squares += v * v;
  const auto n = static_cast<double>(values.size());
  r.value = sum / n;
  r.rms = std::sqrt(squares / n);
  r.max = *std::max_element(values.begin(), values.end());
  const auto p95 = values.begin() + static_cast<std::ptrdiff_t>(values.size() * 95 / 100);
  std::nth_element(values.begin(), p95, values.end());
  r.p95 = *p95;
  return r;
}

std::string full_ground(const TypePlan& plan, std::uint64_t got, double asked, double covered) {
  const bool has_map = plan.rules.density || plan.rules.share_of;
  std::string why = "the ground is full", remedy = "lower count, spacing or scale";
  if (covered < k_full && !plan.avoid.empty()) {
    why = "the feet that it is to avoid leave no more room";
    remedy = "name fewer in avoid, or " + remedy;
  } else if (covered < k_full) {
    why = "its discs are too large for the detail of its map and rules";
  }
  if (has_map) remedy += ", or the map's contrast";
  return fmt::format(
      "{}: where {} {}: {} stand there, {:.0f} are asked for (discs cover up to {:.0f} % of it); the others "
      "stand where it is thinner; {}",
      plan.name, has_map ? "its density is highest" : "its rules allow most", why, got, asked, 100 * covered,
      remedy);
}

}  // namespace

void tell_densities(std::span<const TypePlan> plans, const Population& population, Context& context) {
  Table table{"density and spacing",
              {"type", "of the largest density", "asked for", "planted", "ground under discs"},
              {}};
  for (std::size_t t = 0; t < plans.size(); ++t) {
    const std::vector<DensityShare>& shares = population.types[t].by_density;
    double asked = 0, covered = 0;
    std::uint64_t got = 0;
    for (const DensityShare& s : shares) {
      table.rows.push_back({plans[t].name, fmt::format("{:.3g} to {:.3g}", s.from, s.to),
                            fmt::format("{:.1f}", s.asked), std::to_string(s.got),
                            fmt::format("{:.0f} %", 100 * s.covered)});
      if (static_cast<double>(s.got) >= s.asked * (1 - k_histogram_error) - 1) continue;
      asked += s.asked;
      got += s.got;
      covered = std::max(covered, s.covered);
    }
    // Those that found their first place taken stand in this part or that by chance, few of them too.
    const auto moved = static_cast<double>(population.types[t].moved),
               hindered = static_cast<double>(population.types[t].hindered);
    if (asked > 0 &&
        moved > std::max(k_histogram_error * static_cast<double>(plans[t].count), 2 * std::sqrt(hindered)))
      context.warn(full_ground(plans[t], got, asked, covered));
  }
  if (!table.rows.empty()) context.report().tables.push_back(std::move(table));
}

void tell_tilts(const Population& population, const TerrainGround& ground, Context& context) {
  std::vector<double> values;
  const std::size_t stride = population.instances.size() / k_most_samples + 1;
  for (std::size_t i = 0; i < population.instances.size(); i += stride) {
    const Double3& p = population.instances[i].position;
    if (const auto here = ground.at(p.x, p.z)) values.push_back(thesis_tilt_error(here->normal));
  }
  if (!values.empty())
    context.report().errors.push_back(
        record("tilt by the thesis' two angles", "degrees", "terrain normal", std::move(values)));
}

void tell_ties(const Ecosystem& eco, const std::vector<Instance>& instances,
               const std::vector<std::uint32_t>& order, const TerrainGround& ground, Context& context) {
  constexpr double k_free = -1;
  std::vector<double> feet(order.size(), k_free), axes(order.size(), k_free);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, eco.blocks.size(), 16), [&](const auto& range) {
    for (std::size_t b = range.begin(); b < range.end(); ++b) {
      const InstanceBlock& block = eco.blocks[b];
      const Float3 e = eco.types[block.type].bounds.extent();
      const double size = std::max({double{e.x}, double{e.y}, double{e.z}});
      for (std::size_t i = block.first; i < block.first + block.count; ++i) {
        const Instance& meant = instances[order[i]];
        if (!meant.on_ground && !meant.along_normal) continue;
        const Instance s = instance_of(eco, block, i);
        const auto here = ground.at(s.position.x, s.position.z);
        if (!here) continue;
        if (meant.on_ground)
          feet[i] = std::abs(s.position.y - here->height) / (s.scale * (size > 0 ? size : 1));
        if (meant.along_normal) axes[i] = distance(rotate(s.rotation, {0, 1, 0}), here->normal);
      }
    }
  });
  const auto tell = [&](const char* name, const char* unit, const char* reference, std::vector<double> all) {
    std::erase(all, k_free);
    if (!all.empty()) context.report().errors.push_back(record(name, unit, reference, std::move(all)));
  };
  tell("foot off the ground", "of the tree's size", "terrain triangle", std::move(feet));
  tell("axis off the terrain's normal", "rad", "normal of the terrain triangle", std::move(axes));
}

}  // namespace copse::ecogen
