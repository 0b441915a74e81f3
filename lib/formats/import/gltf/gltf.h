// glTF 2.0, as JSON (.gltf) or in one piece (.glb).
#pragma once

#include "lib/formats/import/companions.h"
#include "lib/formats/import/mesh_builder.h"

#include <cstdint>
#include <span>

namespace copse {

// Reads the default scene. `limit`: how many triangles, and how many vertices, instances may make of it (or
// as many as its file has bytes, if that is more). False: refused, builder.error() says why.
bool read_gltf(std::span<const std::uint8_t> bytes, const Companions& companions, std::uint64_t limit,
               MeshBuilder& builder);

}  // namespace copse
