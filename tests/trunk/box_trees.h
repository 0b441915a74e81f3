// Trees as people model them: faces of a tube are pulled out, and faces of what was pulled out.
#pragma once

#include "lib/analysis/surface/trunk_mesh.h"
#include "tests/trunk/exactness.h"

#include <cstdint>

namespace copse {

struct BoxTree {
  std::uint32_t sides = 8;  // of the trunk; limbs have four
  std::uint32_t rings = 8;  // of the trunk; those of limbs are drawn
  int depth = 2;            // limbs, twigs of limbs, ...
  double share = 0.12;      // of the faces that are pulled out: several of one band, also side by side
  bool open = false;        // ends are open; else closed by one polygon, cut up anyhow
  bool inset = false;       // faces are inset before they are pulled out
  double slant = 0.5;       // how far limbs lean up, against straight out
  std::uint32_t seed = 1;
};

struct BoxTreeMesh {
  TrunkMesh mesh;  // quads are cut along random diagonals
  TrueHierarchy truth;
};

BoxTreeMesh box_tree(const BoxTree& shape);

}  // namespace copse
