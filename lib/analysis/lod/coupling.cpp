#include "lib/analysis/lod/coupling.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace copse {
namespace {

// What the trunk keeps of its triangles from one knot to the next, as tried.
constexpr std::array k_portions{1.0, 0.9, 0.8, 0.68, 0.5, 0.25};

class Coupler {
 public:
  Coupler(const LodSpectra& spectra, const LevelError& error, const LevelFloats& floats)
      : spectra_(spectra), error_(error), floats_(floats) {}

  LodLevel next(const LodLevel& from, std::uint64_t target) {
    LodLevel best = from;
    double least = std::numeric_limits<double>::infinity();
    if (!error_) {
      const LodLevel level = even(from, target);
      return floats_ && floats_(level) > 0 ? nearly_even(from, target, level) : level;
    }
    std::vector<LodLevel> tried;
    const std::uint64_t trunk = count(spectra_.trunk, from.trunk_steps);
    const auto consider = [&](std::uint64_t trunk_triangles) {
      const LodLevel level = divide(from, target, trunk_triangles);
      if (level.triangles > target || std::find(tried.begin(), tried.end(), level) != tried.end()) return;
      tried.push_back(level);
      if (floats_ && floats_(level) > 0) return;
      const double now = error_(level);
      if (now < least) least = now, best = level;
    };
    for (const double portion : k_portions)
      consider(static_cast<std::uint64_t>(std::floor(portion * static_cast<double>(trunk))));
    const std::uint64_t leaves = count(spectra_.leaves, from.leaf_steps);
    if (leaves <= target) consider(target - leaves);
    consider(count(spectra_.trunk, even(from, target).trunk_steps));
    // Nothing fits, or everything floats: the leaves alone give, and only at last both.
    return std::isfinite(least) ? best : leaves_alone(from, target);
  }

 private:
  // The trunk keeps more than its share, as little more as holds the leaves.
  LodLevel nearly_even(const LodLevel& from, std::uint64_t target, const LodLevel& even) const {
    const std::uint64_t least = count(spectra_.trunk, even.trunk_steps);
    const std::uint64_t most = count(spectra_.trunk, from.trunk_steps);
    constexpr std::uint64_t k_tries = 8;
    for (std::uint64_t i = 1; i < k_tries; ++i) {
      const LodLevel level = divide(from, target, least + (most - least) * i / k_tries);
      if (level.triangles <= target && floats_(level) == 0) return level;
    }
    return leaves_alone(from, target);
  }

  LodLevel leaves_alone(const LodLevel& from, std::uint64_t target) const {
    const std::uint64_t trunk = count(spectra_.trunk, from.trunk_steps);
    const LodLevel level =
        level_at(spectra_, from.trunk_steps,
                 std::max(from.leaf_steps, step_with(spectra_.leaves, target > trunk ? target - trunk : 0)));
    return level.triangles < from.triangles ? level : even(from, target);
  }

  static std::uint64_t count(const Spectrum& s, std::uint32_t steps) {
    return s.counts.empty() ? 0 : s.counts[steps];
  }

  LodLevel divide(const LodLevel& from, std::uint64_t target, std::uint64_t trunk_triangles) const {
    const std::uint32_t trunk = std::max(from.trunk_steps, step_with(spectra_.trunk, trunk_triangles));
    const std::uint64_t used = count(spectra_.trunk, trunk);
    const std::uint32_t leaves =
        std::max(from.leaf_steps, step_with(spectra_.leaves, target > used ? target - used : 0));
    return level_at(spectra_, trunk, leaves);
  }
  // The same share of each.
  LodLevel even(const LodLevel& from, std::uint64_t target) const {
    const double whole = static_cast<double>(count(spectra_.trunk, 0) + count(spectra_.leaves, 0));
    const double share = whole > 0 ? static_cast<double>(target) / whole : 0;
    const auto part = [&](const Spectrum& s, std::uint32_t steps) {
      return std::max(
          steps,
          step_with(s, static_cast<std::uint64_t>(std::floor(share * static_cast<double>(count(s, 0))))));
    };
    return level_at(spectra_, part(spectra_.trunk, from.trunk_steps), part(spectra_.leaves, from.leaf_steps));
  }

  const LodSpectra& spectra_;
  const LevelError& error_;
  const LevelFloats& floats_;
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

std::vector<LodLevel> couple(const LodSpectra& spectra, const LevelError& error, const LevelFloats& floats,
                             const CouplingOptions& options) {
  std::vector<LodLevel> knots{level_at(spectra, 0, 0)};
  Coupler coupler(spectra, error, floats);
  const LodLevel end = level_at(spectra, spectra.trunk.steps(), spectra.leaves.steps());
  while (knots.back().triangles > std::max<std::uint64_t>(end.triangles, options.min_triangles)) {
    const auto target = static_cast<std::uint64_t>(std::floor(options.knot_ratio * knots.back().triangles));
    const LodLevel next = coupler.next(knots.back(), std::max<std::uint64_t>(target, end.triangles));
    if (next.triangles >= knots.back().triangles || next.triangles < options.min_triangles) break;
    knots.push_back(next);
  }
  return knots;
}

}  // namespace copse
