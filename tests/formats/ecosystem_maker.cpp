#include "tests/formats/ecosystem_maker.h"

#include "lib/formats/ecosystem/instance_codec.h"
#include "lib/formats/random.h"

#include <cmath>

namespace copse {

// Four leaves along the Hilbert curve, (0,0), (0,1), (1,1), (1,0) in (x, z), of 10 x 10 m each.
Ecosystem little_ecosystem(bool exact) {
  Ecosystem e;
  e.origin = {10, 0, 10};
  e.area = {0, 0, 20, 20};
  e.depth = 1;
  e.terrain.columns = e.terrain.rows = 3;
  e.terrain.spacing_x = e.terrain.spacing_z = 10;
  e.terrain.heights = std::vector<float>{0, 1, 2, 0, 1, 2, 0, 1, 2};
  e.terrain.material = 1;
  e.materials.resize(2);
  e.materials[0].name = "bark";
  e.materials[1].texture = 0;
  e.textures = {{.uri = "ground.png", .mime = "", .bytes = {}}};
  e.types.resize(2);
  e.types[0] = {.name = "oak",
                .uri = "oak.stree",
                .bounds = {{-1, 0, -1}, {1, 3, 1}},
                .instances = 32,
                .scale_min = 0.5f,
                .scale_max = 2};
  e.types[1] = {.name = "fern",
                .uri = "fern.tree",
                .bounds = {{-0.1f, 0, -0.1f}, {0.1f, 0.2f, 0.1f}},
                .instances = 28,
                .scale_min = 1,
                .scale_max = 1};
  const Double3 corners[4] = {{0, 0, 0}, {0, 0, 10}, {10, 0, 10}, {10, 0, 0}};
  Random random(1);
  std::vector<InstanceBlock> blocks;
  std::vector<PackedInstance> packed;
  std::vector<ExactInstance> exacts;
  std::vector<QuadNode> nodes(5);
  std::uint32_t first = 0;
  for (std::uint32_t leaf = 0; leaf < 4; ++leaf) {
    nodes[1 + leaf].first_block = static_cast<std::uint32_t>(blocks.size());
    for (std::uint32_t type = 0; type < 2; ++type) {
      InstanceBlock b;
      b.type = type, b.first = first, b.count = type == 0 ? 8 : 7;
      b.origin = corners[leaf];
      if (!exact) b.step = {0x1p-16f, 0x1p-16f, 0x1p-16f};
      DoubleBox box;
      for (std::uint32_t i = 0; i < b.count; ++i) {
        const double angle = random.uniform(0, 3);
        Instance instance{
            .position = corners[leaf] + Double3{random.uniform(0, 10), 1, random.uniform(0, 10)},
            .rotation = {0, std::sin(angle), 0, std::cos(angle)},
            .scale = type == 0 ? random.uniform(0.5, 2) : 1,
            .type = type,
            .trunk_material = i % 2 == 0 ? 0 : k_none,
            .motion = i};
        const Instance stored =
            exact ? unpack(exacts.emplace_back(pack_exactly(instance, b)), b)
                  : unpack(packed.emplace_back(pack(instance, b, e.types[type])), b, e.types[type]);
        box.grow(transformed(e.types[type].bounds, stored));
      }
      b.bounds = round_outward(
          {box.min - e.origin - Double3{1e-6, 1e-6, 1e-6}, box.max - e.origin + Double3{1e-6, 1e-6, 1e-6}});
      nodes[1 + leaf].bounds.grow(b.bounds);
      ++nodes[1 + leaf].block_count;
      first += b.count;
      blocks.push_back(b);
    }
    nodes[0].bounds.grow(nodes[1 + leaf].bounds);
  }
  nodes[0].block_count = static_cast<std::uint32_t>(blocks.size());
  e.bounds = nodes[0].bounds;
  e.blocks = std::move(blocks);
  e.boxes = std::move(nodes);
  e.packed = std::move(packed);
  e.exact = std::move(exacts);
  return e;
}

}  // namespace copse
