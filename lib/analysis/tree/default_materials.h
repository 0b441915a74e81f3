// Wood is brown and leaves are green where the mesh does not say how they look.
#pragma once

#include "lib/formats/tree/tree.h"

#include <cstdint>
#include <span>

namespace copse {

// Triangles and leaves without a material get one ("wood", "leaf"; appended only when something needs it).
// The colour of `undefined` materials (indices into tree.materials: named by the mesh, but defined nowhere)
// becomes wood's or leaves', whichever has more triangles of it, wood when as many; those that nothing uses
// stay. So every tool draws such a tree alike. Linear in the triangles and leaves that have materials of
// their own.
void give_default_materials(std::span<const std::uint32_t> undefined, Tree& tree);

}  // namespace copse
