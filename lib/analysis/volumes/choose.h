// choose: which of several volumes round the same things to test with.
//
// Source: digest 002, sections 5.9 (costs, T5.4 with the errata) and 6 (smallest volume, volume times cost);
// the expected cost after Cauchy: a random ray meets a convex body in proportion to its surface, a random
// plane cuts it in proportion to its mean width.
#pragma once

#include "lib/analysis/volumes/volume_measures.h"
#include "lib/formats/volumes/volume_numbers.h"

#include <array>
#include <span>

namespace copse {

enum class Criterion {
  volume,    // the least interior volume
  weighted,  // the least product of volume and cost
  aspect,    // by the ratios of the box alone (aspect_tree.h)
  expected,  // the least cost of the test and of what it lets through needlessly
};

struct Candidate {
  VolumeKind kind = VolumeKind::aabb;
  VolumeMeasures measures;
  std::size_t slabs = 0;  // of a k-DOP: k / 2
};

// What it costs to move a volume along and to test it against a frustum, relative to a sphere.
struct TestCosts {
  std::array<double, k_volume_kinds> relative;
  double per_slab = 0;  // of a k-DOP, added to its relative cost
  double of(const Candidate& c) const {
    return relative[static_cast<std::size_t>(c.kind)] + per_slab * static_cast<double>(c.slabs);
  }
};

// T5.4: one transform and 3.5 plane tests, in additions, multiplications, divisions and roots. The cylinder
// with its 11 multiplications (3.159, printed 2.949); ellipsoids by three semi-axis vectors; boxes along the
// axes and k-DOPs, which the table lacks, by the same count.
TestCosts table_costs();

struct ExpectedCost {
  double content = 50;  // what a needless hit costs, in tests of a sphere
  double rays = 0.5;    // share of the tests that are rays; the others are planes of a frustum
};

// Whether a volume round something of this size (its diagonal) has no thickness but what rounding gave it.
bool is_flat(const VolumeMeasures& measures, double size);

// The index of the choice among at least one candidate; `size` is the diagonal of what they enclose. Volumes
// within a millionth of one another are the same, and so are flat ones: then the cheaper test wins, and then
// the first. Criterion::aspect chooses as `volume` here.
std::size_t choose(std::span<const Candidate> candidates, Criterion criterion, const TestCosts& costs,
                   const ExpectedCost& expected, double size);

}  // namespace copse
