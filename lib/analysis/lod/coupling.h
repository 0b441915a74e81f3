// The triangles of a level divided between trunk and leaves so that the *picture* is best and nothing floats.
#pragma once

#include "lib/formats/levels/spectrum.h"

#include <cstdint>
#include <functional>
#include <span>

namespace copse {

struct CouplingOptions {
  double knot_ratio = 0.75;         // of the triangles of the knot before
  std::uint64_t min_triangles = 0;  // no knot below
  // Whether an element of the leaves would float after so many of the trunk's steps or fewer
  // (FloatingLeaves::floats_by; StepOrder says how it is called). Without it nothing ever does.
  std::function<bool(std::uint32_t element, std::uint32_t trunk_steps)> floats_by{};
};

// A level that is tried: the leaves need not be those of any step.
struct TriedLevel {
  std::uint32_t trunk_steps = 0;
  std::span<const std::uint8_t> leaves;  // of every element of the leaves' spectrum whether it is drawn
  std::uint64_t triangles = 0;           // of both parts
};
// What it looks like, smaller is better.
using LevelError = std::function<double(const TriedLevel&)>;

// Makes the schedule of `spectra`: the first knot is full detail; each next one has at most knot_ratio of the
// triangles, taken from trunk and leaves so that `error` is least among the divisions that are tried (the
// trunk gives up nothing, or some of what it has in several portions, the leaves give up nothing, both keep
// the same share), but the leaves do not fall under half of their even share as long as any division that
// holds more gets anywhere, if not as far.
// Without `error` both parts keep the same share. Where leaves would float, they are collapsed into ones that
// do not, before the trunk goes on: for that the steps of spectra.leaves are put into another order
// (step_order), and a knot lies in between, so that nothing floats at any level between two knots either.
// Leaves that nothing can take away stop the trunk. The last knot is the coarsest that can be had so, or the
// last one with min_triangles or more. Deterministic. Calls `error` some 8 times a knot; knots: twice
// log(triangles) / log(1 / knot_ratio) at most.
void couple(LodSpectra& spectra, const LevelError& error, const CouplingOptions& options = {});

// A level from its steps: triangles and error filled in.
LodLevel level_at(const LodSpectra& spectra, std::uint32_t trunk_steps, std::uint32_t leaf_steps);
// The first step with at most so many triangles; the last step when none has.
std::uint32_t step_with(const Spectrum& spectrum, std::uint64_t triangles);

}  // namespace copse
