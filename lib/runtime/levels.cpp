#include "lib/runtime/levels.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

namespace copse {

namespace {

// Elements: more are copied at once, fewer have to be looked at one by one where a window is half dead.
constexpr std::size_t k_window = 512;

}  // namespace

LevelExtractor::LevelExtractor(const Spectrum& spectrum) : spectrum_(&spectrum) {
  const auto& elements = spectrum.elements;
  std::vector<std::uint32_t> order(elements.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return elements[a].material < elements[b].material;
  });
  first_index_.push_back(0);
  births_.reserve(order.size()), deaths_.reserve(order.size()), first_index_.reserve(order.size() + 1);
  indices_.reserve(3 * spectrum.triangles.size());
  for (std::size_t from = 0, to = 0; from < order.size(); from = to) {
    const std::uint32_t material = elements[order[from]].material;
    while (to < order.size() && to - from < k_window && elements[order[to]].material == material) ++to;
    if (runs_.empty() || runs_.back().material != material) {
      const auto at = static_cast<std::uint32_t>(windows_.size());
      runs_.push_back({.material = material, .first = at, .end = at});
      materials_.push_back(material);
    }
    const std::span<std::uint32_t> window = std::span(order).subspan(from, to - from);
    const std::uint32_t last = elements[window.front()].death, first = elements[window.back()].death;
    std::stable_sort(window.begin(), window.end(),
                     [&](std::uint32_t a, std::uint32_t b) { return elements[a].birth < elements[b].birth; });
    windows_.push_back({.first = static_cast<std::uint32_t>(from),
                        .end = static_cast<std::uint32_t>(to),
                        .first_to_die = first,
                        .last_to_die = last});
    ++runs_.back().end;
    for (const std::uint32_t e : window) {
      births_.push_back(elements[e].birth), deaths_.push_back(elements[e].death);
      for (std::uint32_t t = spectrum.first_triangle[e]; t < spectrum.first_triangle[e + 1]; ++t)
        indices_.insert(indices_.end(), spectrum.triangles[t].begin(), spectrum.triangles[t].end());
      first_index_.push_back(static_cast<std::uint32_t>(indices_.size()));
    }
  }
  capacity_ = spectrum.counts.empty() ? 0 : 3 * std::size_t{spectrum.counts[0]};
}

std::size_t LevelExtractor::extract_run(const Run& run, std::uint32_t steps, std::uint32_t* out) const {
  std::uint32_t* at = out;
  const auto copy = [&](std::size_t first, std::size_t end) {
    const std::size_t n = first_index_[end] - first_index_[first];
    std::memcpy(at, indices_.data() + first_index_[first], n * sizeof *at);
    at += n;
  };
  for (std::uint32_t w = run.first; w < run.end && windows_[w].last_to_die > steps; ++w) {
    const Window& window = windows_[w];
    const auto births = births_.begin();
    const auto born = static_cast<std::size_t>(
        std::upper_bound(births + window.first, births + window.end, steps) - births);
    if (window.first_to_die > steps) {
      if (born > window.first) copy(window.first, born);
      continue;
    }
    for (std::size_t e = window.first; e < born; ++e)
      if (deaths_[e] > steps) copy(e, e + 1);
  }
  return static_cast<std::size_t>(at - out);
}

std::size_t LevelExtractor::extract(std::uint32_t steps, std::span<std::uint32_t> out) const {
  if (out.size() < capacity_) return 0;
  steps = std::min(steps, spectrum_->steps());
  std::size_t n = 0;
  for (const Run& run : runs_) n += extract_run(run, steps, out.data() + n);
  return n;
}

std::size_t LevelExtractor::extract(std::uint32_t steps, std::uint32_t material,
                                    std::span<std::uint32_t> out) const {
  if (out.size() < capacity_) return 0;
  steps = std::min(steps, spectrum_->steps());
  for (const Run& run : runs_) {
    if (run.material == material) return extract_run(run, steps, out.data());
  }
  return 0;
}

namespace {

std::uint32_t triangles_after(const Spectrum& s, std::uint32_t steps) {
  return s.counts.empty() ? 0 : s.counts[steps];
}

float error_after(const Spectrum& s, std::uint32_t steps) {
  return s.errors.empty() ? 0 : s.errors[steps];
}

// Between two knots, both parts in proportion; `w` 0 is the finer one.
LodLevel between(const LodSpectra& spectra, const LodLevel& fine, const LodLevel& coarse, double w) {
  const auto mix = [&](std::uint32_t a, std::uint32_t b) {
    return a + static_cast<std::uint32_t>(std::floor(w * static_cast<double>(b - a)));
  };
  LodLevel level = fine;
  level.trunk_steps = mix(fine.trunk_steps, coarse.trunk_steps);
  level.leaf_steps = mix(fine.leaf_steps, coarse.leaf_steps);
  level.triangles =
      triangles_after(spectra.trunk, level.trunk_steps) + triangles_after(spectra.leaves, level.leaf_steps);
  const float error =
      std::max(error_after(spectra.trunk, level.trunk_steps), error_after(spectra.leaves, level.leaf_steps));
  level.error = std::max(fine.error, std::min(coarse.error, error));
  return level;
}

// How far from the finer to the coarser knot one must go until `holds`, which then stays so.
template <class Holds>
double first_weight(const LodSpectra& spectra, const LodLevel& fine, const LodLevel& coarse, Holds holds) {
  double low = 0, high = 1;
  for (int i = 0; i < 32; ++i) {
    const double middle = 0.5 * (low + high);
    (holds(between(spectra, fine, coarse, middle)) ? high : low) = middle;
  }
  return high;
}

// The finest level between two knots that has at most so many triangles.
LodLevel search(const LodSpectra& spectra, const LodLevel& fine, const LodLevel& coarse,
                std::uint64_t triangles) {
  const double w = first_weight(spectra, fine, coarse,
                                [&](const LodLevel& level) { return level.triangles <= triangles; });
  return w >= 1 ? coarse : between(spectra, fine, coarse, w);
}

// The coarsest level between two knots that errs by no more.
LodLevel search_error(const LodSpectra& spectra, const LodLevel& fine, const LodLevel& coarse, double error) {
  const double beyond =
      first_weight(spectra, fine, coarse, [&](const LodLevel& level) { return level.error > error; });
  const double w = std::max(0.0, beyond - 0x1p-32);  // what the search has found to be within
  return between(spectra, fine, coarse, w);
}

// The finest of the discrete levels with at most so many triangles, the coarsest when none has.
LodLevel discrete_of_triangles(const LodSpectra& spectra, std::uint64_t triangles) {
  const LodLevel full = full_detail(spectra);
  if (full.triangles <= triangles || spectra.discrete.empty()) return full;
  const auto at = std::partition_point(spectra.discrete.begin(), spectra.discrete.end(),
                                       [&](const LodLevel& l) { return l.triangles > triangles; });
  return at == spectra.discrete.end() ? spectra.discrete.back() : *at;
}

}  // namespace

LodLevel full_detail(const LodSpectra& spectra) {
  if (!spectra.schedule.empty()) return spectra.schedule.front();
  LodLevel full;
  full.triangles = triangles_after(spectra.trunk, 0) + triangles_after(spectra.leaves, 0);
  return full;
}

LodLevel level_of_triangles(const LodSpectra& spectra, std::uint64_t triangles) {
  if (spectra.schedule.empty()) return discrete_of_triangles(spectra, triangles);
  const auto& knots = spectra.schedule;
  const auto at = std::partition_point(knots.begin(), knots.end(),
                                       [&](const LodLevel& l) { return l.triangles > triangles; });
  if (at == knots.begin()) return knots.front();
  if (at == knots.end()) return knots.back();
  return search(spectra, *std::prev(at), *at, triangles);
}

LodLevel level_of_error(const LodSpectra& spectra, double error) {
  const auto& knots = spectra.schedule.empty() ? spectra.discrete : spectra.schedule;
  const auto at =
      std::partition_point(knots.begin(), knots.end(), [&](const LodLevel& l) { return l.error <= error; });
  if (at == knots.begin()) return full_detail(spectra);
  if (at == knots.end() || spectra.schedule.empty()) return *std::prev(at);
  return search_error(spectra, *std::prev(at), *at, error);
}

LodLevel level_of_distance(const LodSpectra& spectra, double distance) {
  if (spectra.schedule.empty()) {
    const std::uint32_t number = choose_discrete(spectra, distance, k_none);
    return number == 0 ? full_detail(spectra) : spectra.discrete[number - 1];
  }
  if (!(distance > spectra.near)) return spectra.schedule.front();
  if (!(spectra.near > 0)) return spectra.schedule.back();
  const double most = spectra.schedule.front().triangles,
               share = spectra.near / std::min<double>(distance, spectra.far);
  return level_of_triangles(spectra, static_cast<std::uint64_t>(most * share * share));
}

double held_distance(const LodSpectra& spectra, double distance, double held) {
  const double h = spectra.hysteresis;
  if (std::isnan(distance) || !(held > 0) || !(h < 1)) return distance;
  return std::clamp(held, distance / (1 + h), distance / (1 - h));
}

std::uint32_t choose_discrete(const LodSpectra& spectra, double distance, std::uint32_t current) {
  const auto& levels = spectra.discrete;
  if (std::isnan(distance)) return 0;
  const auto nominal = static_cast<std::uint32_t>(
      std::partition_point(levels.begin(), levels.end(),
                           [&](const LodLevel& l) { return l.distance <= distance; }) -
      levels.begin());
  if (current > levels.size()) return nominal;
  const double h = spectra.hysteresis;
  std::uint32_t level = current;
  while (level < nominal && distance > levels[level].distance * (1 + h)) ++level;
  while (level > nominal && distance < levels[level - 1].distance * (1 - h)) --level;
  return level;
}

bool choose_impostor(const LodSpectra& spectra, double border, double distance, bool drawn) {
  const double h = spectra.hysteresis;
  return drawn ? !(distance < border * (1 - h)) && !std::isnan(distance) : distance > border * (1 + h);
}

}  // namespace copse
