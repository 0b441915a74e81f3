// What treeplay draws of an .eco: its terrain and the instances of all its trees as one scene.
#pragma once

#include "tools/treeplay/scene.h"

namespace copse::treeplay {

// Reads the ecosystem and the trees that it names or holds, with `levels` their levels of detail as well.
// Precondition: an .eco file.
Result<void> take_ecosystem(Scene& scene, const std::filesystem::path& path, bool levels, Context& context);

}  // namespace copse::treeplay
