#include "lib/analysis/ecosystem/spread.h"

#include "lib/analysis/ecosystem/hilbert_curve.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

namespace copse {

Spreader::Spreader(const DensityField& field) : field_(field) {
  const auto bits = static_cast<std::uint32_t>(std::bit_width(std::max(field.columns, field.rows) - 1u));
  const auto with_mass = static_cast<std::size_t>(
      std::count_if(field.weights.begin(), field.weights.end(), [](double w) { return w > 0; }));
  cells_.reserve(with_mass);
  cumulative_.reserve(with_mass);
  double sum = 0;
  const auto take = [&](const GridCell& at) {
    if (at.x >= field.columns || at.y >= field.rows) return;
    const std::uint32_t cell = at.y * field.columns + at.x;
    if (!(field.weights[cell] > 0)) return;
    sum += field.weights[cell];
    cells_.push_back(cell);
    cumulative_.push_back(sum);
  };
  constexpr std::uint32_t k_small = 4;  // too small for tiles
  if (bits < k_small)
    for (std::uint64_t i = 0; i < std::uint64_t{1} << (2 * bits); ++i) take(hilbert_cell(i, bits));
  else
    for (std::uint64_t t = 0; t < std::uint64_t{1} << (2 * bits - 8); ++t)
      for (const GridCell& at : hilbert_tile(t, bits)) take(at);
}

std::uint32_t Spreader::cell_of(std::uint64_t piece, std::uint64_t pieces, Random& random) const {
  const double at = (static_cast<double>(piece) + random.uniform()) / static_cast<double>(pieces) * total();
  const auto found = std::upper_bound(cumulative_.begin(), cumulative_.end(), at);
  return cells_[static_cast<std::size_t>(std::min(found, cumulative_.end() - 1) - cumulative_.begin())];
}

std::uint64_t Spreader::piece_of(std::size_t cell, std::uint64_t pieces) const {
  const double before = cell == 0 ? 0 : cumulative_[cell - 1];
  const double share = (before + cumulative_[cell]) / 2 / total();
  return std::min(static_cast<std::uint64_t>(share * static_cast<double>(pieces)), pieces - 1);
}

GroundPlace Spreader::draw(std::uint64_t piece, std::uint64_t pieces, const PlacementTest& test,
                           Random& random) const {
  const std::uint32_t cell = cell_of(piece, pieces, random);
  const double peak = static_cast<double>(field_.peaks[cell]);
  for (int i = 0; i < 8; ++i) {
    const double u = random.uniform(), v = random.uniform();
    const GroundPlace place = field_.point(cell, u, v);
    const double weight = test.weight(place.x, place.z);
    if (weight > 0 && random.uniform() * peak < weight) return place;
  }
  return search(cell, test, random);
}

// Where little of the cell is allowed: near a sample that is, drawn by weight.
GroundPlace Spreader::search(std::uint32_t cell, const PlacementTest& test, Random& random) const {
  const std::uint32_t n = field_.samples;
  std::vector<double> sums;
  double sum = 0;
  for (std::uint32_t k = 0; k < n * n; ++k) {
    const GroundPlace in = sample_in_cell(k % n, k / n, n), at = field_.point(cell, in.x, in.z);
    sums.push_back(sum += test.weight(at.x, at.z));
  }
  const auto found = std::upper_bound(sums.begin(), sums.end(), random.uniform() * sum);
  const auto k = static_cast<std::uint32_t>(std::min(found, sums.end() - 1) - sums.begin());
  const GroundPlace sample = sample_in_cell(k % n, k / n, n);
  // Anywhere in the square that the sample stands for; then ever nearer to it.
  constexpr int k_anywhere = 16, k_nearer = 40;
  const std::uint32_t column = k % n, row = k / n;
  double reach = 1;
  for (int i = 0; i < k_anywhere + k_nearer; ++i) {
    const double u = (column + random.uniform()) / n, v = (row + random.uniform()) / n;
    const GroundPlace place =
        field_.point(cell, sample.x + reach * (u - sample.x), sample.z + reach * (v - sample.z));
    if (test.weight(place.x, place.z) > 0) return place;
    if (i >= k_anywhere) reach /= 2;
  }
  return field_.point(cell, sample.x, sample.z);
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
