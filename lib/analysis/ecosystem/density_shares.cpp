#include "lib/analysis/ecosystem/density_shares.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numbers>
#include <optional>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

namespace copse {
namespace {

constexpr std::size_t k_levels = 1024, k_parts = 8;

class Parts {
 public:
  explicit Parts(const DensityField& field) : field_(field), part_(k_levels) {
    const double largest = *std::max_element(field.weights.begin(), field.weights.end());
    if (!(largest > 0)) return;
    levels_per_weight_ = k_levels / largest;
    std::vector<double> mass(k_levels);
    for (const double w : field.weights)
      if (w > 0) mass[level_of(w)] += w;
    cut(mass, field.total());
    for (const double w : field.weights)
      if (w > 0) ++cells_[part_[level_of(w)]];
  }

  std::optional<std::size_t> part_at(double x, double z) const {
    const PlantedArea& a = field_.area;
    if (!(x >= a.x0 && x <= a.x1 && z >= a.z0 && z <= a.z1)) return std::nullopt;
    const auto cell = [](double share, std::uint32_t n) {
      return static_cast<std::size_t>(std::clamp(share * n, 0.0, n - 1.0));
    };
    const double w = field_.weights[cell((z - a.z0) / a.depth(), field_.rows) * field_.columns +
                                    cell((x - a.x0) / a.width(), field_.columns)];
    return w > 0 ? std::optional(part_[level_of(w)]) : std::nullopt;
  }

  double ground(std::size_t part) const {
    return static_cast<double>(cells_[part]) * (field_.area.width() / field_.columns) *
           (field_.area.depth() / field_.rows);
  }

  std::vector<DensityShare> shares;  // asked: a share of all

 private:
  std::size_t level_of(double weight) const {
    return std::min(static_cast<std::size_t>(weight * levels_per_weight_), k_levels - 1);
  }

  // A part begins where an eighth of the mass does; levels without mass belong to the part before.
  void cut(const std::vector<double>& mass, double total) {
    double before = 0;
    std::size_t eighth = k_parts;
    for (std::size_t l = 0; l < k_levels; ++l) {
      if (!(mass[l] > 0)) continue;
      const auto now = std::min(static_cast<std::size_t>(before / total * k_parts), k_parts - 1);
      if (now != eighth) {
        shares.push_back({.from = static_cast<double>(l) / k_levels});
        cells_.push_back(0);
      }
      eighth = now;
      shares.back().to = static_cast<double>(l + 1) / k_levels;
      shares.back().asked += mass[l] / total;
      part_[l] = shares.size() - 1;
      before += mass[l];
    }
  }

  const DensityField& field_;
  double levels_per_weight_ = 0;
  std::vector<std::size_t> part_;  // of every level
  std::vector<std::uint64_t> cells_;
};

}  // namespace

std::vector<DensityShare> density_shares(const DensityField& field, std::uint64_t trees,
                                         const std::function<GroundPlace(std::uint64_t)>& unhindered,
                                         std::span<const GroundPlace> feet, std::span<const Disc> discs) {
  if (field.weights.empty()) return {};
  Parts parts(field);
  if (parts.shares.size() < 2) return {};
  std::vector<DensityShare>& shares = parts.shares;
  for (const GroundPlace& at : feet)
    if (const auto part = parts.part_at(at.x, at.z)) ++shares[*part].got;
  std::vector<std::atomic<std::uint64_t>> counts(shares.size());
  tbb::parallel_for(tbb::blocked_range<std::uint64_t>(0, trees, 1024), [&](const auto& range) {
    for (std::uint64_t i = range.begin(); i < range.end(); ++i) {
      const GroundPlace at = unhindered(i);
      if (const auto part = parts.part_at(at.x, at.z)) counts[*part].fetch_add(1, std::memory_order_relaxed);
    }
  });
  for (std::size_t p = 0; p < shares.size(); ++p) shares[p].unhindered = counts[p];
  for (const Disc& d : discs)
    if (const auto part = parts.part_at(d.x, d.z))
      shares[*part].covered += std::numbers::pi * d.radius * d.radius;
  for (std::size_t p = 0; p < shares.size(); ++p) {
    shares[p].asked *= static_cast<double>(trees);
    shares[p].covered /= parts.ground(p);
  }
  return std::move(shares);
}

double histogram_error(std::span<const DensityShare> shares) {
  double off = 0, all = 0;
  for (const DensityShare& s : shares) {
    off += std::abs(static_cast<double>(s.got) - s.asked);
    all += s.asked;
  }
  return all > 0 ? off / all : 0;
}

std::uint64_t out_of_their_part(std::span<const DensityShare> shares) {
  std::uint64_t out = 0;
  for (const DensityShare& s : shares) out += s.got > s.unhindered ? s.got - s.unhindered : 0;
  return out;
}

}  // namespace copse
