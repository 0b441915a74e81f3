#include "lib/analysis/trunk/fit.h"

#include "lib/analysis/rings/fork_rings.h"
#include "tests/trunk/welded_meshes.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

Surface pipe() {
  const Double3 axis[] = {{0, 0, 0}, {0, 2, 0}, {0, 4, 0}};
  const double radii[] = {1, 0.8, 0.5};
  return surface_of(tube(axis, radii, 8, false));
}

TEST(Fit, OfRegularRingsIsPerfect) {
  const Surface s = pipe();
  const Fit fit = fit_of(s, read_fork_rings(s).hierarchy);
  EXPECT_NEAR(fit.distance, 0, 1e-12);
  EXPECT_EQ(fit.explained, 1);
  EXPECT_NEAR(fit.cost(), 0, 1e-12);
}

TEST(Fit, SuffersFromWrongRadiiAndFromWhatIsUnexplained) {
  const Surface s = pipe();
  Hierarchy thick = read_fork_rings(s).hierarchy;
  for (RadiusNode& r : thick.radii) r.diameter *= 1.5;
  EXPECT_GT(fit_of(s, thick).distance, 0.05);
  Hierarchy half = read_fork_rings(s).hierarchy;
  for (std::size_t t = 0; t < half.segment_of.size() / 2; ++t) half.segment_of[t] = k_none;
  EXPECT_LT(fit_of(s, half).explained, 0.7);
  EXPECT_GT(fit_of(s, half).cost(), 0.03);
}

}  // namespace
}  // namespace copse
