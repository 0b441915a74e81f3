#include "lib/runtime/foliage_levels.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace copse {
namespace {

// The corners of a cell's box.
Double3 corner(const OrientedBox<float>& box, int which) {
  Double3 p = to_double(box.centre);
  for (int a = 0; a < 3; ++a)
    p += to_double(box.axes[a]) *
         ((which >> a & 1) != 0 ? double{box.half_extents[a]} : -double{box.half_extents[a]});
  return p;
}

double triple(const Double3& a, const Double3& b, const Double3& c) {
  return dot(cross(a, b), c);
}

}  // namespace

double ramp_share(const FoliageParameters& p, double distance, FoliageRamp ramp) {
  if (!(distance > p.near)) return 1;
  if (ramp == FoliageRamp::linear) {
    if (distance >= p.far) return p.least;
    return 1 - (1 - double{p.least}) * (distance - p.near) / (double{p.far} - p.near);
  }
  // u = z^(-log_h 2), z >= 1 (erratum P1).
  if (!(p.near > 0) || !(p.half_distance > 1)) return p.least;
  const double u = std::exp(-std::log(2.0) * std::log(distance / p.near) / std::log(double{p.half_distance}));
  return std::clamp(u, double{p.least}, 1.0);
}

ViewWeights view_weights(const FoliageCells& cells, const Double3& toward_eye) {
  const double size = length(toward_eye);
  if (!(size > 0) || !std::isfinite(size)) return {};
  const Double3 d = toward_eye / size;
  ViewWeights best;
  double deepest = -std::numeric_limits<double>::infinity();
  for (const auto& t : cells.view_triangles) {
    const Double3 a = to_double(cells.views[t[0]]), b = to_double(cells.views[t[1]]),
                  c = to_double(cells.views[t[2]]);
    const double volume = triple(a, b, c);
    if (!(std::abs(volume) > 1e-12)) continue;
    const std::array<double, 3> w{triple(d, b, c) / volume, triple(a, d, c) / volume,
                                  triple(a, b, d) / volume};
    // The triangle that is pierced has no negative weight; rounding may leave none that is quite so.
    const double least = std::min({w[0], w[1], w[2]});
    if (!(least > deepest)) continue;
    deepest = least;
    const std::array<double, 3> kept{std::max(w[0], 0.0), std::max(w[1], 0.0), std::max(w[2], 0.0)};
    const double sum = kept[0] + kept[1] + kept[2];
    best = {t, {kept[0] / sum, kept[1] / sum, kept[2] / sum}};
  }
  return best;
}

FoliageLevels::FoliageLevels(const FoliageCells& cells) : cells_(&cells) {
  DoubleBox box;
  for (const FoliageCell& cell : cells.cells)
    for (int i = 0; i < 8; ++i) box.grow(corner(cell.box, i));
  if (box.empty()) return;
  centre_ = box.centre();
  for (const FoliageCell& cell : cells.cells)
    for (int i = 0; i < 8; ++i) radius_ = std::max(radius_, distance(corner(cell.box, i), centre_));
}

void FoliageLevels::choose(const Double3& eye, const Options& options, std::span<CellLevel> out) const {
  const FoliageParameters& p = cells_->parameters;
  const double away = distance(eye, centre_);
  const ViewWeights weights = view_weights(*cells_, eye - centre_);
  // What was counted from outside says nothing inside: 1 there, as counted from twice the radius on.
  const double counted = options.uniform || radius_ <= 0 ? 0 : std::clamp(away / radius_ - 1, 0.0, 1.0);
  for (std::size_t c = 0; c < std::min(out.size(), cell_count()); ++c) {
    const FoliageCell& cell = cells_->cells[c];
    double visible = 0;
    for (std::size_t k = 0; k < 3; ++k)
      if (weights.weight[k] > 0) visible += weights.weight[k] * cells_->at(c, weights.view[k]).share();
    visible = counted * visible + (1 - counted);
    const double from =
        p.distance == FoliageParameters::Distance::tree ? away : distance(eye, to_double(cell.box.centre));
    const double share = ramp_share(p, from, options.ramp), wanted = cell.count * visible * share;
    // A whole number that rounding has pushed up a little stays what it is; not a number is full detail.
    const double rounded = std::isfinite(wanted) ? std::ceil(wanted - 1e-9 * cell.count) : cell.count;
    out[c].count = static_cast<std::uint32_t>(std::clamp<double>(rounded, 0, cell.count));
    const bool fraction = options.shrinking && out[c].count > 0 && wanted < out[c].count;
    out[c].last = fraction ? static_cast<float>(wanted - (out[c].count - 1)) : 1.0f;
    const double shown = fraction ? wanted : out[c].count;
    // Leaves that no one sees projected nothing, so by default only those that the distance takes are made
    // good (erratum P5).
    const bool total = p.compensation == FoliageParameters::Compensation::total;
    const double kept =
        total ? shown / cell.count : std::min(1.0, shown / std::max(1e-300, cell.count * visible));
    out[c].enlargement = out[c].count == 0
                             ? 1.0f
                             : static_cast<float>(std::clamp(1 / kept, 1.0, double{p.largest_enlargement}));
  }
}

std::size_t FoliageLevels::extract(std::span<const CellLevel> levels, std::span<std::uint32_t> leaves) const {
  std::uint64_t total = 0;
  const std::size_t cells = std::min(levels.size(), cell_count());
  for (std::size_t c = 0; c < cells; ++c) total += std::min(levels[c].count, cells_->cells[c].count);
  if (total > leaves.size()) return 0;
  std::size_t at = 0;
  for (std::size_t c = 0; c < cells; ++c) {
    const FoliageCell& cell = cells_->cells[c];
    const std::size_t count = std::min(levels[c].count, cell.count);
    std::copy_n(cells_->order.begin() + cell.first, count, leaves.begin() + static_cast<std::ptrdiff_t>(at));
    at += count;
  }
  return at;
}

}  // namespace copse
