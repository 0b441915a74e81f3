#include "lib/analysis/lod/step_order.h"

#include "lib/analysis/lod/spectrum_builder.h"

#include <algorithm>
#include <numeric>
#include <utility>

#include <tbb/parallel_for.h>

namespace copse {
namespace {

// Elements by a step of theirs from 1 to `steps`; those without one are in no list.
template <class Key>
void sort_by_step(const Spectrum& s, Key key, std::vector<std::uint32_t>& first,
                  std::vector<std::uint32_t>& list) {
  const std::uint32_t steps = s.steps();
  const auto listed = [&](std::uint32_t step) { return step >= 1 && step <= steps; };
  first.assign(std::size_t{steps} + 2, 0);
  for (const SpectrumElement& e : s.elements)
    if (listed(key(e))) ++first[key(e) + 1];
  std::partial_sum(first.begin(), first.end(), first.begin());
  list.resize(first.back());
  std::vector<std::uint32_t> at(first);
  for (std::uint32_t e = 0; e < s.elements.size(); ++e)
    if (const std::uint32_t step = key(s.elements[e]); listed(step)) list[at[step]++] = e;
}

}  // namespace

StepOrder::StepOrder(const Spectrum& spectrum, MustGo must_go)
    : spectrum_(spectrum), must_go_(std::move(must_go)) {
  sort_by_step(
      spectrum, [](const SpectrumElement& e) { return e.death; }, first_killed_, killed_);
  sort_by_step(
      spectrum, [](const SpectrumElement& e) { return e.birth; }, first_born_, born_);
}

std::span<const std::uint32_t> StepOrder::killed(std::uint32_t step) const {
  return std::span(killed_).subspan(first_killed_[step], first_killed_[step + 1] - first_killed_[step]);
}

std::span<const std::uint32_t> StepOrder::born(std::uint32_t step) const {
  return std::span(born_).subspan(first_born_[step], first_born_[step + 1] - first_born_[step]);
}

std::uint32_t StepOrder::width(std::uint32_t element) const {
  return spectrum_.first_triangle[element + 1] - spectrum_.first_triangle[element];
}

StepOrder::State StepOrder::full_detail() const {
  State state;
  state.taken.assign(std::size_t{spectrum_.steps()} + 1, 0);
  state.drawn.resize(spectrum_.elements.size());
  for (std::uint32_t e = 0; e < state.drawn.size(); ++e) {
    state.drawn[e] = spectrum_.elements[e].birth == 0;
    if (state.drawn[e]) state.triangles += width(e);
  }
  return state;
}

void StepOrder::apply(State& state, std::uint32_t step) const {
  state.taken[step] = 1;
  for (const std::uint32_t e : killed(step)) state.drawn[e] = 0, state.triangles -= width(e);
  for (const std::uint32_t e : born(step)) state.drawn[e] = 1, state.triangles += width(e);
}

void StepOrder::undo(State& state, const Batch& batch) const {
  for (auto step = batch.rbegin(); step != batch.rend(); ++step) {
    state.taken[*step] = 0;
    for (const std::uint32_t e : born(*step)) state.drawn[e] = 0, state.triangles -= width(e);
    for (const std::uint32_t e : killed(*step)) state.drawn[e] = 1, state.triangles += width(e);
  }
}

// One step with all that it needs before it, and with what must go of all that they make, into `batch`. Or
// nothing at all: when there would be fewer than `least` triangles, or when what must go never goes.
bool StepOrder::take(State& state, std::uint32_t step, std::uint32_t other, std::uint64_t least,
                     Batch& batch) const {
  const std::size_t before = batch.size();
  std::vector<std::uint32_t> open{step}, later;
  const auto give_up = [&] {
    undo(state, Batch(batch.begin() + static_cast<std::ptrdiff_t>(before), batch.end()));
    batch.resize(before);
    return false;
  };
  while (!open.empty() || !later.empty()) {
    if (open.empty()) open.push_back(later.back()), later.pop_back();
    const std::uint32_t now = open.back();
    if (state.taken[now]) {
      open.pop_back();
      continue;
    }
    const std::size_t waiting = open.size();
    for (const std::uint32_t e : killed(now)) {
      const std::uint32_t maker = spectrum_.elements[e].birth;
      if (maker > 0 && !state.taken[maker]) open.push_back(maker);
    }
    if (open.size() > waiting) continue;
    open.pop_back();
    apply(state, now);
    batch.push_back(now);
    if (batch.size() > before + 1 && state.triangles < least) return give_up();
    for (const std::uint32_t e : born(now)) {
      if (!must_go_ || !must_go_(e, other)) continue;
      if (spectrum_.elements[e].death == k_none) return give_up();
      later.push_back(spectrum_.elements[e].death);
    }
  }
  return true;
}

bool StepOrder::take_forced(State& state, std::uint32_t other, std::vector<Batch>& batches) const {
  if (!must_go_) return true;
  // What a batch makes beside has been asked about when it was taken.
  std::vector<std::uint8_t> goes(state.drawn.size(), 0);
  tbb::parallel_for(std::size_t{0}, goes.size(), [&](std::size_t e) {
    goes[e] = state.drawn[e] && must_go_(static_cast<std::uint32_t>(e), other);
  });
  for (std::uint32_t e = 0; e < state.drawn.size(); ++e) {
    if (!goes[e] || !state.drawn[e]) continue;
    Batch batch;
    if (spectrum_.elements[e].death == k_none || !take(state, spectrum_.elements[e].death, other, 0, batch))
      return false;
    batches.push_back(std::move(batch));
  }
  return true;
}

void StepOrder::take_until(State& state, std::uint32_t other, std::uint64_t triangles,
                           std::vector<Batch>& batches) const {
  const std::uint32_t steps = spectrum_.steps();
  // First nothing that would take much along, then whatever there is.
  const std::uint64_t slack = std::clamp<std::uint64_t>(triangles / 32, 8, 256);
  for (const std::uint64_t least : {triangles > slack ? triangles - slack : 0, std::uint64_t{0}}) {
    while (state.first_left <= steps && state.taken[state.first_left]) ++state.first_left;
    for (std::uint32_t step = state.first_left; step <= steps && state.triangles > triangles; ++step) {
      if (state.taken[step]) continue;
      Batch batch;
      if (take(state, step, other, least, batch)) batches.push_back(std::move(batch));
    }
  }
  while (state.first_left <= steps && state.taken[state.first_left]) ++state.first_left;
}

Spectrum StepOrder::reordered(std::span<const Batch> batches) const {
  const std::uint32_t steps = spectrum_.steps();
  std::vector<std::uint32_t> number(std::size_t{steps} + 1, 0);
  std::vector<double> errors;
  for (const Batch& batch : batches) {
    errors.push_back(0);
    for (const std::uint32_t step : batch) {
      number[step] = static_cast<std::uint32_t>(errors.size());
      errors.back() = std::max<double>(errors.back(), spectrum_.errors[step]);
    }
  }
  for (std::uint32_t step = 1; step <= steps; ++step) {
    if (number[step] != 0) continue;
    errors.push_back(spectrum_.errors[step]);
    number[step] = static_cast<std::uint32_t>(errors.size());
  }
  SpectrumBuilder builder(spectrum_.method);
  for (const SpectrumVertex& v : spectrum_.vertices) builder.vertex(v);
  for (const double error : errors) builder.step(error);
  for (std::uint32_t e = 0; e < spectrum_.elements.size(); ++e) {
    SpectrumElement element = spectrum_.elements[e];
    element.birth = number[element.birth];
    if (element.death != k_none) element.death = number[element.death];
    const std::uint32_t first = spectrum_.first_triangle[e];
    builder.element(element, std::span(spectrum_.triangles).subspan(first, width(e)));
  }
  return builder.finish();
}

}  // namespace copse
