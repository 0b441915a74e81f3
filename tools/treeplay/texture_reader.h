// Images, read when something that has them is first drawn: many at once, by all threads.
#pragma once

#include "lib/runtime/mip_chain.h"
#include "tools/treeplay/scene.h"

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace copse::treeplay {

struct WantedTexture {
  std::uint32_t texture = 0;  // of Scene::textures
  float cutoff = 0;           // of its material's alpha
  friend auto operator<=>(const WantedTexture&, const WantedTexture&) = default;
};

// The mip levels of each; none of one that cannot be read, which is warned about in the order of `wanted`.
std::vector<std::optional<std::vector<MipLevel>>> read_textures(const Scene& scene,
                                                                std::span<const WantedTexture> wanted);

struct ImpostorImages {
  Image albedo, normals;
};

// Refused: the first one with a picture that cannot be read.
Result<std::vector<ImpostorImages>> read_impostors(std::span<const TreeImpostor* const> wanted);

}  // namespace copse::treeplay
