#include "lib/formats/tree_file/tree_volumes.h"

#include "lib/formats/tree_file/tree_file.h"
#include "tests/formats/tampering.h"
#include "tests/formats/tree_maker.h"

#include <cstring>

#include <gtest/gtest.h>

namespace copse {
namespace {

using Bytes = std::vector<std::uint8_t>;

struct Builder {
  std::vector<VolumeSet> sets;
  std::vector<VolumeRecord> volumes;
  std::vector<float> numbers;
  std::vector<VolumeNode> nodes;

  void set(VolumePart part, std::uint32_t index, const std::vector<Volume<float>>& of) {
    sets.push_back({.part = part,
                    .index = index,
                    .first = static_cast<std::uint32_t>(volumes.size()),
                    .count = static_cast<std::uint32_t>(of.size()),
                    .chosen = static_cast<std::uint32_t>(of.size() - 1),
                    .points = 9});
    for (const Volume<float>& v : of) {
      const std::vector<float> n = numbers_of(v);
      VolumeRecord r{.kind = kind_of(v),
                     .flags = VolumeRecord::certified,
                     .first = static_cast<std::uint32_t>(numbers.size()),
                     .count = static_cast<std::uint32_t>(n.size()),
                     .volume = 2,
                     .lower_bound = 1};
      std::memcpy(r.method.data(), "minimal", 7);
      volumes.push_back(r);
      numbers.insert(numbers.end(), n.begin(), n.end());
    }
  }
  TreeVolumes volumes_of() const { return {sets, volumes, numbers, nodes}; }
};

Builder sample() {
  Builder b;
  b.set(VolumePart::whole, k_none,
        {FloatBox{{0, 0, 0}, {1, 1, 1}}, BoundingSphere<float>{{1, 2, 3}, 4},
         Kdop<float>{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0}, {1, 1, 1}}});
  b.set(VolumePart::group, 0, {Capsule<float>{{0, 0, 0}, {1, 0, 0}, 2}});
  b.set(VolumePart::group, 1, {Capsule<float>{{0, 0, 0}, {2, 0, 0}, 2}});
  b.set(VolumePart::node, 0, {BoundingSphere<float>{{0, 0, 0}, 9}});
  b.nodes = {{3, k_none, 3}, {2, 0, 1}, {3, 1, 2}};
  return b;
}

Bytes tree_bytes() {
  return *encode_tree(make_tree({.groups = 4}, 1));
}
Bytes with(const Builder& b) {
  const auto file = Container::from_bytes(tree_bytes(), "tree");
  return *with_volumes(*file, b.volumes_of());
}

TEST(TreeVolumes, ComeBackFromTheFileAndTheTreeStaysAsItWas) {
  const auto file = TreeFile::from_bytes(with(sample()), "tree");
  ASSERT_TRUE(file);
  EXPECT_TRUE(file->verify().empty()) << file->verify().front();
  const auto v = load_volumes(*file);
  ASSERT_TRUE(v) << v.error().what;
  const Builder b = sample();
  EXPECT_EQ(v->sets.to_vector(), b.sets);
  EXPECT_EQ(v->volumes.to_vector(), b.volumes);
  EXPECT_EQ(v->nodes.to_vector(), b.nodes);
  EXPECT_EQ(v->chosen(v->sets[1]), Volume<float>(Capsule<float>{{0, 0, 0}, {1, 0, 0}, 2}));
  EXPECT_EQ(v->volumes[0].method_name(), "minimal");
  EXPECT_EQ(set_name(v->sets[2]), "group 1");
  EXPECT_TRUE(same(*file->load(), make_tree({.groups = 4}, 1)));
}

TEST(TreeVolumes, AFileWithoutThemHasNone) {
  const auto v = load_volumes(*TreeFile::from_bytes(tree_bytes(), "tree"));
  ASSERT_TRUE(v);
  EXPECT_TRUE(v->empty());
}

TEST(TreeVolumes, AreReplacedAndRemovedWithoutATrace) {
  const auto once = with(sample());
  const auto again = with_volumes(*Container::from_bytes(once, "tree"), sample().volumes_of());
  EXPECT_EQ(*again, once);
  EXPECT_EQ(*with_volumes(*Container::from_bytes(once, "tree"), {}), tree_bytes());
}

TEST(TreeVolumes, AreCompressedBesideAPackedTreeAndInPlaceElsewhere) {
  const auto encoding = [](const Container& file) {
    const auto bytes = with_volumes(file, sample().volumes_of());
    return Container::from_bytes(*bytes, "tree")->find("VOLU")->encoding;
  };
  const Container plain = *Container::from_bytes(tree_bytes(), "tree");
  EXPECT_EQ(encoding(plain), Encoding::raw);
  ContainerWriter writer(plain);
  ASSERT_TRUE(writer.put("PACK", 1, 1, Bytes{0}));
  EXPECT_EQ(encoding(*Container::from_bytes(*writer.finish(), "tree")), Encoding::zstd);
}

TEST(TreeVolumes, EverySectionHasTheBytesOfTheSpecification) {
  const Bytes bytes = with(sample());
  const std::size_t set = tampering::section_at(bytes, "VSET");
  EXPECT_EQ(get<std::uint32_t>(bytes, set + 32), 3u);       // part: group
  EXPECT_EQ(get<std::uint32_t>(bytes, set + 32 + 4), 0u);   // index
  EXPECT_EQ(get<std::uint32_t>(bytes, set + 32 + 12), 3u);  // first volume
  EXPECT_EQ(get<std::uint32_t>(bytes, set + 24), 9u);       // points
  const std::size_t volume = tampering::section_at(bytes, "VOLU");
  EXPECT_EQ(get<std::uint32_t>(bytes, volume + 56), 1u);      // kind: sphere
  EXPECT_EQ(get<std::uint32_t>(bytes, volume + 56 + 8), 6u);  // its numbers come after the box's
  EXPECT_EQ(get<std::uint32_t>(bytes, volume + 56 + 12), 4u);
  EXPECT_EQ(std::memcmp(bytes.data() + volume + 16, "minimal\0", 8), 0);
  EXPECT_EQ(get<double>(bytes, volume + 40), 2);
  EXPECT_EQ(get<double>(bytes, volume + 48), 1);
  EXPECT_EQ(get<float>(bytes, tampering::section_at(bytes, "VNUM") + 4 * 9), 4.0f);  // the sphere's radius
  EXPECT_EQ(get<std::uint32_t>(bytes, tampering::section_at(bytes, "VNOD")), 3u);
}

struct Damage {
  const char* what;
  void (*damage)(Builder&);
  const char* says;
};

TEST(TreeVolumes, WhatIsNotSoundIsRefusedWithItsPlace) {
  const Damage damages[] = {
      {"part", [](Builder& b) { b.sets[0].part = static_cast<VolumePart>(7); }, "VSET[0]"},
      {"motion", [](Builder& b) { b.sets[1].motion = static_cast<VolumeMotion>(2); }, "VSET[1]"},
      {"index of the whole", [](Builder& b) { b.sets[0].index = 0; }, "VSET[0]: index"},
      {"group", [](Builder& b) { b.sets[2].index = 4; }, "VSET[2]: index"},
      {"gap", [](Builder& b) { b.sets[1].first = 4; }, "VSET[1]: its volumes"},
      {"too many", [](Builder& b) { b.sets[3].count = 0xffffffff; }, "VSET[3]: its volumes"},
      {"empty", [](Builder& b) { b.sets[3].count = 0; }, "VSET[3]: its volumes"},
      {"left over", [](Builder& b) { b.sets.pop_back(), b.nodes.clear(); }, "VOLU[5]: volumes of no set"},
      {"chosen", [](Builder& b) { b.sets[0].chosen = 3; }, "VSET[0]: what is chosen"},
      {"sway at rest", [](Builder& b) { b.sets[0].sway = 1; }, "VSET[0]"},
      {"sway", [](Builder& b) { b.sets[0].motion = VolumeMotion::envelope, b.sets[0].sway = std::nanf(""); },
       "VSET[0]"},
      {"kind", [](Builder& b) { b.volumes[0].kind = static_cast<VolumeKind>(8); },
       "VOLU[0]: an unknown kind"},
      {"numbers", [](Builder& b) { b.volumes[1].count = 5; }, "VOLU[1]: its numbers"},
      {"far numbers", [](Builder& b) { b.volumes[1].first = 0xfffffff0; }, "VOLU[1]: its numbers"},
      {"flags", [](Builder& b) { b.volumes[1].flags = 3; }, "VOLU[1]: unknown flags"},
      {"method", [](Builder& b) { b.volumes[1].method = {}; }, "VOLU[1]: a method"},
      {"hidden text", [](Builder& b) { b.volumes[1].method[20] = 'x'; }, "VOLU[1]: a method"},
      {"negative", [](Builder& b) { b.volumes[2].volume = -1; }, "VOLU[2]: a volume"},
      {"bound", [](Builder& b) { b.volumes[2].lower_bound = 3; }, "VOLU[2]: a volume"},
      {"radius", [](Builder& b) { b.numbers[9] = -4; }, "VOLU[1]: numbers that make no volume"},
      {"not finite", [](Builder& b) { b.numbers[0] = std::nanf(""); },
       "VOLU[0]: numbers that make no volume"},
      {"skip", [](Builder& b) { b.nodes[0].skip = 4; }, "VNOD[0]"},
      {"skip back", [](Builder& b) { b.nodes[1].skip = 1; }, "VNOD[1]"},
      {"past the parent",
       [](Builder& b) {
         b.nodes = {{3, k_none, 3}, {3, k_none, 3}, {4, 1, 2}, {4, 1, 2}};
       },
       "VNOD["},
      {"two roots", [](Builder& b) { b.nodes[0].skip = 2; }, "VNOD[0]"},
      {"set of a node", [](Builder& b) { b.nodes[2].set = 4; }, "VNOD[2]: set"},
      {"childless", [](Builder& b) { b.nodes[2].item = k_none; }, "VNOD[2]"},
  };
  for (const Damage& d : damages) {
    Builder b = sample();
    d.damage(b);
    const auto file = TreeFile::from_bytes(with(b), "tree");
    ASSERT_TRUE(file) << d.what;
    const auto v = load_volumes(*file);
    ASSERT_FALSE(v) << d.what;
    EXPECT_NE(v.error().what.find(d.says), std::string::npos) << d.what << ": " << v.error().what;
    EXPECT_FALSE(file->verify().empty()) << d.what;
  }
}

TEST(TreeVolumes, ForgedTablesAreRefused) {
  Bytes bytes = with(sample());
  tampering::set(bytes, tampering::entry_of(bytes, "VSET") + container_layout::k_entry_version, 2u);
  EXPECT_FALSE(load_volumes(*TreeFile::from_bytes(bytes, "tree")));
  bytes = with(sample());
  tampering::set(bytes, tampering::entry_of(bytes, "VNUM") + container_layout::k_entry_stride, 1u);
  EXPECT_FALSE(load_volumes(*TreeFile::from_bytes(bytes, "tree")));
  bytes = with(sample());
  bytes[tampering::section_at(bytes, "VNUM")] ^= 1;  // with the checksum as it was
  EXPECT_FALSE(load_volumes(*TreeFile::from_bytes(bytes, "tree")));
}

TEST(TreeVolumes, AnyFlippedByteIsRefusedOrHarmless) {
  const Bytes sound = with(sample());
  for (const char* section : {"VSET", "VOLU", "VNOD", "VNUM"}) {
    const std::size_t at = tampering::section_at(sound, section);
    const auto size =
        get<std::uint64_t>(sound, tampering::entry_of(sound, section) + container_layout::k_entry_stored);
    for (std::size_t i = 0; i < size; ++i) {
      Bytes bytes = sound;
      bytes[at + i] ^= 0xff;
      tampering::mend_checksums(bytes);
      const auto v = load_volumes(*TreeFile::from_bytes(bytes, "tree"));
      if (!v) continue;
      for (const VolumeSet& s : v->sets) EXPECT_TRUE(is_sound(v->chosen(s)));
    }
  }
}

}  // namespace
}  // namespace copse
