// limb_samples: circles along a limb, measured on the surface.
#pragma once

#include "lib/analysis/skeleton/curve_skeleton.h"
#include "lib/analysis/skeleton/section.h"
#include "lib/analysis/skeleton/skeleton_limbs.h"
#include "lib/analysis/surface/surface.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

struct LimbSample {
  RingCircle circle;
  double way = 0;          // along the limb's nodes from its base
  std::uint32_t node = 0;  // the index in Limb::nodes that it is nearest to
  bool fork = false;       // another limb starts here
  bool measured = false;   // the circle is a section's
};

// The way along a limb to each of its nodes, and the limb's thickness there: the skeleton's rough radii,
// where no neighbour implies a larger one (slices at ends and forks are torn).
struct LimbProfile {
  std::vector<double> way, thickness;
};
LimbProfile limb_profile(const CurveSkeleton& skeleton, const Limb& limb);

// Where another limb starts: the index in Limb::nodes of the place that it grows from, and the stretch of the
// limb on which a section cuts the other one too.
struct LimbFork {
  std::uint32_t node = 0;
  double from = 0, to = 0;
};

// Circles from the limb's base (the first limb) or from where it leaves its parent's surface, `clearance`
// from the base, to its tip. `forks` by ascending node: each gets a sample, those that are nearer to one
// another than half a radius share one. `vertices_of`: the surface's vertices by skeleton node.
class LimbSampler {
 public:
  LimbSampler(const Surface& surface, const CurveSkeleton& skeleton, const Lists& vertices_of)
      : s_(surface), k_(skeleton), vertices_of_(vertices_of), sections_(surface) {}

  std::vector<LimbSample> sample(const Limb& limb, const LimbProfile& profile,
                                 std::span<const LimbFork> forks, double clearance);

 private:
  std::vector<LimbSample> spread(const Limb& limb, const LimbProfile& profile,
                                 std::span<const LimbFork> forks, double clearance) const;
  Double3 point_at(const Limb& limb, const LimbProfile& profile, double way, std::uint32_t& node) const;
  void recentre(const Limb& limb, const LimbProfile& profile, std::vector<LimbSample>& samples);
  bool measure(const Limb& limb, LimbSample& sample, const Double3& normal, double thickness);
  bool end_at_border(const Limb& limb, const LimbProfile& profile, const Double3& out, LimbSample& end,
                     bool tip);
  void finish_end(const Limb& limb, const LimbProfile& profile, std::vector<LimbSample>& samples, bool tip);

  const Surface& s_;
  const CurveSkeleton& k_;
  const Lists& vertices_of_;
  Sections sections_;
  std::vector<std::uint32_t> seeds_;
};

// Replaces what was not measured, and what lies on the stretch of a fork, by what the others imply.
void bridge_gaps(std::span<LimbSample> samples, std::span<const LimbFork> forks);

// Leaves out the samples that the remaining ones imply: centre and radius between two kept ones are within
// k_sample_tolerance of a radius of the straight line, and those are no farther apart than k_sample_gap
// radii. Ends and forks stay.
std::vector<LimbSample> thin_out(const std::vector<LimbSample>& samples);

}  // namespace copse
