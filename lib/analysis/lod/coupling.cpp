#include "lib/analysis/lod/coupling.h"

#include "lib/analysis/lod/hausdorff_errors.h"
#include "lib/analysis/lod/step_order.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>
#include <cstdlib>
#include <optional>
#include <utility>
#include <vector>

namespace copse {
namespace {

// What the trunk keeps of its triangles from one knot to the next, as tried.
constexpr std::array k_portions{1.0, 0.9, 0.8, 0.68, 0.5, 0.25};

// What a division that leaves enough leaves but misses its target must have at most, of the triangles before.
constexpr double k_progress = 0.95;

// How good a division is, best first. Leaves that fall far below their even share are worse than a target
// that is missed, as long as there is any progress.
struct Rank {
  enum Kind { good, over, poor, hopeless } kind = good;
  std::uint64_t too_many = 0;  // triangles
  double error = 0;            // of the picture, or how far the shares of both parts are from one another
  friend auto operator<=>(const Rank&, const Rank&) = default;
};

class Coupler {
 public:
  Coupler(const LodSpectra& spectra, const LevelError& error, const StepOrder::MustGo& floats_by)
      : spectra_(spectra),
        error_(error),
        order_(spectra.leaves, floats_by),
        state_(order_.full_detail()),
        knots_(1) {}

  std::uint64_t triangles() const { return count(spectra_.trunk, trunk_) + state_.triangles; }

  // Goes to the best division with at most so many triangles, or as few as there are; false when all have
  // fewer than `least` or none fewer than now.
  bool go(std::uint64_t target, std::uint64_t least) {
    best_.reset(), tried_.clear();
    const std::uint64_t trunk = count(spectra_.trunk, trunk_);
    const std::uint64_t even_trunk = count(spectra_.trunk, even(target));
    if (error_) {
      for (const double portion : k_portions)
        consider(static_cast<std::uint64_t>(std::floor(portion * static_cast<double>(trunk))), target);
      if (state_.triangles <= target) consider(target - state_.triangles, target);
      consider(even_trunk, target);
    } else {
      consider(even_trunk, target);
      for (std::uint64_t i = 1; i <= k_even_tries && best_ && best_->rank.error > k_near_even; ++i)
        consider(even_trunk + (trunk - std::min(trunk, even_trunk)) * i / k_even_tries, target);
    }
    if (!best_ || best_->triangles < least) return false;
    take_best();
    return true;
  }

  // The spectra in their new order, with the schedule.
  void finish(LodSpectra& spectra) {
    if (!in_order()) spectra.leaves = order_.reordered(batches_);
    // Other states than before are drawn on the way.
    if (spectra.leaves.method == LodMethod::collapse && spectra.leaves.steps() > 0)
      spectra.leaves.errors = hausdorff_errors(spectra.leaves);
    spectra.schedule.clear();
    for (const auto& [trunk, leaves] : knots_) spectra.schedule.push_back(level_at(spectra, trunk, leaves));
  }

 private:
  static constexpr std::uint64_t k_even_tries = 8;
  static constexpr double k_near_even = 0.02;  // of all leaves
  static constexpr double k_fair = 0.5;        // of their even share
  struct Division {
    std::uint32_t trunk = 0;
    std::uint64_t triangles = 0;
    std::vector<StepOrder::Batch> forced, free;
    StepOrder::State state;
    Rank rank;
  };

  void consider(std::uint64_t trunk_triangles, std::uint64_t target) {
    const std::uint32_t trunk = std::max(trunk_, step_with(spectra_.trunk, trunk_triangles));
    if (std::find(tried_.begin(), tried_.end(), trunk) != tried_.end()) return;
    tried_.push_back(trunk);
    const std::uint64_t used = count(spectra_.trunk, trunk);
    Division division;
    division.trunk = trunk, division.state = state_;
    if (!order_.take_forced(division.state, trunk, division.forced)) return;
    std::uint64_t wanted = target > used ? target - used : 0;
    if (!error_) wanted = std::min(wanted, even_leaves(target));
    order_.take_until(division.state, trunk, wanted, division.free);
    division.triangles = used + division.state.triangles;
    if (division.triangles >= triangles()) return;
    division.rank = rank(division, target);
    if (!best_ || division.rank < best_->rank) best_ = std::move(division);
  }

  Rank rank(const Division& division, std::uint64_t target) const {
    const auto leaves = static_cast<double>(division.state.triangles);
    const auto fair = static_cast<double>(std::min(even_leaves(target), state_.triangles));
    const bool poor = leaves<k_fair * fair, over = division.triangles> target,
               slow = static_cast<double>(division.triangles) > k_progress * static_cast<double>(triangles());
    Rank rank;
    rank.kind = over ? (poor || slow ? Rank::hopeless : Rank::over) : poor ? Rank::poor : Rank::good;
    rank.too_many = over ? division.triangles - target : 0;
    rank.error =
        error_ ? error_({division.trunk, division.state.drawn, division.triangles}) : unevenness(division);
    return rank;
  }

  double unevenness(const Division& division) const {
    const std::uint64_t trunk = count(spectra_.trunk, 0), leaves = count(spectra_.leaves, 0);
    if (trunk == 0 || leaves == 0) return 0;
    return std::abs(static_cast<double>(count(spectra_.trunk, division.trunk)) / static_cast<double>(trunk) -
                    static_cast<double>(division.state.triangles) / static_cast<double>(leaves));
  }

  void take_best() {
    for (auto& batch : best_->forced) batches_.push_back(std::move(batch));
    if (!best_->forced.empty() && best_->trunk != trunk_) add_knot(trunk_);
    for (auto& batch : best_->free) batches_.push_back(std::move(batch));
    trunk_ = best_->trunk, state_ = std::move(best_->state);
    add_knot(trunk_);
  }

  void add_knot(std::uint32_t trunk) {
    knots_.emplace_back(trunk, static_cast<std::uint32_t>(batches_.size()));
  }

  bool in_order() const {
    for (std::size_t i = 0; i < batches_.size(); ++i)
      if (batches_[i].size() != 1 || batches_[i][0] != i + 1) return false;
    return true;
  }

  static std::uint64_t count(const Spectrum& s, std::uint32_t steps) {
    return s.counts.empty() ? 0 : s.counts[steps];
  }
  // The same share of each.
  double share(std::uint64_t target) const {
    const double whole = static_cast<double>(count(spectra_.trunk, 0) + count(spectra_.leaves, 0));
    return whole > 0 ? static_cast<double>(target) / whole : 0;
  }
  std::uint32_t even(std::uint64_t target) const {
    const double trunk = share(target) * static_cast<double>(count(spectra_.trunk, 0));
    return step_with(spectra_.trunk, static_cast<std::uint64_t>(std::floor(trunk)));
  }
  std::uint64_t even_leaves(std::uint64_t target) const {
    return static_cast<std::uint64_t>(
        std::floor(share(target) * static_cast<double>(count(spectra_.leaves, 0))));
  }

  const LodSpectra& spectra_;
  const LevelError& error_;
  StepOrder order_;
  std::uint32_t trunk_ = 0;
  StepOrder::State state_;
  std::vector<StepOrder::Batch> batches_;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> knots_;  // steps of the trunk, of the leaves
  std::optional<Division> best_;
  std::vector<std::uint32_t> tried_;
};

}  // namespace

LodLevel level_at(const LodSpectra& spectra, std::uint32_t trunk_steps, std::uint32_t leaf_steps) {
  LodLevel level{.trunk_steps = trunk_steps, .leaf_steps = leaf_steps};
  if (!spectra.trunk.counts.empty()) {
    level.triangles += spectra.trunk.counts[trunk_steps];
    level.error = std::max(level.error, spectra.trunk.errors[trunk_steps]);
  }
  if (!spectra.leaves.counts.empty()) {
    level.triangles += spectra.leaves.counts[leaf_steps];
    level.error = std::max(level.error, spectra.leaves.errors[leaf_steps]);
  }
  return level;
}

std::uint32_t step_with(const Spectrum& spectrum, std::uint64_t triangles) {
  if (spectrum.counts.empty()) return 0;
  const auto at = std::partition_point(spectrum.counts.begin(), spectrum.counts.end(),
                                       [&](std::uint32_t count) { return count > triangles; });
  return std::min(static_cast<std::uint32_t>(at - spectrum.counts.begin()), spectrum.steps());
}

void couple(LodSpectra& spectra, const LevelError& error, const CouplingOptions& options) {
  Coupler coupler(spectra, error, options.floats_by);
  const std::uint64_t end = level_at(spectra, spectra.trunk.steps(), spectra.leaves.steps()).triangles;
  while (coupler.triangles() > std::max(end, options.min_triangles)) {
    const auto target =
        static_cast<std::uint64_t>(std::floor(options.knot_ratio * static_cast<double>(coupler.triangles())));
    if (!coupler.go(std::max({target, end, options.min_triangles}), options.min_triangles)) break;
  }
  coupler.finish(spectra);
}

}  // namespace copse
