// step_order: the steps of a spectrum in another order than the one in which they were found.
//
// What a step takes away must be there, so it needs the steps that made it, and no others: a spectrum of
// leaves is a forest of collapses, of which any order will do that has children before parents.
#pragma once

#include "lib/formats/levels/spectrum.h"

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace copse {

class StepOrder {
 public:
  // Steps that are taken as one: what one of them makes and another takes away is never drawn.
  using Batch = std::vector<std::uint32_t>;

  // Whether an element must not be drawn after so many of the other part's steps; then after no more of them
  // either. Called in parallel, but for each element by one thread.
  using MustGo = std::function<bool(std::uint32_t element, std::uint32_t other)>;
  // Keeps a reference to `spectrum`. Without `must_go` all may be drawn.
  StepOrder(const Spectrum& spectrum, MustGo must_go);

  // What is drawn: which steps have been taken.
  struct State {
    std::vector<std::uint8_t> taken;  // of every step, 1 and up; 0 is full detail
    std::vector<std::uint8_t> drawn;  // of every element
    std::uint64_t triangles = 0;
    std::uint32_t first_left = 1;  // all steps before have been taken
  };
  State full_detail() const;

  // Takes the steps that take away all that must not be drawn after `other` steps of the other part, each
  // with what it needs. False, with `state` in disorder, when something must go that no step takes.
  bool take_forced(State& state, std::uint32_t other, std::vector<Batch>& batches) const;
  // Takes steps in their own order until there are at most so many triangles or none is left. After
  // take_forced nothing that is drawn in between must not be; a step whose results must not be drawn waits as
  // long as what would have to go with it takes the triangles far below.
  void take_until(State& state, std::uint32_t other, std::uint64_t triangles,
                  std::vector<Batch>& batches) const;

  // The spectrum with one step a batch, and what is left in its own order behind them. Errors are those of
  // the worst step taken so far.
  Spectrum reordered(std::span<const Batch> batches) const;

 private:
  bool take(State& state, std::uint32_t step, std::uint32_t other, std::uint64_t least, Batch& batch) const;
  void apply(State& state, std::uint32_t step) const;
  void undo(State& state, const Batch& batch) const;
  std::span<const std::uint32_t> killed(std::uint32_t step) const;
  std::span<const std::uint32_t> born(std::uint32_t step) const;
  std::uint32_t width(std::uint32_t element) const;

  const Spectrum& spectrum_;
  MustGo must_go_;
  std::vector<std::uint32_t> first_killed_, killed_, first_born_, born_;  // elements, step after step
};

}  // namespace copse
