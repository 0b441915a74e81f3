#include "lib/runtime/sentinels.h"

namespace copse {

Sentinels::Sentinels(std::span<const VolumeNode> nodes)
    : parent_(nodes.size(), k_none), away_(nodes.size(), 0) {
  for (std::uint32_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].item != k_none) continue;
    for (std::uint32_t c = i + 1; c < nodes[i].skip; c = nodes[c].skip) parent_[c] = i;
  }
}

void Sentinels::set(std::uint32_t bottom_node, bool away) {
  if ((away_[bottom_node] > 0) == away) return;
  for (std::uint32_t n = bottom_node; n != k_none; n = parent_[n]) {
    if (away) {
      ++away_[n];
    } else {
      --away_[n];
    }
  }
}

}  // namespace copse
