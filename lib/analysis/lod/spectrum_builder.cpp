#include "lib/analysis/lod/spectrum_builder.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace copse {
namespace {

// The largest number of triangles that is drawn after each step.
std::vector<std::int64_t> raw_counts(const std::vector<SpectrumElement>& elements,
                                     const std::vector<std::uint32_t>& first, std::size_t states) {
  std::vector<std::int64_t> change(states + 1);
  for (std::size_t e = 0; e < elements.size(); ++e) {
    const std::int64_t triangles = first[e + 1] - first[e];
    change[elements[e].birth] += triangles;
    if (elements[e].death != k_none) change[elements[e].death] -= triangles;
  }
  change.pop_back();
  std::partial_sum(change.begin(), change.end(), change.begin());
  return change;
}

// The step of the finished spectrum at which what happens in each step shows: the next one whose count is not
// above all before it; k_none when there is none.
std::vector<std::uint32_t> kept_steps(const std::vector<std::int64_t>& counts) {
  std::vector<std::uint32_t> kept(counts.size(), k_none);
  std::int64_t least = std::numeric_limits<std::int64_t>::max();
  std::uint32_t next = 0;
  std::size_t waiting = 0;
  for (std::size_t n = 0; n < counts.size(); ++n) {
    if (counts[n] > least) continue;
    least = counts[n];
    for (; waiting <= n; ++waiting) kept[waiting] = next;
    ++next;
  }
  return kept;
}

// Stable, by a key from 0 to `largest`.
template <class Key>
void sort_by(std::vector<std::uint32_t>& numbers, std::size_t largest, Key key) {
  std::vector<std::uint32_t> first(largest + 2, 0), out(numbers.size());
  for (const std::uint32_t n : numbers) ++first[key(n) + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  for (const std::uint32_t n : numbers) out[first[key(n)]++] = n;
  numbers.swap(out);
}

}  // namespace

std::uint32_t SpectrumBuilder::vertex(const SpectrumVertex& vertex) {
  vertices_.push_back(vertex);
  return static_cast<std::uint32_t>(vertices_.size() - 1);
}

std::uint32_t SpectrumBuilder::element(std::uint32_t material, std::uint32_t radius,
                                       std::span<const std::array<std::uint32_t, 3>> triangles) {
  alive_ += triangles.size();
  return element({.birth = steps(), .death = k_none, .material = material, .radius = radius}, triangles);
}

std::uint32_t SpectrumBuilder::element(const SpectrumElement& element,
                                       std::span<const std::array<std::uint32_t, 3>> triangles) {
  elements_.push_back(element);
  triangles_.insert(triangles_.end(), triangles.begin(), triangles.end());
  first_.push_back(static_cast<std::uint32_t>(triangles_.size()));
  return static_cast<std::uint32_t>(elements_.size() - 1);
}

void SpectrumBuilder::remove(std::uint32_t element) {
  elements_[element].death = steps();
  alive_ -= first_[element + 1] - first_[element];
}

void SpectrumBuilder::step(double error) {
  const float stored =
      std::isfinite(error) ? round_up(std::max(error, 0.0)) : std::numeric_limits<float>::max();
  errors_.push_back(std::max(errors_.back(), stored));
}

Spectrum SpectrumBuilder::finish() {
  const std::vector<std::int64_t> counts = raw_counts(elements_, first_, errors_.size());
  const std::vector<std::uint32_t> kept = kept_steps(counts);
  Spectrum s;
  s.method = method_;
  std::vector<std::uint32_t> order;
  for (std::uint32_t e = 0; e < elements_.size(); ++e) {
    SpectrumElement& element = elements_[e];
    element.birth = kept[element.birth];
    if (element.death != k_none) element.death = kept[element.death];
    if (element.birth < element.death && first_[e] != first_[e + 1]) order.push_back(e);
  }
  const std::size_t states = errors_.size();
  sort_by(order, states, [&](std::uint32_t e) { return elements_[e].birth; });
  sort_by(order, states,
          [&](std::uint32_t e) { return elements_[e].death == k_none ? 0 : states - elements_[e].death; });

  std::vector<std::uint32_t> number(vertices_.size(), k_none), first{0}, stored_counts;
  std::vector<SpectrumVertex> vertices;
  std::vector<SpectrumElement> elements;
  std::vector<std::array<std::uint32_t, 3>> triangles;
  std::vector<float> errors;
  vertices.reserve(vertices_.size()), triangles.reserve(triangles_.size());
  elements.reserve(order.size()), first.reserve(order.size() + 1);
  for (const std::uint32_t e : order) {
    elements.push_back(elements_[e]);
    for (std::uint32_t t = first_[e]; t < first_[e + 1]; ++t) {
      std::array<std::uint32_t, 3> corners = triangles_[t];
      for (std::uint32_t& v : corners) {
        if (number[v] == k_none) {
          number[v] = static_cast<std::uint32_t>(vertices.size());
          vertices.push_back(vertices_[v]);
        }
        v = number[v];
      }
      triangles.push_back(corners);
    }
    first.push_back(static_cast<std::uint32_t>(triangles.size()));
  }
  for (std::size_t n = 0; n < counts.size(); ++n) {
    if (kept[n] == k_none || kept[n] < stored_counts.size()) continue;
    if (n + 1 < counts.size() && kept[n + 1] == kept[n]) continue;  // joined with a later one
    stored_counts.push_back(static_cast<std::uint32_t>(counts[n]));
    errors.push_back(errors_[n]);
  }
  s.vertices = std::move(vertices);
  s.elements = std::move(elements);
  s.first_triangle = std::move(first);
  s.triangles = std::move(triangles);
  s.counts = std::move(stored_counts);
  s.errors = std::move(errors);
  *this = SpectrumBuilder(method_);
  return s;
}

}  // namespace copse
