// aspect_tree: the kind of volume by the proportions of the oriented box alone, so that only the volume that
// is chosen need be fitted.
//
// Source: digest 002, section 6 (the dissertation's section 6.3): with sorted extents L >= M >= S, ratio2 =
// L / M, ratio3 = M / S, ratio1 = ratio2 / ratio3; a binary tree of at most three comparisons, whose
// thresholds are the user's or tuned. Its own thresholds are lost with its figure; `seed` is what the digest
// proposes to begin with. The default tree is tuned (docs/volumes.md has its figures), and `bvfit --tune`
// finds the one that agrees best with the smallest volumes of given parts.
#pragma once

#include "lib/formats/result.h"
#include "lib/formats/volumes/volume_numbers.h"

#include <array>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace copse {

struct AspectRatios {
  std::array<double, 3> ratio{1, 1, 1};  // ratio1, ratio2, ratio3
};

// Of a box with these extents. What is thinner than a millionth of the longest counts as that; a point has
// ratios of 1.
AspectRatios aspect_ratios(const Double3& extents);

struct AspectNode {
  int ratio = 0;  // 1 to 3: compared with `threshold`; 0: this is a leaf
  double threshold = 0;
  VolumeKind kind = VolumeKind::obb;  // of a leaf
};

class AspectTree {
 public:
  static constexpr int k_levels = 3;

  AspectTree();              // the default
  static AspectTree seed();  // rods get capsules, plates lozenges, what is compact spheres

  VolumeKind choose(const AspectRatios& ratios) const;
  std::vector<VolumeKind> kinds() const;  // that it may choose

  // "ratio1>2?capsule:(ratio3>2.5?lozenge:obb)": text and back; "default" and "seed" are read too. An error
  // (usage) names the place.
  std::string text() const;
  static Result<AspectTree> parse(std::string_view text);

  // Node i's children are 2 i + 1 (the ratio is above the threshold) and 2 i + 2.
  std::array<AspectNode, 15> nodes;
};

// One thing whose volumes of several kinds are known.
struct AspectSample {
  AspectRatios ratios;
  std::array<double, k_volume_kinds> volume;  // infinite where a kind is not wanted
};

// The tree whose choices have the least volume, compared with the smallest volume of each sample (the mean of
// the logarithm of their ratio), greedily level by level. At least one sample. O(n log n).
AspectTree tune_aspect_tree(std::span<const AspectSample> samples);

struct AspectAgreement {
  double agree = 0;   // share of the samples for which the choice is the smallest volume (within 1e-6)
  double excess = 0;  // geometric mean of the chosen volume over the smallest, minus 1
};
AspectAgreement agreement(const AspectTree& tree, std::span<const AspectSample> samples);

}  // namespace copse
