// The light of the sky in a whole forest: of a cloud with as much leaf in each place, not of every leaf.
#pragma once

#include "tools/treeplay/scene.h"

namespace copse::treeplay {

// Of a small forest every tree takes part as it stands; of a large one as much of its type anywhere in its
// block, so that no instance is read. Precondition: an ecosystem. O(types' triangles + blocks + cells).
SkyLight forest_sky(const Scene& scene);

}  // namespace copse::treeplay
