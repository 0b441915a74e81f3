#include "lib/analysis/ecosystem/spread.h"

#include "lib/analysis/ecosystem/hilbert_curve.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace copse {

Spreader::Spreader(const DensityField& field) : field_(field) {
  const std::uint32_t bits =
      static_cast<std::uint32_t>(std::bit_width(std::max(field.columns, field.rows) - 1u));
  double sum = 0;
  for (std::uint64_t i = 0; i < (std::uint64_t{1} << (2 * bits)); ++i) {
    const GridCell at = hilbert_cell(i, bits);
    if (at.x >= field.columns || at.y >= field.rows) continue;
    const std::uint32_t cell = at.y * field.columns + at.x;
    if (!(field.weights[cell] > 0)) continue;
    sum += field.weights[cell];
    cells_.push_back(cell);
    cumulative_.push_back(sum);
  }
}

std::uint32_t Spreader::cell_of(std::uint64_t piece, std::uint64_t pieces, Random& random) const {
  const double at = (static_cast<double>(piece) + random.uniform()) / static_cast<double>(pieces) * total();
  const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end(), at);
  return cells_[static_cast<std::size_t>(std::min(found, cumulative_.end() - 1) - cumulative_.begin())];
}

GroundPlace Spreader::point_in(std::uint32_t cell, double u, double v) const {
  const std::uint32_t c = cell % field_.columns, r = cell / field_.columns;
  return {field_.area.x0 + (c + u) / field_.columns * field_.area.width(),
          field_.area.z0 + (r + v) / field_.rows * field_.area.depth()};
}

GroundPlace Spreader::draw(std::uint64_t piece, std::uint64_t pieces, Random& random) const {
  const std::uint32_t cell = cell_of(piece, pieces, random);
  const double u = random.uniform(), v = random.uniform();
  return point_in(cell, u, v);
}

GroundPlace Spreader::draw(std::uint64_t piece, std::uint64_t pieces, const PlacementTest& test,
                           Random& random) const {
  const std::uint32_t cell = cell_of(piece, pieces, random);
  for (int i = 0; i < 8; ++i) {
    const double u = random.uniform(), v = random.uniform();
    const GroundPlace place = point_in(cell, u, v);
    if (test.allows(place.x, place.z)) return place;
  }
  return point_in(cell, 0.5, 0.5);
}

std::vector<std::uint64_t> apportion(std::uint64_t total, std::span<const double> weights) {
  std::vector<std::uint64_t> counts(weights.size());
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  if (!(sum > 0)) return counts;
  std::vector<std::pair<double, std::size_t>> rest;
  std::uint64_t given = 0;
  for (std::size_t i = 0; i < weights.size(); ++i) {
    const double share = static_cast<double>(total) * (weights[i] / sum);
    counts[i] = std::min(static_cast<std::uint64_t>(share), total - given);
    given += counts[i];
    rest.emplace_back(-(share - static_cast<double>(counts[i])), i);
  }
  std::sort(rest.begin(), rest.end());
  for (std::size_t i = 0; given < total; i = (i + 1) % rest.size()) {
    if (weights[rest[i].second] > 0) ++counts[rest[i].second], ++given;
  }
  return counts;
}

}  // namespace copse
