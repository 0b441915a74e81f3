// Spreads exactly n points over a density field, so that every part of it gets its share: one point in each
// of n equal pieces of the field's mass, the pieces cut along the Hilbert curve, so that each is a compact
// patch.
//
// Stratified sampling: what lies in a region is off by less than the pieces that its border cuts, not by the
// square root of their number.
#pragma once

#include "lib/analysis/ecosystem/density_field.h"
#include "lib/formats/random.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace copse {

// The field's cells along the curve, and their mass summed up. O(cells).
class Spreader {
 public:
  explicit Spreader(const DensityField& field);

  double total() const { return cumulative_.empty() ? 0 : cumulative_.back(); }
  // A point of piece `piece` of `pieces`: uniform in mass; inside a cell as `test` weighs its points, and
  // only where it allows. No point comes twice, however little of the cell is allowed. total() > 0.
  GroundPlace draw(std::uint64_t piece, std::uint64_t pieces, const PlacementTest& test,
                   Random& random) const;
  // The cells that have mass, along the curve, and of each in which of `pieces` the middle of its mass lies.
  std::span<const std::uint32_t> cells() const { return cells_; }
  std::uint64_t piece_of(std::size_t cell, std::uint64_t pieces) const;

 private:
  std::uint32_t cell_of(std::uint64_t piece, std::uint64_t pieces, Random& random) const;
  GroundPlace search(std::uint32_t cell, const PlacementTest& test, Random& random) const;
  const DensityField& field_;
  std::vector<std::uint32_t> cells_;  // with mass, along the curve
  std::vector<double> cumulative_;    // mass up to and with each
};

// How many of `total` each gets, in proportion to `weights`: the largest remainder decides, ties the first.
// Adds up exactly; all 0 when no weight is above 0.
std::vector<std::uint64_t> apportion(std::uint64_t total, std::span<const double> weights);

}  // namespace copse
