#include "lib/analysis/lod/discrete_spectra.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace copse {
namespace {

// Ascending step counts, 0 first.
using Steps = std::vector<std::uint32_t>;

std::uint32_t place(const Steps& kept, std::uint32_t step) {
  return static_cast<std::uint32_t>(std::lower_bound(kept.begin(), kept.end(), step) - kept.begin());
}

struct Life {
  std::uint32_t element = 0, birth = 0, death = k_none;
};

// Elements that some kept state shows, in the order of a spectrum.
std::vector<Life> survivors(const Spectrum& s, const Steps& kept) {
  std::vector<Life> out;
  const auto states = static_cast<std::uint32_t>(kept.size());
  for (std::uint32_t e = 0; e < s.elements.size(); ++e) {
    const SpectrumElement& x = s.elements[e];
    const std::uint32_t birth = place(kept, x.birth), end = x.death == k_none ? states : place(kept, x.death);
    if (birth < end) out.push_back({e, birth, end == states ? k_none : end});
  }
  std::stable_sort(out.begin(), out.end(), [](const Life& a, const Life& b) {
    return std::pair(b.death, a.birth) < std::pair(a.death, b.birth);
  });
  return out;
}

// New numbers of the vertices that are used, in their old order; k_none for the rest.
std::vector<std::uint32_t> renumbered(const Spectrum& s, const std::vector<Life>& lives) {
  std::vector<std::uint32_t> number(s.vertices.size(), k_none);
  for (const Life& life : lives) {
    for (std::uint32_t t = s.first_triangle[life.element]; t < s.first_triangle[life.element + 1]; ++t)
      for (const std::uint32_t v : s.triangles[t]) number[v] = 0;
  }
  std::uint32_t next = 0;
  for (std::uint32_t& n : number)
    if (n != k_none) n = next++;
  return number;
}

Spectrum with_states(const Spectrum& s, const Steps& kept) {
  if (s.elements.empty()) return s;
  const std::vector<Life> lives = survivors(s, kept);
  const std::vector<std::uint32_t> number = renumbered(s, lives);
  std::vector<SpectrumVertex> vertices;
  for (std::size_t v = 0; v < number.size(); ++v)
    if (number[v] != k_none) vertices.push_back(s.vertices[v]);
  std::vector<SpectrumElement> elements;
  std::vector<std::uint32_t> first{0}, counts;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  for (const Life& life : lives) {
    elements.push_back(s.elements[life.element]);
    elements.back().birth = life.birth, elements.back().death = life.death;
    for (std::uint32_t t = s.first_triangle[life.element]; t < s.first_triangle[life.element + 1]; ++t) {
      const auto& v = s.triangles[t];
      triangles.push_back({number[v[0]], number[v[1]], number[v[2]]});
    }
    first.push_back(static_cast<std::uint32_t>(triangles.size()));
  }
  std::vector<float> errors;
  for (const std::uint32_t step : kept) counts.push_back(s.counts[step]), errors.push_back(s.errors[step]);
  Spectrum out;
  out.method = s.method;
  out.vertices = std::move(vertices), out.elements = std::move(elements);
  out.first_triangle = std::move(first), out.triangles = std::move(triangles);
  out.counts = std::move(counts), out.errors = std::move(errors);
  return out;
}

Steps kept_steps(const std::vector<LodLevel>& levels, std::uint32_t LodLevel::*steps) {
  Steps out{0};
  for (const LodLevel& level : levels) out.push_back(level.*steps);
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

}  // namespace

LodSpectra discrete_spectra(const LodSpectra& spectra) {
  const Steps trunk = kept_steps(spectra.discrete, &LodLevel::trunk_steps),
              leaves = kept_steps(spectra.discrete, &LodLevel::leaf_steps);
  LodSpectra out;
  out.trunk = with_states(spectra.trunk, trunk), out.leaves = with_states(spectra.leaves, leaves);
  out.discrete = spectra.discrete;
  for (LodLevel& level : out.discrete) {
    level.trunk_steps = place(trunk, level.trunk_steps);
    level.leaf_steps = place(leaves, level.leaf_steps);
  }
  out.hysteresis = spectra.hysteresis, out.near = spectra.near, out.far = spectra.far;
  return out;
}

}  // namespace copse
