#include "tools/lodbake/levels.h"

#include "lib/runtime/levels.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace copse::lodbake {
namespace {

constexpr double k_full_pixels = 1024, k_screen_lines = 1080, k_field_of_view = std::numbers::pi / 3;

std::vector<LodLevel> wanted(const Options& options, const LodSpectra& spectra) {
  const double full = spectra.schedule.front().triangles;
  std::vector<LodLevel> levels;
  for (const double share : asked_shares(options))
    levels.push_back(level_of_triangles(
        spectra, std::max(options.min_triangles, static_cast<std::uint64_t>(std::floor(share * full)))));
  for (const double error : options.discrete_error) levels.push_back(level_of_error(spectra, error));
  return levels;
}

bool same(const LodLevel& a, const LodLevel& b) {
  return a.trunk_steps == b.trunk_steps && a.leaf_steps == b.leaf_steps;
}

// Whether the tree has the level, or nearly, that was asked for.
bool as_asked(const Options& options, const LodSpectra& spectra, std::size_t i) {
  const std::vector<double> shares = asked_shares(options);
  if (i >= shares.size()) return true;
  const double asked = shares[i] * spectra.schedule.front().triangles;
  return spectra.discrete[i].triangles <= asked && spectra.discrete[i].triangles >= 0.9 * asked;
}

// Bands of hysteresis that would meet.
Result<void> keep_apart(const Options& options, LodSpectra& spectra) {
  const double h = options.hysteresis / 100;
  auto& levels = spectra.discrete;
  for (std::size_t i = 1; i < levels.size(); ++i) {
    const double before = levels[i - 1].distance, border = before * (1 + h) / (1 - h);
    if (levels[i].distance > border || before == 0) continue;
    if (as_asked(options, spectra, i - 1) && as_asked(options, spectra, i) && !same(levels[i - 1], levels[i]))
      return fail(
          Fault::usage, "",
          fmt::format("levels {} and {} begin at {:.4g} and {:.4g} m: with a hysteresis of {:.3g} % level "
                      "{} would be drawn nowhere",
                      i, i + 1, before, levels[i].distance, options.hysteresis, i),
          "name levels or distances that are farther apart, or a smaller --hysteresis");
    levels[i].distance = static_cast<float>(border * 1.001);
  }
  return {};
}

double distance_of(double share, double height) {
  return distance_for_pixels(height, k_full_pixels * std::sqrt(std::max(share, 1e-6)));
}

}  // namespace

double distance_for_pixels(double metres, double pixels) {
  return metres * k_screen_lines / (2 * std::tan(k_field_of_view / 2)) / pixels;
}

std::vector<double> asked_shares(const Options& options) {
  // Without any wish three models, near, medium and far, each with half of the triangles of the finer one
  // (003, section 1.2).
  if (options.discrete.empty() && options.discrete_error.empty()) return {0.5, 0.25};
  return options.discrete;
}

Result<void> choose_levels(const Options& options, double height, LodSpectra& spectra) {
  if (spectra.schedule.empty()) return {};
  const double full = std::max(1.0, static_cast<double>(spectra.schedule.front().triangles));
  spectra.discrete = wanted(options, spectra);
  spectra.hysteresis = static_cast<float>(options.hysteresis / 100);
  for (LodLevel& level : spectra.discrete)
    level.distance = static_cast<float>(distance_of(level.triangles / full, height));
  const double last = spectra.discrete.empty() ? distance_of(spectra.schedule.back().triangles / full, height)
                                               : spectra.discrete.back().distance;
  spectra.near = static_cast<float>(options.near.value_or(distance_of(1, height)));
  if (options.far && *options.far < spectra.near)
    return fail(Fault::usage, "",
                fmt::format("--far {:.4g} is nearer than {:.4g} m, up to where there is full detail",
                            *options.far, spectra.near),
                "name a greater distance, or a smaller --near");
  spectra.far = static_cast<float>(std::max<double>(options.far.value_or(last), spectra.near));
  // The near model of the three that 003 has is full detail: then --medium is where it ends.
  const bool three_models = spectra.discrete.size() == 2 && options.near && options.medium && options.far;
  const auto& first = three_models ? options.medium : options.near;
  if (first && !spectra.discrete.empty()) spectra.discrete.front().distance = static_cast<float>(*first);
  if (options.medium && spectra.discrete.size() > 1 && !three_models)
    spectra.discrete[1].distance = static_cast<float>(*options.medium);
  if (options.far && !spectra.discrete.empty()) spectra.discrete.back().distance = spectra.far;
  for (LodLevel& knot : spectra.schedule)
    knot.distance = static_cast<float>(distance_of(knot.triangles / full, height));
  if (auto apart = keep_apart(options, spectra); !apart) return apart;
  if (!spectra.discrete.empty() && !options.far)
    spectra.far = std::max(spectra.far, spectra.discrete.back().distance);
  return {};
}

}  // namespace copse::lodbake
