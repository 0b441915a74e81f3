#include "lib/analysis/lod/edge_spectrum.h"

#include "lib/formats/levels/level_mesh.h"
#include "tests/lod/edge_shapes.h"

#include <gtest/gtest.h>

namespace copse {
namespace {

TEST(EdgeSpectrum, IsTheStatesOneByOne) {
  const PartTriangles mesh = torus(12, 8, true);
  const EdgeCollapses c = collapse_edges(mesh, {.max_error = 1});
  const Spectrum s = edge_spectrum(mesh, c, {});
  ASSERT_EQ(s.steps(), c.size());
  for (std::uint32_t n = 0; n <= s.steps(); n += 5) {
    EXPECT_EQ(s.counts[n], collapsed_state(mesh, c, n).triangles.size());
    Mesh state;
    append_state(state, s, n, "torus");
    EXPECT_EQ(state.triangles.size(), s.counts[n]);
  }
}

}  // namespace
}  // namespace copse
