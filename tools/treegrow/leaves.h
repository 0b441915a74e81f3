// Leaves: where they sit on a stem, what one is made of, and the surface and truth of all of them.
#pragma once

#include "tools/treegrow/breaks.h"
#include "tools/treegrow/layout.h"
#include "tools/treegrow/skeleton.h"
#include "tools/treegrow/surface.h"
#include "tools/treegrow/truth.h"
#include "tools/treegrow/tubes.h"

#include <array>
#include <cstdint>
#include <vector>

namespace copse::grow {

// A leaf in its own frame: x across, y from the stalk to the tip, z out of its upper side; the stalk is at
// the origin, the tip at (0, 1, 0). Vertex 0 is where it is held.
struct LeafShape {
  struct Vertex {
    Double3 position, normal;
    Float2 uv;
  };
  std::vector<Vertex> vertices;
  std::vector<std::vector<std::uint32_t>> faces;  // 3 or 4 corners each
  std::uint32_t components = 1;
  bool solid = false;  // has an inside; is drawn without a texture
};

LeafShape leaf_shape(const Breaks& breaks);

// Adds the leaves of all stems, in the order of the stems.
void build_leaves(const Species& species, const Skeleton& skeleton, const Layout& layout,
                  const Breaks& breaks, const Tubes& tubes, Surface& surface, Truth& truth);

}  // namespace copse::grow
