// Skins: where a mesh that hangs on joints stands when its nodes stand as the file places them.
#pragma once

#include "lib/formats/import/gltf/scene.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace copse {

struct GltfSkin {
  std::vector<Affine> joints;  // from the mesh to the scene; empty: the mesh has no skin

  // The mean of four joints by weight; joints out of range count as none. Identity of joint 0 without weight.
  Affine blend(const double* joint, const double* weight) const;
};

// The skin of a node, empty when it has none. `places` are the nodes' places in the scene.
bool read_skin(GltfDocument& document, std::uint32_t node, std::span<const Affine> places, GltfSkin& out);

}  // namespace copse
