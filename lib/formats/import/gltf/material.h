// glTF materials as Blinn-Phong materials. The formulas are in docs/import.md, section "Materials".
#pragma once

#include "lib/formats/import/gltf/document.h"

#include <array>
#include <cstdint>
#include <map>
#include <vector>

namespace copse {

// How a material's texture looks texture coordinates up: u' = m u + t in glTF's frame (v down).
struct UvTransform {
  std::uint32_t set = 0;                      // TEXCOORD_n
  std::array<double, 6> m{1, 0, 0, 0, 1, 0};  // two rows of three
  friend auto operator<=>(const UvTransform&, const UvTransform&) = default;
};

struct GltfMaterials {
  std::vector<UvTransform> uv;  // one a material of the mesh
};

// Converts all materials into builder.mesh.materials, in the file's order, and the images that they use into
// its textures. False: refused.
bool read_materials(GltfDocument& document, GltfMaterials& out);

}  // namespace copse
