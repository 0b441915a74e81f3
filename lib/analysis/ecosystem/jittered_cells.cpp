#include "lib/analysis/ecosystem/jittered_cells.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace copse {
namespace {

// Which cells are free, and the first free one from any cell on: a forest of links with path halving.
class FreeCells {
 public:
  explicit FreeCells(std::uint64_t cells) : next_(cells + 1), free_(cells) {
    std::iota(next_.begin(), next_.end(), 0);
  }

  std::uint64_t count() const { return free_; }
  std::uint64_t end() const { return next_.size() - 1; }
  bool is_free(std::uint64_t cell) const { return next_[cell] == cell; }
  // end() when there is none.
  std::uint64_t first_from(std::uint64_t cell) {
    while (next_[cell] != cell) {
      next_[cell] = next_[next_[cell]];
      cell = next_[cell];
    }
    return cell;
  }
  void take(std::uint64_t cell) {
    next_[cell] = cell + 1;
    --free_;
  }

 private:
  std::vector<std::uint64_t> next_;  // itself while it is free; the last one stands for the end
  std::uint64_t free_;
};

class Placer {
 public:
  Placer(std::uint64_t cells, CellPlaces& places) : cells_(cells), free_(cells), places_(places) {}

  void place(std::uint64_t count, Random random) {
    if (count == 0) return;
    const double ideal = static_cast<double>(cells_) / static_cast<double>(count);
    double position = -0.5 * ideal;
    std::uint64_t placed = 0;
    for (; placed < count && free_.count() > 0; ++placed) {
      position += ideal * random.uniform(1 - k_walk_margin, 1 + k_walk_margin);
      if (position >= static_cast<double>(cells_)) break;
      const auto wanted = static_cast<std::uint64_t>(std::max(position, 0.0));
      const std::uint64_t cell = free_.first_from(wanted);
      if (cell == free_.end()) break;
      places_.displaced += cell != wanted;
      put(cell);
    }
    put_at_random(count - placed, random.fork(1));
  }

 private:
  void put(std::uint64_t cell) {
    free_.take(cell);
    places_.cells.push_back(cell);
  }

  void put_at_random(std::uint64_t count, Random random) {
    if (count == 0) return;
    std::vector<std::uint64_t> open;
    open.reserve(free_.count());
    for (std::uint64_t c = 0; c < cells_; ++c)
      if (free_.is_free(c)) open.push_back(c);
    for (std::uint64_t i = 0; i < count; ++i) {
      std::swap(open[i], open[i + random.below(open.size() - i)]);
      put(open[i]);
    }
    places_.at_random += count;
  }

  std::uint64_t cells_;
  FreeCells free_;
  CellPlaces& places_;
};

}  // namespace

CellGrid cells_over(double width, double depth, std::uint64_t instances) {
  if (instances == 0 || !(width > 0) || !(depth > 0)) return {instances, instances > 0 ? 1u : 0u};
  // Over the longer side it is fewest rows that have room for most columns.
  if (width < depth) {
    const CellGrid turned = cells_over(depth, width, instances);
    return {turned.rows, turned.columns};
  }
  CellGrid best;
  double side = 0;
  for (std::uint64_t rows = 1, columns = instances;; ++rows) {
    columns = (instances + rows - 1) / rows;
    const double fits = std::min(width / static_cast<double>(columns), depth / static_cast<double>(rows));
    if (fits > side) best = {columns, rows}, side = fits;
    if (columns <= rows) break;
  }
  if (best.rows == 1) return best;
  // Those that fit in beside them.
  const auto whole = [&](double length, std::uint64_t least) {
    return std::max(least, static_cast<std::uint64_t>(length / side * (1 + 1e-12)));
  };
  return {whole(width, best.columns), whole(depth, best.rows)};
}

CellPlaces place_in_cells(std::span<const std::uint64_t> counts, std::uint64_t cells, const Random& random) {
  CellPlaces places;
  places.cells.reserve(std::accumulate(counts.begin(), counts.end(), std::uint64_t{0}));
  Placer placer(cells, places);
  for (std::size_t t = 0; t < counts.size(); ++t) placer.place(counts[t], random.fork(t));
  return places;
}

}  // namespace copse
