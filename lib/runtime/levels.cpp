#include "lib/runtime/levels.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numeric>

namespace copse {

LevelExtractor::LevelExtractor(const Spectrum& spectrum) : spectrum_(&spectrum) {
  const auto& elements = spectrum.elements;
  std::vector<std::uint32_t> order(elements.size());
  std::iota(order.begin(), order.end(), 0u);
  std::stable_sort(order.begin(), order.end(), [&](std::uint32_t a, std::uint32_t b) {
    return elements[a].material < elements[b].material;
  });
  std::uint32_t widest = 0;
  first_index_.push_back(0);
  indices_.reserve(3 * spectrum.triangles.size());
  for (const std::uint32_t e : order) {
    const auto at = static_cast<std::uint32_t>(births_.size());
    const std::uint32_t triangles = spectrum.first_triangle[e + 1] - spectrum.first_triangle[e];
    if (runs_.empty() || runs_.back().material != elements[e].material) {
      runs_.push_back({.material = elements[e].material,
                       .first = at,
                       .end = at,
                       .narrowest = triangles,
                       .widest = triangles});
      materials_.push_back(elements[e].material);
    }
    runs_.back().end = at + 1;
    runs_.back().narrowest = std::min(runs_.back().narrowest, triangles);
    runs_.back().widest = std::max(runs_.back().widest, triangles);
    widest = std::max(widest, triangles);
    births_.push_back(elements[e].birth), deaths_.push_back(elements[e].death);
    for (std::uint32_t t = spectrum.first_triangle[e]; t < spectrum.first_triangle[e + 1]; ++t)
      indices_.insert(indices_.end(), spectrum.triangles[t].begin(), spectrum.triangles[t].end());
    first_index_.push_back(static_cast<std::uint32_t>(indices_.size()));
  }
  indices_.resize(indices_.size() + 3 * std::size_t{widest});  // a copy may be wider than the last element
  for (std::size_t b = 0; b < births_.size(); b += k_block) {
    const auto from = births_.begin() + static_cast<std::ptrdiff_t>(b);
    const auto [low, high] = std::minmax_element(
        from, from + static_cast<std::ptrdiff_t>(std::min<std::size_t>(k_block, births_.size() - b)));
    low_birth_.push_back(*low), high_birth_.push_back(*high);
  }
  // One element more than what is drawn: a copy is written before it is known whether it stays.
  capacity_ = spectrum.counts.empty() ? 0 : 3 * (std::size_t{spectrum.counts[0]} + widest);
}

std::size_t LevelExtractor::extract_run(const Run& run, std::uint32_t steps, std::uint32_t* out) const {
  std::uint32_t* at = out;
  // By descending death: what is alive lies before the first element that is dead.
  const auto first = deaths_.begin() + run.first, last = deaths_.begin() + run.end;
  const auto end = static_cast<std::uint32_t>(
      std::partition_point(first, last, [&](std::uint32_t death) { return death > steps; }) -
      deaths_.begin());
  for (std::uint32_t e = run.first; e < end;) {
    const std::uint32_t block = e / k_block, stop = std::min(end, (block + 1) * k_block);
    if (high_birth_[block] <= steps) {
      const std::size_t n = first_index_[stop] - first_index_[e];
      std::memcpy(at, indices_.data() + first_index_[e], n * sizeof *at);
      at += n, e = stop;
    } else if (low_birth_[block] > steps) {
      e = stop;
    } else if (run.narrowest == 2 && run.widest == 2) {
      // Written whether it lives or not, and kept if it does: no branch to foretell.
      for (; e < stop; ++e) {
        std::memcpy(at, indices_.data() + first_index_[e], 6 * sizeof *at);
        at += births_[e] <= steps ? 6 : 0;
      }
    } else if (run.widest == 2) {
      // The same, each as if it had two.
      for (; e < stop; ++e) {
        std::memcpy(at, indices_.data() + first_index_[e], 6 * sizeof *at);
        at += births_[e] <= steps ? first_index_[e + 1] - first_index_[e] : 0;
      }
    } else if (run.widest == 1) {
      for (; e < stop; ++e) {
        std::memcpy(at, indices_.data() + first_index_[e], 3 * sizeof *at);
        at += births_[e] <= steps ? 3 : 0;
      }
    } else {
      for (; e < stop; ++e) {
        if (births_[e] > steps) continue;
        const std::size_t n = first_index_[e + 1] - first_index_[e];
        std::memcpy(at, indices_.data() + first_index_[e], n * sizeof *at);
        at += n;
      }
    }
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
  return level_of_triangles(
      spectra, static_cast<std::uint64_t>(
                   std::max(most * share * share, double{0} + spectra.schedule.back().triangles)));
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
