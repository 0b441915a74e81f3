#include "lib/runtime/block_stream.h"

#include "lib/formats/ecosystem/instance_codec.h"
#include "tests/formats/ecosystem_maker.h"

#include <cstring>
#include <memory>

#include <gtest/gtest.h>
#include <sys/mman.h>

namespace copse {
namespace {

TEST(BlockStream, GivesEveryInstanceAsItIsStored) {
  for (const bool exact : {false, true}) {
    const Ecosystem eco = little_ecosystem(exact);
    BlockStream stream(eco, 1 << 20);
    std::size_t seen = 0;
    for (std::uint32_t b = 0; b < eco.blocks.size(); ++b) {
      const auto instances = stream.block(b);
      ASSERT_EQ(instances.size(), eco.blocks[b].count);
      for (std::size_t k = 0; k < instances.size(); ++k, ++seen) {
        const Instance i = instance_of(eco, eco.blocks[b], eco.blocks[b].first + k);
        const Double3 p{0.3, 0.7, -0.2};
        const Double3 meant = i.position - eco.origin + rotate(i.rotation, p * i.scale);
        for (std::size_t r = 0; r < 3; ++r) {
          const Float4& row = instances[k].rows[r];
          EXPECT_NEAR(double{row.x} * p.x + double{row.y} * p.y + double{row.z} * p.z + double{row.w},
                      meant[static_cast<int>(r)], 1e-5);
        }
        EXPECT_EQ(instances[k].trunk_material, i.trunk_material);
        EXPECT_EQ(instances[k].motion, i.motion);
        EXPECT_EQ(instances[k].tint[2], i.tint[2]);
      }
    }
    EXPECT_EQ(seen, eco.instance_count());
    EXPECT_EQ(stream.counts().instances, seen);
    EXPECT_EQ(stream.damaged(), k_none);
  }
}

// Points of the tree's box, or of a bounding sphere of the type that is smaller than the one round its box.
TEST(BlockStream, TheSphereHoldsTheTree) {
  Ecosystem eco = little_ecosystem(true);
  const BoundingSphere<float> ball{{0.25f, 1.5f, 0}, 1.25f};
  for (const bool round : {false, true}) {
    if (round) eco.types[0].volumes = {ball};
    BlockStream stream(eco, 0);
    for (std::uint32_t k = 0; k < eco.blocks.size(); ++k) {
      const InstanceBlock& block = eco.blocks[k];
      const FloatBox& box = eco.types[block.type].bounds;
      const auto instances = stream.block(k);
      for (std::size_t i = 0; i < instances.size(); ++i) {
        const Instance meant = instance_of(eco, block, block.first + i);
        if (round && block.type == 0) {
          EXPECT_LT(double{instances[i].radius}, 1.26 * meant.scale);
        }
        for (int c = 0; c < 8; ++c) {
          Double3 p{double{c & 1 ? box.max.x : box.min.x}, double{c & 2 ? box.max.y : box.min.y},
                    double{c & 4 ? box.max.z : box.min.z}};
          if (round && block.type == 0)
            p = to_double(ball.centre) + normalized(p - to_double(ball.centre)) * double{ball.radius};
          const Double3 at = meant.position - eco.origin + rotate(meant.rotation, p * meant.scale);
          EXPECT_LE(distance(at, to_double(instances[i].centre)), double{instances[i].radius});
        }
      }
    }
  }
}

// The judge is the machine: every page of the instances without one of the blocks that are asked for may not
// be touched.
TEST(BlockStream, TouchesNoPageOfABlockThatIsNotAskedFor) {
  constexpr std::size_t k_page = 4096, k_blocks = 64, k_each = 256;
  Ecosystem eco = little_ecosystem(false);
  constexpr std::size_t bytes = k_blocks * k_each * sizeof(PackedInstance);
  void* memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  ASSERT_NE(memory, MAP_FAILED);
  const std::shared_ptr<void> owner(memory, [](void* p) { munmap(p, bytes); });
  auto* instances = static_cast<PackedInstance*>(memory);
  for (std::size_t i = 0; i < k_blocks * k_each; ++i) instances[i] = eco.packed[i % 20];
  std::vector<InstanceBlock> blocks(k_blocks, eco.blocks[0]);
  for (std::uint32_t b = 0; b < k_blocks; ++b) blocks[b].first = b * k_each, blocks[b].count = k_each;
  eco.blocks = blocks;
  eco.packed = Array<PackedInstance>({instances, k_blocks * k_each}, owner);
  const std::vector<std::uint32_t> wanted{3, 16, 17, 40};
  for (std::size_t page = 0; page < bytes / k_page; ++page) {
    bool needed = false;
    for (const std::uint32_t b : wanted) {
      const std::size_t begin = b * k_each * sizeof(PackedInstance),
                        end = begin + k_each * sizeof(PackedInstance);
      needed |= begin < (page + 1) * k_page && end > page * k_page;
    }
    const int rights = needed ? PROT_READ : PROT_NONE;
    ASSERT_EQ(mprotect(static_cast<char*>(memory) + page * k_page, k_page, rights), 0);
  }
  BlockStream stream(eco, 1 << 20);
  for (const std::uint32_t b : wanted) EXPECT_EQ(stream.block(b).size(), k_each);
  EXPECT_EQ(stream.counts().blocks, 4u);
  EXPECT_EQ(stream.counts().bytes, 4 * k_each * sizeof(PackedInstance));
  // 6144 bytes a block: 1.5 pages, and the two neighbours share one.
  EXPECT_EQ(stream.counts().pages, 2u + 3u + 2u);
}

TEST(BlockStream, WhatIsNotUsedGoesTheLongestUnusedFirst) {
  const Ecosystem eco = little_ecosystem(false);
  const std::size_t one = eco.blocks[0].count * sizeof(StreamedInstance);
  BlockStream stream(eco, 2 * one);
  for (const std::uint32_t b : {0u, 1u, 2u}) {
    stream.block(b);
    stream.next_frame();
  }
  EXPECT_LE(stream.kept_bytes(), 2 * one);
  const std::uint64_t before = stream.counts().unpacked;
  stream.block(2), stream.block(1);
  EXPECT_EQ(stream.counts().unpacked, before);
  stream.block(0);
  EXPECT_GT(stream.counts().unpacked, before);
  EXPECT_EQ(stream.counts().blocks, 3u);  // read at least once
}

TEST(BlockStream, WhatAFrameUsesStaysWhateverTheBudget) {
  const Ecosystem eco = little_ecosystem(false);
  BlockStream stream(eco, 0);
  const auto first = stream.block(0);
  const StreamedInstance copy = first[0];
  for (std::uint32_t b = 1; b < eco.blocks.size(); ++b) stream.block(b);
  EXPECT_EQ(std::memcmp(&copy.rows, &first[0].rows, sizeof copy.rows), 0);
  stream.next_frame();
  EXPECT_GT(stream.kept_bytes(), 0u);  // of the frame that has just ended
  stream.next_frame();
  EXPECT_EQ(stream.kept_bytes(), 0u);
}

TEST(BlockStream, ABlockThatIsDamagedGivesNothingAndIsNamed) {
  Ecosystem eco = little_ecosystem(false);
  std::vector<PackedInstance> packed = eco.packed.to_vector();
  packed[eco.blocks[2].first + 1].trunk_material = 200;
  eco.packed = packed;
  BlockStream stream(eco, 1 << 20);
  EXPECT_EQ(stream.block(1).size(), eco.blocks[1].count);
  EXPECT_EQ(stream.damaged(), k_none);
  EXPECT_TRUE(stream.block(2).empty());
  EXPECT_TRUE(stream.block(2).empty());
  EXPECT_EQ(stream.damaged(), 2u);
  EXPECT_EQ(stream.block(3).size(), eco.blocks[3].count);
}

}  // namespace
}  // namespace copse
