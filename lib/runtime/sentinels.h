// Which volumes of a hierarchy cannot be trusted because something below has left the pose that they were
// fitted to.
//
// A node's volume is fitted to a preferred pose of the moving parts below it (a gun that points ahead). When
// a part leaves its pose, every node above it is stale, not only the nearest: it is then skipped, and what is
// below decides (or the envelope of the motion, where one is stored). When the part comes back, the nodes are
// as good as before.
//
// Source: digest 002, section 3.6 (preferred position and sentinel, with the addition).
#pragma once

#include "lib/formats/tree_file/tree_volumes.h"

#include <cstdint>
#include <span>
#include <vector>

namespace copse {

class Sentinels {
 public:
  // `nodes` are sound (check_volumes). O(nodes).
  explicit Sentinels(std::span<const VolumeNode> nodes);

  // The part of this bottom node leaves its pose, or is back in it. Telling the same twice changes nothing.
  // O(depth), no allocation.
  void leave(std::uint32_t bottom_node) { set(bottom_node, true); }
  void come_back(std::uint32_t bottom_node) { set(bottom_node, false); }

  // Whether a part below the node, or the node's own, is out of its pose. The bottom node's own volume moves
  // along with its part and stays good.
  bool is_stale(std::uint32_t node) const { return away_[node] > 0; }

 private:
  void set(std::uint32_t bottom_node, bool away);
  std::vector<std::uint32_t> parent_;  // k_none of the root
  std::vector<std::uint32_t> away_;    // how many parts below are out of their pose
};

}  // namespace copse
