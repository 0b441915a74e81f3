#include "lib/analysis/ecosystem/mix_masses.h"

#include <map>
#include <memory>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace copse {
namespace {

// A part as the pass asks it.
struct Asked {
  std::size_t number = 0;
  PlacementTest test;
  ClusterKernel kernel;
};

// Those that have as many samples a cell, and so the same points.
struct Together {
  std::uint32_t samples = 1;
  std::vector<Asked> parts;
};

std::vector<Together> group(std::span<const MixPart> parts, const PlantedArea& area,
                            const TerrainGround& ground, std::uint32_t columns, std::uint32_t rows) {
  std::map<std::uint32_t, Together> by_samples;
  std::map<const ValueMap*, std::shared_ptr<const PixelDistance>> distances;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const PlacementRules& rules = *parts[i].rules;
    std::shared_ptr<const PixelDistance> distance;
    if (rules.distance_to) {
      distance = distances[rules.distance_to];
      if (!distance) distance = std::make_shared<const PixelDistance>(*rules.distance_to, area);
      distances[rules.distance_to] = distance;
    }
    const std::uint32_t samples = field_samples(rules, ground, columns, rows);
    Together& t = by_samples[samples];
    t.samples = samples;
    t.parts.push_back({i, PlacementTest(rules, area, ground, distance),
                       ClusterKernel(rules.clusters, area, columns, rows, parts[i].random)});
  }
  std::vector<Together> groups;
  for (auto& [samples, together] : by_samples) groups.push_back(std::move(together));
  return groups;
}

class Row {
 public:
  Row(const DensityField& grid, const TerrainGround& ground, std::span<double> masses)
      : grid_(grid), ground_(ground), masses_(masses) {}

  void add(const Together& together, std::uint32_t cell) {
    near_.clear();
    bool any = false;
    const GroundPlace middle = grid_.point(cell, 0.5, 0.5);
    for (const Asked& part : together.parts) any |= near_.emplace_back(part.kernel.at(middle)) > 0;
    if (!any) return;
    const std::uint32_t n = together.samples;
    sums_.assign(together.parts.size(), 0);
    for (std::uint32_t j = 0; j < n; ++j)
      for (std::uint32_t i = 0; i < n; ++i) {
        const GroundPlace in = sample_in_cell(i, j, n);
        ask(together, grid_.point(cell, in.x, in.z));
      }
    for (std::size_t k = 0; k < sums_.size(); ++k)
      masses_[together.parts[k].number] += near_[k] * (sums_[k] / (n * n));
  }

  std::uint64_t points = 0;

 private:
  void ask(const Together& together, const GroundPlace& at) {
    ++points;
    const double unshared = together.parts[0].test.unshared(at.x, at.z);
    if (!(unshared > 0)) return;
    AskedPlace place(ground_, at.x, at.z);
    for (std::size_t k = 0; k < together.parts.size(); ++k) {
      if (!(near_[k] > 0)) continue;
      const PlacementTest& test = together.parts[k].test;
      const double w = unshared * test.share(at.x, at.z);
      if (w > 0 && test.allows(place)) sums_[k] += w;
    }
  }

  const DensityField& grid_;
  const TerrainGround& ground_;
  std::span<double> masses_;
  std::vector<double> near_, sums_;  // of the parts of a group, in a cell
};

}  // namespace

MixMasses mix_masses(std::span<const MixPart> parts, const PlantedArea& area, const TerrainGround& ground,
                     std::uint32_t columns, std::uint32_t rows) {
  const std::vector<Together> groups = group(parts, area, ground, columns, rows);
  const DensityField grid{.area = area, .columns = columns, .rows = rows, .weights = {}};
  std::vector<double> by_row(std::size_t{rows} * parts.size());
  std::vector<std::uint64_t> points(rows);
  tbb::parallel_for(tbb::blocked_range<std::uint32_t>(0, rows), [&](const auto& range) {
    for (std::uint32_t r = range.begin(); r < range.end(); ++r) {
      Row row(grid, ground, std::span(by_row).subspan(r * parts.size(), parts.size()));
      for (const Together& together : groups)
        for (std::uint32_t c = 0; c < columns; ++c) row.add(together, r * columns + c);
      points[r] = row.points;
    }
  });
  MixMasses out{.masses = std::vector<double>(parts.size())};
  for (std::uint32_t r = 0; r < rows; ++r) {
    for (std::size_t p = 0; p < parts.size(); ++p) out.masses[p] += by_row[r * parts.size() + p];
    out.points += points[r];
  }
  return out;
}

}  // namespace copse
