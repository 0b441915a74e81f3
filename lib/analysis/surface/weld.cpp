#include "lib/analysis/surface/weld.h"

#include "lib/analysis/surface/tolerances.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

namespace copse {
namespace {

std::uint64_t mix(
    std::uint64_t h) {  // the finalizer of MurmurHash3: every input bit reaches every output bit
  h ^= h >> 33;
  h *= 0xff51afd7ed558ccdULL;
  h ^= h >> 33;
  h *= 0xc4ceb9fe1a85ec53ULL;
  return h ^ (h >> 33);
}

std::uint64_t hash_of(std::uint64_t a, std::uint64_t b, std::uint64_t c) {
  return mix(a + 0x9e3779b97f4a7c15ULL * (mix(b + 0x9e3779b97f4a7c15ULL * mix(c + 1)) | 1));
}

// Buckets of point chains, addressed by hash. Chains may hold points of other cells: users compare.
class Buckets {
 public:
  explicit Buckets(std::size_t points)
      : mask_(std::bit_ceil(std::max<std::size_t>(16, points)) - 1),
        head_(mask_ + 1, k_none),
        next_(points) {}
  std::uint32_t first(std::uint64_t hash) const { return head_[hash & mask_]; }
  std::uint32_t next(std::uint32_t point) const { return next_[point]; }
  void fetch(std::uint64_t hash) const { __builtin_prefetch(&head_[hash & mask_]); }
  void insert(std::uint64_t hash, std::uint32_t point) {
    next_[point] = head_[hash & mask_];
    head_[hash & mask_] = point;
  }

 private:
  std::uint64_t mask_;
  std::vector<std::uint32_t> head_, next_;
};

std::uint64_t hash_of(const Double3& p) {
  // + 0.0 makes -0 and 0 the same bits.
  return hash_of(std::bit_cast<std::uint64_t>(p.x + 0.0), std::bit_cast<std::uint64_t>(p.y + 0.0),
                 std::bit_cast<std::uint64_t>(p.z + 0.0));
}

// Joins equal positions; fills `representative`. Every look-up misses the caches, so they are asked for a
// block ahead, first the bucket, then the point in it.
void weld_equal(std::span<const Double3> p, std::vector<std::uint32_t>& representative) {
  constexpr std::size_t k_block = 32;
  Buckets buckets(p.size());
  std::array<std::uint64_t, k_block> hashes;
  for (std::size_t begin = 0; begin < p.size(); begin += k_block) {
    const std::size_t end = std::min(p.size(), begin + k_block);
    for (std::size_t i = begin; i < end; ++i) {
      hashes[i - begin] = hash_of(p[i]);
      buckets.fetch(hashes[i - begin]);
    }
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint32_t first = buckets.first(hashes[i - begin]);
      if (first != k_none) __builtin_prefetch(&p[first]);
    }
    for (std::size_t i = begin; i < end; ++i) {
      const std::uint64_t hash = hashes[i - begin];
      std::uint32_t j = buckets.first(hash);
      while (j != k_none && !(p[j] == p[i])) j = buckets.next(j);
      representative[i] = j == k_none ? static_cast<std::uint32_t>(i) : j;
      if (j == k_none) buckets.insert(hash, static_cast<std::uint32_t>(i));
    }
  }
}

// Grids of several cell sizes in one table. A point lies in the grid of its tolerance's power of two, whose
// cells are k_cells of them wide: few points of a grid share a cell, and few look into a neighbouring one.
class Grids {
 public:
  Grids(std::span<const Double3> positions, std::span<const double> tolerances)
      : positions_(positions), tolerances_(tolerances), buckets_(positions.size()) {
    DoubleBox box;
    for (const Double3& p : positions) box.grow(p);
    if (!box.empty()) low_ = box.min;
  }

  // The lowest point in the grids that `i` may be welded to; k_none when there is none.
  std::uint32_t nearest_representative(std::uint32_t i) const {
    std::uint32_t found = k_none;
    for (const int level : levels_) {
      const double cell = std::ldexp(k_cells, level);
      const double reach = std::min(tolerances_[i], std::ldexp(2.0, level));
      std::array<std::array<std::int64_t, 2>, 3> range;
      for (int axis = 0; axis < 3; ++axis) {
        range[axis] = {index(positions_[i][axis] - reach, axis, cell),
                       index(positions_[i][axis] + reach, axis, cell)};
      }
      for (std::int64_t x = range[0][0]; x <= range[0][1]; ++x) {
        for (std::int64_t y = range[1][0]; y <= range[1][1]; ++y) {
          for (std::int64_t z = range[2][0]; z <= range[2][1]; ++z) {
            found = std::min(found, search(hash(level, x, y, z), i));
          }
        }
      }
    }
    return found;
  }

  void insert(std::uint32_t i) {
    const int level = level_of(tolerances_[i]);
    const auto at = std::ranges::lower_bound(levels_, level);
    if (at == levels_.end() || *at != level) levels_.insert(at, level);
    const double cell = std::ldexp(k_cells, level);
    buckets_.insert(hash(level, index(positions_[i].x, 0, cell), index(positions_[i].y, 1, cell),
                         index(positions_[i].z, 2, cell)),
                    i);
  }

 private:
  static constexpr double k_cells = 8;

  // 2^level <= tolerance < 2^(level + 1)
  static int level_of(double tolerance) { return std::ilogb(tolerance); }
  std::int64_t index(double x, int axis, double cell) const {
    // Beyond 2^62 cells a double cannot tell cells apart any more; they all become the last one.
    return static_cast<std::int64_t>(std::floor(std::clamp((x - low_[axis]) / cell, -0x1p62, 0x1p62)));
  }
  static std::uint64_t hash(int level, std::int64_t x, std::int64_t y, std::int64_t z) {
    return hash_of(static_cast<std::uint64_t>(x) + 0x632be59bd9b4e019ULL * static_cast<std::uint64_t>(level),
                   static_cast<std::uint64_t>(y), static_cast<std::uint64_t>(z));
  }
  std::uint32_t search(std::uint64_t hash, std::uint32_t i) const {
    std::uint32_t found = k_none;
    for (std::uint32_t j = buckets_.first(hash); j != k_none; j = buckets_.next(j)) {
      if (j < found && distance(positions_[i], positions_[j]) <= std::min(tolerances_[i], tolerances_[j])) {
        found = j;
      }
    }
    return found;
  }

  std::span<const Double3> positions_;
  std::span<const double> tolerances_;
  Buckets buckets_;
  Double3 low_;
  std::vector<int> levels_;  // in use, ascending
};

}  // namespace

namespace {

// Joins what is near, given that what is equal has been joined.
void weld_near(std::span<const Double3> positions, std::span<const double> tolerances,
               std::vector<std::uint32_t>& representative) {
  Grids grids(positions, tolerances);
  for (std::uint32_t i = 0; i < positions.size(); ++i) {
    if (representative[i] != i) {
      representative[i] = representative[representative[i]];
    } else if (tolerances[i] > 0) {
      const std::uint32_t found = grids.nearest_representative(i);
      if (found == k_none) {
        grids.insert(i);
      } else {
        representative[i] = found;
      }
    }
  }
}

// The tolerances of representatives of equal positions; 0 elsewhere.
std::vector<double> tolerances_of(std::span<const Double3> positions, std::span<const Triangle> triangles,
                                  std::span<const std::uint32_t> representative) {
  DoubleBox box;
  for (const Triangle& t : triangles) {
    for (const std::uint32_t v : t) box.grow(positions[v]);
  }
  // Coordinates so large that differences overflow leave nothing to compare tolerances with.
  const double extent = length(box.extent());
  const double diagonal = std::isfinite(extent) ? extent : 0;
  const auto noise = [&](const Double3& p) {
    const double size = std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)});
    return std::min(size * k_weld_float_noise, diagonal * k_weld_noise_of_diagonal);
  };
  std::vector<double> shortest(positions.size(), -1);  // -1: no triangle uses it
  for (const Triangle& t : triangles) {
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t a = representative[t[i]], b = representative[t[(i + 1) % 3]];
      if (shortest[a] < 0) shortest[a] = diagonal;
      if (shortest[b] < 0) shortest[b] = diagonal;
      const double l = distance(positions[a], positions[b]);
      if (l >= shortest[a] && l >= shortest[b]) continue;
      if (l <= std::max(noise(positions[a]), noise(positions[b]))) continue;
      shortest[a] = std::min(shortest[a], l);
      shortest[b] = std::min(shortest[b], l);
    }
  }
  for (std::size_t v = 0; v < positions.size(); ++v) {
    shortest[v] = shortest[v] < 0 ? 0
                                  : std::max(noise(positions[v]), std::min(shortest[v] * k_weld_of_edge,
                                                                           diagonal * k_weld_of_diagonal));
  }
  return shortest;
}

}  // namespace

std::vector<std::uint32_t> weld(std::span<const Double3> positions, std::span<const double> tolerances,
                                std::vector<std::uint32_t> equal) {
  weld_near(positions, tolerances, equal);
  return equal;
}

std::vector<std::uint32_t> weld(std::span<const Double3> positions, std::span<const double> tolerances) {
  return weld(positions, tolerances, weld(positions, 0.0));
}

std::vector<std::uint32_t> weld(std::span<const Double3> positions, double tolerance) {
  if (tolerance > 0) return weld(positions, std::vector<double>(positions.size(), tolerance));
  std::vector<std::uint32_t> representative(positions.size());
  weld_equal(positions, representative);
  return representative;
}

std::vector<std::uint32_t> weld(std::span<const Double3> positions, std::span<const Triangle> triangles) {
  std::vector<std::uint32_t> equal = weld(positions, 0.0);
  const std::vector<double> tolerances = tolerances_of(positions, triangles, equal);
  return weld(positions, tolerances, std::move(equal));
}

std::vector<double> weld_tolerances(std::span<const Double3> positions, std::span<const Triangle> triangles,
                                    std::span<const std::uint32_t> equal) {
  std::vector<double> tolerances = tolerances_of(positions, triangles, equal);
  for (std::size_t v = 0; v < positions.size(); ++v) tolerances[v] = tolerances[equal[v]];
  return tolerances;
}

std::vector<double> weld_tolerances(std::span<const Double3> positions, std::span<const Triangle> triangles) {
  return weld_tolerances(positions, triangles, weld(positions, 0.0));
}

}  // namespace copse
