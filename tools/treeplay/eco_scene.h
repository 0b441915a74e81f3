// What treeplay draws of an .eco: its terrain and the instances of all its trees as one scene.
#pragma once

#include "tools/treeplay/scene.h"

namespace copse::treeplay {

// Reads the ecosystem and the trees that it names or holds, if so wanted with their levels of detail.
// Precondition: an .eco file.
Result<void> take_ecosystem(Scene& scene, const std::filesystem::path& path, const Wanted& wanted,
                            Context& context);

}  // namespace copse::treeplay
