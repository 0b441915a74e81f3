#include "tools/lodbake/levels.h"

#include "lib/runtime/levels.h"
#include "tools/lodbake/level_distances.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <fmt/format.h>

namespace copse::lodbake {
namespace {

constexpr double k_full_pixels = 1024;
// Of a metre a metre away: 1080 lines see 60 degrees.
constexpr double k_pixels_at_one = 1080 * std::numbers::sqrt3 / 2;

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

double distance_of(double share, double size) {
  return distance_for_pixels(size, k_full_pixels * std::sqrt(std::max(share, 1e-6)));
}

}  // namespace

double distance_for_pixels(double metres, double pixels) {
  return metres * k_pixels_at_one / pixels;
}
double pixels_at_distance(double metres, double distance) {
  return metres * k_pixels_at_one / distance;
}

std::vector<double> asked_shares(const Options& options) {
  // Without any wish three models, near, medium and far, each with half of the triangles of the finer one
  // (003, section 1.2).
  if (options.discrete.empty() && options.discrete_error.empty()) return {0.5, 0.25};
  return options.discrete;
}

void choose_levels(const Options& options, double size, LodSpectra& spectra, Context& context) {
  if (spectra.schedule.empty()) return;
  const double full = std::max(1.0, static_cast<double>(spectra.schedule.front().triangles));
  const auto natural = [&](const LodLevel& level) { return distance_of(level.triangles / full, size); };
  for (LodLevel& knot : spectra.schedule) knot.distance = static_cast<float>(natural(knot));
  spectra.discrete = wanted(options, spectra);
  spectra.hysteresis = static_cast<float>(options.hysteresis / 100);
  std::vector<double> distances;
  for (const LodLevel& level : spectra.discrete) distances.push_back(natural(level));
  const NamedDistances named = named_distances(options);
  const std::vector<double> followed = distances = follow_named(distances, named);
  keep_apart(distances, named, spectra.hysteresis);
  for (std::size_t i = 0; i < distances.size(); ++i)
    spectra.discrete[i].distance = static_cast<float>(distances[i]);
  for (std::size_t i = 1; i < distances.size(); ++i)
    if (distances[i] > 1.01 * followed[i] && !same(spectra.discrete[i - 1], spectra.discrete[i]))
      context.warn(
          fmt::format("{}: level {} begins at {:.4g} m instead of {:.4g}, so that with a hysteresis "
                      "of {:.3g} % level {} is drawn somewhere",
                      options.input.string(), i + 1, distances[i], followed[i], options.hysteresis, i));
  const double near = std::min(distance_of(1, size), distances.front());
  spectra.near = static_cast<float>(options.near.value_or(near));
  spectra.far = std::max(spectra.near, spectra.discrete.back().distance);
}

}  // namespace copse::lodbake
