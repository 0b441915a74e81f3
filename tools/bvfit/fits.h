// The volumes of every part: which methods, in which order, and which of them is chosen.
#pragma once

#include "lib/analysis/volumes/aspect_tree.h"
#include "tools/bvfit/input.h"
#include "tools/bvfit/options.h"

#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace copse::bvfit {

struct SetFit {
  std::string name;
  VolumePart part = VolumePart::whole;
  std::uint32_t index = k_none;
  VolumeMotion motion = VolumeMotion::rest;
  float sway = 0;  // of an envelope, degrees
  std::size_t points = 0;
  std::optional<std::size_t> hull_points;  // none: no method needed the hull
  double hull_loss = 0;                    // above 0: they are a kernel's, and points are so far outside it
  double size = 0;                         // the diagonal of its box
  AspectRatios ratios;
  double hull_seconds = 0;
  std::vector<FittedVolume> volumes;
  std::vector<VolumeKind> dropped;  // types of volumes that float32 cannot hold
  std::size_t chosen = 0;
  bool chosen_as_flat = false;          // though another volume is smaller: none has thickness
  std::optional<VolumeKind> not_asked;  // what the aspect tree picks, where no method of it was wanted
};

// What --volumes and --methods name, by kind, the cheapest method first. An error (usage) for unknown names.
Result<std::vector<FitMethod>> wanted_methods(const Options& options);

// What the choice goes by.
struct Choosing {
  Criterion criterion = Criterion::volume;
  TestCosts costs;
  ExpectedCost expected;
  AspectTree aspect;
};
Result<Choosing> choosing(const Options& options);

// Fits all sets, in parallel; the result does not depend on the number of threads. Refused when float32
// cannot hold the coordinates.
Result<std::vector<SetFit>> fit_sets(std::span<const PartSet> sets, const std::vector<FitMethod>& methods,
                                     const Options& options, const Choosing& choosing, Stage& stage);

// The same of sets that are made when their turn comes, by any thread.
Result<std::vector<SetFit>> fit_sets(std::size_t count, const std::function<PartSet(std::size_t)>& make,
                                     const std::vector<FitMethod>& methods, const Options& options,
                                     const Choosing& choosing, Stage& stage);

// One of them.
Result<SetFit> fit_set(const PartSet& set, const std::vector<FitMethod>& methods, const Options& options,
                       const Choosing& choosing);

// With --quality exact: what has not been proven to its gap, in a sentence; empty when all has been. What is
// flat has no gap.
std::string unproven_text(std::span<const SetFit> fits);

// The types of which volumes are missing because float32 cannot hold them, in a sentence; empty when none
// are.
std::string dropped_text(std::span<const SetFit> fits);

// With --choose aspect: of how many sets the tree picks a type that was not asked for, in a sentence; empty
// when of none.
std::string not_asked_text(std::span<const SetFit> fits);

// The index of the volume to test with; of spheres as good as one another the minimal one, which knows what
// holds it.
std::size_t choose_volume(const SetFit& fit, const Choosing& choosing);

}  // namespace copse::bvfit
