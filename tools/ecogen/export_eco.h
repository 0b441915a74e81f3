// An ecosystem for other programs: GLB with EXT_mesh_gpu_instancing, a map from above as PNG, OBJ, CSV.
#pragma once

#include "lib/formats/ecosystem/ecosystem.h"
#include "lib/formats/export/instancing.h"
#include "lib/formats/result.h"
#include "tools/common/tool.h"
#include "tools/ecogen/map_picture.h"

#include <filesystem>
#include <string>

namespace copse::ecogen {

inline constexpr std::uint64_t k_most_obj_triangles = 5'000'000;

// The extension picks the format; a usage error when it is none of .glb, .obj, .png, .csv. `trees` says where
// the trees of types by reference are: relative to it; `form` is that of a .glb, `map` that of `eco`.
Result<void> check_export(const std::filesystem::path& file);
Result<void> export_ecosystem(const Ecosystem& eco, const std::filesystem::path& trees,
                              const std::filesystem::path& file, Instancing form, ForestMap& map,
                              Context& context);

}  // namespace copse::ecogen
