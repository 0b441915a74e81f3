#include "tools/lodbake/levels.h"

#include "lib/runtime/levels.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace copse::lodbake {
namespace {

constexpr double k_full_pixels = 1024, k_screen_lines = 1080, k_field_of_view = std::numbers::pi / 3;

std::vector<LodLevel> wanted(const Options& options, const LodSpectra& spectra) {
  const double full = spectra.schedule.front().triangles;
  std::vector<double> shares = options.discrete;
  // Without any wish three models, near, medium and far, each with half of the triangles of the finer one
  // (003, section 1.2).
  if (shares.empty() && options.discrete_error.empty()) shares = {0.5, 0.25};
  std::vector<LodLevel> levels;
  for (const double share : shares)
    levels.push_back(level_of_triangles(
        spectra, std::max(options.min_triangles, static_cast<std::uint64_t>(std::floor(share * full)))));
  for (const double error : options.discrete_error) levels.push_back(level_of_error(spectra, error));
  return levels;
}

double distance_of(double share, double height) {
  return distance_for_pixels(height, k_full_pixels * std::sqrt(std::max(share, 1e-6)));
}

}  // namespace

double distance_for_pixels(double metres, double pixels) {
  return metres * k_screen_lines / (2 * std::tan(k_field_of_view / 2)) / pixels;
}

void choose_levels(const Options& options, double height, LodSpectra& spectra) {
  if (spectra.schedule.empty()) return;
  const double full = std::max(1.0, static_cast<double>(spectra.schedule.front().triangles));
  spectra.discrete = wanted(options, spectra);
  spectra.hysteresis = static_cast<float>(options.hysteresis / 100);
  for (LodLevel& level : spectra.discrete)
    level.distance = static_cast<float>(distance_of(level.triangles / full, height));
  const double last = spectra.discrete.empty() ? distance_of(spectra.schedule.back().triangles / full, height)
                                               : spectra.discrete.back().distance;
  spectra.near = static_cast<float>(options.near.value_or(distance_of(1, height)));
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
  for (std::size_t i = 1; i < spectra.discrete.size(); ++i)
    spectra.discrete[i].distance = std::max(spectra.discrete[i].distance, spectra.discrete[i - 1].distance);
}

}  // namespace copse::lodbake
