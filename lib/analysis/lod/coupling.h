// The triangles of a level divided between trunk and leaves so that the picture is best and nothing floats.
#pragma once

#include "lib/formats/spectrum.h"

#include <cstdint>
#include <functional>

namespace copse {

struct CouplingOptions {
  double knot_ratio = 0.75;         // of the triangles of the knot before
  std::uint64_t min_triangles = 0;  // no knot below
};

// What a level looks like, smaller is better; and how many of its leaves float.
using LevelError = std::function<double(const LodLevel&)>;
using LevelFloats = std::function<std::uint64_t(const LodLevel&)>;

// The schedule of `spectra`: the first knot is full detail; each next one has at most knot_ratio of the
// triangles, taken from trunk and leaves so that `error` is least among the divisions that are tried (the
// trunk gives up nothing, or some of what it has in several portions, the leaves give up nothing, both keep
// the same share) and nothing floats. The last knot is the coarsest state of both, or the last one with
// min_triangles or more. Without `error` both parts keep the same share as long as nothing floats; where
// every division makes leaves float the leaves alone give. Deterministic. Calls `error` some 8 times a knot;
// knots: log(triangles) / log(1 / knot_ratio).
std::vector<LodLevel> couple(const LodSpectra& spectra, const LevelError& error, const LevelFloats& floats,
                             const CouplingOptions& options = {});

// A level from its steps: triangles and error filled in.
LodLevel level_at(const LodSpectra& spectra, std::uint32_t trunk_steps, std::uint32_t leaf_steps);
// The first step with at most so many triangles; the last step when none has.
std::uint32_t step_with(const Spectrum& spectrum, std::uint64_t triangles);

}  // namespace copse
