#include "lib/analysis/ecosystem/populate.h"

#include "lib/analysis/ecosystem/density_shares.h"
#include "lib/analysis/ecosystem/jittered_cells.h"
#include "lib/analysis/ecosystem/spacing.h"
#include "lib/analysis/ecosystem/spread.h"
#include "lib/analysis/ecosystem/spread_apart.h"
#include "lib/analysis/ecosystem/tilt.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace copse {
namespace {

// What a type's random numbers are for.
enum Stream : std::uint64_t { stream_cells = 1 << 20, stream_place, stream_look, stream_clusters };

// Where a footprint does not fit its cell nothing can be promised, and a tree in the middle of each cell
// would show the grid: it keeps this share of the cell from the border.
constexpr double k_crowded_margin = 0.25;

constexpr int k_tries_in_cell = 32, k_halvings = 40;

class Planter {
 public:
  Planter(std::span<const TypePlan> types, const TerrainGround& ground, const PlantedArea& area,
          const Random& random, const std::function<void(double)>& progress)
      : types_(types),
        ground_(ground),
        area_(area),
        random_(random),
        progress_(progress),
        random_ones_(types.size()) {
    out_.types.resize(types.size());
  }

  Result<Population> plant() {
    plant_in_cells();
    for (std::size_t t = 0; t < types_.size(); ++t) {
      if (in_cells(t) || types_[t].count == 0 || types_[t].spacing > 0) continue;
      if (auto done = spread(t); !done) return std::unexpected(done.error());
    }
    if (auto done = space_out(); !done) return std::unexpected(done.error());
    for (std::size_t t = 0; t < types_.size(); ++t) {
      out_.types[t].placed = random_ones_[t].size();
      out_.instances.insert(out_.instances.end(), random_ones_[t].begin(), random_ones_[t].end());
      for (Instance i : types_[t].manual) {
        i.type = static_cast<std::uint32_t>(t);
        out_.instances.push_back(i);
      }
    }
    return std::move(out_);
  }

 private:
  bool in_cells(std::size_t t) const {
    return ground_.covers_all() && !types_[t].rules.limits_anything() && !(types_[t].spacing > 0);
  }

  Random stream(std::size_t type, std::uint64_t purpose) const { return random_.fork(type).fork(purpose); }

  // What does not depend on the place.
  double scale_of(std::size_t type, std::uint64_t index, const GroundPlace& at) const {
    const TypePlan& p = types_[type];
    if (p.scale_map) {
      const double v = std::clamp(smooth_at(*p.scale_map, area_, at.x, at.z), 0.0, 1.0);
      return p.scale.min + (p.scale.max - p.scale.min) * v;
    }
    return stream(type, stream_look).fork(index).fork(0).uniform(p.scale.min, p.scale.max);
  }

  Instance instance(std::size_t type, std::uint64_t index, const GroundPlace& at) const {
    const TypePlan& p = types_[type];
    Random look = stream(type, stream_look).fork(index).fork(1);
    Instance i;
    i.type = static_cast<std::uint32_t>(type);
    i.scale = scale_of(type, index, at);
    const GroundPoint ground = ground_.at(at.x, at.z).value_or(GroundPoint{});
    i.position = {at.x, ground.height, at.z};
    const double head = look.uniform(p.head.min, p.head.max), pitch = look.uniform(p.pitch.min, p.pitch.max),
                 roll = look.uniform(p.roll.min, p.roll.max);
    i.rotation = with_head(p.tilt_to_ground ? tilt_to(ground.normal) : tilt_of(pitch, roll), head);
    i.trunk_material = p.trunk_material;
    i.leaf_material = p.leaf_material;
    i.motion = p.motion;
    i.on_ground = true;
    i.along_normal = p.tilt_to_ground;
    if (p.tint_map) {
      const TintMap& m = *p.tint_map;
      const auto pixel = [](double f, std::uint32_t n) {
        return static_cast<std::uint32_t>(std::clamp(f * n, 0.0, n - 1.0));
      };
      i.tint = m.colours[std::size_t{pixel((at.z - area_.z0) / area_.depth(), m.height)} * m.width +
                         pixel((at.x - area_.x0) / area_.width(), m.width)];
    }
    return i;
  }

  void plant_in_cells() {
    std::vector<std::uint64_t> counts(types_.size());
    for (std::size_t t = 0; t < types_.size(); ++t) counts[t] = in_cells(t) ? types_[t].count : 0;
    const std::uint64_t total = std::accumulate(counts.begin(), counts.end(), std::uint64_t{0});
    if (total == 0) return;
    const CellGrid grid = cells_over(area_.width(), area_.depth(), total);
    const CellPlaces places = place_in_cells(counts, grid.cells(), random_.fork(stream_cells));
    out_.cells = grid.cells();
    out_.displaced = places.displaced;
    out_.in_random_cells = places.at_random;
    std::uint64_t first = 0;
    for (std::size_t t = 0; t < types_.size(); ++t) {
      fill_cells(t, std::span(places.cells).subspan(first, counts[t]), grid);
      first += counts[t];
    }
  }

  void fill_cells(std::size_t t, std::span<const std::uint64_t> cells, const CellGrid& grid) {
    random_ones_[t].resize(cells.size());
    const double w = area_.width() / static_cast<double>(grid.columns),
                 d = area_.depth() / static_cast<double>(grid.rows);
    std::vector<std::uint8_t> crowded(cells.size());
    tbb::parallel_for(tbb::blocked_range<std::size_t>(0, cells.size(), 1024), [&](const auto& range) {
      for (std::size_t i = range.begin(); i < range.end(); ++i) {
        const auto column = cells[i] % grid.columns, row = cells[i] / grid.columns;
        const Patch cell{area_.x0 + static_cast<double>(column) * w, area_.z0 + static_cast<double>(row) * d,
                         w, d};
        Random random = stream(t, stream_place).fork(i);
        auto at = place_inside(t, i, cell, random);
        crowded[i] = !at;
        if (!at) at = place_between(cell, k_crowded_margin * w, k_crowded_margin * d, random);
        random_ones_[t][i] = instance(t, i, *at);
      }
    });
    out_.types[t].crowded = static_cast<std::uint64_t>(std::count(crowded.begin(), crowded.end(), 1));
  }

  static GroundPlace place_between(const Patch& cell, double mx, double mz, Random& random) {
    const double x = random.uniform(cell.x + mx, cell.x + cell.width - mx),
                 z = random.uniform(cell.z + mz, cell.z + cell.depth - mz);
    return {x, z};
  }

  // A place where the footprint, as large as its scale is at that very place, stays in the cell; none when
  // none was found, and it is too large in the middle.
  std::optional<GroundPlace> place_inside(std::size_t t, std::uint64_t i, const Patch& cell,
                                          Random& random) const {
    const TypePlan& p = types_[t];
    const GroundPlace middle{cell.x + cell.width / 2, cell.z + cell.depth / 2};
    const double least = p.footprint * (p.scale_map ? p.scale.min : scale_of(t, i, middle));
    if (2 * least > std::min(cell.width, cell.depth)) return std::nullopt;
    if (!p.scale_map) return place_between(cell, least, least, random);
    const auto fits = [&](const GroundPlace& at) {
      const double reach = p.footprint * scale_of(t, i, at);
      return at.x - reach >= cell.x && at.x + reach <= cell.x + cell.width && at.z - reach >= cell.z &&
             at.z + reach <= cell.z + cell.depth;
    };
    GroundPlace at;
    for (int n = 0; n < k_tries_in_cell; ++n)
      if (at = place_between(cell, least, least, random); fits(at)) return at;
    if (!fits(middle)) return std::nullopt;
    // As far from the middle as it fits, towards the last place that was tried.
    for (int n = 0; n < k_halvings; ++n)
      if (at = {(at.x + middle.x) / 2, (at.z + middle.z) / 2}; fits(at)) return at;
    return middle;
  }

  std::unexpected<Error> nowhere(std::size_t t) const {
    return refuse("", fmt::format("{}: there is no place that its maps and rules allow", types_[t].name),
                  "widen its rules, or set its count to 0");
  }

  DensityField field_of(std::size_t t, const PlacementTest& test) const {
    const TypePlan& plan = types_[t];
    const PlacementRules& r = plan.rules;
    std::uint32_t largest = 0;
    for (const ValueMap* m : {r.density, r.forbidden, r.share_of, r.distance_to})
      if (m) largest = std::max({largest, m->width, m->height});
    const std::uint32_t side =
        plan.field_cells > 0 ? plan.field_cells : field_side(largest, plan.count, r.clusters, area_);
    return make_field(test, side, side, cluster_random(random_, t));
  }

  Result<void> spread(std::size_t t) {
    const PlacementTest test(types_[t].rules, area_, ground_);
    const DensityField field = field_of(t, test);
    const Spreader spreader(field);
    if (!(spreader.total() > 0)) return nowhere(t);
    const std::uint64_t count = types_[t].count;
    random_ones_[t].resize(count);
    tbb::parallel_for(tbb::blocked_range<std::uint64_t>(0, count, 1024), [&](const auto& range) {
      for (std::uint64_t i = range.begin(); i < range.end(); ++i) {
        Random random = stream(t, stream_place).fork(i);
        random_ones_[t][i] = instance(t, i, spreader.draw(i, count, test, random));
      }
    });
    return {};
  }

  // The types that ask for room, the largest first; those placed by hand before all.
  Result<void> space_out() {
    std::vector<std::size_t> order;
    for (std::size_t t = 0; t < types_.size(); ++t) {
      if (!(types_[t].spacing > 0)) continue;
      order.push_back(t);
      for (const Instance& i : types_[t].manual) {
        const Disc disc{i.position.x, i.position.z, types_[t].spacing * i.scale};
        if (!spacing_.is_free(disc)) ++out_.types[t].overlapping;
        spacing_.add(disc);
        discs_.push_back(disc);
      }
    }
    std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
      return types_[a].spacing * types_[a].scale.max > types_[b].spacing * types_[b].scale.max;
    });
    for (std::size_t k = 0; k < order.size(); ++k)
      if (auto done = space(order[k], k, order.size()); !done) return done;
    return {};
  }

  Result<void> space(std::size_t t, std::size_t number, std::size_t of) {
    const TypePlan& p = types_[t];
    if (p.count == 0) return {};
    const PlacementTest test(p.rules, area_, ground_);
    const DensityField field = field_of(t, test);
    const Spreader spreader(field);
    if (!(spreader.total() > 0)) return nowhere(t);
    DiscsApart wanted{
        .count = p.count,
        .radius = [&](auto i, const auto& at) { return p.spacing * scale_of(t, i, at); },
        .by_place = p.scale_map != nullptr,
        .least = [&](const Patch& patch) { return p.spacing * least_scale(p, patch); },
        .least_anywhere = p.spacing * p.scale.min,
        .feet = feet_to_avoid(t),
        .place = [&](auto i, const auto& at) { random_ones_[t].push_back(instance(t, i, at)); }};
    if (progress_)
      wanted.progress = [&](double share) {
        progress_((static_cast<double>(number) + share) / static_cast<double>(of));
      };
    const ApartCounts counts = spread_apart(wanted, field, spreader, test, stream(t, stream_place), spacing_);
    out_.types[t].missing = counts.missing;
    out_.types[t].hindered = counts.hindered;
    if (out_.types[t].missing > 0 && !p.fewer)
      return refuse("",
                    fmt::format("{}: {} asked for, there is room for {} at this spacing", p.name, p.count,
                                random_ones_[t].size()),
                    "lower count or spacing, or set \"fewer\" to take what fits");
    take_shares(t, field, [&](std::uint64_t i) {
      return unhindered_place(i, p.count, spreader, test, stream(t, stream_place));
    });
    return {};
  }

  void take_shares(std::size_t t, const DensityField& field,
                   const std::function<GroundPlace(std::uint64_t)>& unhindered) {
    std::vector<GroundPlace> feet;
    for (const Instance& i : random_ones_[t]) {
      feet.push_back({i.position.x, i.position.z});
      discs_.push_back({i.position.x, i.position.z, types_[t].spacing * i.scale});
    }
    out_.types[t].by_density = density_shares(field, types_[t].count, unhindered, feet, discs_);
    out_.types[t].moved = out_of_their_part(out_.types[t].by_density);
  }

  double least_scale(const TypePlan& p, const Patch& at) const {
    if (!p.scale_map) return p.scale.min;
    const double v = least_in(*p.scale_map, area_, at.x, at.z, at.x + at.width, at.z + at.depth);
    return p.scale.min + (p.scale.max - p.scale.min) * std::clamp(v, 0.0, 1.0);
  }

  std::vector<GroundPlace> feet_to_avoid(std::size_t t) const {
    std::vector<GroundPlace> feet;
    for (const std::size_t other : types_[t].avoid) {
      if (types_[other].spacing > 0) continue;  // they keep apart anyway
      for (const Instance& i : random_ones_[other]) feet.push_back({i.position.x, i.position.z});
      for (const Instance& i : types_[other].manual) feet.push_back({i.position.x, i.position.z});
    }
    return feet;
  }

  std::span<const TypePlan> types_;
  const TerrainGround& ground_;
  PlantedArea area_;
  Random random_;
  const std::function<void(double)>& progress_;
  std::vector<std::vector<Instance>> random_ones_;
  Spacing spacing_;
  std::vector<Disc> discs_;  // those in spacing_
  Population out_;
};

}  // namespace

Random cluster_random(const Random& random, std::size_t type) {
  return random.fork(type).fork(stream_clusters);
}

Result<Population> populate(std::span<const TypePlan> types, const TerrainGround& ground,
                            const PlantedArea& area, const Random& random,
                            const std::function<void(double)>& progress) {
  return Planter(types, ground, area, random, progress).plant();
}

}  // namespace copse
