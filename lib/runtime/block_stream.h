// The instances of an ecosystem, block by block as frames need them: of a mapped file only the pages of those
// blocks are ever read.
//
// Source: digest 000, sections 3.3 and 3.4 (blocks of a leaf are drawn as one, and each of their instances is
// tested where its block crosses the frustum). A block is checked and unpacked when it is asked for first,
// and kept, up to a budget.
#pragma once

#include "lib/formats/ecosystem/ecosystem.h"
#include "lib/runtime/matrix.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace copse {

// One instance, ready to be drawn: relative to Ecosystem::origin.
struct StreamedInstance {
  std::array<Float4, 3> rows;  // of a 3 x 4 matrix from the tree's frame
  Float3 centre;               // of a sphere that holds its tree, wherever it sways; radius below 0: it has
  float radius = -1;           // nothing to show
  float scale = 1;
  std::uint32_t trunk_material = k_none, leaf_material = k_none, motion = 0;
  std::array<std::uint8_t, 4> tint{255, 255, 255, 255};  // sRGB
};

struct StreamCounts {
  std::uint64_t blocks = 0, instances = 0, bytes = 0;  // read at least once
  std::uint64_t pages = 0;                             // of 4096 bytes that those bytes lie in
  std::uint64_t unpacked = 0;                          // instances; more than read when blocks come back
};

// How far the spheres of instances reach from their feet, as far as a scale of 1 goes: whatever their motion.
double reach_from_foot(const TreeType& type);

class BlockStream {
 public:
  // Keeps a reference. `budget`: bytes of unpacked instances to keep when they are not used any more.
  // O(blocks).
  BlockStream(const Ecosystem& eco, std::size_t budget);

  // What was not asked for since the last call may go, the longest unused first, until the budget is kept.
  void next_frame();

  // The instances of a block, in its order, until next_frame(); none when they are damaged (is_sound_block).
  // O(its instances) when it is not kept, otherwise O(1).
  std::span<const StreamedInstance> block(std::uint32_t index);

  const StreamCounts& counts() const { return counts_; }
  // The first block that turned out to be damaged; k_none: there was none.
  std::uint32_t damaged() const { return damaged_; }
  std::size_t kept_bytes() const { return kept_; }

 private:
  struct Sphere {
    Double3 centre;
    double radius = -1;
  };
  friend double reach_from_foot(const TreeType& type);
  struct Kept {
    std::vector<StreamedInstance> instances;
    std::uint64_t used = 0;  // in this frame; 0: never
  };
  static Sphere sphere_of(const TreeType& type, bool moves);
  StreamedInstance ready(const InstanceBlock& block, std::size_t index) const;
  void count(const InstanceBlock& block);

  const Ecosystem& eco_;
  std::size_t budget_;
  std::vector<std::array<Sphere, 2>> spheres_;  // of a type that stands, that moves
  std::vector<Kept> blocks_;
  std::vector<std::uint32_t> held_;  // blocks that are unpacked
  std::vector<bool> pages_, read_;
  StreamCounts counts_;
  std::size_t kept_ = 0;
  std::uint64_t frame_ = 1;
  std::uint32_t damaged_ = k_none;
};

}  // namespace copse
