// From which distance on each discrete level is drawn: where that was named, and the others so that none is
// in the way of what was.
#pragma once

#include "lib/formats/result.h"
#include "tools/lodbake/options.h"

#include <cstddef>
#include <optional>
#include <vector>

namespace copse::lodbake {

// How many discrete levels are asked for; two when none are named.
std::size_t level_count(const Options& options);

struct NamedDistances {
  // Where full detail stops being promised, when that is no level's border: there is one more distance than
  // levels. The near model of 003's three is full detail.
  std::optional<double> near;
  std::vector<std::optional<double>> levels;  // of each where it begins
};
NamedDistances named_distances(const Options& options);

// Whether what is named leaves every level a place beyond both bands of the hysteresis (digest 003, H-10).
// All that can contradict is known before anything is baked.
Result<void> check_distances(const Options& options);

// `natural`: positive, ascending, where the levels would begin by themselves; one for each of
// named_distances(). What is not named stays there as far as it can. What lies beyond a named distance that
// is farther than the natural one (before one that is nearer) keeps its proportion to it; between two named
// ones the natural distances are stretched, in their logarithms, to reach from one to the other.
std::vector<double> follow_named(const std::vector<double>& natural, const NamedDistances& named);
// Moves those that are not named so that no bands meet.
void keep_apart(std::vector<double>& distances, const NamedDistances& named, double hysteresis);

}  // namespace copse::lodbake
